"""The report of a film: findings, figures, table, inputs, limits."""

from __future__ import annotations

import math
from pathlib import Path

import xarray as xr

from gearlube.report.inputs import remark_findings
from gearlube.report.numbers import number_text
from gearlube.report.parts import Cell, Column, Input, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.films.figures.catalogue import drawn_figures
from gearlube.studies.films.film_formulas import ROUGHNESS
from gearlube.studies.films.findings import STEADY, findings, numbers
from gearlube.studies.films.hypoid.summary import ratio_rows
from gearlube.studies.films.results import SOLUTION, summary_rows

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
        figures=pictured(catalogue, figures),
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
