"""Map of a state over one period, with its derivatives, for the search of periodic motions.

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

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import N_ROW, TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.mode_march import (
    DIVERGED_UM,
    MARCH_WORK,
    MOST_PARTS,
    N_Y,
    NOT_FINITE,
    OK,
    AngleSlope,
    angle_slope,
    part_of_step,
)
from gearlube_core.kernels.jit import kernel

# steps of the central differences; rates are linear or nearly so in all of these
_STEP_X = 1.0e-5  # um
_STEP_W = 1.0e-3  # rad/s
_STEP_V = 1.0e-6  # m/s
_STEP_TORQUE = 1.0e-2  # N.m
_STEP_SPEED = 1.0e-3  # rad/s
N_COLUMNS = N_Y + 1  # derivatives by three states, load torque, speed
WORK = MARCH_WORK + 2 * N_Y + 3 * N_Y * N_COLUMNS


@kernel
def _add_row(
    turned: Array, upper: AngleSlope, lower: AngleSlope, width: float, column: int
) -> None:
    """Add the derivative by one argument to a column."""
    turned[0, column] += (upper.y_0 - lower.y_0) / width
    turned[1, column] += (upper.y_1 - lower.y_1) / width
    turned[2, column] += (upper.y_2 - lower.y_2) / width
    turned[3, column] += (upper.y_3 - lower.y_3) / width


@kernel
def slope_derivative(
    trial: Array,
    tangent: Array,
    phi: float,
    load_torque: float,
    speed: float,
    rows: Array,
    at: int,
    mode: int,
    p: TorsionalParameters,
    slope: Array,
    turned: Array,
) -> None:
    """Write dy/dphi and J tangent + d(dy/dphi)/d(load torque, speed).

    Parameters
    ----------
    trial, slope : ndarray of shape (N_Y,)
        State, and its dy/dphi.
    tangent, turned : ndarray of shape (N_Y, N_COLUMNS)
        Derivatives of the state, and those of the slope.
    at : int
        Row of the mesh data at `phi`.
    mode : int
        See `contact_mode`; its law of the mesh force is kept.
    """
    x, a, b = trial[0], trial[1], trial[2]
    here = angle_slope(x, a, b, phi, load_torque, speed, rows, at, mode, p)
    slope[0] = here.y_0
    slope[1] = here.y_1
    slope[2] = here.y_2
    slope[3] = here.y_3
    for i in range(N_Y):
        for j in range(N_COLUMNS):
            turned[i, j] = 0.0
    step_a = _STEP_V if p.form == 1.0 else _STEP_W
    for s in range(3):
        dx = _STEP_X if s == 0 else 0.0
        da = step_a if s == 1 else 0.0
        db = _STEP_W if s == 2 else 0.0
        upper = angle_slope(x + dx, a + da, b + db, phi, load_torque, speed, rows, at, mode, p)
        lower = angle_slope(x - dx, a - da, b - db, phi, load_torque, speed, rows, at, mode, p)
        width = 2.0 * (dx + da + db)
        d_0 = (upper.y_0 - lower.y_0) / width
        d_1 = (upper.y_1 - lower.y_1) / width
        d_2 = (upper.y_2 - lower.y_2) / width
        d_3 = (upper.y_3 - lower.y_3) / width
        for j in range(N_COLUMNS):
            turned[0, j] += d_0 * tangent[s, j]
            turned[1, j] += d_1 * tangent[s, j]
            turned[2, j] += d_2 * tangent[s, j]
            turned[3, j] += d_3 * tangent[s, j]
    d = _STEP_TORQUE
    upper = angle_slope(x, a, b, phi, load_torque + d, speed, rows, at, mode, p)
    lower = angle_slope(x, a, b, phi, load_torque - d, speed, rows, at, mode, p)
    _add_row(turned, upper, lower, 2.0 * d, 3)
    d = _STEP_SPEED
    upper = angle_slope(x, a, b, phi, load_torque, speed + d, rows, at, mode, p)
    lower = angle_slope(x, a, b, phi, load_torque, speed - d, rows, at, mode, p)
    _add_row(turned, upper, lower, 2.0 * d, 4)


@kernel
def tangent_step(
    y: Array,
    derivatives: Array,
    phi: float,
    h: float,
    load_torque: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
    work: Array,
) -> None:
    """Advance `y` and its derivatives by the angle `h` [rad] in one contact mode.

    The variational equations go through the same Runge-Kutta stages as the state. Arguments as
    in `angle_step` and `period_map`.
    """
    size = N_Y * N_COLUMNS
    trial = work[0:N_Y]
    slope = work[N_Y : 2 * N_Y]
    total = 2 * N_Y
    tangent = work[total : total + size].reshape((N_Y, N_COLUMNS))
    turned = work[total + size : total + 2 * size].reshape((N_Y, N_COLUMNS))
    begun = work[total + 2 * size : total + 3 * size].reshape((N_Y, N_COLUMNS))
    x, a, b = y[0], y[1], y[2]
    for m in range(N_Y):
        for n in range(N_COLUMNS):
            begun[m, n] = derivatives[m, n]
    for stage in range(4):
        ahead = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
        at = i if stage == 0 else (i + 2 if stage == 3 else i + 1)
        trial[0] = x + ahead * slope[0]
        trial[1] = a + ahead * slope[1]
        trial[2] = b + ahead * slope[2]
        for m in range(N_Y):
            for n in range(N_COLUMNS):
                tangent[m, n] = begun[m, n] + ahead * turned[m, n]
        slope_derivative(
            trial,
            tangent,
            phi + ahead,
            load_torque,
            speed,
            rows,
            at % rows.shape[0],
            mode,
            p,
            slope,
            turned,
        )
        weight = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
        for m in range(N_Y):
            y[m] += weight * slope[m]
            for n in range(N_COLUMNS):
                derivatives[m, n] += weight * turned[m, n]


@kernel
def period_map(
    y: Array,
    derivatives: Array,
    load_torque: float,
    speed: float,
    periods: int,
    rows: Array,
    p: TorsionalParameters,
    work: Array,
) -> int:
    """Advance `y` over `periods` mesh periods from pinion angle zero, with derivatives.

    The variational equations go through the same Runge-Kutta stages as the state, and both end a
    step where the contact mode changes: the derivatives are those of the discrete map. The force
    is continuous at such a change, so that they do not jump there.

    Parameters
    ----------
    y : ndarray of shape (N_Y,)
        State of `mode_march`; in: start, out: end.
    derivatives : ndarray of shape (N_Y, N_COLUMNS)
        Out: d(y_end)/d(three states of y0, load torque [N.m], speed [rad/s]).
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
        Outcome: `OK` or `NOT_FINITE`.
    """
    trial = work[0:N_Y]
    between = work[N_Y:MARCH_WORK].reshape((3, N_ROW))
    inner = work[MARCH_WORK:WORK]
    for i in range(N_Y):
        for j in range(N_COLUMNS):
            derivatives[i, j] = 1.0 if i == j and i < 3 else 0.0
    steps = rows.shape[0] // 2
    h = 2.0 * math.pi / (p.z_p * steps)
    for step in range(periods * steps):
        first = 2 * (step % steps)
        phi = step * h
        start = 0.0
        for part in range(MOST_PARTS):
            whole = 1 if part == MOST_PARTS - 1 else 0
            done = part_of_step(
                y, phi, h, start, whole, load_torque, speed, rows, first, p, trial, between
            )
            data, i = (rows, first) if done.end - start == 1.0 else (between, 0)
            length = (done.end - start) * h
            at = phi + start * h
            tangent_step(
                y, derivatives, at, length, load_torque, speed, data, i, done.mode, p, inner
            )
            start = done.end
            if start == 1.0:
                break
    if not abs(y[0]) < DIVERGED_UM or not y[3] < math.inf:
        return NOT_FINITE
    return OK
