"""Compute a drive cycle: from settings to a dataset and its files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from drivetrain.sump_heat import SumpHeat, Warming, warm
from gearlube.output.csv_text import csv_text
from gearlube.studies.drive_cycle.datasets import cycle_dataset
from gearlube.studies.drive_cycle.demand import demand_of
from gearlube.studies.drive_cycle.figures import save_cycle_figures
from gearlube.studies.drive_cycle.loss_field import losses_along
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube.studies.drive_cycle.spread import check_inputs, cycle_spread
from gearlube.studies.drive_cycle.tables import SUMMARY_HEAD, series_rows, summary_rows
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset, write_text

_OF_MAP, _OF_SPREAD = 0.3, 0.95  # shares of the work at which map and error bars are done


def run_cycle(
    settings: DriveCycleSettings,
    *,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return losses and oil temperature of an axle over a drive cycle.

    Parameters
    ----------
    settings
        Car, cycle, temperatures, brakes, heat.
    folder
        Folder for drive_cycle.nc, drive_cycle.csv, summary.csv and figures; None: nothing is
        written.
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
    >>> from gearlube.studies.drive_cycle.traces import DriveCycle
    >>> cruise = DriveCycle(name="cruise", time=np.arange(60.0), speed=np.full(60, 20.0))  # m/s
    >>> found = run_cycle(DriveCycleSettings(car=read_axle("mohammadpour_2015"), cycle=cruise))
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
    if folder is not None:
        progress(1.0, "writing files and figures")
        folder.mkdir(parents=True, exist_ok=True)
        write_dataset(dataset, folder / "drive_cycle.nc")
        write_text(csv_text(*series_rows(dataset)), folder / "drive_cycle.csv")
        write_text(csv_text(SUMMARY_HEAD, summary_rows(dataset)), folder / "summary.csv")
        save_cycle_figures(dataset, folder / "figures")
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
