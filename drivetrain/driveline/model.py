"""Engine, gearbox, shafts, wheels and vehicle around the axle, as a co-simulation partner."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drivetrain.driveline.equations import (
    INDEX,
    LONGEST_INNER_STEP,
    MEMORY,
    POWERS,
    SLOT,
    STATES,
    driveline_equations,
    driveline_stepper,
)
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.driveline.steady_state import (
    periodic_deviation,
    steady_state,
)
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError, StepError

_LONGEST_STEP = 1e-2  # s

# Default communication step [s]. With a rigid axle the exchange of torques is stable up to 1.06 ms;
# with an elastic mesh (2 kHz mode) up to 0.23 ms. At 0.1 ms the damping ratio of the propshaft
# mode changes by less than 1e-3 and that of the mesh mode by -5.5e-3; at 0.05 ms by -1e-3.
COMMUNICATION_STEP = 1e-4
_SIGNALS = ("h", "pinion_angle", "pinion_speed", "wheel_angle", "wheel_speed")


class Driveline:
    """The vehicle around the axle at a requested speed.

    Parameters
    ----------
    parameters : DrivelineParameters
        The car.
    speed : float
        Requested vehicle speed [m/s].
    axle_power_loss : float
        Known power loss of the axle [W]; the speed controller finds the rest.
    gear : int, optional
        Counted from 1; by default the gearbox chooses it for the requested speed.

    Notes
    -----
    The gear does not change. The driveline starts in its
    periodic steady state, computed from the engine orders and a rigid axle.
    """

    def __init__(
        self,
        parameters: DrivelineParameters,
        speed: float,
        axle_power_loss: float = 0.0,
        gear: int | None = None,
    ) -> None:
        check_within("axle_power_loss", axle_power_loss, 0.0, 1e6, "W", "A loss is positive.")
        road = parameters.road_load
        self.parameters = parameters
        if gear is None:
            gear = parameters.gearbox.gear_for(road.pinion_speed(speed), parameters.engine)
        self.gear = int(check_within("gear", gear, 1, len(parameters.gearbox.ratios)))
        self.gear_ratio = parameters.gearbox.ratios[self.gear - 1]
        self.equations = driveline_equations(parameters, self.gear_ratio)
        self.steady = steady_state(parameters, self.gear_ratio, speed, axle_power_loss)
        self._steppers: dict[int, Any] = {}
        self._alive: list[Any] = []
        self._inputs = np.array([speed, self.steady.engine_torque, 1.0])
        self._memory = np.zeros(len(MEMORY))
        self._memory[: len(STATES)] = self.steady.state
        if parameters.engine.orders:
            self._memory[: len(STATES)] += periodic_deviation(parameters, self.steady)
        self._next = np.zeros(len(MEMORY))
        self._motion = np.zeros(len(_SIGNALS))
        self._torques = np.zeros(3)

    @property
    def vehicle_speed(self) -> float:
        """Speed of the vehicle's mass [m/s]."""
        return float(self._memory[INDEX["vehicle_speed"]])

    @property
    def engine_speed(self) -> float:
        """Crank speed [rad/s]."""
        return float(self._memory[INDEX["crank_speed"]])

    @property
    def states(self) -> dict[str, float]:
        """States by name, SI."""
        return {name: float(self._memory[index]) for name, index in INDEX.items()}

    @property
    def energy(self) -> dict[str, float]:
        """Energies since the start [J].

        engine = pinion - ring_gear + road + dissipated + (change of stored) - interface

        Notes
        -----
        "pinion" leaves through the propshaft, "ring_gear" comes back through the half-shafts, each
        as the mean torque times the angle that the axle has covered; the last interval counts with
        the continued angle until the next step. "interface" is the numerical energy of the
        co-simulation: what correcting the continued angles has brought in.
        """
        values = {name: float(self._memory[SLOT[name]]) for name in (*POWERS, "interface")}
        state = self._memory[: len(STATES)]
        # The stored energy does not depend on the axle's speeds.
        values["stored"] = float(self.equations(state, (0.0, 0.0), self._inputs)[3])
        return values

    def request_speed(self, speed: float) -> None:
        """Set the target of the speed controller to `speed` [m/s], in the same gear."""
        self._inputs[0] = check_within("speed", speed, 0.0, 120.0, "m/s", "Speeds are forward.")

    def request(self, speed: float, engine_torque: float) -> None:
        """Set the target of the speed controller [m/s] and the mean engine torque there [N m]."""
        self._inputs[0] = speed
        self._inputs[1] = engine_torque

    def step(
        self,
        h: float,
        pinion_angle: float,
        pinion_speed: float,
        wheel_angle: float,
        wheel_speed: float,
    ) -> tuple[float, float]:
        """Advance by `h` [s]; return the mean propshaft and half-shaft torque of the interval.

        Parameters
        ----------
        h : float
            Communication step, at most 0.01 [s].
        pinion_angle, wheel_angle : float
            Angles of pinion and ring gear at the start of the interval [rad].
        pinion_speed, wheel_speed : float
            Their speeds [rad/s].

        Returns
        -------
        tuple of float
            Torque that drives the pinion, torque that resists the ring gear [N m].

        Raises
        ------
        StepError
            On a signal that is not finite; the driveline is then as before the call.
        """
        inner_steps = math.ceil(h / LONGEST_INNER_STEP) if 0.0 < h <= _LONGEST_STEP else 0
        call = self._steppers.get(inner_steps) or self._stepper(inner_steps, h)
        motion = self._motion
        motion[0] = h
        motion[1] = pinion_angle
        motion[2] = pinion_speed
        motion[3] = wheel_angle
        motion[4] = wheel_speed
        call()
        torque, load, total = self._torques.tolist()
        if not math.isfinite(total + torque + load):
            got = ", ".join(
                f"{name} {value:g}" for name, value in zip(_SIGNALS, motion, strict=True)
            )
            raise StepError(
                f"The driveline must get finite signals, got {got} and states {self.states}. "
                "Look at the axle's outputs before this step; the driveline has not moved."
            )
        self._memory[:] = self._next
        return torque, load

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (n,)."""
        return np.concatenate([self._memory, self._inputs])

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""
        values = np.asarray(state, dtype=np.float64)
        size = self._memory.size
        length = size + self._inputs.size
        if values.shape != (length,) or not np.all(np.isfinite(values)):
            raise ParameterError(
                f"The state must hold {length} finite numbers, got shape {values.shape}. "
                "Use what get_state of the same class returned."
            )
        self._memory[:] = values[:size]
        self._inputs[:] = values[size:]

    def _interval(self, inner_steps: int) -> Any:
        a = self.parameters
        return driveline_stepper(
            self.equations, inner_steps, a.propshaft_stiffness, a.half_shaft_stiffness
        )

    @property
    def inputs(self) -> Array:
        """Requested speed [m/s], mean engine torque there [N m], scale of the orders [-]."""
        return self._inputs.copy()

    def _stepper(self, inner_steps: int, h: float) -> Any:
        if inner_steps == 0:
            raise StepError(
                f"h must be within 0 to {_LONGEST_STEP:g} s, got {h:g} s. "
                "A communication step of 1e-4 s keeps a margin."
            )
        function = self._interval(inner_steps)
        buffer, call = function.buffer()
        for position, array in enumerate((self._memory, self._motion, self._inputs)):
            buffer.set_arg(position, array.data)
        buffer.set_res(0, self._next.data)
        buffer.set_res(1, self._torques.data)
        # The function and its buffer must live as long as the bare call.
        self._alive += [function, buffer]
        self._steppers[inner_steps] = call
        return call
