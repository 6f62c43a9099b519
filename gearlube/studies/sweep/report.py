"""The report of a sweep: findings, figures, tables, inputs, limits."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.inputs import OF_AXLE, origin_of, stored_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import ASSUMED, Figure, Input, Report
from gearlube.studies.sweep.figures import CATALOGUE, Entry
from gearlube.studies.sweep.findings import findings
from gearlube.studies.sweep.peaks import numbers
from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.settings import FMU_PARAMETERS, STEADY
from gearlube.studies.sweep.tables import tables
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.units import kelvin_to_celsius

_DPI = 130
_COOLING = (
    "setting_air_temperature",
    "setting_conductance_at_rest",
    "setting_conductance_at_100_kmh",
)
_UNITS = {
    "roughness_rms": ("µm", 1e6),
    "backlash": ("µm", 1e6),
    "conductance_at_rest": ("W/K", 1.0),
    "conductance_at_100_kmh": ("W/K", 1.0),
    "communication_step": ("ms", 1e3),
    "settling_time": ("s", 1.0),
    "record_time": ("s", 1.0),
}
_OPTIONS = {  # of the command that set them, where they have other names
    "oil_state": "steady_temperature",
    "roughness_rms": "roughness_um",
    "conductance_at_100_kmh": "conductance_at_100",
    "settling_time": "quick",
    "record_time": "quick",
    "cage_turns": "quick",
}
_LIMITS = (
    "Films are from a formula (Chittenden et al. 1985), friction from a regression for shear and a "
    "law of asperities (Evans and Johnson 1986, Greenwood and Tripp 1971), not from a solution of "
    "the film. The page docs/ehl_hypoid.md compares them with film solutions.",
    "The axle has 8 degrees of freedom; housing and shafts do not bend. Vibration of the housing "
    "and sound are not computed.",
    "Torques are those of the road load on a level road at constant speed: no acceleration, no "
    "coasting.",
    "Natural frequencies are undamped, about the static state at the middle speed.",
    "Spectra end at 4000 Hz. Extremes are taken over the whole record.",
    "The efficiency does not include sources of loss that are not modelled: see the findings.",
)


def write_sweep_report(
    dataset: xr.Dataset, directory: Path | str, entries: Sequence[Entry] = CATALOGUE
) -> Path:
    """Write report.html and figures/*.png of a sweep into `directory`; return the report's path.

    Examples
    --------
    >>> from gearlube.studies.sweep.datasets import load_sweep
    >>> write_sweep_report(load_sweep("gearlube_sweep"), "gearlube_sweep")  # doctest: +SKIP
    """
    return write_report(sweep_report(dataset, Path(directory) / "figures", entries), directory)


def sweep_report(
    dataset: xr.Dataset, figures: Path | None = None, entries: Sequence[Entry] = CATALOGUE
) -> Report:
    """Return the report of a merged sweep.

    Parameters
    ----------
    dataset : xarray.Dataset
        Merged sweep.
    figures : path
        Folder that gets all figures as pictures.
    entries : sequence of Entry
        Figures to draw.
    """
    finished = int((dataset["status"] == FINISHED).sum())
    return Report(
        study="sweep",
        title=str(dataset.attrs["title"]),
        subtitle=_subtitle(dataset, finished),
        findings=findings(dataset),
        numbers=numbers(dataset),
        figures=_figures(dataset, figures, entries) if finished else (),
        tables=tables(dataset),
        inputs=[
            *_settings(dataset),
            *stored_inputs(dataset.attrs, "inputs_given", "inputs_assumed"),
        ],
        limits=_LIMITS,
        facts=_facts(dataset, finished),
        files=("sweep.nc", "summary.csv", "figures/"),
    )


def _subtitle(dataset: xr.Dataset, finished: int) -> str:
    speeds = dataset["speed_kmh"].values
    preloads = " and ".join(f"{p:g}" for p in dataset["preload"].values)
    return (
        f"Hypoid axle {dataset.attrs.get('axle', '')} on preloaded tapered roller bearings, run as "
        f"an FMU at {speeds.size} speeds from {speeds[0]:g} to {speeds[-1]:g} km/h and preloads of "
        f"{preloads} N: {finished} of {dataset['status'].size} points are finished."
    ).replace("axle  on", "axle on")


def _figures(dataset: xr.Dataset, directory: Path | None, entries: Sequence[Entry]) -> list[Figure]:
    found = []
    for entry in entries:
        png = _png(dataset, entry) if directory is not None or entry.chart is None else None
        if directory is not None and png is not None:
            directory.mkdir(parents=True, exist_ok=True)
            with atomic_write(directory / f"{entry.name}.png") as partial:
                partial.write_bytes(png)
        found.append(
            Figure(
                name=entry.name,
                title=entry.title,
                caption=entry.caption,
                chart=None if entry.chart is None else entry.chart(dataset),
                picture=png if entry.chart is None else None,
            )
        )
    return found


def _png(dataset: xr.Dataset, entry: Entry) -> bytes:
    buffer = io.BytesIO()
    entry.draw(dataset).savefig(buffer, format="png", dpi=_DPI)
    return buffer.getvalue()


def _settings(dataset: xr.Dataset) -> list[Input]:
    steady = dataset.attrs.get("setting_oil_state") == STEADY
    unused = ("setting_oil_temperature",) if steady else _COOLING
    return [
        _setting(name.removeprefix("setting_"), value)
        for name, value in dataset.attrs.items()
        if name.startswith("setting_") and name not in unused
    ]


def _setting(name: str, value: Any) -> Input:
    words = f"sweep: {name.replace('_', ' ')}"
    otherwise = OF_AXLE if name in FMU_PARAMETERS else (ASSUMED, "default")
    origin = origin_of(_OPTIONS.get(name, name), otherwise=otherwise)
    if name.endswith("_temperature"):
        return Input(words, f"{kelvin_to_celsius(float(value)):.1f}", "°C", *origin)
    unit, factor = _UNITS.get(name, ("", 1.0))
    text = f"{factor * value:g}" if isinstance(value, float | np.floating) else str(value)
    return Input(words, text, unit, *origin)


def _facts(dataset: xr.Dataset, finished: int) -> list[tuple[str, str]]:
    attributes = dataset.attrs
    lines = [
        ("command", str(attributes.get("command_line") or "(run from Python)")),
        ("points", f"{finished} of {dataset['status'].size} finished"),
        ("run on", str(attributes.get("scheduler", ""))),
        ("sweep by gearlube", str(attributes.get("gearlube_version", ""))),
        ("FMU", f"{attributes.get('fmu_kind', '')} {attributes.get('fmu_guid', '')}".strip()),
        ("axle", f"{attributes.get('axle', '')} ({attributes.get('axle_source', '')})"),
        (
            "mesh table",
            f"{attributes.get('mesh_table', '')} ({attributes.get('mesh_table_source', '')})",
        ),
    ]
    if "wall_time" in attributes:
        computed = attributes.get("computed_points", dataset["status"].size)
        lines.append(("time", f"{attributes['wall_time']:.1f} s for {computed} computed points"))
    return [(name, value.replace(" ()", "").replace("()", "")) for name, value in lines if value]
