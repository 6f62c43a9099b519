"""Losses of an axle along a cycle, read from a map over torque, speed and oil temperature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.road_load import Vehicle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress

_WHEELS = 4
_ANGLES = 8  # of a mesh period: within 4e-4 of 256
_RESERVE = 0.1, 15.0  # of the largest torque [-] and [N.m], for what the axle itself loses
_SLOWEST = 0.01  # of the highest speed, below which the loss torque does not change
_MOST_POINTS = 500_000  # of the map: half a gigabyte
_ROUNDS, _SETTLED = 100, 1e-9  # N.m


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

    As `RoadLoad.resistance`, over slopes [-] of the trace instead of the vehicle's.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class LossesAlong:
    """Losses of every step at the oil temperatures of the map.

    Parameters
    ----------
    temperatures : ndarray of shape (k,)
        [K]
    power : ndarray of shape (n, k, sources)
        [W], sources as in LOSS_SOURCES.
    torque : ndarray of shape (n, k)
        Of the pinion [N.m].
    outside : ndarray of shape (n, k, ranges)
        Share of the points of the map around it that are outside each range of the axle [-];
        ranges as in `HypoidAxleParameters.ranges`.
    film : ndarray of shape (n, k, 4)
        Bound of the flanks' friction loss by a film model [W], and share of their load outside its
        domain [-]; the same of the bearings' drag and of the rollers; 0 with film formulas.
    """

    temperatures: Array
    power: Array
    torque: Array
    outside: Array
    film: Array


def losses_along(
    settings: DriveCycleSettings, demand: Demand, progress: Progress = no_progress
) -> LossesAlong:
    """Return the losses of each step of a cycle at each oil temperature of the map.

    Between the points of the map the loss torque of each source is linear in torque, speed and
    temperature; below the lowest speed it is that of the lowest. The pinion's torque is that of
    the wheels over the ratio plus the loss torque, solved by iteration. What is outside a range
    of a formula is 1 at the points of the map where that range is left, 0 at others, and linear
    between them as well.
    """
    axle = settings.car.axle
    temperatures = _temperatures(settings)
    turning = demand.pinion_speed > 0.0
    count = demand.torque.size
    power = np.zeros((count, temperatures.size, len(LOSS_SOURCES)))
    torque = np.repeat(demand.torque[:, None], temperatures.size, axis=1)
    outside = np.zeros((count, temperatures.size, len(axle.ranges)))
    film = np.zeros((count, temperatures.size, 4))
    along = LossesAlong(
        temperatures=temperatures, power=power, torque=torque, outside=outside, film=film
    )
    if not np.any(turning):
        return along
    torques = torque_nodes(settings, demand.torque[turning])
    speeds = speed_nodes(settings.grid.speeds, float(demand.pinion_speed.max()))
    found = axle_losses(
        axle,
        torques=torques,
        speeds=speeds,
        temperatures=temperatures,
        angles=_ANGLES,
        progress=progress,
    )
    _check_map(found.status, temperatures, speeds, torques)
    bounds = found.friction_bound, found.share_outside, found.drag_bound, found.rollers_outside
    left = found.exceeded.astype(int)[..., None] >> np.arange(len(axle.ranges)) & 1
    asked, speed = demand.torque[turning], demand.pinion_speed[turning]
    at_speed = np.clip(speed, speeds[0], speeds[-1])
    for k in range(temperatures.size):
        loss_torque = RegularGridInterpolator(
            (speeds, torques), found.power[k] / speeds[:, None, None]
        )
        carried = asked
        if not demand.measured:
            carried = _with_losses(loss_torque, at_speed, asked, torques)
        points = np.column_stack([at_speed, carried])
        power[turning, k] = loss_torque(points) * speed[:, None]
        torque[turning, k] = carried
        outside[turning, k] = RegularGridInterpolator((speeds, torques), left[k])(points)
        of_film = np.stack([one[k] for one in bounds], axis=-1)
        film[turning, k] = RegularGridInterpolator((speeds, torques), of_film)(points)
    return along


def _with_losses(
    loss_torque: RegularGridInterpolator, speed: Array, asked: Array, nodes: Array
) -> Array:
    """Return the pinion torques that are `asked` plus the loss torque at themselves [N.m]."""
    carried = asked
    for _ in range(_ROUNDS):
        points = np.column_stack([speed, np.clip(carried, nodes[0], nodes[-1])])
        new = asked + loss_torque(points).sum(axis=-1)
        change = float(np.abs(new - carried).max())
        carried = new
        if change < _SETTLED:
            break
    else:
        raise ParameterError(
            "The iteration of the pinion torque with the losses must settle to within "
            f"{_SETTLED:g} N.m, got a change of {change:.2g} N.m in the last round. The losses "
            "grow faster than the torque. Check the oil and the roughness of the axle."
        )
    if carried.max() > nodes[-1] or carried.min() < nodes[0]:
        raise ParameterError(
            f"The pinion torque with losses must be within {nodes[0]:g} to {nodes[-1]:g} N.m, got "
            f"{carried.min():.4g} to {carried.max():.4g} N.m. Run `gearlube contact` with higher "
            "torques, or give a trace with smaller torques."
        )
    return carried


def torque_nodes(settings: DriveCycleSettings, torque: Array) -> Array:
    """Return the torques of the map [N.m]: over the trace, denser near 0, and 0 itself."""
    limits = torque_limits(settings.car.axle)
    reach = _RESERVE[0] * float(np.abs(torque).max()) + _RESERVE[1]
    low = max(limits.pinion_low, min(0.0, float(torque.min())) - reach)
    high = min(limits.pinion_high, max(0.0, float(torque.max())) + reach)
    roots = np.sqrt(-low), np.sqrt(high)
    below = max(2, round((settings.grid.torques - 1) * roots[0] / sum(roots)))
    above = max(2, settings.grid.torques - 1 - below)
    return np.concatenate(
        [
            low * np.linspace(1.0, 0.0, below, endpoint=False) ** 2,
            high * np.linspace(0.0, 1.0, above + 1) ** 2,
        ]
    )


def speed_nodes(count: int, highest: float) -> Array:
    """Return the pinion speeds of the map [rad/s], in a geometric series."""
    nodes = np.geomspace(_SLOWEST * highest, highest, count)
    nodes[-1] = highest
    return nodes


def _temperatures(settings: DriveCycleSettings) -> Array:
    """Return the oil temperatures of the map [K], from the coldest to the end of the oil's data."""
    low = min(settings.start_temperature, settings.air_temperature)
    high = settings.car.axle.oil.temperature_high
    low = min(low, high - 1.0)
    grid = settings.grid
    count = max(1, int(np.ceil((high - low) / grid.temperature_step)))
    points = grid.torques * grid.speeds * (count + 1)
    cure = "Take a coarser grid."
    check_within("torques times speeds times temperatures", points, 1, _MOST_POINTS, "", cure)
    return np.linspace(low, high, count + 1)


def _check_map(status: Array, temperatures: Array, speeds: Array, torques: Array) -> None:
    if not np.any(status):
        return
    i, j, k = np.argwhere(status)[0]
    raise ParameterError(
        f"The losses must be found at every point of the map, but {int((status != 0).sum())} "
        f"points failed. The first is at {temperatures[i]:.1f} K, {speeds[j]:.4g} rad/s and "
        f"{torques[k]:.4g} N.m: {FAILURES[int(status[i, j, k])]}"
    )


def at_temperatures(values: Array, nodes: Array, temperatures: Array) -> Array:
    """Return values (n, k, ...) at a temperature for each of n steps, linear between k nodes."""
    cell = np.searchsorted(nodes[1:-1], temperatures)
    share = (temperatures - nodes[cell]) / (nodes[cell + 1] - nodes[cell])
    share = share.reshape(-1, *(1,) * (values.ndim - 2))
    rows = np.arange(len(temperatures))
    return np.asarray((1.0 - share) * values[rows, cell] + share * values[rows, cell + 1])
