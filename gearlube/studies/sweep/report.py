"""The report of a sweep: findings, figures, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import range_text
from gearlube.plotting.style import preload_label
from gearlube.report.inputs import OF_AXLE, origin_of, stored_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import ASSUMED, Cell, Column, Figure, Input, Report, Table
from gearlube.report.pictures import shown
from gearlube.studies.sweep.datasets import SEPARATION_MEANINGS
from gearlube.studies.sweep.figures.catalogue import CATALOGUE, Entry
from gearlube.studies.sweep.findings import findings
from gearlube.studies.sweep.peaks import (
    ORDERS,
    crossings,
    harmonic_amplitude,
    numbers,
)
from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.settings import FMU_PARAMETERS, STEADY
from gearlube_core.storage.atomic_file import write_figure
from gearlube_core.units import kelvin_to_celsius

_FEW = 24  # rows of a table that is shown at once
_Value = Callable[[xr.Dataset], Cell]
_WHERE: tuple[tuple[Column, _Value], ...] = (
    (Column("preload", "N", 4), lambda p: float(p["preload"])),
    (Column("speed", "km/h"), lambda p: float(p["speed_kmh"])),
)
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


def _of(name: str, factor: float = 1.0) -> _Value:
    return lambda p: factor * float(p[name]) if name in p else None


def _oil(point: xr.Dataset) -> Cell:
    if "oil_temperature" not in point:
        return None
    return float(kelvin_to_celsius(float(point["oil_temperature"])))


_VIBRATION: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("mesh frequency", "Hz"), _of("mesh_frequency")),
    (Column("DTE least", "µm"), _of("dte_min", 1e6)),
    (Column("DTE largest", "µm"), _of("dte_max", 1e6)),
    (Column("DTE peak to peak", "µm"), _of("dte_pp", 1e6)),
    *((Column(f"order {n}", "µm"), _of(f"order_{n}", 1e6)) for n in ORDERS),
    (Column("separation"), lambda p: SEPARATION_MEANINGS[int(p["separation"])]),
    (Column("radial, peak to peak", "µm"), _of("radial_pp", 1e6)),
)
_LOADS: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("pinion torque", "N·m"), _of("pinion_torque")),
    (Column("wheel torque", "N·m"), _of("wheel_torque")),
    (Column("mean mesh force", "N"), _of("mesh_force_mean")),
    (Column("dynamic factor"), _of("dynamic_factor")),
    (Column("roller 1 least", "N"), _of("roller_load_min")),
    (Column("roller 1 largest", "N"), _of("roller_load_max")),
)
_LOSSES: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("oil", "°C"), _oil),
    (Column("film least", "µm"), _of("film_thickness_min", 1e6)),
    (Column("film ratio λ least"), _of("film_ratio_min")),
    (Column("flank film warmest", "°C"), lambda p: _celsius(p, "flank_temperature_max")),
    (Column("efficiency mesh", "%", 4), _of("efficiency_mesh", 100.0)),
    (Column("efficiency axle", "%", 4), _of("efficiency_axle", 100.0)),
    (Column("losses", "W"), lambda p: float(p["loss"].sum())),
    (Column("ranges left"), lambda p: int(p["range_exceeded"]) if "range_exceeded" in p else None),
    (Column("energy balance", "ppm of input", 2), _of("energy_closure_error", 1e6)),
)


def _celsius(point: xr.Dataset, name: str) -> Cell:
    return float(kelvin_to_celsius(float(point[name])))


def tables(dataset: xr.Dataset) -> list[Table]:
    """Return the tables of a report, what went wrong first."""
    points = _points(dataset)
    finished = [p for p in points if int(p["status"]) == FINISHED]
    return [
        *_failures([p for p in points if int(p["status"]) != FINISHED]),
        *_ranges(finished),
        *_modes(dataset),
        *(
            _of_points(finished, title, columns, caption)
            for title, columns, caption in (
                ("Vibration", _VIBRATION, "Transmission error, its mesh orders as amplitudes, and "
                 "the radial motion of the pinion. Extremes are over the whole record."),
                ("Loads", _LOADS, "Mean torques from the road; roller 1 of pinion bearing 1."),
                ("Films and losses", _LOSSES, "The energy balance is the part of the input that "
                 "outputs, losses and stored energy leave unexplained."),
            )
            if finished
        ),
    ]  # fmt: skip


def _points(dataset: xr.Dataset) -> list[xr.Dataset]:
    """Return every point as a dataset of its own, with the amplitudes of its mesh orders."""
    if "dte_spectrum" in dataset:
        dataset = dataset.assign(
            {
                f"order_{n}": (
                    ("preload", "speed"),
                    np.array(
                        [
                            harmonic_amplitude(dataset.isel(preload=row), n)
                            for row in range(dataset.sizes["preload"])
                        ]
                    ),
                )
                for n in ORDERS
            }
        )
    return [
        dataset.isel(preload=row, speed=column)
        for row in range(dataset.sizes["preload"])
        for column in range(dataset.sizes["speed"])
    ]


def _of_points(
    points: Sequence[xr.Dataset], title: str, columns: Sequence[tuple[Column, _Value]], caption: str
) -> Table:
    return Table(
        title=f"Points: {title.lower()}",
        columns=[column for column, _ in columns],
        rows=[[value(point) for _, value in columns] for point in points],
        caption=caption,
        folded=len(points) > _FEW,
    )


def _failures(points: Sequence[xr.Dataset]) -> list[Table]:
    if not points:
        return []
    return [
        Table(
            title="Failed points",
            columns=[*(column for column, _ in _WHERE), Column("why")],
            rows=[[*(value(p) for _, value in _WHERE), str(p["message"].values)] for p in points],
        )
    ]


def _ranges(points: Sequence[xr.Dataset]) -> list[Table]:
    left = [p for p in points if "range_exceeded" in p and float(p["range_exceeded"]) > 0.0]
    if not left:
        return []
    return [
        Table(
            title="Points that left a range",
            columns=[*(column for column, _ in _WHERE), Column("what left its range")],
            rows=[
                [*(value(p) for _, value in _WHERE), range_text(str(p["range_message"].values))]
                for p in left
            ],
            caption="They left the range of a formula or of the mesh table. What is computed there "
            "is extrapolated.",
        )
    ]


def _modes(dataset: xr.Dataset) -> list[Table]:
    found = crossings(dataset)
    if not found:
        return []
    preloads = [float(p) for p in dataset["preload"].values]
    first = {(c.mode, c.order): c.speed_kmh for c in found if c.preload == preloads[0]}
    known = "mode_strain" in dataset
    return [
        Table(
            title="Natural frequencies, and the speeds at which mesh orders meet them",
            columns=[
                Column("mode"),
                *(Column(preload_label(p), "Hz", 4) for p in preloads),
                *(Column(f"order {n} meets it at", "km/h") for n in ORDERS),
                *([Column("damping ratio", "%", 2), Column("strained springs")] if known else []),
            ],
            rows=[
                [
                    str(mode),
                    *(float(f) for f in frequencies),
                    *(first.get((str(mode), n)) for n in ORDERS),
                    *(_damping_and_springs(dataset, str(mode)) if known else ()),
                ]
                for mode, frequencies in zip(
                    dataset["mode"].values, dataset["mode_frequency"].values.T, strict=True
                )
            ],
            caption=f"Speeds at preload {preloads[0]:g} N. Swept: "
            f"{float(dataset['speed_kmh'][0]):g} to {float(dataset['speed_kmh'][-1]):g} km/h.",
        )
    ]


def _damping_and_springs(dataset: xr.Dataset, mode: str) -> tuple[float, str]:
    """Return the damping ratio [%] of a mode and the springs with most of its strain energy."""
    strain = dataset["mode_strain"].sel(mode=mode)
    largest = sorted(zip(strain.values, strain["spring"].values, strict=True), reverse=True)
    words = ", ".join(
        f"{name} {100.0 * share:.0f} %" for share, name in largest[:3] if share > 0.05
    )
    return 100.0 * float(dataset["mode_damping"].sel(mode=mode)[0]), words


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
        main_figures=[one.name for one in CATALOGUE if one.essential],
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
        figure = entry.draw(dataset)
        if directory is not None:
            directory.mkdir(parents=True, exist_ok=True)
            write_figure(figure, directory / f"{entry.name}.png")
        found.append(shown(entry.name, entry.title, entry.caption, figure))
    return found


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
