"""Settings of a run-up or coast-down."""

from __future__ import annotations

import hashlib
import json
import math
import sys
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.ramp_vehicle import gear_for_ramp
from drivetrain.speed_ramp import SpeedRamp
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_option, check_within
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin, rads_to_rpm

NODES = 9  # equal times along the ramp
_OF_TABLE = 0.95  # share of the mesh table's torque; the rest is for the loss of the axle
BENCH, VEHICLE = "bench", "vehicle"
DRIVERS = (BENCH, VEHICLE)
SPEEDS = (5.0, 2000.0)  # of the pinion [rad/s]
LONGEST = 600.0  # s
LARGEST_CHANGE = 0.25  # of the speed within a block of revolutions
LEAST_BLOCKS = 8  # that do not overlap
SAMPLE_RATE = 32768.0  # Hz


def car_torques(car: DrivelineParameters, ramp: SpeedRamp) -> Array:
    """Return the torque for road load and acceleration [N m] at `NODES` equal times."""
    return road_torques(car, ramp) + _inertial_torque(car, ramp)


def road_torques(car: DrivelineParameters, ramp: SpeedRamp) -> Array:
    """Return the torque for the road load [N m] at `NODES` equal times of the ramp."""
    road = car.road_load
    arm = car.rolling_radius / car.axle_ratio
    speeds = np.linspace(ramp.start, ramp.end, NODES) / road.final_drive.ratio
    return arm * np.array([road.resistance(float(v)) for v in speeds * road.tyre.rolling_radius])


def fitting_duration(car_axle: CarAxle, ramp: SpeedRamp) -> float:
    """Return the duration of the ramp [s] with which the torque stays in the mesh table.

    It is that of `ramp` if this is long enough, or if the road load alone is too much for any.
    """
    car = car_axle.driveline
    low, high = (_OF_TABLE * end for end in car_axle.axle.torque_range)
    road = road_torques(car, ramp)
    left = high - road.max() if ramp.acceleration > 0.0 else road.min() - low
    if left <= 0.0:
        return ramp.duration
    impulse = abs(_inertial_torque(car, replace(ramp, duration=1.0)))  # N.m s
    return max(ramp.duration, impulse / left)


def _inertial_torque(car: DrivelineParameters, ramp: SpeedRamp) -> float:
    radius, ratio = car.rolling_radius, car.axle_ratio
    mass = car.translating_mass + 2.0 * car.wheel_inertia / radius**2
    return float(mass * ramp.acceleration * radius**2 / ratio**2)


