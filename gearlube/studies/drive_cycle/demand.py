"""What a trace asks of the axle: torque and speed in the middle of each step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.road_load import Vehicle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError

_WHEELS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """What the axle carries in each step; arrays of shape (n,).

    Parameters
    ----------
    steps : ndarray
        Durations [s].
    speed, pinion_speed : ndarray
        Of the vehicle [m/s] and of the pinion [rad/s], in the middle of the step.
    torque : ndarray
        Torque of both wheels over the ratio, or that of the pinion where it was `measured` [N.m].
    brakes : ndarray
        Power of the friction brakes [W].
    measured : bool
    """

    steps: Array
    speed: Array
    pinion_speed: Array
    torque: Array
    brakes: Array
    measured: bool


def demand_of(settings: DriveCycleSettings) -> Demand:
    """Return torque and speed of each step of a cycle.

    Wheel torque is rolling radius times resistance of air, road and slope and the inertia of the
    vehicle and its four wheels. Where it brakes by more than the coast torque, the axle carries
    of the rest the share `regeneration`.

    Raises
    ------
    ParameterError
        A torque is beyond what the mesh table allows.
    """
    cycle, car = settings.cycle, settings.car
    road = car.driveline.road_load
    radius, ratio = road.tyre.rolling_radius, road.final_drive.ratio
    steps = np.diff(cycle.time)
    if cycle.pinion_speed is not None and cycle.pinion_torque is not None:
        turning, torque = _middle(cycle.pinion_speed), _middle(cycle.pinion_torque)
        speed, brakes = turning / ratio * radius, np.zeros_like(turning)
    else:
        assert cycle.speed is not None
        speed = _middle(cycle.speed)
        grade = None if cycle.grade is None else _middle(cycle.grade)
        force = resistance(road.vehicle, speed, grade)
        force += _inertia(car) * np.diff(cycle.speed) / steps
        asked = np.where(speed > 0.0, force, 0.0) * radius / ratio
        turning = speed / radius * ratio
        beyond = np.maximum(0.0, -asked - settings.coast_torque)
        by_brakes = (1.0 - settings.regeneration) * beyond
        torque, brakes = asked + by_brakes, by_brakes * turning
    _check_torque(settings, torque)
    return Demand(
        steps=steps,
        speed=speed,
        pinion_speed=turning,
        torque=torque,
        brakes=brakes,
        measured=cycle.measured,
    )


def resistance(vehicle: Vehicle, speed: Array, grade: Array | None = None) -> Array:
    """Return the resistance [N] of air, road and slope at speeds above 0 [m/s].

    As `RoadLoad.resistance`, over slopes [-] of the trace in the place of the vehicle's.
    """
    slope = np.arctan(vehicle.grade if grade is None else grade)
    weight = vehicle.mass * vehicle.gravity
    along = vehicle.rolling_coefficient * np.cos(slope) + np.sin(slope)
    return np.asarray(vehicle.drag_area * speed**2 + weight * along)


def _inertia(car: CarAxle) -> float:
    """Return the mass of vehicle and wheels as the road feels it [kg]."""
    radius = car.driveline.road_load.tyre.rolling_radius
    return car.driveline.road_load.vehicle.mass + _WHEELS * car.driveline.wheel_inertia / radius**2


def _middle(values: Array) -> Array:
    return np.asarray(0.5 * (values[1:] + values[:-1]))


def _check_torque(settings: DriveCycleSettings, torque: Array) -> None:
    limits = torque_limits(settings.car.axle)
    bad = np.flatnonzero((torque < limits.pinion_low) | (torque > limits.pinion_high))
    if bad.size:
        time = settings.cycle.time[bad[0]]
        raise ParameterError(
            f"The pinion torque of {settings.cycle.name} must be within {limits.pinion_low:g} to "
            f"{limits.pinion_high:g} N.m, got {torque[bad[0]]:.4g} N.m at {time:g} s. Check mass "
            "and tyre of the axle file and the units of the trace. If the axle file names a gear "
            "file, its contact_torques_n_m set the torques at which that is analysed. "
            f"{limits.cure}"
        )
