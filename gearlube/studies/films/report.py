"""The report of a film: findings, figures, table, inputs, limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, panels
from gearlube.report.inputs import remark_findings
from gearlube.report.numbers import number_text
from gearlube.report.parts import Cell, Column, Input, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.films.figures.catalogue import drawn_figures
from gearlube.studies.films.figures.parts import HEADROOM, shown_range
from gearlube.studies.films.film_formulas import ROUGHNESS
from gearlube.studies.films.findings import STEADY, findings, numbers
from gearlube.studies.films.hypoid.summary import ratio_rows
from gearlube.studies.films.results import SOLUTION, summary_rows

_PRESSURE = Axis("pressure", "GPa")
_FILM = Axis("film", "µm")
_SIDE = 1.6  # half widths that are shown

_KINDS = {
    "line": "line contact",
    "point": "point contact",
    "helical": "contact line of a helical pair",
    "helical_cycle": "contact line of a helical pair through its cycle",
    "hypoid": "hypoid tooth pair from entry to exit",
}
_LIMITS = (
    "The bodies are elastic half-spaces; the oil is that of the case, without history.",
    "The inlet is full of oil; starvation is included only if the case has it.",
    "Where the film is thinner than the roughness, asperities carry load; this is not included.",
)
_UNITS = {
    "m": (1e6, "µm"), "Pa": (1e-9, "GPa"), "N/m": (1e-3, "N/mm"), "1": (1.0, ""),
}  # fmt: skip
# attribute: name, factor to the unit that is shown, unit
_INPUTS = {
    "radius": ("radius", 1e3, "mm"),
    "radius_x": ("radius along x", 1e3, "mm"),
    "radius_y": ("radius along y", 1e3, "mm"),
    "reduced_modulus": ("reduced modulus", 1e-9, "GPa"),
    "line_load": ("load per length", 1e-3, "N/mm"),
    "load": ("load", 1.0, "N"),
    "torque": ("torque", 1.0, "N·m"),
    "pinion_torque": ("pinion torque", 1.0, "N·m"),
    "pinion_speed": ("pinion speed", 30.0 / math.pi, "rpm"),
    "speed_1": ("speed of surface 1", 1.0, "m/s"),
    "speed_2": ("speed of surface 2", 1.0, "m/s"),
    "entrainment_x": ("entrainment along x", 1.0, "m/s"),
    "entrainment_y": ("entrainment along y", 1.0, "m/s"),
    "sliding_x": ("sliding along x", 1.0, "m/s"),
    "sliding_y": ("sliding along y", 1.0, "m/s"),
    "step": ("step of the meshing cycle", 1.0, ""),
    ROUGHNESS: ("composite rms roughness", 1e6, "µm"),
    "eyring_stress": ("Eyring stress", 1e-6, "MPa"),
    "nodes_minor": ("nodes along the minor axis", 1.0, ""),
    "nodes_major": ("nodes along the major axis", 1.0, ""),
}
_WORDS = {
    "mesh_table": "mesh table",
    "flank": "flank",
    "load_of": "load of",
    "entrainment_of": "entrainment of",
    "oil": "oil",
    "flow": "flow",
    "side_conditions": "sides",
}


def film_report(dataset: xr.Dataset, figures: Path) -> Report:
    """Return the report of a film; `figures` is the folder of its pictures."""
    of, said = dataset.attrs, findings(dataset)
    kind = str(of["contact"])
    catalogue = drawn_figures(dataset)
    facts = (("source", str(of["source"])), ("outcome", of["outcome"]))
    return Report(
        study=f"ehl {kind}",
        title=f"Film of {of['name']}",
        subtitle=f"Lubricated {_KINDS[kind]}.",
        findings=[*said[:1], *remark_findings(of), *said[1:]],
        numbers=numbers(dataset),
        main_figures=[name for name in catalogue if name != "residuals"],
        figures=pictured(catalogue, figures, _main_charts(dataset)),
        tables=_tables(dataset),
        inputs=film_inputs(dataset),
        limits=_LIMITS,
        facts=[(name, text) for name, text in facts if text],
        files=("NetCDF file", "summary.csv", "figures/"),
    )


def film_inputs(dataset: xr.Dataset) -> list[Input]:
    """Return the inputs that the attributes of the dataset have, in everyday units."""
    of = dataset.attrs
    found = [
        Input(name, f"{factor * float(of[key]):.5g}", unit)
        for key, (name, factor, unit) in _INPUTS.items()
        if key in of
    ]
    for key in ("temperature_inlet", "oil_temperature"):
        if math.isfinite(float(of.get(key, math.nan))):
            found.append(Input("oil temperature", f"{float(of[key]) - 273.15:.4g}", "°C"))
    found += [Input(name, str(of[key])) for key, name in _WORDS.items() if key in of]
    if ROUGHNESS not in of:
        found.append(Input("composite rms roughness", "not given"))
    if of["contact"] in STEADY:
        sizes = " x ".join(str(dataset.sizes[one]) for one in ("x", "y") if one in dataset.sizes)
        found.append(Input("nodes of the finest grid", sizes))
    return found


def _tables(dataset: xr.Dataset) -> list[Table]:
    kind = dataset.attrs["contact"]
    rows: list[list[Cell]] = []
    columns: tuple[str, ...]
    if kind in STEADY:
        for row in summary_rows(dataset):
            factor, unit = _UNITS.get(row.unit, (1.0, row.unit))
            away = "" if row.source == SOLUTION else f"{100.0 * row.deviation:+.1f} %"
            value = factor * row.value
            text = f"{value:.0f}" if value.is_integer() else number_text(value, 4)
            rows.append([row.quantity, row.source, text, unit, away.replace("-", "−")])
        columns = ("quantity", "source", "value", "unit", "against the solution")
    elif kind == "hypoid":
        for one in ratio_rows(dataset):
            factor, unit = _UNITS.get(one.unit, (1.0, one.unit))
            values = (one.least, one.largest, one.load_weighted_mean)
            texts = [number_text(factor * value, 4) for value in values]
            rows.append([one.quantity, one.source, *texts, unit])
        columns = ("quantity", "of", "least", "largest", "mean by load", "unit")
    else:
        return []
    return [Table(title="Summary", columns=[Column(name) for name in columns], rows=rows)]


def _main_charts(dataset: xr.Dataset) -> dict[str, Any]:
    """Return charts in place of the figures with two scales, by name."""
    drawn = {
        "line": ("profile", _line), "point": ("sections", _point), "helical": ("along", _along)
    }  # fmt: skip
    kind = dataset.attrs["contact"]
    if kind not in drawn:
        return {}
    name, draw = drawn[kind]
    return {name: draw(dataset)}


def _two(
    titles: Sequence[str],
    x: Axis,
    lines: Sequence[tuple[int, Line]],
) -> Any:
    """Return lines in panels, each with the number of its panel from 1."""
    y = (_PRESSURE, _FILM)
    figure = panels(titles, x, y, 280)
    for number, (row, line) in enumerate(lines):
        add_line(figure, line, number, x, y[row - 1], row=row, col=1)
    return figure


def _limits(figure: Any, dataset: xr.Dataset, low_high: tuple[float, float] | None = None) -> Any:
    """Show the loaded zone, and films up to a few central ones: outside the gap grows fast."""
    top = 1e6 * HEADROOM * dataset.attrs["central_film"]
    figure.update_yaxes(range=[0.0, top], row=2, col=1)
    if low_high is not None:
        figure.update_xaxes(range=list(low_high))
    return figure


def _line(dataset: xr.Dataset) -> Any:
    x = 1e3 * dataset["x"].values
    figure = _two(
        ("Pressure", "Film"),
        Axis("along the motion", "mm"),
        [
            (1, Line(name="pressure", x=x, y=1e-9 * dataset["pressure"].values)),
            (1, Line(name="dry contact", x=x, y=1e-9 * dataset["hertz_pressure"].values, dash=2)),
            (2, Line(name="film", x=x, y=1e6 * dataset["film"].values)),
        ],
    )
    side = _SIDE * dataset.attrs["half_width"]
    return _limits(figure, dataset, shown_range(dataset, "x", side, 0.01))


def _point(dataset: xr.Dataset) -> Any:
    lines = []
    for group, (along, other) in enumerate((("x", "y"), ("y", "x"))):
        section = dataset.sel({other: 0.0}, method="nearest")
        place = 1e3 * section[along].values
        for row, name, scale in ((1, "pressure", 1e-9), (2, "film", 1e6)):
            values = scale * section[name].values
            label = f"{name} along {along}"
            lines.append((row, Line(name=label, x=place, y=values, group=group)))
    figure = _two(("Pressure", "Film"), Axis("from the centre", "mm"), lines)
    side = _SIDE * dataset.attrs["semi_axis_x"]
    return _limits(figure, dataset, shown_range(dataset, "x", side, 0.01))


def _along(dataset: xr.Dataset) -> Any:
    y = 1e3 * dataset["y"].values
    figure = _two(
        ("Largest pressure of each section", "Smallest film of each section"),
        Axis("along the line", "mm"),
        [
            (1, Line(name="pressure", x=y, y=1e-9 * dataset["pressure"].max("x").values)),
            (2, Line(name="film", x=y, y=1e6 * dataset["film"].min("x").values)),
        ],
    )
    return _limits(figure, dataset)
