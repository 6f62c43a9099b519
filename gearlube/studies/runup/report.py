"""The report of a run-up, a coast-down or both: findings, figures, tables, inputs, limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.report.inputs import origin_of, stored_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import INFERRED, Column, Figure, Input, Report, Table
from gearlube.report.pictures import shown
from gearlube.studies.runup import levels
from gearlube.studies.runup.critical import critical_speeds
from gearlube.studies.runup.figures.catalogue import CATALOGUE
from gearlube.studies.runup.figures.moving.parts import moving_figures
from gearlube.studies.runup.findings import findings, numbers, peaks
from gearlube.studies.runup.run import FILES
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

_DIGITS = 5
_LIMITS = (
    "The axle has 8 degrees of freedom; housing and shafts do not bend. Forces are those of the "
    "bearings on the shafts; noise of the housing is not included.",
    "On the bench the torque on the pinion is smooth; with `--engine-orders` those of the engine "
    "act, in one gear.",
    "Natural frequencies are undamped, at the mean mesh stiffness, along the ramp's torque.",
    "All teeth are equal unless the mesh table has errors of single teeth. So between the mesh "
    "orders lie only the far lower lines of the rollers, not the noise of a measurement.",
    "Films and friction are from formulas unless film.model is solved; see docs/ehl_hypoid.md for "
    "their error.",
)
_INPUTS = (  # setting, words, unit, conversion, options of the command
    ("start_speed", "start speed of the pinion", "rpm", rads_to_rpm, ("start",)),
    ("end_speed", "end speed of the pinion", "rpm", rads_to_rpm, ("end",)),
    ("duration", "duration", "s", float, ("duration", "rate")),
    ("pinion_torque", "torque on the pinion", "N·m", float, ("torque",)),
    ("oil_temperature", "oil temperature", "°C", kelvin_to_celsius, ("oil_temperature",)),
    ("order_resolution", "order resolution", "", float, ("order_resolution", "quick")),
    ("highest_frequency", "end of the spectra", "Hz", float, ()),
    ("sample_rate", "sample rate", "Hz", float, ()),
    ("settling_time", "settling time", "s", float, ()),
)
_BACK = {"start": "end", "end": "start", "torque": "coast_torque"}  # of an added coast-down


def summary_csv(datasets: Sequence[xr.Dataset]) -> str:
    """Return rms levels along ramps as CSV, units in the heads: one row a block."""
    orders = [int(one) for one in datasets[0]["mesh_order"].values]
    heads = [
        "ramp",
        "time_s",
        "pinion_speed_rpm",
        "vehicle_speed_kmh",
        "bearing_forces_rms_n",
        *(f"bearing_forces_h{order}_rms_n" for order in orders),
        "dte_rms_um",
        *(f"dte_h{order}_rms_um" for order in orders),
    ]
    return csv_text(heads, [row for one in datasets for row in _rows(one)])


def _rows(dataset: xr.Dataset) -> list[list[object]]:
    speed = levels.rpm(dataset)
    force = levels.total_force(dataset, "bearing_force_track").values
    error = levels.track_rms(dataset, "dte_track").values
    overall = levels.total_force(dataset, "bearing_force_overall").values
    name = str(dataset.attrs["ramp"])
    found: list[list[object]] = []
    for i in range(speed.size):
        values = [
            float(dataset["block_time"][i]),
            float(speed[i]),
            levels.kmh_per_rpm(dataset) * float(speed[i]),
            float(overall[i]),
            *map(float, force[i]),
            1e6 * float(dataset["dte_overall"][i]),
            *(1e6 * float(one) for one in error[i]),
        ]
        found.append([name, *map(_rounded, values)])
    return found


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else value


def write_runup_report(
    datasets: Sequence[xr.Dataset],
    folder: Path | str,
    animations: Sequence[xr.Dataset] = (),
) -> Path:
    """Write report.html and figures/*.png of one ramp or more; return the path of the report.

    `animations` are of `animate_ramp`, at most one of each ramp.

    Examples
    --------
    >>> from gearlube.studies.runup.run import load_runup
    >>> write_runup_report([load_runup("gearlube_runup")], "gearlube_runup")  # doctest: +SKIP
    """
    folder = Path(folder)
    drawn = drawn_figures(datasets)
    save_figure_folder(drawn, folder / "figures")
    return write_report(runup_report(datasets, drawn, animations), folder)


def report_of_one(dataset: xr.Dataset) -> Report:
    """Return the report of one ramp."""
    return runup_report([dataset], drawn_figures([dataset]))


def drawn_figures(datasets: Sequence[xr.Dataset]) -> dict[str, Any]:
    """Return all figures of ramps for which there are data, by name."""
    return {
        _name(dataset, one.name): one.draw(dataset)
        for dataset in datasets
        for one in CATALOGUE
        if one.needs in dataset.variables
    }


def _name(dataset: xr.Dataset, name: str) -> str:
    return f"{dataset.attrs['ramp'].replace('-', '')}_{name}"


def runup_report(
    datasets: Sequence[xr.Dataset],
    drawn: dict[str, Any],
    animations: Sequence[xr.Dataset] = (),
) -> Report:
    """Return the report of ramps; `drawn` has every figure as a picture of matplotlib."""
    several = len(datasets) > 1
    moving = {str(one.attrs["ramp"]): one for one in animations}
    found = Report(
        study="runup",
        title=" and ".join(str(one.attrs["ramp"]) for one in datasets).capitalize()
        + " of a lubricated hypoid axle",
        subtitle=" ".join(map(_subtitle, datasets)),
        limits=_LIMITS,
        files=(
            *(FILES[one.attrs["ramp"]] for one in datasets),
            "summary.csv",
            "figures/",
            *(["animation/"] if moving else []),
        ),
        inputs=stored_inputs(datasets[0].attrs, "inputs_given", "inputs_assumed"),
        facts=_facts(datasets[0]),
    )
    for dataset in datasets:
        before = f"{dataset.attrs['ramp'].capitalize()}: " if several else ""
        found = replace(
            found,
            findings=[
                *found.findings,
                *(replace(f, headline=_joined(before, f.headline)) for f in findings(dataset)),
            ],
            numbers=[
                *found.numbers,
                *(replace(n, name=f"{before}{n.name}") for n in numbers(dataset)),
            ],
            figures=[
                *found.figures,
                *_figures(dataset, drawn, before),
                *(
                    moving_figures(moving[dataset.attrs["ramp"]], before)
                    if dataset.attrs["ramp"] in moving
                    else []
                ),
            ],
            tables=[*found.tables, *tables(dataset, before)],
            inputs=[*_settings(dataset, before), *found.inputs],
        )
    return found


def _joined(before: str, sentence: str) -> str:
    return before + (sentence[0].lower() + sentence[1:] if before else sentence)


def _subtitle(dataset: xr.Dataset) -> str:
    start, end = (rads_to_rpm(float(dataset.attrs[f"setting_{e}_speed"])) for e in ("start", "end"))
    kmh = levels.kmh_per_rpm(dataset)
    return (
        f"Hypoid axle {dataset.attrs['axle']}, {levels.heading(dataset)}, from {start:.0f} to "
        f"{end:.0f} rpm of the pinion ({kmh * start:.0f} to {kmh * end:.0f} km/h) in "
        f"{dataset.attrs['setting_duration']:.3g} s as one continuous ramp."
    )


def _figures(dataset: xr.Dataset, drawn: dict[str, Any], before: str) -> list[Figure]:
    found = []
    for one in CATALOGUE:
        name = _name(dataset, one.name)
        if name in drawn:
            found.append(shown(name, _joined(before, one.title), one.caption, drawn[name]))
    return found


def tables(dataset: xr.Dataset, before: str = "") -> list[Table]:
    """Return the crests of the orders and the critical speeds."""
    kmh = levels.kmh_per_rpm(dataset)
    crests = [
        (
            one.mesh_order, one.force, one.speed_rpm, kmh * one.speed_rpm, one.frequency,
            one.bearing, one.direction, one.part,
        )
        for one in peaks(dataset)
    ]  # fmt: skip
    critical = [
        (
            one.mode, one.mesh_order, one.speed_rpm, kmh * one.speed_rpm, one.frequency,
            100.0 * one.damping, None if math.isnan(one.force) else one.force,
            100.0 * one.margin, 100.0 * one.hurry,
        )
        for one in critical_speeds(dataset)
    ]  # fmt: skip
    return [
        Table(
            title=_joined(before, "Crests of the mesh orders"),
            caption="Largest bearing forces of each mesh order, all bearings and directions "
            "together, and the one with the largest part.",
            columns=(
                Column("mesh order"), Column("bearing forces", "N rms"),
                Column("pinion speed", "rpm", 4), Column("vehicle speed", "km/h"),
                Column("frequency", "Hz"), Column("bearing"), Column("direction"),
                Column("its part", "N rms"),
            ),
            rows=crests,
        ),
        Table(
            title=_joined(before, "Critical speeds"),
            caption="Where a mesh order meets a natural frequency. Margin: how far outside the "
            "ramp, as a share of its end. Rate: how fast the order passes the mode, as a share of "
            "the fastest that allows full build-up (ISO 7626-2).",
            columns=(
                Column("natural mode"), Column("mesh order"), Column("pinion speed", "rpm", 4),
                Column("vehicle speed", "km/h"), Column("frequency", "Hz"),
                Column("damping ratio", "%", 2), Column("bearing forces", "N rms"),
                Column("margin", "%", 2), Column("rate", "%", 2),
            ),
            rows=critical,
            folded=True,
        ),
    ]  # fmt: skip


def _settings(dataset: xr.Dataset, before: str) -> list[Input]:
    driver = str(dataset.attrs.get("setting_driver", "bench"))
    found = [Input(f"{before or 'ramp: '}driver", driver, "", *origin_of("engine_orders"))]
    added = bool(before) and dataset.attrs["ramp"] == "coast-down"
    for name, words, unit, converted, options in _INPUTS:
        value = float(dataset.attrs[f"setting_{name}"])
        label = f"{before or 'ramp: '}{words}"
        origin = origin_of(*(_BACK.get(one, one) if added else one for one in options))
        if math.isnan(value):
            found.append(Input(label, "what the car needs", "", INFERRED, "road load and inertia"))
        else:
            found.append(Input(label, f"{converted(value):.6g}", unit, *origin))
    return found


def _facts(dataset: xr.Dataset) -> list[tuple[str, str]]:
    attributes = dataset.attrs
    return [
        ("ramp by gearlube", str(attributes["gearlube_version"])),
        ("axle", f"{attributes['axle']} {attributes['axle_source']}".strip()),
        ("mesh table", str(attributes["mesh_table"])),
        ("bearing preload", f"{attributes['bearing_preload']:g} N"),
        ("oil", str(attributes["oil"])),
    ]
