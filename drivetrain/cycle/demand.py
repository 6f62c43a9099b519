"""Demand of a drive cycle on the shaft that drives a car."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from drivetrain.cycle.traces import DriveCycle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import Vehicle
from gearlube_core.arrays import Array

_WHEELS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Load of the driven shaft of a car in each step; arrays of shape (n,).

    Parameters
    ----------
    steps : ndarray
        Durations [s].
    speed, shaft_speed : ndarray
        Of the vehicle [m/s] and of the shaft [rad/s], in the middle of the step.
    torque : ndarray
        Torque of all wheels over the ratio, or that of the shaft where it was `measured` [N.m].
    brakes, road : ndarray
        Power of the friction brakes and of air, road and slope [W]; `road` is NaN where torques
        were measured.
    measured : bool
    """

    steps: Array
    speed: Array
    shaft_speed: Array
    torque: Array
    brakes: Array
    road: Array
    measured: bool


def shaft_demand(
    cycle: DriveCycle,
    car: DrivelineParameters,
    *,
    ratio: float,
    coast_torque: float,
    regeneration: float,
) -> Demand:
    """Return torque and speed of the driven shaft in each step of a cycle.

    Wheel torque is rolling radius times resistance of air, road and slope and the inertia of the
    vehicle and its four wheels. Where the car brakes by more than the coast torque, the shaft
    carries of the rest the share `regeneration`.

    Parameters
    ----------
    cycle : DriveCycle
    car : DrivelineParameters
    ratio : float
        Speed of the shaft over that of the wheels [-].
    coast_torque : float
        By which the shaft brakes before any brake does [N.m].
    regeneration : float
        [-]

    Examples
    --------
    >>> from drivetrain.road_load import mohammadpour_2015_road_load
    >>> cruise = DriveCycle(name="cruise", time=np.arange(3.0), speed=np.full(3, 20.0))  # m/s
    >>> car = DrivelineParameters(road_load=mohammadpour_2015_road_load())
    >>> found = shaft_demand(cruise, car, ratio=10.0, coast_torque=0.0, regeneration=1.0)
    >>> found.torque.round(2), found.shaft_speed.round(1)  # N.m, rad/s
    (array([12.45, 12.45]), array([624.4, 624.4]))
    """
    radius, steps = car.rolling_radius, np.diff(cycle.time)
    if cycle.pinion_speed is not None and cycle.pinion_torque is not None:
        turning, torque = _middle(cycle.pinion_speed), _middle(cycle.pinion_torque)
        speed, brakes = turning / ratio * radius, np.zeros_like(turning)
        road = np.full_like(turning, np.nan)
    else:
        assert cycle.speed is not None
        speed = _middle(cycle.speed)
        grade = None if cycle.grade is None else _middle(cycle.grade)
        force = resistance(car.road_load.vehicle, speed, grade)
        road = force * speed
        force = force + felt_mass(car) * np.diff(cycle.speed) / steps
        asked = np.where(speed > 0.0, force, 0.0) * radius / ratio
        turning = speed / radius * ratio
        beyond = np.maximum(0.0, -asked - coast_torque)
        by_brakes = (1.0 - regeneration) * beyond
        torque, brakes = asked + by_brakes, by_brakes * turning
    return Demand(
        steps=steps,
        speed=speed,
        shaft_speed=turning,
        torque=torque,
        brakes=brakes,
        road=road,
        measured=cycle.measured,
    )


def felt_mass(car: DrivelineParameters) -> float:
    """Return the mass of a vehicle and its four wheels as the road feels it [kg]."""
    return car.road_load.vehicle.mass + _WHEELS * car.wheel_inertia / car.rolling_radius**2


def resistance(vehicle: Vehicle, speed: Array, grade: Array | None = None) -> Array:
    """Return the resistance [N] of air, road and slope at speeds above 0 [m/s].

    As `RoadLoad.resistance`, over slopes [-] of the trace instead of the vehicle's.
    """
    slope = np.arctan(vehicle.grade if grade is None else grade)
    weight = vehicle.mass * vehicle.gravity
    along = vehicle.rolling_coefficient * np.cos(slope) + np.sin(slope)
    return np.asarray(vehicle.drag_area * speed**2 + weight * along)


def _middle(values: Array) -> Array:
    return np.asarray(0.5 * (values[1:] + values[:-1]))
