"""Compute a drive cycle: from settings to a dataset and its files."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from drivetrain.sump_heat import SumpHeat, Warming, warm
from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.plotting.words import left_out
from gearlube.report.churning import REGIME, churning_regime
from gearlube.report.cycle import KJ, Variable, energy, steps_dataset, variables_of
from gearlube.report.films import covered_alone, film_model_attributes
from gearlube.report.result import Result
from gearlube.studies.drive_cycle.figures import cycle_figure
from gearlube.studies.drive_cycle.loss_field import (
    Demand,
    LossesAlong,
    at_temperatures,
    demand_of,
    losses_along,
)
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube.studies.drive_cycle.spread import (
    CycleSpread,
    check_inputs,
    cycle_spread,
    uncertain_inputs,
)
from gearlube.studies.drive_cycle.tables import (
    SUMMARY_HEAD,
    co2mpas_text,
    constant_efficiency,
    fastsim_text,
    series_rows,
    summary_rows,
)
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.units import ZERO_CELSIUS

_NOT_HEATED = "heat from brakes, gearbox and exhaust"
_NAMED_CAUSES = 3
_OF_MAP, _OF_SPREAD = 0.3, 0.95  # shares of the work at which map and error bars are done


def cycle_dataset(
    settings: DriveCycleSettings,
    demand: Demand,
    losses: LossesAlong,
    warming: Warming,
    others: list[Warming],
    spread: CycleSpread | None = None,
) -> xr.Dataset:
    """Return a cycle over time: demand, losses by source and oil temperature, and the energies.

    Parameters
    ----------
    others
        Temperatures with capacity and conductances at the ends of their intervals.
    spread
        Error bars; None: those of the heat data alone, and none of the efficiency.
    """
    ratio = settings.car.driveline.road_load.final_drive.ratio
    power = at_temperatures(losses.power, losses.temperatures, warming.mean)
    torque = at_temperatures(losses.torque, losses.temperatures, warming.mean)
    outside = at_temperatures(losses.outside, losses.temperatures, warming.mean)
    base = steps_dataset(
        settings.cycle, demand, torque, power, LOSS_SOURCES, shaft="pinion", ratio=ratio
    )
    temperatures = np.array([one.temperature for one in (warming, *others)]) - ZERO_CELSIUS
    ends = KJ * np.array(
        [
            float(
                at_temperatures(losses.power, losses.temperatures, one.mean).sum(-1) @ demand.steps
            )
            for one in (warming, *others)
        ]
    )
    if spread is not None:
        ends = np.array(spread.lost)
    whose = "fastest and slowest warming" if spread is None else "95 % of draws"
    energy_in = float(base["energy_in"])
    step, time = ("step",), ("time",)
    variables: dict[str, Variable] = {
        "oil_temperature": (time, temperatures[0], "degC", "oil temperature"),
        "oil_temperature_low": (time, temperatures.min(axis=0), "degC", "oil, slowest warming"),
        "oil_temperature_high": (time, temperatures.max(axis=0), "degC", "oil, fastest warming"),
        "outside_range": (
            ("step", "range"),
            outside,
            "1",
            "share of the points of the map around the step that are outside a range",
        ),
        "time_outside_range": (
            ("range",),
            _share(outside, np.where(demand.shaft_speed > 0.0, demand.steps, 0.0)),
            "1",
            "share of the running time outside a range",
        ),
        "energy_outside_range": (
            ("range",),
            _share(outside, power.sum(axis=-1) * demand.steps),
            "1",
            "share of the energy lost that is lost outside a range",
        ),
        "energy_lost_low": ((), ends.min(), "kJ", f"energy lost in all, low: {whose}"),
        "energy_lost_high": ((), ends.max(), "kJ", f"energy lost in all, high: {whose}"),
    }
    regime = churning_regime(settings.car.axle, warming.mean, demand.shaft_speed / ratio)
    if regime is not None:
        variables["churning_regime"] = (step, regime, *REGIME)
    bound, share, drag, rollers = at_temperatures(losses.film, losses.temperatures, warming.mean).T
    bound, drag = covered_alone(bound, share), covered_alone(drag, rollers)
    if settings.car.axle.bearing_torque_loss == "solved_films":
        variables |= {
            "drag_bound": (step, drag, "W", "bound of the bearings' drag loss"),
            "rollers_outside": (step, rollers, "1", "share of the rollers' load outside it"),
            "energy_drag_bound": (
                (),
                energy(np.nan_to_num(drag), demand),
                "kJ",
                "bound of the bearings' drag in steps that the model covers",
            ),
        }
    if settings.car.axle.film == "solved":
        energy_bound = energy(np.nan_to_num(bound), demand)
        variables |= {
            "friction_bound": (step, bound, "W", "bound of the flanks' friction loss"),
            "share_outside": (step, share, "1", "share of their load outside the film model"),
            "energy_lost_bound": (
                (),
                energy_bound,
                "kJ",
                "bound of the energy lost by films in steps that the model covers",
            ),
            "efficiency_bound": (
                (),
                energy_bound / energy_in if energy_in > 0.0 else np.nan,
                "1",
                "the same of the efficiency",
            ),
        }
    if spread is not None:
        bounds = {
            "efficiency": (spread.efficiency, "1"),
            "end_temperature": (np.subtract(spread.end_temperature, ZERO_CELSIUS), "degC"),
        }
        for name, (pair, unit) in bounds.items():
            for end, value in zip(("low", "high"), pair, strict=True):
                about = f"{name.replace('_', ' ')}, {end}: 95 % of draws"
                variables[f"{name}_{end}"] = ((), float(value), unit, about)
    coordinates = {
        "time": ("time", np.array(settings.cycle.time), {"units": "s", "long_name": "time"}),
        "range": (
            "range",
            np.array([one.output for one in settings.car.axle.ranges]),
            {"long_name": "range of a formula or table"},
        ),
    }
    dataset = base.assign_coords(coordinates).assign(variables_of(variables))
    if spread is not None:
        named = [f"{name} {100.0 * share:.0f} %" for name, share in spread.causes[:_NAMED_CAUSES]]
        dataset.attrs["causes"] = ", ".join(named)
    return dataset.assign_attrs(_attributes(settings, outside))


def _share(outside: Array, weights: Array) -> Array:
    """Return the weighted mean over the steps; 0 where the weights are 0."""
    whole = float(weights.sum())
    return np.asarray(weights @ outside / whole if whole > 0.0 else 0.0 * outside.sum(axis=0))


def _attributes(settings: DriveCycleSettings, outside: Array) -> dict[str, object]:
    heat = settings.heat
    left = np.flatnonzero(outside.sum(axis=0))
    ranges = [settings.car.axle.ranges[i] for i in left]
    return {
        "axle": settings.car.name,
        "oil": settings.car.axle.oil.name,
        **film_model_attributes(settings.car.axle.film_models),
        "not_modelled": ", ".join((*left_out(settings.car.axle), _NOT_HEATED)),
        "ranges_left": "; ".join(f"{one.what} ({one.output})" for one in ranges),
        "start_temperature_degc": settings.start_temperature - ZERO_CELSIUS,
        "air_temperature_degc": settings.air_temperature - ZERO_CELSIUS,
        "regeneration": settings.regeneration,
        "coast_torque_n_m": settings.coast_torque,
        "capacity_j_k": heat.capacity,
        "conductance_at_rest_w_k": heat.conductance_at_rest,
        "conductance_at_100_kmh_w_k": heat.conductance_at_100_kmh,
        "draws": settings.draws,
        "seed": settings.seed,
        "uncertain": "; ".join(
            f"{one.name}: factor {one.factor:g} (k = 2), {one.why}"
            for one in uncertain_inputs(settings)
        ),
        "band": "capacity and conductances at the ends of their assumed intervals",
    }


def run_cycle(
    settings: DriveCycleSettings, *, folder: Path | None = None, progress: Progress = no_progress
) -> Result:
    """Return losses and oil temperature of an axle over a drive cycle.

    Parameters
    ----------
    settings
        Car, cycle, temperatures, brakes, heat.
    folder
        Folder for drive_cycle.nc, drive_cycle.csv, summary.csv, fastsim.yaml, co2mpas.csv and
        figures; None: nothing is written.
    progress
        Called with the share that is done and a sentence.

    Returns
    -------
    xr.Dataset
        Over the steps of the trace torques, speeds and `loss` by source [W]; at its rows
        `oil_temperature` [degC]; `energy_in`, `energy_lost` by source [kJ], `efficiency`, and the
        bounds of 95 % of the samples.

    Raises
    ------
    ParameterError
        Torque or temperature is out of range; for torque before anything has been computed.

    Notes
    -----
    The loss in each step is that of steady running at the torque, speed and oil temperature in the
    middle of the step. At standstill nothing is lost.

    Examples
    --------
    >>> import numpy as np
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> from drivetrain.cycle.traces import DriveCycle
    >>> cruise = DriveCycle(name="cruise", time=np.arange(60.0), speed=np.full(60, 20.0))  # m/s
    >>> car = read_axle("mohammadpour_2015")
    >>> found = run_cycle(DriveCycleSettings(car=car, cycle=cruise, draws=0))  # no error bars
    >>> found.sizes["step"], found["oil_temperature"].dims
    (59, ('time',))
    """
    check_inputs(settings)
    demand = demand_of(settings)
    losses = losses_along(
        settings, demand, part_of(progress, 0.0, _OF_MAP if settings.draws else _OF_SPREAD)
    )
    total = losses.power.sum(axis=-1)

    def warmed(heat: SumpHeat) -> Warming:
        return warm(
            heat,
            steps=demand.steps,
            speeds=demand.speed,
            power=total,
            nodes=losses.temperatures,
            start=settings.start_temperature,
            air=settings.air_temperature,
        )

    warming = warmed(settings.heat)
    _check_oil(settings, warming.temperature)
    others = [warmed(one) for one in settings.heat.corners]
    spread = None
    if settings.draws:
        bars = part_of(progress, _OF_MAP, _OF_SPREAD)
        spread = cycle_spread(settings, demand, losses, bars)
    dataset = cycle_dataset(settings, demand, losses, warming, others, spread)
    dataset = Result.of(dataset, "cycle")
    if folder is not None:
        progress(1.0, "writing files and figures")
        folder.mkdir(parents=True, exist_ok=True)
        write_dataset(dataset, folder / "drive_cycle.nc")
        write_text(csv_text(*series_rows(dataset)), folder / "drive_cycle.csv")
        write_text(csv_text(SUMMARY_HEAD, summary_rows(dataset)), folder / "summary.csv")
        one = constant_efficiency(dataset)
        if math.isfinite(one):
            ratio = settings.car.driveline.road_load.final_drive.ratio
            write_text(fastsim_text(one, settings.cycle.name), folder / "fastsim.yaml")
            write_text(co2mpas_text(one, ratio), folder / "co2mpas.csv")
        save_figure_folder({"drive_cycle": cycle_figure(dataset)}, folder / "figures")
    return dataset


def grid_change(
    settings: DriveCycleSettings, dataset: xr.Dataset, progress: Progress = no_progress
) -> float:
    """Return by what share the energy lost changes with a map twice as fine [-]."""
    finer = run_cycle(replace(settings, grid=settings.grid.finer, draws=0), progress=progress)
    return float(finer["energy_lost"].sum() / dataset["energy_lost"].sum()) - 1.0


def _check_oil(settings: DriveCycleSettings, temperature: np.ndarray) -> None:
    oil = settings.car.axle.oil
    beyond = np.flatnonzero(temperature > oil.temperature_high)
    if beyond.size:
        raise ParameterError(
            f"The oil temperature must be at most {oil.temperature_high:g} K, the end of the data "
            f"of {oil.name}; it is above this from {settings.cycle.time[beyond[0]]:g} s on, up to "
            f"{temperature.max():.4g} K. Take larger conductances or a larger heat capacity."
        )
