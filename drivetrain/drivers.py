"""Drivers: models that give the torques on the axle's two shafts from their motion."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.driveline.steady_state import GEAR_INERTIA, PINION_INERTIA
from drivetrain.road_load import RoadLoad
from drivetrain.speed_ramp import SlowLoop
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError, StepError


class Driver(Protocol):
    """Interface of a model that gives the torques on the two shafts of the axle.

    Notes
    -----
    `step` takes the motion at the start of an interval and returns the torques for that interval.
    Only changes of the angles count, so the axle may start at any angle.
    """

    def initial_torques(self) -> tuple[float, float]:
        """Return the steady torques on pinion and wheel [N m]."""

    def step(
        self,
        h: float,
        pinion_angle: float,
        pinion_speed: float,
        wheel_angle: float,
        wheel_speed: float,
    ) -> tuple[float, float]:
        """Return the torques on pinion and wheel [N m] for the next `h` [s]."""

    @property
    def initial_pinion_speed(self) -> float:
        """Pinion speed at which the axle should start [rad/s]."""

    @property
    def vehicle_speed(self) -> float:
        """Speed of the vehicle [m/s]."""

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (n,)."""

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""


class SpeedHold:
    """Constant road load on the ring gear, and a slow speed hold on the pinion.

    T_w = T_ag(V),  T_p = (Zp/Zg) T_ag + P_loss/w_0 + K (w_0 - w) + K_I (w_0 t - angle)

    Parameters
    ----------
    road_load : RoadLoad
        Gives T_ag and w_0.
    speed : float
        Requested vehicle speed [m/s].
    axle_power_loss : float
        Known power loss of the axle [W]; the integral term finds the rest.
    proportional_gain : float
        K [N m s/rad]. The gain is a damper K / I_p on the pinion: 0.05 changes the damping ratio
        of the mesh mode by 0.001, 5 by 0.1, which can hide an instability.
    integral_gain : float, optional
        K_I [N m/rad]; by default K^2 / (4 I), which is critical damping for the inertia I of the
        whole axle at the pinion.
    axle_inertia : float, optional
        I [kg m2]; by default that of [mohammadpour_2015 Table 1].
    start_factor : float
        By which the loop is faster at the start, so that it learns the axle's losses before a
        record begins [-]: K times f, K_I times f squared with f = 3 / (w t), at most this factor
        and at least 1, where w = K / (2 I) is the bandwidth. 1 switches it off.

    Notes
    -----
    The loop is that of `SlowLoop`. With the slow
    loop alone an unknown loss of 1 % of the torque costs up to 8 % of speed at 20 km/h. A gain
    that falls with 1/t averages the ripple over all the time that has passed. By default f is 2.8
    after 0.4 s and 1 from 1.1 s on.

    References
    ----------
    [mohammadpour_2015 (7)] [mohammadpour_2015 (9)]; the paper gives no speed control.
    """

    def __init__(
        self,
        road_load: RoadLoad,
        speed: float,
        *,
        axle_power_loss: float = 0.0,
        proportional_gain: float = 0.05,
        integral_gain: float | None = None,
        axle_inertia: float | None = None,
        start_factor: float = 20.0,
    ) -> None:
        check_within("speed", speed, 0.5, 120.0, "m/s", "The axle must turn forward.")
        if axle_inertia is None:
            axle_inertia = PINION_INERTIA + GEAR_INERTIA / road_load.final_drive.ratio**2
        self._loop = SlowLoop(proportional_gain, integral_gain, axle_inertia, start_factor)
        self.road_load = road_load
        self._speed = road_load.pinion_speed(speed)
        self._torque = road_load.pinion_torque(speed, axle_power_loss)
        self._load = road_load.ring_gear_torque(speed)
        self._wheel_speed = road_load.wheel_speed(speed)

    def initial_torques(self) -> tuple[float, float]:
        """Return the steady torques on pinion and wheel [N m]."""
        return self._torque, self._load

    @property
    def initial_pinion_speed(self) -> float:
        """Pinion speed at the requested vehicle speed [rad/s]."""
        return self._speed

    @property
    def vehicle_speed(self) -> float:
        """Speed of a vehicle whose wheels roll with the ring gear [m/s]."""
        return self.road_load.vehicle_speed(self._wheel_speed)

    @property
    def loss_torque(self) -> float:
        """Pinion torque that the integral term has learnt, beyond the given loss [N m]."""
        return self._loop.learnt

    def step(
        self,
        h: float,
        pinion_angle: float,
        pinion_speed: float,
        wheel_angle: float,
        wheel_speed: float,
    ) -> tuple[float, float]:
        """Return the torques on pinion and wheel [N m] for the next `h` [s]."""
        if not (h > 0.0 and math.isfinite(h + pinion_angle + pinion_speed + wheel_speed)):
            raise StepError(
                f"The speed hold needs h above 0 s and finite signals, got h {h:g} s, pinion "
                f"{pinion_angle:g} rad, {pinion_speed:g} rad/s, wheel {wheel_speed:g} rad/s. "
                "Look at the axle's outputs before this step."
            )
        self._wheel_speed = float(wheel_speed)
        torque = self._torque + self._loop.torque(
            h, pinion_angle, pinion_speed, self._speed, h * self._speed
        )
        return torque, self._load

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (5,)."""
        elapsed, integral, expected, started = self._loop.state
        return np.array([elapsed, integral, expected, self._wheel_speed, started])

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""
        values = np.asarray(state, dtype=np.float64)
        if values.shape != (5,) or not np.all(np.isfinite(values)):
            raise ParameterError(
                f"The state must hold 5 finite numbers, got shape {values.shape}. "
                "Use what get_state of the same class returned."
            )
        elapsed, integral, expected, self._wheel_speed, started = values.tolist()
        self._loop.state = (elapsed, integral, expected, started)


class CoupledVehicle:
    """Engine, driveline, wheels and vehicle, coupled to the axle.

    Parameters
    ----------
    parameters : DrivelineParameters
        The car.
    speed : float
        Requested vehicle speed [m/s].
    axle_power_loss : float
        Power lost in the axle, as far as known [W].
    """

    def __init__(
        self, parameters: DrivelineParameters, speed: float, *, axle_power_loss: float = 0.0
    ) -> None:
        self.driveline = Driveline(parameters, speed, axle_power_loss)
        self.step = self.driveline.step  # one call less in every step

    def initial_torques(self) -> tuple[float, float]:
        """Return the steady torques on pinion and wheel [N m]."""
        return self.driveline.steady.pinion_torque, self.driveline.steady.wheel_torque

    @property
    def initial_pinion_speed(self) -> float:
        """Pinion speed at the requested vehicle speed, tyre slip included [rad/s]."""
        return self.driveline.steady.pinion_speed

    @property
    def vehicle_speed(self) -> float:
        """Speed of the vehicle's mass [m/s]."""
        return self.driveline.vehicle_speed

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (n,)."""
        return self.driveline.get_state()

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""
        self.driveline.set_state(state)
