"""Which setting or misalignment changes a hypoid pair's contact how much: a library call."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from rich.table import Table

from gearlube.output.csv_text import csv_text
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.plotting.words import parameter_words, tolerance_words
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings,
    contact_sensitivity,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_figure, write_text

_PANELS = (
    ("unloaded_pp", 1e6, "unloaded transmission error,\npeak to peak [µrad]"),
    ("te_1", 1e6, "loaded transmission error,\nfirst mesh order [µrad]"),
    ("s", 1e2, "centre of force, root to tip\n[% of the height]"),
    ("t", 1e2, "centre of force, toe to heel\n[% of the face]"),
)

POSITIONS = "sensitivity_positions"  # folder of finished positions, in that of the results
_COLUMNS = (
    ("TE without\nload [µrad]", "unloaded_pp", 1e6),
    ("TE loaded\n[µrad]", "te_1", 1e6),
    ("force,\nheight [%]", "s", 1e2),
    ("force,\nface [%]", "t", 1e2),
)


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
    write_figure(sensitivity_figure(dataset), folder / "figures" / "sensitivity.png")


def sensitivity_figure(dataset: xr.Dataset) -> Any:
    """Return bars of what each parameter's tolerance changes, both sides; the largest on top."""
    order = np.argsort(_largest(dataset))
    part = dataset.isel(parameter=order)
    labels = [
        f"{parameter_words(str(name))}  +{tolerance_words(float(size), str(unit))}"
        for name, size, unit in zip(
            part["parameter"].values, part["tolerance"].values, part["unit"].values, strict=True
        )
    ]
    place = np.arange(len(labels))
    with house_style():
        figure = new_figure(12.5, 1.8 + 0.27 * len(labels))
        axes = figure.subplots(1, len(_PANELS), sharey=True)
        for ax, (name, scale, title) in zip(axes, _PANELS, strict=True):
            for row, side in enumerate(SIDES):
                change = scale * part["tolerance"].values * _rate(part.sel(side=side), name)
                ax.barh(place + 0.2 - 0.4 * row, change, 0.4, color=SERIES[row], label=side)
            ax.axvline(0.0, color="black", lw=0.7)
            ax.set_xlabel(title)
        axes[0].set_yticks(place, labels)
        axes[0].set_ylim(-0.7, len(labels) - 0.3)
        handles, words = axes[0].get_legend_handles_labels()
        figure.legend(handles, words, ncols=2, loc="outside lower center")
        torque = dataset.attrs["torque"]
        figure.suptitle(
            f"{dataset.attrs['name']}: change of the contact by small errors, {torque:g} N·m",
            fontsize=11.5,
        )
    return figure


def _rate(part: xr.Dataset, name: str) -> Array:
    values = part[f"{name}_rate"]
    return np.asarray((values.mean("phase") if "phase" in values.dims else values).values)


def _largest(dataset: xr.Dataset) -> Array:
    """Return the largest change of each parameter on either side, over all panels, (P,)."""
    found = np.zeros(dataset.sizes["parameter"])
    for name, _, _ in _PANELS:
        change = np.abs(
            [dataset["tolerance"].values * _rate(dataset.sel(side=side), name) for side in SIDES]
        )
        if np.isfinite(change).any() and np.nanmax(change) > 0.0:
            found = np.fmax(found, np.nanmax(change / np.nanmax(change), axis=0))
    return found


def sensitivity_table(name: str, torque: float, rows: Sequence[SensitivityRow]) -> Table:
    """Return a line a parameter, the largest change of the loaded error's first order on top.

    Errors at the pinion, without load peak to peak; force: its centre on the gear.
    """
    table = Table(title=f"{name}: what small errors change at {torque:g} N·m, drive / coast")
    table.add_column("what grows by how much")
    for heading, *_ in _COLUMNS:
        table.add_column(heading, justify="right", no_wrap=True)
    pairs = list(zip(rows[::2], rows[1::2], strict=True))
    for pair in sorted(pairs, key=lambda pair: -max(abs(one.te_1) for one in pair)):
        table.add_row(
            parameter_words(pair[0].parameter)
            + f", {tolerance_words(pair[0].tolerance, pair[0].unit)}",
            *(
                "/".join(_shown(scale * getattr(one, field)) for one in pair)
                for _, field, scale in _COLUMNS
            ),
        )
    return table


def _shown(change: float) -> str:
    return "-" if math.isnan(change) else f"{change:+.2f}"
