"""Derivatives of the forces on the axle with respect to its coordinates and speeds."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad, MeshLevels
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_rhs
from gearlube_core.dynamics.hypoid_axle.start import mean_series
from gearlube_core.dynamics.hypoid_axle.state import (
    MICRO,
    N_ODE,
    N_STATE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, N_X, R_G, R_P
from gearlube_core.oil.lubricant_state import lubricant_state

N_COORDINATES = 8  # rotations of pinion and gear, displacements of pinion and gear

ANGLE_STEP = 1e-8  # rad, of the central differences
LENGTH_STEP = 1e-9  # m
SPEED_STEP = 1e-5  # rad/s or m/s

_AT_SLOPE = SCRATCH
_AT_SERIES = _AT_SLOPE + N_ODE
_AT_STATE = _AT_SERIES + N_SERIES
DERIVATIVES_WORK = _AT_STATE + N_STATE


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
    oil = lubricant_state(p.oil, oil_temperature)
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
