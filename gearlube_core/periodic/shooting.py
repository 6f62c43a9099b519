"""Periodic motions at a given parameter by shooting."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ConvergenceError
from gearlube_core.periodic.floquet import Multipliers, floquet_multipliers, stability_margin
from gearlube_core.periodic.newton import Correction, NewtonSettings, Status, correct
from gearlube_core.periodic.problem import PeriodicProblem

_DEFAULTS = NewtonSettings()
_CURES = {
    "iteration limit": "Start closer, or follow a branch from a parameter that converges.",
    "no descent": "Start closer, or follow a branch; near grazing refine the steps of the map.",
    "singular Jacobian": "A fold or branch point lies at this parameter: move it, or follow.",
    "map not finite at the start": "Start from a state that the model can integrate.",
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PeriodicMotion:
    """A periodic motion with the record of its iteration.

    Parameters
    ----------
    unknowns : ndarray, shape (m,)
        z, in the problem's units.
    parameter
        p, in its unit.
    monodromy : ndarray, shape (k, k)
        Of the last evaluation.
    multipliers : ndarray of complex, shape (k - trivial,)
        Floquet multipliers, largest first, without the trivial ones.
    status
        `converged`, or what stopped the iteration.
    evaluations
        Calls of the problem's residual.
    history : tuple of float
        Norm of the scaled residual [-] at the start and after each Newton step.
    """

    unknowns: Array
    parameter: float
    monodromy: Array
    multipliers: Multipliers
    status: Status
    evaluations: int
    history: tuple[float, ...]

    @property
    def converged(self) -> bool:
        """Whether the equations hold within the tolerance."""
        return self.status == "converged"

    @property
    def iterations(self) -> int:
        """Newton steps taken."""
        return len(self.history) - 1

    @property
    def residual(self) -> float:
        """Norm of the scaled residual [-]."""
        return self.history[-1]

    @property
    def margin(self) -> float:
        """1 - max |mu| [-]; negative when unstable."""
        return stability_margin(self.multipliers)

    @property
    def stable(self) -> bool:
        """Whether small disturbances die out."""
        return self.margin > 0.0


def solve_periodic(
    problem: PeriodicProblem,
    start: Array,
    parameter: float,
    *,
    settings: NewtonSettings = _DEFAULTS,
    throw: bool = True,
) -> PeriodicMotion:
    """Return the periodic motion near `start` at a fixed parameter.

    Parameters
    ----------
    problem
        Equations and scales of the unknowns.
    start : ndarray, shape (m,)
        Unknowns to start from. Of several coexisting motions, the start decides.
    parameter
        p, in its unit.
    settings
        Tolerance and limits of Newton's method.
    throw
        Raise if it does not converge; else hand back the last iterate with its status.

    Raises
    ------
    ParameterError
        Start of the wrong shape or not finite.
    ConvergenceError
        Newton's method stopped without reaching the tolerance.

    Notes
    -----
    Single shooting: errors grow over the period with the largest multiplier, so that motions with
    multipliers above about 1e6 are out of reach.

    Examples
    --------
    The fixed point z = 2 of z -> p z + 1 at p = 0.5, with multiplier p:

    >>> from gearlube_core.periodic.problem import fixed_point_residual
    >>> def line(z, p):
    ...     return p * z + 1.0, np.array([[p]]), z
    >>> problem = PeriodicProblem(
    ...     residual=fixed_point_residual(line), unknown_scale=np.ones(1), parameter_scale=1.0
    ... )
    >>> motion = solve_periodic(problem, np.zeros(1), 0.5)
    >>> float(motion.unknowns[0]), motion.stable, motion.margin
    (2.0, True, 0.5)
    """
    place = problem.place(start, parameter)
    correction = correct(problem, place, np.eye(place.size)[-1], settings)
    if throw:
        require(problem, correction)
    z, _ = problem.unscaled(correction.evaluation.place)
    monodromy = correction.evaluation.monodromy
    return PeriodicMotion(
        unknowns=z,
        parameter=float(parameter),
        monodromy=monodromy,
        multipliers=floquet_multipliers(monodromy, trivial=problem.trivial_multipliers),
        status=correction.status,
        evaluations=correction.evaluations,
        history=correction.history,
    )


def require(problem: PeriodicProblem, correction: Correction) -> None:
    """Raise ConvergenceError unless the iteration converged."""
    if not correction.converged:
        _, p = problem.unscaled(correction.evaluation.place)
        raise ConvergenceError(
            f"No periodic motion found near the start at parameter {p:g}: {correction.status} "
            f"after {correction.iterations} steps, scaled residual {correction.history[-1]:.2g}. "
            f"{_CURES[correction.status]}"
        )
