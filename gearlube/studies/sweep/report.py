"""Write report.html: settings, main numbers, figures and failed points."""

from __future__ import annotations

import base64
import io
import json
import logging
import platform
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.sweep.figures import CATALOGUE, Entry
from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.quantities import SEPARATION_MEANINGS
from gearlube.studies.sweep.settings import STEADY
from gearlube_core.units import kelvin_to_celsius

logger = logging.getLogger(__name__)

_PACKAGES = ("numpy", "scipy", "numba", "casadi", "fmpy", "xarray", "matplotlib")
_DPI = 130
_COOLING = (
    "setting_air_temperature",
    "setting_conductance_at_rest",
    "setting_conductance_at_100_kmh",
)

# Columns of the table: heading, unit, value of a point.
_COLUMNS = (
    ("preload", "N", lambda p: f"{float(p['preload']):g}"),
    ("speed", "km/h", lambda p: f"{float(p['speed_kmh']):g}"),
    ("f<sub>m</sub>", "Hz", lambda p: f"{float(p['mesh_frequency']):.1f}"),
    (
        "oil",
        "°C",
        lambda p: (
            f"{kelvin_to_celsius(float(p['oil_temperature'])):.1f}"
            if "oil_temperature" in p
            else ""
        ),
    ),
    ("T pinion", "N m", lambda p: f"{float(p['pinion_torque']):.1f}"),
    ("T wheel", "N m", lambda p: f"{float(p['wheel_torque']):.1f}"),
    ("DTE min", "µm", lambda p: f"{1e6 * float(p['dte_min']):.2f}"),
    ("DTE max", "µm", lambda p: f"{1e6 * float(p['dte_max']):.2f}"),
    ("DTE p-p", "µm", lambda p: f"{1e6 * float(p['dte_pp']):.2f}"),
    ("separation", "", lambda p: SEPARATION_MEANINGS[int(p["separation"])]),
    ("radial p-p", "µm", lambda p: f"{1e6 * float(p['radial_pp']):.2f}"),
    ("roller min", "N", lambda p: f"{float(p['roller_load_min']):.0f}"),
    ("roller max", "N", lambda p: f"{float(p['roller_load_max']):.0f}"),
    ("film min", "µm", lambda p: f"{1e6 * float(p['film_thickness_min']):.3f}"),
    ("λ min", "", lambda p: f"{float(p['film_ratio_min']):.2f}"),
    ("η mesh", "%", lambda p: f"{100.0 * float(p['efficiency_mesh']):.2f}"),
    ("η axle", "%", lambda p: f"{100.0 * float(p['efficiency_axle']):.2f}"),
    ("losses", "W", lambda p: f"{float(p['loss'].sum()):.1f}"),
    ("out of range", "", lambda p: f"{int(p['range_exceeded'])}" if "range_exceeded" in p else ""),
    ("balance", "ppm of input", lambda p: f"{1e6 * float(p['energy_closure_error']):.1f}"),
)


