"""One communication interval of the driveline, compiled to a single casadi call."""

from __future__ import annotations

import math
from typing import Any

from drivetrain.driveline.equations import INDEX, POWERS, STATES

_CYCLE = 4.0 * math.pi  # rad, four strokes
LONGEST_INNER_STEP = 2.5e-4  # s; modes stay below 350 Hz, RK4 then errs by 1e-5 at most

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
