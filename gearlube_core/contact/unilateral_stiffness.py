"""Tangent stiffness of a loaded unilateral contact."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.unilateral_problem import UnilateralProblem, UnilateralSolution
from gearlube_core.errors import ConvergenceError, ParameterError


def tangent_stiffness(
    problem: UnilateralProblem,
    solution: UnilateralSolution,
    *,
    tolerance: float = 1e-4,
    max_iterations: int = 1000,
) -> float:
    """Return dT/d(delta) for a fixed set of loaded cells.

    A y = R on loaded cells, y = 0 elsewhere;  dT/d(delta) = R.y

    Parameters
    ----------
    problem, solution
        The contact and its converged state.
    tolerance
        Limit of the root mean square of 1 - A y/R on loaded cells [-], 1e-12 to 1e-1; the
        stiffness is about as accurate.
    max_iterations
        Where to stop without convergence.

    Returns
    -------
    float
        Tangent stiffness [N m/rad]; T/delta counted from first contact is the secant.

    Raises
    ------
    ParameterError
        No cell is loaded, or the compliance is not positive definite.
    ConvergenceError
        The tolerance was not reached.

    Notes
    -----
    Exact for a smooth gap up to the discretisation: as the loaded area grows, its edge carries no
    pressure, so the moving edge adds nothing to first order.
    """
    forces = tangent_forces(problem, solution, tolerance=tolerance, max_iterations=max_iterations)
    return float(np.where(solution.touching, problem.arm, 0.0) @ forces)


def tangent_forces(
    problem: UnilateralProblem,
    solution: UnilateralSolution,
    *,
    tolerance: float = 1e-4,
    max_iterations: int = 1000,
) -> Array:
    """Return y = df/d(delta) of `tangent_stiffness`, cell by cell [N/rad], shape (n,).

    Parameters and errors as there. Local values are less smooth than their sum: cells at the edge
    of the contact share the singularity of a flat punch.
    """
    check_within("tolerance", tolerance, 1e-12, 1e-1)
    loaded = solution.touching
    if not loaded.any():
        raise ParameterError("solution must have loaded cells, got none: the stiffness is zero.")
    arm = np.where(loaded, problem.arm, 0.0)
    # the forces themselves are the first guess, scaled to the least energy: A f is known
    scale = solution.torque / (2.0 * solution.strain_energy)
    y = scale * solution.forces
    residual = np.where(loaded, arm - scale * solution.displacement, 0.0)
    # in the moments q = R y, as the contact is solved
    direction = np.zeros(arm.size)
    square_before, limit = np.inf, tolerance**2 * float(loaded.sum())
    for _ in range(max_iterations):
        scaled = np.divide(residual, arm, out=np.zeros(arm.size), where=loaded)
        square = float(scaled @ scaled)
        if square <= limit:
            return np.asarray(y)
        direction = scaled + (square / square_before) * direction
        probe = np.divide(direction, arm, out=np.zeros(arm.size), where=loaded)
        product = np.where(loaded, problem.compliance(probe), 0.0)
        curvature = float(probe @ product)
        if not curvature > 0.0:
            raise ParameterError(
                "compliance must be positive definite on loaded cells, got the work "
                f"{curvature:g} J along a search direction."
            )
        y += (square / curvature) * probe
        residual -= (square / curvature) * product
        square_before = square
    raise ConvergenceError(
        f"tangent stiffness must reach a residual of {tolerance:g}, got "
        f"{(square / float(loaded.sum())) ** 0.5:.3g} after {max_iterations} iterations. Raise "
        "max_iterations or the tolerance."
    )