@dataclass(frozen=True, slots=True, kw_only=True)
class RunupSettings:
    """Axle, speed ramp and torque of a run-up or coast-down, for `run_runup`.

    Parameters
    ----------
    car_axle : CarAxle
        Axle and car, see `read_axle`.
    start_speed, end_speed : float
        Pinion speed at the two ends [rad/s]; if the end is lower than the start, it is a
        coast-down.
    duration : float
        Time from start to end [s].
    pinion_torque : float, optional
        Constant torque on the pinion from outside [N m]; below 0 the wheels drive. None: what the
        car needs for its road load and for its acceleration in the ramp.
    driver : str
        "bench": smooth torque on the pinion, the wheel holds the ramp; "vehicle": engine with its
        orders, driveline and tyres in one gear, with the torque that the car needs.
    oil_temperature : float
        Temperature of the oil [K].
    order_resolution : float
        Smallest distance of two orders that are separated [-]; 1 divided by a whole number of
        pinion revolutions.
    highest_frequency : float
        End of the spectra [Hz].
    sample_rate : float
        Sample rate of the record [Hz].
    settling_time : float
        Time at the start speed before the record begins [s].

    Raises
    ------
    ParameterError
        A value is out of range, or the speed changes by more than a quarter within the revolutions
        that the order resolution takes.

    Examples
    --------
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> ramp = RunupSettings(
    ...     car_axle=read_axle("mohammadpour_2015"), start_speed=100.0, end_speed=300.0,
    ...     duration=20.0, pinion_torque=80.0,
    ... )
    >>> ramp.name, ramp.revolutions
    ('run-up', 4)
    """

    car_axle: CarAxle
    start_speed: float
    end_speed: float
    duration: float
    pinion_torque: float | None = None
    driver: str = "bench"
    oil_temperature: float = celsius_to_kelvin(80.0)
    order_resolution: float = 0.25
    highest_frequency: float = 4000.0
    sample_rate: float = SAMPLE_RATE
    settling_time: float = 1.0

    def __post_init__(self) -> None:
        for name in ("start_speed", "end_speed"):
            check_within(name, getattr(self, name), *SPEEDS, "rad/s", "It is the pinion's.")
        if self.start_speed == self.end_speed:
            raise ParameterError(
                f"start_speed and end_speed must differ, got {self.start_speed:g} rad/s for both. "
                "For one speed use a sweep."
            )
        check_within("duration", self.duration, 0.2, LONGEST, "s")
        check_within("order_resolution", self.order_resolution, 0.02, 1.0)
        check_within("sample_rate", self.sample_rate, 8192.0, 131072.0, "Hz")
        check_within(
            "highest_frequency", self.highest_frequency, 100.0, 0.4 * self.sample_rate, "Hz"
        )
        check_within("settling_time", self.settling_time, 0.0, 60.0, "s")
        self.car_axle.axle.oil.check_temperature(self.oil_temperature, "oil_temperature")
        check_option("driver", self.driver, DRIVERS)
        if self.pinion_torque is not None:
            check_finite("pinion_torque", self.pinion_torque, "N m")
            if self.driver == VEHICLE:
                raise ParameterError(
                    "pinion_torque must be left out with the driver 'vehicle', whose engine gives "
                    f"it, got {self.pinion_torque:g} N m. Leave it out, or take 'bench'."
                )
        if self.driver == VEHICLE:
            gear_for_ramp(self.car_axle.driveline, self.ramp)
        self._check_rate()
        self._check_torque()

    @property
    def name(self) -> str:
        """Return "run-up" or "coast-down"."""
        return "run-up" if self.end_speed > self.start_speed else "coast-down"

    @property
    def ramp(self) -> SpeedRamp:
        """The speed over time."""
        return SpeedRamp(start=self.start_speed, end=self.end_speed, duration=self.duration)

    @property
    def revolutions(self) -> int:
        """Pinion revolutions in a block of the order analysis."""
        return math.ceil(1.0 / self.order_resolution - 1e-9)

    def _check_rate(self) -> None:
        slow, fast = sorted((self.start_speed, self.end_speed))
        block = 2.0 * math.pi * self.revolutions
        per_second = (fast - slow) / self.duration
        change = per_second * block / slow**2
        resolution = 1.0 / self.revolutions
        if change > LARGEST_CHANGE:
            shortest = self.duration * change / LARGEST_CHANGE
            lowest = math.sqrt(per_second * block / LARGEST_CHANGE)
            coarser = 1.0 / max(1, int(self.revolutions * LARGEST_CHANGE / change))
            cures = [f"take at least {_up(shortest)} s"]
            if lowest < fast:
                cures.append(f"begin above {_up(rads_to_rpm(lowest))} rpm")
            if coarser > resolution:
                cures.append(f"resolve orders {coarser:.3g} apart")
            raise ParameterError(
                f"The pinion speed must change by at most {100.0 * LARGEST_CHANGE:g} % within the "
                f"{self.revolutions} revolutions that separate orders {resolution:.3g} apart, got "
                f"{100.0 * change:.3g} % at {rads_to_rpm(slow):.0f} rpm: the ramp is too fast. "
                f"For this ramp {', or '.join(cures)}."
            )
        turned = 0.5 * (slow + fast) * self.duration / block
        if turned < LEAST_BLOCKS:
            raise ParameterError(
                f"The ramp must hold {LEAST_BLOCKS} times the {self.revolutions} revolutions that "
                f"separate orders {resolution:.3g} apart, got {turned:.2g} times. Take at least "
                f"{_up(self.duration * LEAST_BLOCKS / turned)} s."
            )

    def _check_torque(self) -> None:
        limits = torque_limits(self.car_axle.axle)
        for torque in self._asked_torques():
            check_within(
                "The torque on the pinion",
                float(torque),
                limits.pinion_low,
                limits.pinion_high,
                "N.m",
                f"{limits.cure} Or take a slower ramp, or give a torque.",
            )

    def vehicle_speed(self, pinion_speed: Array) -> Array:
        """Return the speed of a car whose wheels roll without slip [m/s]."""
        road = self.car_axle.driveline.road_load
        return np.asarray(pinion_speed) / road.final_drive.ratio * road.tyre.rolling_radius

    def _asked_torques(self) -> Array:
        """Return the torque on the pinion without the axle's loss [N m] at equal times."""
        if self.pinion_torque is not None:
            return np.full(NODES, float(self.pinion_torque))
        return car_torques(self.car_axle.driveline, self.ramp)

    def torques(self) -> tuple[Array, Array]:
        """Return torque on the pinion and expected loss torque [N m] at equal times of the ramp.

        Raises
        ------
        ParameterError
            The axle finds no balance at a speed of the ramp.
        """
        asked = self._asked_torques()
        speeds = np.linspace(self.start_speed, self.end_speed, NODES)
        loss = np.empty(NODES)
        for i, (torque, speed) in enumerate(zip(asked, speeds, strict=True)):
            found = axle_losses(
                self.car_axle.axle,
                torques=np.array([torque]),
                speeds=np.array([speed]),
                temperatures=np.array([self.oil_temperature]),
                extremes=False,
            )
            status = int(found.status[0, 0, 0])
            if status:
                raise ParameterError(
                    "The axle must have a static equilibrium along the ramp, but it has none with "
                    f"{torque:.4g} N m at {rads_to_rpm(float(speed)):.0f} rpm: {FAILURES[status]}"
                )
            loss[i] = found.total[0, 0, 0] / speed
        return (asked if self.pinion_torque is not None else asked + loss), loss

    def as_dict(self) -> dict[str, Any]:
        """Return the numbers by name."""
        return {
            "start_speed": self.start_speed,
            "end_speed": self.end_speed,
            "duration": self.duration,
            "pinion_torque": math.nan if self.pinion_torque is None else self.pinion_torque,
            "driver": self.driver,
            "oil_temperature": self.oil_temperature,
            "order_resolution": 1.0 / self.revolutions,
            "highest_frequency": self.highest_frequency,
            "sample_rate": self.sample_rate,
            "settling_time": self.settling_time,
        }

    def key(self) -> str:
        """Return a hash of everything that the record depends on."""
        with np.printoptions(threshold=sys.maxsize):
            axle, car = repr(self.car_axle.axle), repr(self.car_axle.driveline)
        everything = json.dumps([self.as_dict(), axle, car, __version__])
        return hashlib.sha256(everything.encode()).hexdigest()[:20]


def _up(value: float) -> str:
    """Return a number rounded up to two digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / step - 1e-9) * step:g}"
