"""Error bars of a drive cycle: uncertain data and laws of the losses, and assumed heat data."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from drivetrain.sump_heat import SumpHeat, warm
from gearlube.studies.drive_cycle.loss_field import (
    Demand,
    LossesAlong,
    at_temperatures,
    losses_along,
)
from gearlube.studies.drive_cycle.settings import DriveCycleSettings, LossGrid
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.uncertain import (
    UPPER_END,
    Uncertain,
    by_one_film,
    changed_axle,
    log_slope,
    uncertain_of,
)
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.progress import Progress, no_progress

_BOUNDS = 2.5, 97.5  # percent
_KJ = 1e-3
_LEAST_DRAWS = 3  # for each input, to separate causes


@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSpread:
    """Bounds of 95 % of the draws, low and high.

    Parameters
    ----------
    lost, efficiency, end_temperature : tuple of 2 floats
        Energy lost [kJ], efficiency [-], oil temperature at the end [K].
    causes : tuple of (str, float)
        What an input is, and by what share it alone moves the energy lost to its upper end, largest
        first; empty with too few draws.
    """

    lost: tuple[float, float]
    efficiency: tuple[float, float]
    end_temperature: tuple[float, float]
    causes: tuple[tuple[str, float], ...] = ()


def uncertain_inputs(settings: DriveCycleSettings) -> tuple[Uncertain, ...]:
    """Return the uncertain data of the axle of a cycle, as its loss map has them."""
    return uncertain_of(settings.car.axle, calibrated_bearings=settings.calibrated_bearings)


def check_inputs(settings: DriveCycleSettings) -> None:
    """Raise ParameterError where an uncertain datum leaves its limits; nothing is computed."""
    if settings.draws:
        for one in uncertain_inputs(settings):
            for normal in (UPPER_END, -UPPER_END):
                changed_axle(one, settings.car.axle, normal, np.ones(len(LOSS_SOURCES)))


def cycle_spread(
    settings: DriveCycleSettings,
    demand: Demand,
    losses: LossesAlong,
    progress: Progress = no_progress,
) -> CycleSpread:
    """Return the error bars of a cycle by `settings.draws` draws, each for the whole cycle.

    The losses of a draw are those of the axle, source by source, times exp(s z) for each datum
    at a standard normal z. There s is the logarithm of the ratio of the losses with the datum at
    its upper and at its lower end, over the four standard deviations between them. Two coarse maps
    for each datum give the ratio, at the torques that the axle carries with all data at their
    values. Laws that are known to a factor scale their sources. Heat capacity and conductances
    that were not given are drawn within their assumed intervals.
    """
    inputs = uncertain_inputs(settings)
    carried = replace(demand, torque=losses.torque.mean(axis=1), measured=True)
    slopes = _slopes(settings, carried, inputs, progress)
    rng = np.random.default_rng(settings.seed)
    results, drawn = np.empty((settings.draws, 3)), np.empty((settings.draws, len(inputs)))
    sources = losses.power @ np.ones(len(LOSS_SOURCES))
    driving = losses.torque > 0.0
    measured = 0.0 if demand.measured else 1.0
    for k in range(settings.draws):
        normals, heat = rng.standard_normal(len(inputs)), _drawn_heat(settings.heat, rng)
        drawn[k] = normals
        exponent = sum(normal * slope for normal, slope in zip(normals, slopes, strict=True))
        total = np.asarray((losses.power * np.exp(exponent)).sum(axis=-1))
        warming = warm(
            heat,
            steps=demand.steps,
            speeds=demand.speed,
            power=total,
            nodes=losses.temperatures,
            start=settings.start_temperature,
            air=settings.air_temperature,
        )
        put_in = losses.torque * demand.shaft_speed[:, None]
        # what is lost more, the pinion puts in where it drives; in coast the wheels give less
        put_in = put_in + measured * np.where(driving, total - sources, 0.0)
        given_out = put_in - total
        energy = np.maximum(put_in, 0.0) + np.maximum(-given_out, 0.0)
        along = np.stack([total, energy], axis=-1)
        lost, into = demand.steps @ at_temperatures(along, losses.temperatures, warming.mean)
        results[k] = (
            _KJ * lost,
            1.0 - lost / into if into > 0.0 else np.nan,
            warming.temperature[-1],
        )
    low, high = np.percentile(results, _BOUNDS, axis=0)
    pairs = [(float(a), float(b)) for a, b in zip(low, high, strict=True)]
    return CycleSpread(
        lost=pairs[0],
        efficiency=pairs[1],
        end_temperature=pairs[2],
        causes=_causes(inputs, drawn, results[:, 0]),
    )


def _causes(
    inputs: tuple[Uncertain, ...], drawn: Array, lost: Array
) -> tuple[tuple[str, float], ...]:
    """Return the causes of the spread, by the best straight line of ln(lost) in all inputs."""
    if lost.size < _LEAST_DRAWS * len(inputs) or not (lost > 0.0).all():
        return ()
    rows = np.column_stack([drawn, np.ones(lost.size)])
    slopes = np.abs(np.linalg.lstsq(rows, np.log(lost), rcond=None)[0][:-1])
    return tuple(
        (inputs[i].words, float(np.expm1(UPPER_END * slopes[i]))) for i in np.argsort(-slopes)
    )


def _slopes(
    settings: DriveCycleSettings, demand: Demand, inputs: tuple[Uncertain, ...], progress: Progress
) -> list[Array]:
    """Return d ln(loss) by the standard normal of each input; broadcasts to (n, k, sources)."""
    grid = settings.grid
    coarse = LossGrid(
        torques=max(4, grid.torques // 2),
        speeds=max(3, grid.speeds // 2),
        temperature_step=grid.temperature_step,
    )

    def losses(axle: HypoidAxleParameters) -> tuple[Array, Array]:
        changed = replace(settings, car=replace(settings.car, axle=axle), grid=coarse)
        found = losses_along(changed, demand)
        return found.power, found.film[..., 1]

    slopes = []
    for i, one in enumerate(inputs):
        progress(i / len(inputs), f"error bars, {one.words}")
        scales = [np.ones(len(LOSS_SOURCES)) for _ in range(2)]
        ends = [
            changed_axle(one, settings.car.axle, normal, scale)
            for normal, scale in zip((UPPER_END, -UPPER_END), scales, strict=True)
        ]
        slopes.append(log_slope(*(scales if one.changed is None else by_one_film(ends, losses))))
    return slopes


def _drawn_heat(heat: SumpHeat, rng: np.random.Generator) -> SumpHeat:
    """Return heat data within the intervals that `SumpHeat.corners` spans, evenly in logarithm."""
    corners = heat.corners
    of_capacity, of_air = rng.uniform(size=2)

    def between(name: str, share: float) -> float:
        ends = [float(getattr(one, name)) for one in corners]
        low, high = min(ends), max(ends)
        return low if low == high else float(low * (high / low) ** share)

    return SumpHeat(
        capacity=between("capacity", of_capacity),
        conductance_at_rest=between("conductance_at_rest", of_air),
        conductance_at_100_kmh=between("conductance_at_100_kmh", of_air),
    )
