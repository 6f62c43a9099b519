"""Displacements of pinion and gear in their bearings under given forces, as a kernel."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion, expanded_forces
from gearlube_core.bearings.followed_shaft import N_FORCES, expand_about
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.kernels.damped_newton import damped_newton, newton_work_size
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

OK = 0
NO_EQUILIBRIUM = 4
N_FREE = 6  # displacements of pinion and gear
_LARGEST_ERROR = 1e-4  # of the forces, in any balance
_LEAST_FORCE = 1.0  # N, of which this share is taken at least
_SCALE = 1e-6  # m, a displacement that matters
# Springs that hold shafts without contact while their bearings are found, then are taken away
_STIFFEST = 1e9  # N/m
_SOFTENING = 0.1
_SOFTENINGS = 10

_AT_SCALE = N_FORCES
_AT_OUT = _AT_SCALE + N_FREE
_AT_SOFT = _AT_OUT + N_FREE
_AT_NEWTON = _AT_SOFT + 1
REST_WORK = _AT_NEWTON + newton_work_size(N_FREE)


class _Problem(NamedTuple):
    """Inputs of the displacements at rest."""

    forces: Array  # from outside on pinion and gear, x y z of each [N]
    oil: LubricantState
    p: AxleParameters
    soft: Array  # stiffness of springs on every displacement [N/m], shape (1,)
    expansion: Array  # work space, shape (N_FORCES,)


@kernel
def pinion_motion(u: Array, speed: float) -> ShaftMotion:
    """Return the motion of the pinion at rest at `u`, (N_FREE,), turning.

    The shaft lies along x: r1 = z, r2 = y turns with the pinion, which drives about -x.
    """
    return ShaftMotion(u[2], u[1], u[0], 0.0, 0.0, 0.0, 0.0, speed)


@kernel
def gear_motion(u: Array, speed: float) -> ShaftMotion:
    """Return the motion of the gear likewise; the shaft lies along z."""
    return ShaftMotion(u[3], u[4], u[5], 0.0, 0.0, 0.0, 0.0, speed)


@kernel
def _missing(u: Array, problem: Any, out: Array) -> None:
    p, oil, at = problem.p, problem.oil, problem.expansion
    still = reference_frequency(p.mesh, 0.0)
    pinion, gear = pinion_motion(u, 0.0), gear_motion(u, 0.0)
    expand_about(p.bearing_p, pinion, still, oil, at)
    out[2], out[1], out[0], _ = expanded_forces(p.bearing_p, pinion, at)
    expand_about(p.bearing_g, gear, still, oil, at)
    out[3], out[4], out[5], _ = expanded_forces(p.bearing_g, gear, at)
    for i in range(N_FREE):
        out[i] += problem.forces[i] - problem.soft[0] * u[i]


_displacements = damped_newton(_missing)


@kernel
def shafts_at_rest(
    u: Array, forces: Array, size: float, oil: LubricantState, p: AxleParameters, work: Array
) -> tuple[int, float]:
    """Write the displacements of pinion and gear under forces from outside into `u` [m].

    Parameters
    ----------
    u, forces : ndarray of shape (N_FREE,)
        x y z of the pinion, then of the gear; `forces` [N].
    size : float
        Of the forces, for the tolerance [N].
    oil : LubricantState
    p : AxleParameters
        Without losses, see `kernel_parameters.without_losses`: at rest they play no part.
    work : ndarray of shape (>= REST_WORK,)

    Returns
    -------
    tuple of (int, float)
        OK or NO_EQUILIBRIUM; the largest error of a balance of forces [N].
    """
    expansion, scale = work[0:_AT_SCALE], work[_AT_SCALE:_AT_OUT]
    out, soft = work[_AT_OUT:_AT_SOFT], work[_AT_SOFT:_AT_NEWTON]
    for i in range(N_FREE):
        scale[i] = _SCALE
    problem = _Problem(forces, oil, p, soft, expansion)
    limit = _LARGEST_ERROR * max(size, _LEAST_FORCE)
    worst = math.inf
    for attempt in range(_SOFTENINGS + 2):
        # without springs first, then with softer and softer ones, at last without any
        soft[0] = 0.0
        if 0 < attempt <= _SOFTENINGS:
            soft[0] = _STIFFEST * _SOFTENING ** (attempt - 1)
        if attempt <= 1:
            for i in range(N_FREE):
                u[i] = 0.0
        _displacements(u, scale, problem, work[_AT_NEWTON:REST_WORK])
        if soft[0] == 0.0:
            _missing(u, problem, out)
            worst = 0.0
            for i in range(N_FREE):
                worst = max(worst, abs(out[i])) if abs(out[i]) < math.inf else math.inf
            if worst <= limit:
                break
    return (OK if worst <= limit else NO_EQUILIBRIUM), worst
