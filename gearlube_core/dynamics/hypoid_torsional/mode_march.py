"""March over mesh periods in which every change of the contact mode ends a part of a step.

A step across a kink of the mesh force is exact to second order only, and its derivative to first.
Cut where the mode changes, its parts keep the fourth order of the scheme. The force is continuous
there, so that the derivative of a motion does not jump. A touch, or a loss of contact, that begins
and ends within one step goes unseen.

Fixed-step RK4 with the pinion angle as independent variable.

Steps are locked to the mesh: sampled motions need no interpolation and no window, and mesh data
are read from `mesh_rows`. States, by form:

2-DOF: y = (x [um], w_p [rad/s], w_g [rad/s], t [s])
1-DOF: y = (x [um], v [m/s], 0, t [s])
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    N_ROW,
    ONE_DOF,
    K,
    TorsionalParameters,
    rows_between,
)
from gearlube_core.dynamics.hypoid_torsional.rates import (
    MICRO,
    UM,
    contact_mode,
    mode_margin,
    pair_approach,
    pair_rates,
    reduced_approach,
    reduced_rates,
)
from gearlube_core.kernels.jit import kernel

N_Y = 4
OK, NOT_FINITE = 0, 1
DIVERGED_UM = 1.0e5  # transmission error of 0.1 m: teeth long broken [um]
N_RECORD = 5  # angle [rad], x [um], pinion speed, gear speed [rad/s], mesh force [N]
MOST_PARTS = 12  # of one step; the last one keeps its mode to the end
MARCH_WORK = N_Y + 3 * N_ROW
_CLOSE = 1.0e-9  # share of a step within which the end of a mode is found
_LOOKS = 60  # at most, each a thousandth of the bracket or more


class AngleSlope(NamedTuple):
    """dy/dphi of the four of a state, and the mesh force."""

    y_0: float
    y_1: float
    y_2: float
    y_3: float
    force: float  # N


@kernel
def angle_slope(
    y_0: float,
    y_1: float,
    y_2: float,
    phi: float,
    load_torque: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
) -> AngleSlope:
    """Return dy/dphi; nothing depends on time. `rows[i]` is `mesh_row` at `phi`.

    The law of the mesh force is that of `mode`.
    """
    if p.form == 1.0:
        reduced = reduced_rates(y_0 * UM, y_1, phi, speed, rows, i, mode, p)
        per_angle = 1.0 / speed
        return AngleSlope(
            reduced.x * MICRO * per_angle, reduced.v * per_angle, 0.0, per_angle, reduced.force
        )
    rates = pair_rates(y_0 * UM, y_1, y_2, phi, load_torque, speed, rows, i, mode, p)
    per_angle = 1.0 / y_1
    return AngleSlope(
        rates.x * MICRO * per_angle,
        rates.w_p * per_angle,
        rates.w_g * per_angle,
        per_angle,
        rates.force,
    )


@kernel
def _ahead(
    y: Array,
    s: AngleSlope,
    h: float,
    phi: float,
    load_torque: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
) -> AngleSlope:
    """Return dy/dphi an angle `h` after `phi`, where the state has gone on with a slope."""
    x, a, b = y[0] + h * s.y_0, y[1] + h * s.y_1, y[2] + h * s.y_2
    return angle_slope(x, a, b, phi + h, load_torque, speed, rows, i, mode, p)


@kernel
def angle_step(
    y: Array,
    phi: float,
    h: float,
    load_torque: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
) -> float:
    """Advance `y` by the angle `h` [rad] with the classic fourth-order Runge-Kutta scheme.

    Returns the mesh force before the step [N]. `rows[i]` belongs to `phi`, the next two (in a
    circle) to the middle and the end of the step.
    """
    half = 0.5 * h
    j = i + 1
    k = i + 2 if i + 2 < rows.shape[0] else 0
    s_1 = angle_slope(y[0], y[1], y[2], phi, load_torque, speed, rows, i, mode, p)
    s_2 = _ahead(y, s_1, half, phi, load_torque, speed, rows, j, mode, p)
    s_3 = _ahead(y, s_2, half, phi, load_torque, speed, rows, j, mode, p)
    s_4 = _ahead(y, s_3, h, phi, load_torque, speed, rows, k, mode, p)
    sixth = h / 6.0
    y[0] += sixth * (s_1.y_0 + 2.0 * (s_2.y_0 + s_3.y_0) + s_4.y_0)
    y[1] += sixth * (s_1.y_1 + 2.0 * (s_2.y_1 + s_3.y_1) + s_4.y_1)
    y[2] += sixth * (s_1.y_2 + 2.0 * (s_2.y_2 + s_3.y_2) + s_4.y_2)
    y[3] += sixth * (s_1.y_3 + 2.0 * (s_2.y_3 + s_3.y_3) + s_4.y_3)
    return s_1.force


class Part(NamedTuple):
    """Part of a step in which the contact mode does not change."""

    end: float  # share of the step at its end [-]
    mode: int  # see `contact_mode`
    force: float  # mesh force at its start [N]


@kernel
def approach(y: Array, speed: float, rows: Array, i: int, p: TorsionalParameters) -> float:
    """Return dx/dt of a state [m/s]."""
    if p.form == ONE_DOF:
        return reduced_approach(y[1], speed, rows, i)
    return pair_approach(y[1], y[2], rows, i)


@kernel
def _margin(
    mode: int, y: Array, speed: float, rows: Array, i: int, p: TorsionalParameters
) -> float:
    """Return `mode_margin` of a state [m]."""
    return mode_margin(mode, y[0] * UM, approach(y, speed, rows, i, p), rows[i, K], p)


@kernel
def part_of_step(
    y: Array,
    phi: float,
    h: float,
    start: float,
    whole: int,
    load_torque: float,
    speed: float,
    rows: Array,
    first: int,
    p: TorsionalParameters,
    trial: Array,
    between: Array,
) -> Part:
    """Advance from a share of a step to its end, or to where the contact mode ends before.

    Parameters
    ----------
    y : ndarray of shape (4,)
        State at the share `start` of the step.
    phi, h : float
        Pinion angle where the step begins, and its length [rad].
    start : float
        [-]
    whole : int
        1 to go to the end of the step in any case.
    load_torque, speed : float
        [N.m], [rad/s]
    rows, first
        Mesh data, and the row at `phi`.
    p : TorsionalParameters
    trial : ndarray of shape (4,)
        Out: state at the end of the part; beyond the mode by less than 1e-9 of the step.
    between : ndarray of shape (3, N_ROW)
        Out: mesh data of the part, unless it is the whole step.
    """
    data, i, last = rows, first, (first + 2) % rows.shape[0]
    if start > 0.0:
        rows_between(rows, first, start, 1.0, between)
        data, i, last = between, 0, 2
    mode = contact_mode(y[0] * UM, approach(y, speed, data, i, p), data[i, K], p)
    margin_low = _margin(mode, y, speed, data, i, p)
    for n in range(N_Y):
        trial[n] = y[n]
    at = phi + start * h
    force = angle_step(trial, at, (1.0 - start) * h, load_torque, speed, data, i, mode, p)
    margin_high = _margin(mode, trial, speed, data, last, p)
    if whole == 1 or not margin_high < 0.0:
        return Part(1.0, mode, force)
    low, high, tried, kept = start, 1.0, 1.0, 0
    for _ in range(_LOOKS):
        width = high - low
        if width < _CLOSE:
            break
        tried = low + width * margin_low / (margin_low - margin_high)  # of either sign
        tried = min(max(tried, low + 1e-3 * width), high - 1e-3 * width)
        rows_between(rows, first, start, tried, between)
        for n in range(N_Y):
            trial[n] = y[n]
        angle_step(trial, at, (tried - start) * h, load_torque, speed, between, 0, mode, p)
        margin = _margin(mode, trial, speed, between, 2, p)
        if margin < 0.0:  # an end that stays for the second time counts half: Illinois
            high, margin_high = tried, margin
            margin_low *= 0.5 if kept < 0 else 1.0
            kept = -1
        else:
            low, margin_low = tried, margin
            margin_high *= 0.5 if kept > 0 else 1.0
            kept = 1
    if tried != high:
        rows_between(rows, first, start, high, between)
        for n in range(N_Y):
            trial[n] = y[n]
        angle_step(trial, at, (high - start) * h, load_torque, speed, between, 0, mode, p)
    return Part(high, mode, force)


@kernel
def march(
    y: Array,
    first_period: int,
    periods: int,
    load_torque: float,
    speed: float,
    rows: Array,
    p: TorsionalParameters,
    record: Array,
    work: Array,
) -> int:
    """Advance `y` over whole mesh periods; return OK or NOT_FINITE.

    Parameters
    ----------
    y : ndarray of shape (4,)
        State of the pair, changed in place.
    first_period : int
        Mesh periods since pinion angle zero.
    periods : int
    load_torque, speed : float
        [N.m], [rad/s]
    rows : ndarray of shape (2 steps, N_ROW)
        `mesh_rows`; sets the number of steps per mesh period.
    p : TorsionalParameters
    record : ndarray of shape (periods * steps, N_RECORD) or (0, N_RECORD)
        Before each step, or nothing recorded.
    work : ndarray of shape (MARCH_WORK,)
    """
    trial = work[0:N_Y]
    between = work[N_Y:MARCH_WORK].reshape((3, N_ROW))
    steps = rows.shape[0] // 2
    period = 2.0 * math.pi / p.z_p
    h = period / steps
    keep = record.shape[0] > 0
    for m in range(periods):
        for i in range(steps):
            phi = (first_period + m) * period + i * h
            x = y[0]
            w_p, w_g = y[1], y[2]
            if p.form == 1.0:
                w_p, w_g = speed, speed / p.ratio
            start, force = 0.0, 0.0
            for part in range(MOST_PARTS):
                whole = 1 if part == MOST_PARTS - 1 else 0
                done = part_of_step(
                    y, phi, h, start, whole, load_torque, speed, rows, 2 * i, p, trial, between
                )
                for n in range(N_Y):
                    y[n] = trial[n]
                if part == 0:
                    force = done.force
                start = done.end
                if start == 1.0:
                    break
            if keep:
                at = m * steps + i
                record[at, 0] = phi
                record[at, 1] = x
                record[at, 2] = w_p
                record[at, 3] = w_g
                record[at, 4] = force
        if not abs(y[0]) < DIVERGED_UM or not y[3] < math.inf:
            return NOT_FINITE
    return OK
