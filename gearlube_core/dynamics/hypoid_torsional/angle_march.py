"""Fixed-step RK4 with the pinion angle as independent variable.

Steps are locked to the mesh: sampled motions need no interpolation and no window, and mesh data
are read from `mesh_rows`. States, by form:

2-DOF: y = (x [um], w_p [rad/s], w_g [rad/s], t [s])
1-DOF: y = (x [um], v [m/s], t [s])
"""

from __future__ import annotations

import math

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM, pair_rates, reduced_rates
from gearlube_core.jit import kernel

OK, NOT_FINITE = 0, 1
DIVERGED_UM = 1.0e5  # transmission error of 0.1 m: teeth long broken [um]
N_MAX = 4  # of y


@kernel
def angle_slope(
    y: NDArray[float64],
    phi: float,
    load_torque: float,
    speed: float,
    row: NDArray[float64],
    p: TorsionalParameters,
    slope: NDArray[float64],
) -> float:
    """Write dy/dphi into `slope`; return the mesh force [N]. `row` is `mesh_row` at `phi`."""
    if p.form == 1.0:
        reduced = reduced_rates(y[0] * UM, y[1], phi, speed, row, p)
        per_angle = 1.0 / speed
        slope[0] = reduced.x * MICRO * per_angle
        slope[1] = reduced.v * per_angle
        slope[2] = per_angle
        return reduced.force
    rates = pair_rates(y[0] * UM, y[1], y[2], phi, load_torque, speed, row, p)
    per_angle = 1.0 / y[1]
    slope[0] = rates.x * MICRO * per_angle
    slope[1] = rates.w_p * per_angle
    slope[2] = rates.w_g * per_angle
    slope[3] = per_angle
    return rates.force


@kernel
def angle_step(
    y: NDArray[float64],
    phi: float,
    h: float,
    load_torque: float,
    speed: float,
    row: NDArray[float64],
    row_middle: NDArray[float64],
    row_end: NDArray[float64],
    p: TorsionalParameters,
    work: NDArray[float64],
) -> None:
    """Advance `y` by the angle `h` [rad] with the classic fourth-order Runge-Kutta scheme.

    `work` has shape (3 N_MAX,).
    """
    n = y.size
    trial = work[0:n]
    slope = work[N_MAX : N_MAX + n]
    total = work[2 * N_MAX : 2 * N_MAX + n]
    angle_slope(y, phi, load_torque, speed, row, p, slope)
    for i in range(n):
        total[i] = slope[i]
        trial[i] = y[i] + 0.5 * h * slope[i]
    angle_slope(trial, phi + 0.5 * h, load_torque, speed, row_middle, p, slope)
    for i in range(n):
        total[i] += 2.0 * slope[i]
        trial[i] = y[i] + 0.5 * h * slope[i]
    angle_slope(trial, phi + 0.5 * h, load_torque, speed, row_middle, p, slope)
    for i in range(n):
        total[i] += 2.0 * slope[i]
        trial[i] = y[i] + h * slope[i]
    angle_slope(trial, phi + h, load_torque, speed, row_end, p, slope)
    for i in range(n):
        y[i] += h / 6.0 * (total[i] + slope[i])


@kernel
def march(
    y: NDArray[float64],
    first_period: int,
    periods: int,
    load_torque: float,
    speed: float,
    rows: NDArray[float64],
    p: TorsionalParameters,
    work: NDArray[float64],
    record: NDArray[float64],
) -> int:
    """Advance `y` over whole mesh periods; return OK or NOT_FINITE.

    Parameters
    ----------
    y : ndarray of shape (4,) or (3,)
        Changed.
    first_period : int
        Mesh periods since pinion angle zero.
    periods : int
    load_torque, speed : float
        [N.m], [rad/s]
    rows : ndarray of shape (2 steps, N_ROW)
        `mesh_rows`; sets the number of steps per mesh period.
    p : TorsionalParameters
    work : ndarray of shape (3 N_MAX,)
    record : ndarray of shape (periods * steps, 4) or (0, 4)
        Angle [rad], x [um], pinion speed [rad/s] and mesh force [N] before each step, or nothing
        recorded.
    """
    count = rows.shape[0]
    steps = count // 2
    period = 2.0 * math.pi / p.z_p
    h = period / steps
    slope = work[N_MAX : N_MAX + y.size]
    for m in range(periods):
        for i in range(steps):
            phi = (first_period + m) * period + i * h
            row = rows[2 * i]
            if record.shape[0] > 0:
                at = m * steps + i
                record[at, 0] = phi
                record[at, 1] = y[0]
                record[at, 2] = speed if p.form == 1.0 else y[1]
                record[at, 3] = angle_slope(y, phi, load_torque, speed, row, p, slope)
            row_end = rows[(2 * i + 2) % count]
            angle_step(y, phi, h, load_torque, speed, row, rows[2 * i + 1], row_end, p, work)
        if not abs(y[0]) < DIVERGED_UM or not y[y.size - 1] < math.inf:
            return NOT_FINITE
    return OK
