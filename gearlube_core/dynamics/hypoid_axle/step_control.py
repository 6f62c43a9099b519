"""What the integrator step of the axle is tied to, as a kernel."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.force_derivatives import (
    DERIVATIVES_WORK,
    N_COORDINATES,
    force_derivatives,
    mass_of,
)
from gearlube_core.dynamics.hypoid_axle.integrate import StepControl
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshLevels
from gearlube_core.dynamics.hypoid_axle.start import OK, mean_series
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.spectral_radius import spectral_radius
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, R_G, R_P

NO_MODES = 5  # beside the statuses of `integrate.advance` and `start.rest`
NO_MODES_WORDS = (
    "the natural frequencies at the static equilibrium could not be found. "
    "Change the torque or the preload a little."
)

_AT_SERIES = DERIVATIVES_WORK
_AT_MATRIX = _AT_SERIES + N_SERIES
_AT_SQUARE = _AT_MATRIX + N_COORDINATES**2
CONTROL_WORK = _AT_SQUARE + N_COORDINATES**2


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
    series = work[_AT_SERIES:_AT_MATRIX]
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
