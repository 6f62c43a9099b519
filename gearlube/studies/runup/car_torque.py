"""Torque on the pinion that the car needs in a speed ramp, without the loss of the axle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.speed_ramp import SpeedRamp
from gearlube_core.arrays import Array

NODES = 9  # equal times along the ramp
_OF_TABLE = 0.95  # share of the mesh table's torque; the rest is for the loss of the axle


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
