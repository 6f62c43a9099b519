"""Friction of a tapered roller bearing over speed, load and temperature: a library call."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.bearing.dataset import bearing_dataset, bearing_rows
from gearlube.studies.bearing.figures import save_bearing_figures
from gearlube.studies.bearing.settings import BearingSettings
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import bearing_loss
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text


def run_bearing(
    file: BearingFile,
    settings: BearingSettings | None = None,
    *,
    oil: Lubricant | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return friction torque and power loss of a bearing, in all and by part.

    Parameters
    ----------
    file : BearingFile
    settings : BearingSettings, optional
        Conditions and laws; default: those of the file.
    oil : Lubricant, optional
        Oil; default: that of the file.
    folder : Path, optional
        Folder for bearing.nc, bearing.csv and figures/.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Returns
    -------
    xarray.Dataset
        `torque` and `power` along law, speed, axial_load, radial_load, temperature; `part_torque`
        along part too; `torque_low` and `torque_high` are the ends of the error bar.

    Raises
    ------
    ParameterError
        A condition is outside the range of bearing, law or oil; nothing is computed then.

    Examples
    --------
    >>> found = run_bearing(BearingFile.named("wingertszahn_2023"))
    >>> point = found.sel(law="zhou_hoeprich", radial_load=0.0, temperature=323.15)
    >>> round(float(point["torque"].sel(speed=209.4, method="nearest").item()), 1)  # N m
    3.2
    """
    settings = settings or BearingSettings.of_file(file)
    oil = read_oil(file.oil).lubricant if oil is None else oil
    geometry = file.geometry()
    settings.check(geometry, oil)
    conditions = list(
        product(
            settings.models,
            settings.speeds,
            settings.axial_loads,
            settings.radial_loads,
            settings.temperatures,
        )
    )
    losses = np.empty(len(conditions), dtype=object)
    for i, (model, speed, axial, radial, temperature) in enumerate(conditions):
        losses[i] = bearing_loss(
            geometry,
            oil,
            model,
            speed=speed,
            axial_load=axial,
            radial_load=radial,
            temperature=temperature,
        )
        progress((i + 1) / len(conditions), f"bearing: {model.law}")
    dataset = bearing_dataset(file, oil, settings, losses)
    if folder is not None:
        write_bearing(dataset, folder)
    return dataset


def write_bearing(dataset: xr.Dataset, folder: Path) -> None:
    """Write bearing.nc, bearing.csv and figures/ into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / "bearing.nc")
    write_text(bearing_rows(dataset), folder / "bearing.csv")
    save_bearing_figures(dataset, folder / "figures")
