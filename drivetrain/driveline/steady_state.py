"""Steady state of the driveline with its axle, and the periodic motion around it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from drivetrain.driveline.equations import INDEX, STATES, driveline_equations
from drivetrain.driveline.parameters import DrivelineParameters
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError

# Inertias about the shafts [kg m2], [mohammadpour_2015 Table 1].
PINION_INERTIA = 1.734e-3
GEAR_INERTIA = 5.81e-2


@dataclass(frozen=True, slots=True, kw_only=True)
class SteadyState:
    """The driveline at constant speed without torque ripple.

    Parameters
    ----------
    state : array
        In the order of `STATES`, crank angle zero; shape (10,).
    pinion_speed, wheel_speed : float
        Of the axle [rad/s].
    pinion_torque, wheel_torque : float
        On the axle [N m].
    engine_torque : float
        Mean torque [N m].
    gear_ratio : float
        Engine speed over propshaft speed [-].
    """

    state: Array
    pinion_speed: float
    wheel_speed: float
    pinion_torque: float
    wheel_torque: float
    engine_torque: float
    gear_ratio: float


def steady_state(
    parameters: DrivelineParameters, gear_ratio: float, speed: float, axle_power_loss: float
) -> SteadyState:
    """Return the steady state at vehicle speed `speed` [m/s] with `axle_power_loss` [W].

    All rates vanish, and T_p w_p = T_w w_w + P_loss with w_p = (Zg/Zp) w_w.

    Notes
    -----
    The wheels turn slightly faster than V / r_t because the tyres slip while they drive.
    """
    import casadi as ca

    check_within("vehicle speed", speed, 0.5, 120.0, "m/s", "A steady state needs a moving car.")
    road, ratio = parameters.road_load, parameters.axle_ratio
    equations = driveline_equations(parameters, gear_ratio)
    # Unknown: the states but crank angle, vehicle speed, integral; engine torque; wheel speed.
    free = [index for name, index in INDEX.items() if name not in _GIVEN]
    unknown = ca.MX.sym("unknown", len(free) + 2)
    torque, wheel = unknown[len(free)], unknown[len(free) + 1]
    state: list[Any] = [ca.MX(0.0)] * len(STATES)
    for position, index in enumerate(free):
        state[index] = unknown[position]
    state[INDEX["vehicle_speed"]] = ca.MX(speed)
    motion = ca.vertcat(ratio * wheel, wheel)
    rates, _, powers, _ = equations(ca.vertcat(*state), motion, ca.vertcat(speed, torque, 0.0))
    residual = ca.vertcat(
        *[rates[index] for index in (*free, INDEX["vehicle_speed"])],
        powers[1] - powers[2] - axle_power_loss,
    )
    guess = np.zeros(len(free) + 2)
    guess[len(free)] = road.pinion_torque(speed, axle_power_loss) / gear_ratio
    guess[len(free) + 1] = road.wheel_speed(speed)
    solver = ca.rootfinder(
        "steady_state",
        "newton",
        {"x": unknown, "g": residual},
        {"abstol": 1e-9, "error_on_fail": False},
    )
    solution = np.array(solver(guess, [])).ravel()
    if not solver.stats()["success"] or not np.all(np.isfinite(solution)):
        raise ConvergenceError(
            f"No steady state was found at {speed:g} m/s with an axle loss of "
            f"{axle_power_loss:g} W. Check the inertias and stiffnesses of the driveline."
        )
    values = np.zeros(len(STATES))
    values[free] = solution[: len(free)]
    values[INDEX["vehicle_speed"]] = speed
    engine_torque, wheel_speed = (float(value) for value in solution[-2:])
    found = np.array(
        equations(values, [ratio * wheel_speed, wheel_speed], [speed, engine_torque, 0.0])[1]
    ).ravel()
    return SteadyState(
        state=values,
        pinion_speed=ratio * wheel_speed,
        wheel_speed=wheel_speed,
        pinion_torque=float(found[0]),
        wheel_torque=float(found[1]),
        engine_torque=engine_torque,
        gear_ratio=gear_ratio,
    )


_GIVEN = ("crank_angle", "vehicle_speed", "control_torque")


def rigid_axle_jacobian(
    parameters: DrivelineParameters,
    steady: SteadyState,
    pinion_inertia: float = PINION_INERTIA,
    gear_inertia: float = GEAR_INERTIA,
) -> Array:
    """Return the exact Jacobian of driveline and rigid axle at a steady state.

    (I_p + I_g / i^2) w_p' = T_p - T_w / i,  w_w = w_p / i

    Returns
    -------
    array
        Shape (10, 10): the states but the crank angle, in their order, then the pinion speed.
        The torque orders are off, so no state depends on the crank angle.
    """
    import casadi as ca

    ratio = parameters.axle_ratio
    equations = driveline_equations(parameters, steady.gear_ratio)
    y = ca.MX.sym("y", len(STATES))
    pinion = y[len(STATES) - 1]
    inputs = [float(steady.state[INDEX["vehicle_speed"]]), steady.engine_torque, 0.0]
    rates, torques, _, _ = equations(
        ca.vertcat(0.0, y[: len(STATES) - 1]), ca.vertcat(pinion, pinion / ratio), inputs
    )
    inertia = pinion_inertia + gear_inertia / ratio**2
    all_rates = ca.vertcat(rates[1:], (torques[0] - torques[1] / ratio) / inertia)
    jacobian = ca.Function("jacobian", [y], [ca.jacobian(all_rates, y)])
    point = np.append(steady.state[1:], steady.pinion_speed)
    return np.array(jacobian(point))


def periodic_deviation(parameters: DrivelineParameters, steady: SteadyState) -> Array:
    """Return the deviation that engine orders add to the steady state at crank angle zero.

    x_k = Re{(i k w - A)^-1 B a_k T_mean exp(i phase_k)}, summed over the orders k

    Notes
    -----
    Linear, with a rigid axle of the inertias in [mohammadpour_2015 Table 1]. It spares the
    start-up transient of the flywheel and of the shafts.
    """
    jacobian = rigid_axle_jacobian(parameters, steady)
    size = len(jacobian)
    crank = INDEX["crank_speed"]
    drive = np.zeros(size, dtype=complex)
    drive[crank - 1] = steady.engine_torque / parameters.engine.primary_inertia
    total = np.zeros(len(STATES))
    for order in parameters.engine.orders:
        frequency = order.order * steady.state[crank]
        source = drive * order.amplitude * np.exp(1j * order.phase)
        response = np.linalg.solve(1j * frequency * np.eye(size) - jacobian, source)
        total[1:] += response[: len(STATES) - 1].real
        total[0] += (response[crank - 1] / (1j * frequency)).real
    return total
