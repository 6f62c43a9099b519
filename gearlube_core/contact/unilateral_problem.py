"""Statement and solution of a frictionless unilateral contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError, ParameterError

Compliance = Callable[[Array], Array]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UnilateralProblem:
    """Cells that may press but not pull, closed by one rotation.

    g + u - R delta >= 0,  f >= 0,  f.(g + u - R delta) = 0,  u = A f,  T = R.f

    Parameters
    ----------
    compliance
        A: maps cell forces [N], shape (n,), to displacement [m], same shape; symmetric and
        positive definite on the unmasked cells. It may return a buffer that it overwrites.
    gap : ndarray, shape (n,)
        Normal gap g [m] without load at rotation zero; inf masks a cell. May be negative.
    arm : ndarray, shape (n,)
        R [m]: closing of a cell per unit rotation, above zero where the gap is finite. With
        arm one everywhere, the rotation is an approach [m] and the torque a load [N].
    cell_area : ndarray, shape (n,)
        Area [m2] over which a cell's force is spread.

    Raises
    ------
    ParameterError
        Shapes differ, an entry is NaN or out of range, or every cell is masked.
    """

    compliance: Compliance
    gap: Array
    arm: Array
    cell_area: Array

    def __post_init__(self) -> None:
        for name in ("gap", "arm", "cell_area"):
            field = np.array(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, field)
            if field.ndim != 1 or field.shape != self.gap.shape:
                raise ParameterError(
                    f"{name} must be flat with one entry a cell, {self.gap.shape}, "
                    f"got shape {field.shape}."
                )
        unusable = np.isnan(self.gap) | (self.gap == -math.inf)
        if unusable.any():
            raise ParameterError(
                f"gap must be finite or inf in m, got NaN or -inf in {unusable.sum()} cells, first "
                f"in cell {int(np.argmax(unusable))}. Mask cells outside the teeth with inf."
            )
        if not np.isfinite(self.gap).any():
            raise ParameterError(
                f"gap must be finite in at least one cell, got {self.gap.size} masked cells: "
                "nothing can touch. Check that the strip lies on the teeth."
            )
        for name, unit in (("arm", "m"), ("cell_area", "m2")):
            values = getattr(self, name)
            bad = np.isfinite(self.gap) & ~((values > 0.0) & np.isfinite(values))
            if bad.any():
                cell = int(np.argmax(bad))
                raise ParameterError(
                    f"{name} must be above 0 {unit} in unmasked cells, got {values[cell]:g} in "
                    f"cell {cell}. Mask cells that the rotation does not close."
                )
            values[~np.isfinite(self.gap)] = 1.0  # masked cells are never loaded

    @property
    def usable(self) -> np.ndarray:
        """Cells that may touch, shape (n,)."""
        return np.isfinite(self.gap)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """Final status of an iteration.

    Parameters
    ----------
    status
        `converged` or `iteration limit`.
    iterations, operations
        Conjugate-gradient iterations, and applications of the compliance.
    residual
        Estimated error of the forces, root mean square over their mean [-].
    history
        Residual after each iteration [-]; infinite over the first ones, which cannot be judged.
    """

    status: Literal["converged", "iteration limit"]
    iterations: int
    operations: int
    residual: float
    history: tuple[float, ...]

    @property
    def converged(self) -> bool:
        """Whether the residual is within its tolerance."""
        return self.status == "converged"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UnilateralSolution:
    """Loaded cells in equilibrium.

    Parameters
    ----------
    forces, pressure, displacement, separation : ndarray, shape (n,)
        f [N], f over cell area [Pa], u [m], and gap left after loading [m] (inf if masked).
    rotation, torque
        delta [rad] and R.f [N m].
    touching : ndarray of bool, shape (n,)
        Cells with f > 0.
    strain_energy
        f.u/2 [J].
    outcome
        How the iteration ended.
    """

    forces: Array
    pressure: Array
    displacement: Array
    separation: Array
    rotation: float
    torque: float
    touching: np.ndarray
    strain_energy: float
    outcome: Outcome


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
