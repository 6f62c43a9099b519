"""Which setting or misalignment changes a hypoid pair's contact how much: a library call."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.contact.figures.sensitivity import sensitivity_figure
from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings,
    contact_sensitivity,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text

POSITIONS = "sensitivity_positions"  # folder of finished positions, in that of the results


class SensitivityRow(NamedTuple):
    """Change of one side's contact when one parameter grows by its tolerance, to first order."""

    parameter: str
    tolerance: float
    unit: str
    side: str
    unloaded_pp: float  # transmission error without load, peak to peak, at the pinion [rad]
    te_pp: float  # the same under load
    te_1: float  # its first mesh order
    unloaded_s: float  # mean contact without load on the gear, along the height [-]
    unloaded_t: float  # along the face
    s: float  # centre of force, mean over the mesh
    t: float
    stiffness: float  # secant, mean over the mesh, in parts of itself [-]
    pressure: float  # highest of the mesh, in parts of itself
    sliding_loss: float  # mean over the mesh, in parts of itself


def sensitivity_rows(dataset: xr.Dataset) -> list[SensitivityRow]:
    """Return the results of `run_sensitivity` as rows of a table, one for each parameter and flank.

    Parameters
    ----------
    dataset : xarray.Dataset
        From `contact_sensitivity`.

    Examples
    --------
    >>> rows = sensitivity_rows(dataset)  # doctest: +SKIP
    >>> max(rows, key=lambda row: abs(row.te_1)).parameter  # doctest: +SKIP
    """
    rows = []
    for name in dataset["parameter"].values:
        for side in SIDES:
            part = dataset.sel(parameter=name, side=side)
            tolerance = float(part["tolerance"])
            whole = {
                one: tolerance * float(part[f"{one}_rate"])
                for one in ("unloaded_pp", "te_pp", "te_1", "unloaded_s", "unloaded_t")
            }
            highest = part.isel(phase=int(np.argmax(part["pressure_max"].values)))
            rows.append(
                SensitivityRow(
                    parameter=str(name),
                    tolerance=tolerance,
                    unit=str(part["unit"].values),
                    side=side,
                    **whole,
                    s=tolerance * float(part["s_rate"].mean()),
                    t=tolerance * float(part["t_rate"].mean()),
                    stiffness=tolerance * _part_of_mean(part, "secant_stiffness"),
                    pressure=tolerance * _part_of_mean(highest, "pressure_max"),
                    sliding_loss=tolerance * _part_of_mean(part, "sliding_loss"),
                )
            )
    return rows


def _part_of_mean(part: xr.Dataset, name: str) -> float:
    return float(part[f"{name}_rate"].mean() / part[name].mean())


def run_sensitivity(
    file: HypoidGearFile,
    settings: SensitivitySettings | None = None,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return how a hypoid pair's contact changes with its settings and misalignments.

    Parameters
    ----------
    file : HypoidGearFile
    settings : SensitivitySettings, optional
        Parameters, torque and positions; default: all parameters, 50 N.m, 8 positions.
    folder : Path, optional
        Folder for sensitivity.nc, sensitivity.csv and figures/sensitivity.png. Finished positions
        are kept there: after a stop the same call continues.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.

    Returns
    -------
    xarray.Dataset
        From `contact_sensitivity`.

    Raises
    ------
    ParameterError
        The flanks do not meet, or a parameter has no derivative.
    ConvergenceError
        A position finds no equilibrium.

    Examples
    --------
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> found = run_sensitivity(file, SensitivitySettings(torque=100.0))  # doctest: +SKIP
    >>> worst = max(sensitivity_rows(found), key=lambda row: abs(row.te_1))  # doctest: +SKIP
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    store = None if folder is None else folder / POSITIONS
    dataset = contact_sensitivity(
        file, settings or SensitivitySettings(), store=store, jobs=jobs, progress=progress
    )
    if folder is not None:
        write_sensitivity(dataset, folder)
    return dataset


def write_sensitivity(dataset: xr.Dataset, folder: Path) -> None:
    """Write sensitivity.nc, sensitivity.csv and figures/sensitivity.png into a folder."""
    (folder / "figures").mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / "sensitivity.nc")
    rows = sensitivity_rows(dataset)
    write_text(csv_text(SensitivityRow._fields, rows), folder / "sensitivity.csv")
    sensitivity_figure(dataset).savefig(folder / "figures" / "sensitivity.png", dpi=150)
