"""Losses of an axle along a cycle, read from a map over torque, speed and oil temperature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from drivetrain.cycle.demand import Demand, shaft_demand
from drivetrain.cycle.loss_field import LossField, speed_nodes, torque_nodes
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress

_ANGLES = 8  # of a mesh period: within 4e-4 of 256
_RESERVE = 0.1, 15.0  # of the largest torque [-] and [N.m], for what the axle itself loses
_MORE_TORQUE = "Run `gearlube contact` with higher torques, or give a trace with smaller torques."
_MOST_POINTS = 500_000  # of the map: half a gigabyte


def demand_of(settings: DriveCycleSettings) -> Demand:
    """Return torque and speed of the pinion in each step of a cycle, see `shaft_demand`.

    Raises
    ------
    ParameterError
        A torque is beyond what the mesh table allows.
    """
    car = settings.car.driveline
    found = shaft_demand(
        settings.cycle,
        car,
        ratio=car.axle_ratio,
        coast_torque=settings.coast_torque,
        regeneration=settings.regeneration,
    )
    _check_torque(settings, found.torque)
    return found


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
    turning = demand.shaft_speed > 0.0
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
    torques = _torque_nodes(settings, demand.torque[turning])
    speeds = speed_nodes(settings.grid.speeds, float(demand.shaft_speed.max()))
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
    asked, speed = demand.torque[turning], demand.shaft_speed[turning]
    for k in range(temperatures.size):
        field = LossField(speeds=speeds, torques=torques, power=found.power[k])
        carried = asked if demand.measured else field.with_losses(speed, asked, _MORE_TORQUE)
        power[turning, k] = field.lost(speed, carried)
        torque[turning, k] = carried
        outside[turning, k] = field.between(left[k], speed, carried)
        of_film = np.stack([one[k] for one in bounds], axis=-1)
        film[turning, k] = field.between(of_film, speed, carried)
    return along


def _torque_nodes(settings: DriveCycleSettings, torque: Array) -> Array:
    """Return the torques of the map [N.m]: over the trace, as far as the mesh table goes."""
    limits = torque_limits(settings.car.axle)
    reach = _RESERVE[0] * float(np.abs(torque).max()) + _RESERVE[1]
    low = max(limits.pinion_low, min(0.0, float(torque.min())) - reach)
    high = min(limits.pinion_high, max(0.0, float(torque.max())) + reach)
    return torque_nodes(settings.grid.torques, low, high)


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
