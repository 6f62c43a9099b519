"""Static equilibrium of the axle under its pinion torque, as a kernel."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_rhs
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_ODE,
    N_STATE,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, series_size
from gearlube_core.dynamics.hypoid_mesh.step_parts import MICRO
from gearlube_core.kernels.damped_newton import damped_newton, newton_work_size
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, R_P, load_bracket
from gearlube_core.oil.lubricant import LubricantState, lubricant_state

OK = 0
NO_EQUILIBRIUM = 4  # beside the statuses of `integrate.advance`
NO_EQUILIBRIUM_CURE = "Increase the bearing preload or reduce the torque."

N_FREE = 6  # displacements of pinion and gear
_LARGEST_ERROR = 1e-4  # of the mesh force, in any balance of forces
_LEAST_FORCE = 1.0  # N, of which this share is taken at least
_SCALE = 1.0  # um, a displacement that matters
# Springs that hold shafts without contact while their bearings are found, then are taken away
_STIFFEST = 1e3  # N/um
_SOFTENING = 0.1
_SOFTENINGS = 10

_AT_SLOPE = SCRATCH
_AT_SERIES = _AT_SLOPE + N_ODE
_AT_STATE = _AT_SERIES + N_SERIES
_AT_U = _AT_STATE + N_STATE
_AT_SOFT = _AT_U + 3 * N_FREE
_AT_PUSH = _AT_SOFT + 1
_AT_NEWTON = _AT_PUSH + N_FREE
REST_WORK = _AT_NEWTON + newton_work_size(N_FREE)


class RestProblem(NamedTuple):
    """What the displacements at rest depend on; all of it but `p` is or has work space."""

    s: Array  # state at rest, shape (N_STATE,)
    inputs: StepInputs
    mesh: MeshAtLoad
    oil: LubricantState
    p: AxleParameters
    soft: Array  # stiffness of springs on every displacement [N/um], shape (1,)
    push: Array  # further forces on pinion and gear [N], shape (N_FREE,)
    scratch: Array  # shape (SCRATCH,)
    slope: Array  # shape (N_ODE,)


@kernel
def mean_series(torque: float, mesh: MeshLevels, means: Array) -> None:
    """Write the means of the series at the pinion torque [N.m] into `means`, (N_SERIES,)."""
    bracket = load_bracket(torque, torque, mesh.levels, mesh.levels.size)
    size = series_size(mesh)
    first = bracket.lower * size
    second = bracket.upper * size
    for i in range(N_SERIES):
        low = mesh.series[first + i]
        means[i] = low + bracket.weight * (mesh.series[second + i] - low)


@kernel
def rest_forces(u: Array, problem: Any, out: Array) -> None:
    """Write the forces on pinion and gear [N] at the displacements `u` [um], shapes (N_FREE,)."""
    s = problem.s
    for i in range(3):
        s[U_P + i] = u[i]
        s[U_G + i] = u[3 + i]
    axle_rhs(
        s,
        problem.inputs,
        problem.mesh,
        problem.oil,
        problem.p,
        1.0,
        1.0,
        problem.scratch,
        problem.slope,
    )
    for i in range(3):
        out[i] = problem.p.m_p * problem.slope[V_P + i] - problem.soft[0] * u[i]
        out[3 + i] = problem.p.m_g * problem.slope[V_G + i] - problem.soft[0] * u[3 + i]
    for i in range(N_FREE):
        out[i] += problem.push[i]


_displacements = damped_newton(rest_forces)


@kernel
def rest_under(
    s: Array,
    speed: float,
    torque: float,
    oil_temperature: float,
    mesh: MeshLevels,
    p: AxleParameters,
    push: Array,
    work: Array,
) -> tuple[int, float]:
    """Write the static equilibrium under the pinion torque and further forces into `s`, turning.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        On return the state, with zeros for angles, velocities and energies.
    speed : float
        Of the pinion [rad/s].
    torque : float
        Of the pinion [N.m].
    oil_temperature : float
        [K]
    mesh : MeshLevels
    p : AxleParameters
        Without losses, see `kernel_parameters.without_losses`: at rest they play no part.
    push : ndarray of shape (N_FREE,)
        Further forces on pinion and gear, x y z of each [N].
    work : ndarray of shape (>= REST_WORK,)

    Returns
    -------
    tuple of (int, float)
        OK or NO_EQUILIBRIUM; the largest error of a balance of forces [N].
    """
    scratch = work[0:_AT_SLOPE]
    slope = work[_AT_SLOPE:_AT_SERIES]
    series = work[_AT_SERIES:_AT_STATE]
    at_rest = work[_AT_STATE:_AT_U]
    u = work[_AT_U : _AT_U + N_FREE]
    scale = work[_AT_U + N_FREE : _AT_U + 2 * N_FREE]
    out = work[_AT_U + 2 * N_FREE : _AT_SOFT]
    soft = work[_AT_SOFT:_AT_NEWTON]
    oil = lubricant_state(p.oil, oil_temperature, mesh.laws)
    mean_series(torque, mesh, series)
    deflection = torque / series[R_P] / series[K_M]
    for i in range(N_STATE):
        s[i] = 0.0
    s[X] = MICRO * (deflection if deflection >= 0.0 else deflection - p.mesh.backlash)
    s[LOAD_TORQUE] = abs(torque)
    s[SIDE] = -1.0 if torque < 0.0 else 1.0
    for i in range(N_STATE):
        at_rest[i] = s[i]
    for i in range(N_FREE):
        scale[i] = _SCALE
    at_load = MeshAtLoad(series, 0, mesh.windows, mesh.n_nodes, mesh.film_model)
    inputs = StepInputs(torque, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    problem = RestProblem(at_rest, inputs, at_load, oil, p, soft, push, scratch, slope)
    limit = _LARGEST_ERROR * max(abs(torque / series[R_P]), _LEAST_FORCE)
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
            rest_forces(u, problem, out)
            worst = 0.0
            for i in range(N_FREE):
                worst = max(worst, abs(out[i])) if abs(out[i]) < math.inf else math.inf
            if worst <= limit:
                break
    for i in range(3):
        s[U_P + i] = u[i]
        s[U_G + i] = u[3 + i]
    s[W_P] = speed
    s[W_G] = speed / p.ratio
    return (OK if worst <= limit else NO_EQUILIBRIUM), worst


@kernel
def rest(
    s: Array,
    speed: float,
    torque: float,
    oil_temperature: float,
    mesh: MeshLevels,
    p: AxleParameters,
    work: Array,
) -> tuple[int, float]:
    """Write the static equilibrium under the pinion torque into `s`, turning; see `rest_under`."""
    push = work[_AT_PUSH:_AT_NEWTON]
    for i in range(N_FREE):
        push[i] = 0.0
    return rest_under(s, speed, torque, oil_temperature, mesh, p, push, work)