def write_sweep_report(
    dataset: xr.Dataset, directory: Path | str, entries: Sequence[Entry] = CATALOGUE
) -> Path:
    """Write report.html and figures/*.png into `directory`; return the path of the report.

    Examples
    --------
    >>> from gearlube.studies.sweep.datasets import load_sweep
    >>> write_sweep_report(load_sweep("gearlube_sweep"), "gearlube_sweep")  # doctest: +SKIP
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / "report.html"
    path.write_text(report_html(dataset, directory / "figures", entries), encoding="utf-8")
    return path


def report_html(
    dataset: xr.Dataset, figures: Path | None = None, entries: Sequence[Entry] = CATALOGUE
) -> str:
    """Return the report of a merged sweep as HTML with all pictures inside.

    Parameters
    ----------
    dataset : xarray.Dataset
        Merged sweep.
    figures : path
        Folder that gets the pictures as files too.
    entries : sequence of Entry
        Figures to draw.
    """
    from jinja2 import Environment, PackageLoader, select_autoescape

    environment = Environment(
        loader=PackageLoader("gearlube.studies.sweep", "."),
        autoescape=select_autoescape(default_for_string=True, default=True),
        trim_blocks=True,
        lstrip_blocks=True,
    )
    points = _points(dataset)
    finished = [p for p in points if int(p["status"]) == FINISHED]
    return environment.get_template("report.html.j2").render(
        attributes=dataset.attrs,
        run=_run(dataset, len(points), len(finished)),
        settings=_settings(dataset),
        versions=_versions(dataset),
        modes=_modes(dataset),
        headings=[(name, unit) for name, unit, _ in _COLUMNS],
        rows=[[value(p) for _, _, value in _COLUMNS] for p in finished],
        failures=[
            (f"{float(p['speed_kmh']):g}", f"{float(p['preload']):g}", str(p["message"].values))
            for p in points
            if int(p["status"]) != FINISHED
        ],
        inputs=json.loads(dataset.attrs.get("inputs_assumed", "[]")),
        ranges=_ranges(finished),
        figures=_pictures(dataset, figures, entries) if finished else [],
    )


def _ranges(points: Sequence[xr.Dataset]) -> list[tuple[str, str, str]]:
    """Return speed, preload and words of the points that left a range."""
    return [
        (f"{float(p['speed_kmh']):g}", f"{float(p['preload']):g}", str(p["range_message"].values))
        for p in points
        if "range_exceeded" in p and float(p["range_exceeded"]) > 0.0
    ]


def _points(dataset: xr.Dataset) -> list[xr.Dataset]:
    return [
        dataset.isel(preload=row, speed=column)
        for row in range(dataset.sizes["preload"])
        for column in range(dataset.sizes["speed"])
    ]


def _run(dataset: xr.Dataset, points: int, finished: int) -> list[tuple[str, str]]:
    attributes = dataset.attrs
    speeds = dataset["speed_kmh"].values
    preloads = ", ".join(f"{p:g}" for p in dataset["preload"].values)
    lines = [
        ("command", attributes.get("command_line") or "(run from Python)"),
        ("vehicle speeds", f"{speeds[0]:g} to {speeds[-1]:g} km/h, {speeds.size} values"),
        ("bearing preloads", f"{preloads} N"),
        ("points", f"{finished} of {points} finished"),
        ("run on", str(attributes.get("scheduler", ""))),
    ]
    if "wall_time" in attributes:
        computed = attributes.get("computed_points", points)
        lines.append(("time", f"{attributes['wall_time']:.1f} s for {computed} computed points"))
    return lines


def _settings(dataset: xr.Dataset) -> list[tuple[str, str]]:
    lines = []
    steady = dataset.attrs.get("setting_oil_state") == STEADY
    unused = ("setting_oil_temperature",) if steady else _COOLING
    for name, value in dataset.attrs.items():
        if not name.startswith("setting_") or name in unused:
            continue
        text = f"{value:g}" if isinstance(value, float | np.floating) else str(value)
        if name.endswith("_temperature"):
            text = f"{value:.2f} K ({kelvin_to_celsius(value):.1f} °C)"
        if name.startswith("setting_conductance"):
            text += " W/K"
        lines.append((name.removeprefix("setting_").replace("_", " "), text))
    return lines


def _versions(dataset: xr.Dataset) -> list[tuple[str, str]]:
    lines = [
        ("gearlube", str(dataset.attrs.get("gearlube_version", ""))),
        ("FMU", str(dataset.attrs.get("fmu_kind", ""))),
        ("FMU GUID", str(dataset.attrs.get("fmu_guid", ""))),
        ("axle", str(dataset.attrs.get("axle", ""))),
        ("mesh table", str(dataset.attrs.get("mesh_table", ""))),
        ("Python", platform.python_version()),
        ("system", f"{platform.system()} {platform.machine()}"),
    ]
    for package in _PACKAGES:
        try:
            lines.append((package, version(package)))
        except PackageNotFoundError:
            logger.debug("%s is not installed", package)
    return lines


def _modes(dataset: xr.Dataset) -> dict[str, Any]:
    if "mode_frequency" not in dataset:
        return {}
    return {
        "preloads": [f"{p:g}" for p in dataset["preload"].values],
        "rows": [
            (str(name), [f"{f:.0f}" for f in frequencies])
            for name, frequencies in zip(
                dataset["mode"].values, dataset["mode_frequency"].values.T, strict=True
            )
        ],
    }


def _pictures(
    dataset: xr.Dataset, directory: Path | None, entries: Sequence[Entry]
) -> list[tuple[str, str, str]]:
    pictures = []
    for entry in entries:
        png = _png(dataset, entry)
        if directory is not None:
            directory.mkdir(parents=True, exist_ok=True)
            (directory / f"{entry.name}.png").write_bytes(png)
        pictures.append((entry.name, entry.caption, base64.b64encode(png).decode("ascii")))
    return pictures


def _png(dataset: xr.Dataset, entry: Entry) -> bytes:
    buffer = io.BytesIO()
    entry.draw(dataset).savefig(buffer, format="png", dpi=_DPI)
    return buffer.getvalue()
