"""Map of a state over one period, with its derivatives; what a search for periodic motions needs.

Interface of `period_problem.PeriodProblem`, in the order of use:

    problem = PeriodProblem(parameters, periods=1, steps_per_mesh_period=256)
    problem.equations()          gearlube_core.periodic.problem.PeriodicProblem, scaled
    problem.initial_guess(W)     (n,) static deflection at pinion speed W [rad/s]
    problem.residual(z, W)       residual (n,), by z (n, n), by W (n,), monodromy (m, m)
    problem.orbit(z, W)          samples of the motion over the period

Unknowns z, 2-DOF: (x [um], w_p - W [rad/s], w_g - W z_p/z_g [rad/s], T_g [N.m]) with the states
those (m = 3) at the start of the period, n = 4;
residual (y_end - y0 of the three states, mean speed - W).
1-DOF: z = (x [um], v [m/s]), n = m = 2; its speed is constant, its load no unknown.
The parameter is the mean pinion speed W; the mesh frequency is z_p W/(2 pi). The pinion angle is
the independent variable, so the system is not autonomous and needs no phase condition.
A period that is not finite (teeth parted by 0.1 m) gives a residual of NaN.
"""

from __future__ import annotations

import math

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.dynamics.hypoid_torsional.angle_march import (
    DIVERGED_UM,
    N_MAX,
    NOT_FINITE,
    OK,
    angle_slope,
)
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.jit import kernel

# steps of the central differences; rates are linear or nearly so in all of these
_STEP_X = 1.0e-5  # um, as small as rounding allows: stages may lie near a kink
_STEP_W = 1.0e-3  # rad/s
_STEP_V = 1.0e-6  # m/s
_STEP_TORQUE = 1.0e-2  # N.m
_STEP_SPEED = 1.0e-3  # rad/s
N_DERIVATIVES = N_MAX + 1  # columns at most: states without time, load torque, speed
WORK = 4 * N_MAX + 4 * N_MAX * N_DERIVATIVES


@kernel
def slope_derivative(
    y: NDArray[float64],
    tangent: NDArray[float64],
    phi: float,
    load_torque: float,
    speed: float,
    row: NDArray[float64],
    p: TorsionalParameters,
    work: NDArray[float64],
    slope: NDArray[float64],
    turned: NDArray[float64],
) -> None:
    """Write dy/dphi and J tangent + d(dy/dphi)/d(load torque, speed).

    Parameters
    ----------
    y, slope : ndarray of shape (n,)
        State with time last.
    tangent, turned : ndarray of shape (n, n + 1)
        Derivatives of y by (y0 without time, load torque, speed), and those of the slope.
    work : ndarray of shape (3 N_MAX,)
        Work space.
    """
    n = y.size
    trial = work[0:n]
    upper = work[N_MAX : N_MAX + n]
    lower = work[2 * N_MAX : 2 * N_MAX + n]
    angle_slope(y, phi, load_torque, speed, row, p, slope)
    for i in range(n):
        trial[i] = y[i]
        for j in range(n + 1):
            turned[i, j] = 0.0
    for s in range(n - 1):  # nothing depends on time
        step = _STEP_X
        if s > 0:
            step = _STEP_V if p.form == 1.0 else _STEP_W
        trial[s] = y[s] + step
        angle_slope(trial, phi, load_torque, speed, row, p, upper)
        trial[s] = y[s] - step
        angle_slope(trial, phi, load_torque, speed, row, p, lower)
        trial[s] = y[s]
        for i in range(n):
            d = (upper[i] - lower[i]) / (2.0 * step)
            for j in range(n + 1):
                turned[i, j] += d * tangent[s, j]
    angle_slope(y, phi, load_torque + _STEP_TORQUE, speed, row, p, upper)
    angle_slope(y, phi, load_torque - _STEP_TORQUE, speed, row, p, lower)
    for i in range(n):
        turned[i, n - 1] += (upper[i] - lower[i]) / (2.0 * _STEP_TORQUE)
    angle_slope(y, phi, load_torque, speed + _STEP_SPEED, row, p, upper)
    angle_slope(y, phi, load_torque, speed - _STEP_SPEED, row, p, lower)
    for i in range(n):
        turned[i, n] += (upper[i] - lower[i]) / (2.0 * _STEP_SPEED)


@kernel
def period_map(
    y: NDArray[float64],
    derivatives: NDArray[float64],
    load_torque: float,
    speed: float,
    periods: int,
    rows: NDArray[float64],
    p: TorsionalParameters,
    work: NDArray[float64],
) -> int:
    """Advance `y` over `periods` mesh periods from pinion angle zero, with derivatives.

    The variational equations go through the same Runge-Kutta stages as the state, so that the
    derivatives are those of the discrete map, kinks of the mesh force included (the force is
    continuous there, so a trajectory's derivative does not jump).

    Parameters
    ----------
    y : ndarray of shape (n,)
        (x [um], w_p, w_g [rad/s], time [s]) or (x, v [m/s], time); in: start, out: end.
    derivatives : ndarray of shape (n, n + 1)
        Out: d(y_end)/d(y0 without time, load torque [N.m], speed [rad/s]).
    load_torque, speed : float
        [N.m], [rad/s]
    periods : int
        1, or the teeth of the pinion with torque ripple.
    rows : ndarray of shape (2 steps, N_ROW)
        `mesh_rows`.
    p : TorsionalParameters
    work : ndarray of shape (WORK,)

    Returns
    -------
    int
        OK or NOT_FINITE.
    """
    n = y.size
    width = n + 1
    size = n * width
    trial = work[0:n]
    small = work[N_MAX : 4 * N_MAX]
    at = 4 * N_MAX
    trial_tangent = work[at : at + size].reshape((n, width))
    turned = work[at + size : at + 2 * size].reshape((n, width))
    total_tangent = work[at + 2 * size : at + 3 * size].reshape((n, width))
    slope = work[at + 3 * size : at + 3 * size + n]
    total = work[at + 3 * size + n : at + 3 * size + 2 * n]
    for i in range(n):
        for j in range(width):
            derivatives[i, j] = 0.0
    for i in range(n - 1):
        derivatives[i, i] = 1.0
    count = rows.shape[0]
    steps = count // 2
    period = 2.0 * math.pi / p.z_p
    h = period / steps
    for step in range(periods * steps):
        k = 2 * (step % steps)
        for stage in range(4):
            ahead = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
            row = rows[(k + (0 if stage == 0 else (2 if stage == 3 else 1))) % count]
            for i in range(n):
                trial[i] = y[i] + ahead * slope[i] if stage > 0 else y[i]
                for j in range(width):
                    trial_tangent[i, j] = derivatives[i, j]
                    if stage > 0:
                        trial_tangent[i, j] += ahead * turned[i, j]
            phi = step * h + ahead
            slope_derivative(
                trial, trial_tangent, phi, load_torque, speed, row, p, small, slope, turned
            )
            weight = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
            for i in range(n):
                total[i] = weight * slope[i] + (total[i] if stage > 0 else 0.0)
                for j in range(width):
                    before = total_tangent[i, j] if stage > 0 else 0.0
                    total_tangent[i, j] = before + weight * turned[i, j]
        for i in range(n):
            y[i] += total[i]
            for j in range(width):
                derivatives[i, j] += total_tangent[i, j]
    if not abs(y[0]) < DIVERGED_UM or not y[n - 1] < math.inf:
        return NOT_FINITE
    return OK
