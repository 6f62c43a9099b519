"""Derivatives of the forces on the axle, and the time step that follows from them."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.integrate import StepControl
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_rhs
from gearlube_core.dynamics.hypoid_axle.start import OK, mean_series
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, N_STATE, U_G, U_P, V_G, V_P, W_G, W_P, X
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels
from gearlube_core.dynamics.hypoid_mesh.step_parts import MICRO
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.spectral_radius import spectral_radius
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, N_X, R_G, R_P
from gearlube_core.oil.lubricant import lubricant_state

N_COORDINATES = 8  # rotations of pinion and gear, displacements of pinion and gear

ANGLE_STEP = 1e-8  # rad, of the central differences
LENGTH_STEP = 1e-9  # m
SPEED_STEP = 1e-5  # rad/s or m/s

_AT_SLOPE = SCRATCH
_AT_SERIES = _AT_SLOPE + N_ODE
_AT_STATE = _AT_SERIES + N_SERIES
DERIVATIVES_WORK = _AT_STATE + N_STATE
NO_MODES = 5  # beside the statuses of `integrate.advance` and `start.rest`
NO_MODES_WORDS = (
    "the natural frequencies at the static equilibrium could not be found. "
    "Change the torque or the preload a little."
)

_AT_STEP_SERIES = DERIVATIVES_WORK
_AT_MATRIX = _AT_STEP_SERIES + N_SERIES
_AT_SQUARE = _AT_MATRIX + N_COORDINATES**2
CONTROL_WORK = _AT_SQUARE + N_COORDINATES**2


@kernel
def _rate_place(j: int) -> int:
    """Return the place in the state of the speed of coordinate `j`."""
    if j < 2:
        return W_P if j == 0 else W_G
    return V_P + j - 2 if j < 5 else V_G + j - 5


@kernel
def mass_of(j: int, p: AxleParameters) -> float:
    """Return the inertia [kg m2] or mass [kg] that coordinate `j` moves."""
    if j < 2:
        return p.I_p if j == 0 else p.I_g
    return p.m_p if j < 5 else p.m_g


@kernel
def force_derivatives(
    s: Array,
    of_speeds: float,
    torque: float,
    oil_temperature: float,
    mesh: MeshLevels,
    p: AxleParameters,
    work: Array,
    matrix: Array,
) -> None:
    """Write -dQ_i/dq_j, or of speeds -dQ_i/dq'_j, about the state `s` at constant pinion angle.

    Central differences of the right-hand side, with the periodic data held at their means.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    of_speeds : float
        0 for the derivatives with respect to coordinates: the stiffness.
    torque : float
        Pinion torque at which the mesh table is read [N.m].
    oil_temperature : float
        [K]
    mesh : MeshLevels
    p : AxleParameters
        Without flank friction.
    work : ndarray of shape (>= DERIVATIVES_WORK,)
    matrix : ndarray of shape (N_COORDINATES**2,)
        Row by row; SI.
    """
    scratch = work[0:_AT_SLOPE]
    slope = work[_AT_SLOPE:_AT_SERIES]
    series = work[_AT_SERIES:_AT_STATE]
    shifted = work[_AT_STATE:DERIVATIVES_WORK]
    oil = lubricant_state(p.oil, oil_temperature, mesh.laws)
    mean_series(torque, mesh, series)
    series[R_G] = series[R_P] * p.ratio
    at_load = MeshAtLoad(series, 0, mesh.windows, mesh.n_nodes, mesh.film_model)
    inputs = StepInputs(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for j in range(N_COORDINATES):
        step = ANGLE_STEP if j < 2 else LENGTH_STEP
        if of_speeds != 0.0:
            step = SPEED_STEP
        for i in range(N_COORDINATES):
            matrix[i * N_COORDINATES + j] = 0.0
        for side in range(2):
            sense = 1.0 - 2.0 * side
            for i in range(N_STATE):
                shifted[i] = s[i]
            if of_speeds != 0.0:
                shifted[_rate_place(j)] += sense * step
            elif j < 2:
                shifted[X] += sense * step * MICRO * (series[R_P] if j == 0 else -series[R_G])
            elif j < 5:
                shifted[X] += sense * step * MICRO * series[N_X + j - 2]
                shifted[U_P + j - 2] += sense * step * MICRO
            else:
                shifted[X] -= sense * step * MICRO * series[N_X + j - 5]
                shifted[U_G + j - 5] += sense * step * MICRO
            axle_rhs(shifted, inputs, at_load, oil, p, 1.0, 1.0, scratch, slope)
            for i in range(N_COORDINATES):
                change = sense * mass_of(i, p) * slope[_rate_place(i)]
                matrix[i * N_COORDINATES + j] -= change / (2.0 * step)


@kernel
def highest_frequency(stiffness: Array, p: AxleParameters, work: Array) -> float:
    """Return the highest natural frequency [Hz] of a stiffness, NaN or infinite of such a one.

    sqrt(|l|)/(2 pi) of the largest eigenvalue l of M^-1 K. Of the printed equations K is not
    symmetric and l may be complex.

    Parameters
    ----------
    stiffness : ndarray of shape (N_COORDINATES**2,)
        Row by row, SI; overwritten.
    p : AxleParameters
    work : ndarray of shape (N_COORDINATES**2,)
    """
    n = N_COORDINATES
    for i in range(n):
        for j in range(n):
            stiffness[i * n + j] /= mass_of(i, p)
    return math.sqrt(spectral_radius(stiffness, n, work)) / (2.0 * math.pi)


@kernel
def write_step_control(
    s: Array,
    steps_per_mesh_period: float,
    steps_per_highest_period: float,
    torque: float,
    oil_temperature: float,
    mesh: MeshLevels,
    p: AxleParameters,
    work: Array,
    control: Array,
) -> int:
    """Write a flattened `StepControl` about the equilibrium `s`; return OK or NO_MODES.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        As `start.rest` wrote it.
    steps_per_mesh_period, steps_per_highest_period : float
    torque, oil_temperature, mesh, p
        As in `start.rest`.
    work : ndarray of shape (>= CONTROL_WORK,)
    control : ndarray of shape (5,)
    """
    series = work[_AT_STEP_SERIES:_AT_MATRIX]
    matrix = work[_AT_MATRIX:_AT_SQUARE]
    force_derivatives(s, 0.0, torque, oil_temperature, mesh, p, work, matrix)
    frequency = highest_frequency(matrix, p, work[_AT_SQUARE:CONTROL_WORK])
    mean_series(torque, mesh, series)
    turning = series[R_P] * series[R_P] / p.I_p + series[R_G] * series[R_G] / p.I_g
    found = StepControl(
        steps_per_mesh_period,
        steps_per_highest_period,
        frequency,
        series[K_M],
        turning + 1.0 / p.m_p + 1.0 / p.m_g,
    )
    for i in range(len(found)):
        control[i] = found[i]
    return OK if frequency < math.inf else NO_MODES
