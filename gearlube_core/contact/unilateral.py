"""Frictionless unilateral contact of many cells about one closing rotation."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.contact.unilateral_kernels import (
    conjugate_direction,
    direction_with_penetration,
    longest_step,
    project,
    step_length,
    update_separation,
)
from gearlube_core.contact.unilateral_problem import Outcome, UnilateralProblem, UnilateralSolution
from gearlube_core.errors import ConvergenceError, ParameterError

_FINEST = 1e-12  # least tolerance; rounding of the convolution ends the descent at such gaps
_SAFETY, _RECENT = 8.0, 4  # of the error, and iterations whose steps it takes
_PROPORTION = 0.1  # penetrating over loaded squared residual at which cells are added


def solve_torque(
    problem: UnilateralProblem,
    torque: float,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = 2000,
    start: Array | None = None,
    throw: bool = True,
) -> UnilateralSolution:
    """Return the contact that balances a torque.

    Minimises f.A f/2 + g.f over f >= 0 with R.f = T by conjugate gradients in the moments
    q = R f, in which the compliance R^-1 A R^-1 stays symmetric and the constraint reads
    sum of q = T.

    Parameters
    ----------
    problem
        Cells, gaps and compliance.
    torque
        T [N m], above zero.
    tolerance
        Largest error of the forces, root mean square over their mean over all usable cells [-];
        1e-12 to 1e-2, kept down to 1e-9, where rounding begins. Rotation and strain energy are
        more accurate.
    max_iterations
        Where to stop without convergence.
    start : ndarray, shape (n,), optional
        Forces [N] to start from, e.g. of the torque before; negative entries and masked cells
        count as zero. The answer does not depend on it within the tolerance.
    throw
        Raise on `iteration limit`; else return the last state with that outcome.

    Returns
    -------
    UnilateralSolution
        Torque balance holds to rounding.

    Raises
    ------
    ParameterError
        Torque or settings out of range, or a compliance that is not positive definite.
    ConvergenceError
        The tolerance was not reached within `max_iterations`.

    Notes
    -----
    Source: [polonsky_keer_1999] for the gradient under the load constraint, the projection
    and the load restored by scaling; [dostal_schoeberl_2005] for adding penetrating cells by
    an exact line search, once their part of the gradient is out of proportion. Polonsky and
    Keer's own step for penetrating cells may diverge where a smooth compliance couples all
    cells. Where the projected step would raise the energy, the step goes towards the nearest
    moments on the gradient's path, [dai_fletcher_2006], as far as the energy falls: many cells
    let go at once, so that equal cells do not leave one by one. Between changes of the loaded
    set the displacement follows the step: one application of A an iteration instead of two.

    The error of the forces is A^-1 r of the separations r that are left. It is estimated as 8
    times the norm of r times the longest of the last 4 steps along the gradient; these lie between
    the inverses of the largest and the smallest eigenvalue of A.

    Examples
    --------
    Two springs of 1e8 N/m on arms of 20 mm, the second 2 um late:

    >>> springs = UnilateralProblem(
    ...     compliance=lambda forces: 1e-8 * forces,
    ...     gap=np.array([0.0, 2e-6]),
    ...     arm=np.array([0.02, 0.02]),
    ...     cell_area=np.array([1e-6, 1e-6]),
    ... )
    >>> solve_torque(springs, 10.0).forces.round(3).tolist()
    [350.0, 150.0]
    """
    check_positive("torque", torque, "N m", "Turn the problem round for the other flank.")
    forces, operations = _starting_forces(problem, start), 0
    if not forces.any():
        forces = np.where(problem.usable, 1.0, 0.0)
        spread = _displaced(problem, forces)
        forces = _winkler_forces(problem, torque, float(spread @ forces) / float(forces.sum()))
        operations = 1
    forces *= torque / float(problem.arm @ forces)
    return _solve(
        problem, forces, math.nan, float(torque), tolerance, max_iterations, throw, operations
    )


def solve_rotation(
    problem: UnilateralProblem,
    rotation: float,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = 2000,
    start: Array | None = None,
    throw: bool = True,
) -> UnilateralSolution:
    """Return the contact at a prescribed closing rotation; its torque is a result.

    Parameters, errors and source as in `solve_torque`, without the constraint on the moments.
    `rotation` is delta [rad]; where it closes no gap all forces are zero, without error. The torque
    is accurate to a few times the tolerance. Takes about as many iterations as a given torque.
    """
    check_finite("rotation", rotation, "rad")
    forces = _starting_forces(problem, start)
    closing = np.where(problem.usable, problem.arm * rotation - problem.gap, 0.0)
    if not forces.any():
        forces = np.maximum(closing, 0.0)
    operations = int(forces.any())
    if operations:
        work, twice_energy = float(forces @ closing), float(forces @ _displaced(problem, forces))
        if work > 0.0:
            forces *= work / twice_energy  # least energy among all multiples
    return _solve(
        problem, forces, float(rotation), math.nan, tolerance, max_iterations, throw, operations
    )


def _starting_forces(problem: UnilateralProblem, start: Array | None) -> Array:
    if start is None:
        return np.zeros(problem.gap.size)
    forces = np.array(start, dtype=np.float64)
    if forces.shape != problem.gap.shape or not np.isfinite(forces).all():
        raise ParameterError(
            f"start must hold one finite force a cell, shape {problem.gap.shape}, got shape "
            f"{forces.shape}. Leave it out to start from scratch."
        )
    return np.where(problem.usable, np.maximum(forces, 0.0), 0.0)


def _winkler_forces(problem: UnilateralProblem, torque: float, softness: float) -> Array:
    """Return max(R delta - g, 0)/softness with delta from the torque balance."""
    touch = np.where(problem.usable, problem.gap / problem.arm, math.inf)
    order = np.argsort(touch, kind="stable")[: int(problem.usable.sum())]
    weight = np.cumsum(problem.arm[order] ** 2)
    candidates = (softness * torque + np.cumsum(problem.arm[order] ** 2 * touch[order])) / weight
    # candidates with one more cell fall until the next cell no longer touches
    next_touch = np.append(touch[order][1:], math.inf)
    rotation = candidates[int(np.argmax(candidates <= next_touch))]
    closing = np.where(problem.usable, problem.arm * rotation - problem.gap, 0.0)
    return np.maximum(closing, 0.0) / softness


def _displaced(problem: UnilateralProblem, forces: Array) -> Array:
    """Return the displacement under forces that do not all vanish; check that A can be inverted."""
    displacement = np.array(problem.compliance(forces), dtype=np.float64)
    if displacement.shape != forces.shape or not np.isfinite(displacement).all():
        raise ParameterError(
            f"compliance must return a finite displacement of shape {forces.shape}, got shape "
            f"{displacement.shape} or an entry that is not finite."
        )
    work = float(forces @ displacement)
    if not work > 0.0:
        raise ParameterError(
            f"compliance must be positive definite, got the work f.u = {work:g} J under forces of "
            f"{float(forces.sum()):g} N in sum. Check the sign and symmetry of the smooth part."
        )
    return displacement


def _solve(
    problem: UnilateralProblem,
    forces: Array,
    rotation: float,
    torque: float,
    tolerance: float,
    max_iterations: int,
    throw: bool,
    operations: int,
) -> UnilateralSolution:
    """Iterate; rotation NaN means given torque, torque NaN means given rotation.

    `operations` counts what the start took.
    """
    check_within("tolerance", tolerance, _FINEST, 1e-2)
    check_within("max_iterations", max_iterations, 1, 1e6)
    fixed_torque = math.isnan(rotation)
    gap, arm = problem.gap, problem.arm
    weight = np.where(problem.usable, gap if fixed_torque else gap - rotation * arm, 0.0)
    residual, direction, probe = (np.zeros(gap.size) for _ in range(3))
    displacement = np.zeros(gap.size)
    if forces.any():
        displacement[:] = _displaced(problem, forces)
        operations += 1
    history: list[float] = []
    steps: list[float] = []
    loaded_before = math.inf
    while True:
        delta, loaded, penetrating, misfit, deepest, spread = update_separation(
            forces, displacement, gap, arm, rotation, residual
        )
        work = float(forces @ displacement)
        rounded = _relative(misfit, work, deepest * float(forces.sum()))
        softest = max(steps[-_RECENT:]) if len(steps) >= _RECENT else math.inf
        mean = max(float(forces.sum()) / math.sqrt(float(problem.usable.sum())), 1e-300)
        error = _SAFETY * softest * math.sqrt(spread) / mean
        history.append(rounded if rounded <= _FINEST else error)
        if history[-1] <= tolerance or len(history) > max_iterations:
            break
        if penetrating > _PROPORTION * loaded:
            direction_with_penetration(forces, residual, arm, fixed_torque, direction, probe)
            loaded = float(np.dot(direction, direction))
        else:
            conjugate_direction(
                forces, residual, arm, loaded / loaded_before, fixed_torque, direction, probe
            )
        loaded_before = loaded
        product = problem.compliance(probe)
        operations += 1
        tau = step_length(residual, direction, probe, product)
        steps.append(tau)
        limit = longest_step(forces, probe)
        if tau <= limit:
            forces -= tau * probe
            displacement -= tau * product
            continue
        before, displacement_before = forces.copy(), displacement
        energy = 0.5 * work + float(weight @ forces)
        project(forces, probe, arm, tau, torque)
        displacement = np.array(problem.compliance(forces))
        operations += 1
        if 0.5 * float(forces @ displacement) + float(weight @ forces) > energy:
            slope = np.where(problem.usable, residual, 0.0)
            step = _nearest_forces(problem, arm * before - tau * slope, torque) - before
            product = problem.compliance(step)
            operations += 1
            fall, curvature = -float(step @ (slope * arm)), float(step @ product)
            share = min(1.0, fall / curvature) if fall > 0.0 and curvature > 0.0 else 1.0
            forces = np.maximum(before + share * step, 0.0)
            displacement = displacement_before + share * product
            loaded_before = math.inf
    outcome = Outcome(
        status="converged" if history[-1] <= tolerance else "iteration limit",
        iterations=len(history) - 1,
        operations=operations,
        residual=history[-1],
        history=tuple(history),
    )
    if throw and not outcome.converged:
        raise ConvergenceError(
            f"contact must reach a residual of {tolerance:g}, got {outcome.residual:.3g} after "
            f"{outcome.iterations} iterations. Raise max_iterations, or check that the compliance "
            "is symmetric and positive definite."
        )
    return UnilateralSolution(
        forces=forces,
        pressure=forces / problem.cell_area,
        displacement=displacement,
        separation=residual * arm,
        rotation=delta,
        torque=float(arm @ forces),
        touching=forces > 0.0,
        strain_energy=0.5 * work,
        outcome=outcome,
    )


def _nearest_forces(problem: UnilateralProblem, moments: Array, torque: float) -> Array:
    """Return forces >= 0 whose moments are nearest to those given; their sum is the torque.

    max(q - m, 0)/R, with the one m [N m] that balances; m = 0 where the torque is NaN. Source:
    [dai_fletcher_2006].
    """
    usable = np.flatnonzero(problem.usable)
    taken = 0.0
    if not math.isnan(torque):
        falling = np.sort(moments[usable])[::-1]
        means = (np.cumsum(falling) - torque) / np.arange(1, falling.size + 1)
        taken = means[np.flatnonzero(falling > means)[-1]]
    forces = np.zeros(moments.size)
    forces[usable] = np.maximum(moments[usable] - taken, 0.0) / problem.arm[usable]
    return forces


def _relative(misfit: float, work: float, penetration: float) -> float:
    """Return the residual of complementarity, infinite where cells penetrate without load."""
    if work > 0.0:
        return max(misfit, penetration) / work
    return math.inf if penetration > 0.0 else 0.0
