"""Fixed-step RK4 with the pinion angle as independent variable.

Steps are locked to the mesh: sampled motions need no interpolation and no window, and mesh data
are read from `mesh_rows`. States, by form:

2-DOF: y = (x [um], w_p [rad/s], w_g [rad/s], t [s])
1-DOF: y = (x [um], v [m/s], 0, t [s])
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM, pair_rates, reduced_rates
from gearlube_core.kernels.jit import kernel

N_Y = 4


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
    x, a, b = y[0], y[1], y[2]
    half = 0.5 * h
    j = i + 1
    k = i + 2 if i + 2 < rows.shape[0] else 0
    s_1 = angle_slope(x, a, b, phi, load_torque, speed, rows, i, mode, p)
    s_2 = angle_slope(
        x + half * s_1.y_0,
        a + half * s_1.y_1,
        b + half * s_1.y_2,
        phi + half,
        load_torque,
        speed,
        rows,
        j,
        mode,
        p,
    )
    s_3 = angle_slope(
        x + half * s_2.y_0,
        a + half * s_2.y_1,
        b + half * s_2.y_2,
        phi + half,
        load_torque,
        speed,
        rows,
        j,
        mode,
        p,
    )
    s_4 = angle_slope(
        x + h * s_3.y_0,
        a + h * s_3.y_1,
        b + h * s_3.y_2,
        phi + h,
        load_torque,
        speed,
        rows,
        k,
        mode,
        p,
    )
    sixth = h / 6.0
    y[0] += sixth * (s_1.y_0 + 2.0 * (s_2.y_0 + s_3.y_0) + s_4.y_0)
    y[1] += sixth * (s_1.y_1 + 2.0 * (s_2.y_1 + s_3.y_1) + s_4.y_1)
    y[2] += sixth * (s_1.y_2 + 2.0 * (s_2.y_2 + s_3.y_2) + s_4.y_2)
    y[3] += sixth * (s_1.y_3 + 2.0 * (s_2.y_3 + s_3.y_3) + s_4.y_3)
    return s_1.force
