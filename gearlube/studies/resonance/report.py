"""The report of a resonance study: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.report.inputs import origin_of
from gearlube.report.parts import Cell, Column, Figure, Input, Report, Table
from gearlube.report.pictures import pictured, shown
from gearlube.studies.resonance.figures.catalogue import RESONANCE_CATALOGUE, load_curves
from gearlube.studies.resonance.findings import findings, numbers, pinion_rpm
from gearlube.studies.resonance.settings import MODELS
from gearlube.studies.resonance.summary import summaries
from gearlube_core.units import kelvin_to_celsius

_LIMITS = (
    "The pair alone, two rotations about rigid shafts and bearings; in a car shafts and housing "
    "add natural frequencies.",
    "Periodic motions that repeat after one mesh period, or two where they double; motions that "
    "never repeat are seen in the sweeps in time only.",
    "While flanks are apart there is no damping by a film; impacts have the damping of the mesh.",
    "All teeth are equal.",
)
_COLUMNS = (
    Column("model"),
    Column("folds and bifurcations at"),
    Column("largest response, p-p", "µm"),
    Column("at"),
    Column("pinion speed", "rpm", 4),
    Column("teeth apart, rising"),
    Column("teeth apart, falling"),
)


def resonance_report(response: xr.Dataset, figures: Path, load: xr.Dataset | None = None) -> Report:
    """Return the report of a resonance study; `figures` is the folder of its pictures."""
    attributes = response.attrs
    drawn = pictured(RESONANCE_CATALOGUE, figures)
    if load is not None:
        drawn.insert(1, _over_torque(load))
    return Report(
        study="resonance",
        title="Resonance of a torsional hypoid pair",
        subtitle=f"Stable and unstable periodic motions from {attributes['first']:g} to "
        f"{attributes['last']:g} of the natural frequency at {attributes['pinion_torque']:g} N·m "
        f"on the pinion, mesh {attributes.get('mesh', 'not reached')}.",
        findings=findings(response, load),
        numbers=numbers(response),
        figures=drawn,
        tables=[_table(response)] if "model" in response else [],
        inputs=_inputs(response),
        limits=_LIMITS,
        facts=[("source", str(attributes["source"]))] if attributes["source"] else [],
        files=("resonance.nc", "cycle.nc", *(() if load is None else ("load.nc",)), "figures/"),
    )


def _over_torque(load: xr.Dataset) -> Figure:
    words = (
        f"At {load.attrs['relative_frequency']:g} of the natural frequency, without friction. "
        "Dashed: unstable motions. Where two stable motions lie above each other, which one runs "
        "depends on where the torque came from."
    )
    return shown("load_response", "Response over load", words, load_curves(load))


def _table(response: xr.Dataset) -> Table:
    rows: list[list[Cell]] = [
        [
            MODELS[one.model],
            ", ".join(f"{kind} {at:.4f}" for kind, at in one.special) or "none",
            1e6 * one.peak,
            one.peak_at,
            pinion_rpm(response, one.peak_at),
            _ranges(one.separated_up),
            _ranges(one.separated_down),
        ]
        for one in summaries(response)
    ]
    return Table(
        title="Models side by side",
        columns=_COLUMNS,
        rows=rows,
        caption="Frequencies are mesh over natural frequency. Teeth part along slow sweeps of "
        "rising and of falling speed.",
    )


def _ranges(ranges: list[tuple[float, float]]) -> str:
    return ", ".join(f"{a:.3f} to {b:.3f}" for a, b in ranges) or "never"


def _inputs(response: xr.Dataset) -> list[Input]:
    given = response.attrs
    oil, rough = kelvin_to_celsius(given["oil_temperature"]), 1e6 * given["roughness_rms"]
    found = [
        Input("pinion torque", f"{given['pinion_torque']:g}", "N·m", *origin_of("torque")),
        Input(
            "range, mesh over natural frequency",
            f"{given['first']:g} to {given['last']:g}",
            "",
            *origin_of("frequency_range"),
        ),
        Input("contact radii", str(given["radii"]), "", *origin_of("radii")),
        Input("flank friction", str(given["friction"]), "", *origin_of("friction")),
        Input("oil temperature", f"{oil:.4g}", "°C", *origin_of("oil_temperature")),
        Input("roughness of both flanks, rms", f"{rough:.4g}", "µm", *origin_of("roughness_um")),
    ]
    for name, words, scale, unit in (
        ("damping_ratio", "damping ratio", 100.0, "%"),
        ("static_deflection", "static deflection", 1e6, "µm"),
        ("mesh_stiffness", "mean mesh stiffness", 1e-6, "N/µm"),
        ("equivalent_mass", "equivalent mass", 1.0, "kg"),
        ("backlash", "backlash", 1e6, "µm"),
        ("mesh_orders", "mesh orders of the table", 1.0, ""),
    ):
        if name in given:
            origin = "inferred" if name in ("static_deflection", "equivalent_mass") else "assumed"
            why = "of the pair and its mesh" if origin == "inferred" else "of the shipped pair"
            if name in ("mesh_stiffness", "mesh_orders"):
                origin, why = "inferred", "mesh table"
            found.append(Input(words, f"{scale * float(given[name]):.4g}", unit, origin, why))
    return found
