"""Switching to the new branch at a branch point or period doubling."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.periodic.branch import SpecialPoint
from gearlube_core.periodic.newton import NewtonSettings, correct
from gearlube_core.periodic.problem import PeriodicProblem

_DEFAULTS = NewtonSettings()
_SINGULAR = 1e-3  # second smallest singular value over the largest at a branch point, at most
_HALVINGS = 6


class BranchStart(NamedTuple):
    """Start of `follow` on a new branch: z, p, and the direction away from the old branch."""

    unknowns: Array
    parameter: float
    heading: Array


def switch_branch(
    problem: PeriodicProblem,
    point: SpecialPoint,
    *,
    step: float = 0.05,
    settings: NewtonSettings = _DEFAULTS,
) -> BranchStart:
    """Return a motion on the branch that leaves at a special point.

    Parameters
    ----------
    problem
        The same problem at a branch point. At a period doubling, the same unknowns over two
        periods, for instance by `fixed_point_residual(period_map, periods=2)`: there the
        point is a branch point.
    point
        Branch point or period doubling.
    step
        Scaled distance [-] at which to look; halved up to six times. Its sign chooses the side: the
        two sides of a period doubling are the same motion, one period apart.
    settings
        Tolerance and limits of Newton's method.

    Raises
    ------
    ParameterError
        No other branch leaves there.
    ConvergenceError
        None was found.

    Notes
    -----
    At a branch point the derivative [dr/dz, dr/dp] has a null space of dimension two. The search
    goes along the direction in it that is normal to the known branch, and is held at that distance,
    so that it cannot fall back onto the known branch ([keller_1977]).
    """
    check_finite("step", step)
    centre = problem.place(point.unknowns, point.parameter)
    values, directions = np.linalg.svd(problem.evaluate(centre).jacobian)[1:]
    if values[-1] > _SINGULAR * max(values[0], 1.0):
        raise ParameterError(
            f"No branch of this period leaves the {point.kind} at parameter {point.parameter:g}: "
            f"smallest singular value {values[-1]:.2g}, but it must be near 0. At a period "
            "doubling give the problem over two periods."
        )
    plane = directions[-2:]
    across = np.array([plane[1] @ point.tangent, -(plane[0] @ point.tangent)]) @ plane
    across /= float(np.linalg.norm(across))
    across *= 1.0 if across[np.argmax(np.abs(across))] > 0.0 else -1.0
    for halving in range(_HALVINGS + 1):
        place = centre + step * 0.5**halving * across
        correction = correct(problem, place, across, settings)
        if correction.converged:
            found = correction.evaluation.place
            return BranchStart(*problem.unscaled(found), found - centre)
    raise ConvergenceError(
        f"No branch found beside the {point.kind} at parameter {point.parameter:g} within "
        f"{abs(step):g} unknown scales: {correction.status}. Try another step or its other sign."
    )
