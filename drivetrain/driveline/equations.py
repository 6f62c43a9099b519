"""Equations of motion of the driveline, symbolic in casadi.

Signs: every speed is positive forward, every twist is engine side minus road side, the propshaft
torque drives the pinion and the half-shaft torque resists the ring gear.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

from drivetrain.driveline.parameters import DrivelineParameters

STATES = (
    "crank_angle",  # rad, within one four-stroke cycle
    "crank_speed",  # rad/s
    "flywheel_twist",  # rad
    "gearbox_speed",  # rad/s, at the gearbox input
    "propshaft_twist",  # rad
    "half_shaft_twist",  # rad
    "hub_speed",  # rad/s
    "tyre_deflection",  # m, of the carcass, longitudinal
    "vehicle_speed",  # m/s
    "control_torque",  # N m, integral part, at the crankshaft
)
INDEX = {name: index for index, name in enumerate(STATES)}
POWERS = ("engine", "pinion", "ring_gear", "road", "dissipated")
_REST = 0.05  # m/s, below which the rolling resistance fades to zero
_CYCLE = 4.0 * math.pi  # rad, four strokes
LONGEST_INNER_STEP = 2.5e-4  # s; modes stay below 350 Hz, the error of RK4 is then 1e-5 at most

# Memory behind the states: energies [J], the torques of the last interval [N m], the angles that
# the axle was expected to reach [rad], and whether these exist (0 before the first step, else 1).
MEMORY = (
    *STATES,
    *POWERS,
    "interface",
    "pinion_torque",
    "wheel_torque",
    "pinion_angle",
    "wheel_angle",
    "started",
)
SLOT = {name: index for index, name in enumerate(MEMORY)}


@lru_cache(maxsize=16)
def driveline_equations(parameters: DrivelineParameters, gear_ratio: float) -> Any:
    """Return the right-hand side of the driveline as a casadi Function.

    J_c w_c' = T_e - T_d                 T_d = k_d a_d + c_d a_d',  a_d' = w_c - w_s
    J_s w_s' = T_d - T_p / g             T_p = k_p a_p + c_p a_p',  a_p' = w_s/g - w_pinion
    J_h w_h' = T_w - r_t F               T_w = k_h a_h + c_h a_h',  a_h' = w_wheel - w_h
    M V' = F - R(V)                      F = k_x u,  u' = r_t w_h - V - (V/sigma) u
    T_e = T_mean (1 + sum a_k cos(k theta + phase_k))
    T_mean = T_0 + K_P (V_0 - V) + T_I,  T_I' = K_I (V_0 - V)

    Parameters
    ----------
    parameters : DrivelineParameters
        Inertias, stiffnesses, dampings, control.
    gear_ratio : float
        g, crank speed over propshaft speed [-].

    Returns
    -------
    casadi.Function
        (x, u, p) -> (x', torques, powers, stored) with x in the order STATES, u = (pinion speed,
        wheel speed) [rad/s], p = (requested vehicle speed [m/s], mean engine torque at that speed
        [N m], scale of the torque orders [-]), torques = (pinion, wheel) [N m], powers in the
        order POWERS [W], stored energy [J].

    Notes
    -----
    The tyre is the linear first-order relaxation model: in steady rolling u = sigma * slip.
    Gearbox and joints are lossless.
    """
    import casadi as ca

    a, engine = parameters, parameters.engine
    vehicle, radius = a.road_load.vehicle, a.rolling_radius
    x, u, p = ca.SX.sym("x", len(STATES)), ca.SX.sym("u", 2), ca.SX.sym("p", 3)
    theta, w_crank, twist_f, w_box, twist_p, twist_h, w_hub, deflection, speed, integral = (
        ca.vertsplit(x)
    )
    w_pinion, w_wheel = ca.vertsplit(u)
    requested, feedforward, ripple = ca.vertsplit(p)

    proportional_gain, integral_gain = a.control_gains(gear_ratio)
    orders = sum(o.amplitude * ca.cos(o.order * theta + o.phase) for o in engine.orders)
    mean = feedforward + proportional_gain * (requested - speed) + integral
    torque_engine = mean * (1.0 + ripple * orders)

    rate_f = w_crank - w_box
    rate_p = w_box / gear_ratio - w_pinion
    rate_h = w_wheel - w_hub
    creep = ca.fabs(speed) / a.tyre_relaxation_length * deflection
    torque_f = engine.flywheel_stiffness * twist_f + engine.flywheel_damping * rate_f
    torque_p = a.propshaft_stiffness * twist_p + a.propshaft_damping * rate_p
    torque_h = a.half_shaft_stiffness * twist_h + a.half_shaft_damping * rate_h
    force = a.tyre_stiffness * deflection
    resistance = (
        vehicle.drag_area * speed * ca.fabs(speed)
        + vehicle.rolling_resistance * ca.tanh(speed / _REST)
        + vehicle.grade_resistance
    )

    inertia_box = a.gearbox_input_inertia(gear_ratio)
    rates = ca.vertcat(
        w_crank,
        (torque_engine - torque_f) / engine.primary_inertia,
        rate_f,
        (torque_f - torque_p / gear_ratio) / inertia_box,
        rate_p,
        rate_h,
        (torque_h - radius * force) / (2.0 * a.wheel_inertia),
        radius * w_hub - speed - creep,
        (force - resistance) / a.translating_mass,
        integral_gain * (requested - speed),
    )
    dissipated = (
        engine.flywheel_damping * rate_f**2
        + a.propshaft_damping * rate_p**2
        + a.half_shaft_damping * rate_h**2
        + force * creep
    )
    powers = ca.vertcat(
        torque_engine * w_crank,
        torque_p * w_pinion,
        torque_h * w_wheel,
        resistance * speed,
        dissipated,
    )
    stored = 0.5 * (
        engine.primary_inertia * w_crank**2
        + inertia_box * w_box**2
        + 2.0 * a.wheel_inertia * w_hub**2
        + a.translating_mass * speed**2
        + engine.flywheel_stiffness * twist_f**2
        + a.propshaft_stiffness * twist_p**2
        + a.half_shaft_stiffness * twist_h**2
        + a.tyre_stiffness * deflection**2
    )
    return ca.Function(
        "driveline",
        [x, u, p],
        [rates, ca.vertcat(torque_p, torque_h), powers, stored],
        ["x", "u", "p"],
        ["rates", "torques", "powers", "stored"],
    )


def driveline_stepper(
    equations: Any, inner_steps: int, propshaft_stiffness: float, half_shaft_stiffness: float
) -> Any:
    """Return the map over one communication interval as a casadi Function.

    The axle's angles are continued linearly, angle + speed * t. RK4 integrates states and powers.
    What the axle's angles differ from the last continuation goes into the twists first, so that
    twists follow angles, never a sum of speeds.

    Parameters
    ----------
    equations : casadi.Function
        From `driveline_equations`.
    inner_steps : int
        RK4 steps in the interval [-].
    propshaft_stiffness, half_shaft_stiffness : float
        Needed for the energy that the correction of the twists brings in [N m/rad].

    Returns
    -------
    casadi.Function
        (z, m, p) -> (z, torques) with z in the order MEMORY, m = (h, pinion angle, pinion speed,
        wheel angle, wheel speed), p as in `driveline_equations`, torques = (pinion, wheel), their
        means over the interval [N m], and the sum of z, which is finite when all of z is.
    """
    import casadi as ca

    z, m, p = ca.SX.sym("z", len(MEMORY)), ca.SX.sym("m", 5), ca.SX.sym("p", 3)
    h, pinion_angle, pinion_speed, wheel_angle, wheel_speed = ca.vertsplit(m)
    u = ca.vertcat(pinion_speed, wheel_speed)

    started = z[SLOT["started"]]
    ahead = started * (pinion_angle - z[SLOT["pinion_angle"]])
    ahead_wheel = started * (wheel_angle - z[SLOT["wheel_angle"]])
    x = z[: len(STATES)]
    before = (x[INDEX["propshaft_twist"]], x[INDEX["half_shaft_twist"]])
    after = (before[0] - ahead, before[1] + ahead_wheel)
    brought_in = 0.5 * (
        propshaft_stiffness * (after[0] ** 2 - before[0] ** 2)
        + half_shaft_stiffness * (after[1] ** 2 - before[1] ** 2)
    )
    # The axle has turned by that much more under the torques of the last interval.
    to_pinion = z[SLOT["pinion_torque"]] * ahead
    from_ring_gear = z[SLOT["wheel_torque"]] * ahead_wheel
    x = ca.vertcat(x[: INDEX["propshaft_twist"]], *after, x[INDEX["hub_speed"] :])

    count = len(POWERS) + 2
    y = ca.vertcat(x, ca.SX.zeros(count))
    inner = h / inner_steps

    def rates(y: Any) -> Any:
        derivative, torques, powers, _ = equations(y[: len(STATES)], u, p)
        return ca.vertcat(derivative, powers, torques)

    for _ in range(inner_steps):
        k1 = rates(y)
        k2 = rates(y + 0.5 * inner * k1)
        k3 = rates(y + 0.5 * inner * k2)
        k4 = rates(y + inner * k3)
        y = y + inner / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)

    x_end = y[: len(STATES)]
    x_end = ca.vertcat(ca.fmod(x_end[0], _CYCLE), x_end[1:])
    works = y[len(STATES) : len(STATES) + len(POWERS)]
    at_axle = ca.vertcat(0.0, to_pinion, from_ring_gear, 0.0, 0.0)
    energies = z[SLOT[POWERS[0]] : SLOT["interface"]] + works + at_axle
    torques = y[len(STATES) + len(POWERS) :] / h
    z_end = ca.vertcat(
        x_end,
        energies,
        z[SLOT["interface"]] + brought_in + to_pinion - from_ring_gear,
        torques,
        pinion_angle + h * pinion_speed,
        wheel_angle + h * wheel_speed,
        1.0,
    )
    return ca.Function(
        "driveline_interval",
        [z, m, p],
        [z_end, ca.vertcat(torques, ca.sum1(z_end))],
        ["z", "m", "p"],
        ["z_end", "torques"],
    )
