"""The car that takes its axle through a speed ramp in one gear, with the engine's orders."""

from __future__ import annotations

import numpy as np

from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.speed_ramp import SpeedRamp
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import rads_to_rpm


def gear_for_ramp(parameters: DrivelineParameters, ramp: SpeedRamp) -> int:
    """Return the gear that keeps the engine within its speeds all along the ramp.

    The highest one that does not fall below the gearbox's lowest cruising speed, else the lowest.

    Raises
    ------
    ParameterError
        There is none.
    """
    engine, ratios = parameters.engine, parameters.gearbox.ratios
    slow, fast = sorted(rads_to_rpm(one) for one in (ramp.start, ramp.end))
    low, high = engine.idle_speed_rpm, engine.highest_speed_rpm
    fitting = [g for g, r in enumerate(ratios, 1) if r * slow >= low and r * fast <= high]
    if not fitting:
        raise ParameterError(
            f"The car needs one gear that keeps the engine within {low:g} to {high:g} rpm from "
            f"{slow:.0f} to {fast:.0f} rpm of the pinion, but none of the ratios does: {ratios}: "
            f"the ends may differ by a factor of {high / low:.3g}. Take a shorter ramp, or leave "
            "the engine out."
        )
    floor = parameters.gearbox.lowest_cruising_speed_rpm
    lively = [gear for gear in fitting if ratios[gear - 1] * slow >= floor]
    return max(lively) if lively else min(fitting)


class RampVehicle:
    """Driver for a speed ramp in the car: engine, driveline, tyres and mass around the axle.

    The engine's mean torque is what the ramp needs by road load, mass and losses; the slow speed
    controller of the driveline does the rest. The engine's orders act.

    Parameters
    ----------
    parameters : DrivelineParameters
        The car.
    ramp : SpeedRamp
        Of the pinion.
    loss_torque : array
        Expected loss of the axle at the pinion [N m] at equal times of the ramp.
    lead : float
        Time before the ramp in which the car begins to accelerate, smoothly [s].
    gear : int, optional
        By default that of `gear_for_ramp`.
    """

    def __init__(
        self,
        parameters: DrivelineParameters,
        ramp: SpeedRamp,
        loss_torque: Array,
        lead: float,
        gear: int | None = None,
    ) -> None:
        check_within("lead", lead, 0.1, 60.0, "s")
        self.ramp, self._lead = ramp, lead
        self._loss = np.asarray(loss_torque, dtype=np.float64)
        self._times = np.linspace(0.0, ramp.duration, self._loss.size)
        self._metre = parameters.rolling_radius / parameters.axle_ratio  # of the car per rad
        loss = float(self._loss[0]) * ramp.start
        self.driveline = Driveline(
            parameters, self._speed(-lead), loss, gear=gear or gear_for_ramp(parameters, ramp)
        )
        self._road = parameters.road_load
        self._total = self.driveline.gear_ratio / self._metre  # rad of the crank per metre
        self._mass = parameters.moved_mass(self.driveline.gear_ratio)
        self._elapsed = 0.0

    def _acceleration(self, time: float) -> float:
        """Return the acceleration of the car asked for [m/s2]."""
        if time >= self.ramp.duration:
            return 0.0
        share = min(max((time + self._lead) / (0.5 * self._lead), 0.0), 1.0)
        return self.ramp.acceleration * self._metre * share * share * (3.0 - 2.0 * share)

    def _speed(self, time: float) -> float:
        """Return the speed of the car asked for [m/s]: the integral of the acceleration."""
        half = 0.5 * self._lead
        share = min(max((time + self._lead) / half, 0.0), 1.0)
        begun = half * share**3 * (1.0 - 0.5 * share)
        gained = begun - 0.5 * half + min(max(time, -half), self.ramp.duration)
        return self._metre * (self.ramp.start + self.ramp.acceleration * gained)

    def initial_torques(self) -> tuple[float, float]:
        """Return the steady torques on pinion and wheel [N m]."""
        return self.driveline.steady.pinion_torque, self.driveline.steady.wheel_torque

    @property
    def initial_pinion_speed(self) -> float:
        """Pinion speed at the start of the lead, tyre slip included [rad/s]."""
        return self.driveline.steady.pinion_speed

    @property
    def time(self) -> float:
        """Time since the ramp began [s], below 0 before."""
        return self._elapsed - self._lead

    def step(
        self,
        h: float,
        pinion_angle: float,
        pinion_speed: float,
        wheel_angle: float,
        wheel_speed: float,
    ) -> tuple[float, float]:
        """Return the torques on pinion and wheel [N m] for the next `h` [s].

        Parameters as of `drivers.Driver.step`.
        """
        middle = self.time + 0.5 * h
        speed = self._speed(middle)
        force = self._road.resistance(speed) + self._mass * self._acceleration(middle)
        loss = float(np.interp(middle, self._times, self._loss)) / self._metre
        self.driveline.request(speed, (force + loss) / self._total)
        torques = self.driveline.step(h, pinion_angle, pinion_speed, wheel_angle, wheel_speed)
        self._elapsed += h
        return torques

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (n,)."""
        return np.concatenate([self.driveline.get_state(), [self._elapsed]])

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""
        values = np.asarray(state, dtype=np.float64)
        self.driveline.set_state(values[:-1])
        self._elapsed = float(values[-1])
