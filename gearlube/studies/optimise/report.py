"""The report of an optimisation: findings, figures, tables, inputs, limits."""

from __future__ import annotations

import math
from pathlib import Path

import xarray as xr

from gearlube.report.inputs import file_inputs, remark_findings
from gearlube.report.parts import Cell, Column, Input, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.optimise.dataset import measures_of
from gearlube.studies.optimise.figures import NAMES, drawn_figures
from gearlube.studies.optimise.findings import findings, numbers
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.file_names import pair_stem

_MICRO = 1e6
_MAIN = ("mesh_orders", "transmission_error", "errors", "front")
_MOST_FIELDS = 8  # that a table of the front shows
_UNITS = {"um": "µm", "deg": "°", "urad": "µrad", "1": ""}
_LIMITS = (
    "Mesh orders are those of the static loaded transmission error, not at a resonance.",
    "The result is the best pair near the start of the search, perhaps not the best of all: try "
    "other starts.",
    "The elastic teeth are those of the pair as it is; shafts, bearings and housing are rigid.",
    "Errors are taken one at a time, with both signs.",
)


def optimise_report(dataset: xr.Dataset, figures: Path) -> Report:
    """Return the report of an optimisation; `figures` is the folder of its pictures."""
    attributes, sizes = dataset.attrs, dataset.sizes
    kind = HypoidGearFile if attributes["kind"] == "hypoid" else HelicalGearFile
    better: HypoidGearFile | HelicalGearFile = kind.model_validate_json(attributes["gear_file"])
    torques = ", ".join(f"{one:g}" for one in dataset["torque"].values)
    count = sizes["error"] - 1
    return Report(
        study="optimise",
        title=f"Quieter flanks: {attributes['name']}",
        subtitle=f"Better flanks of {attributes['pair']}: {sizes['parameter']} fields may change, "
        f"at {torques} N·m, with {'no' if count == 0 else count} errors of assembly and "
        f"making, aim {attributes['aim']}. All numbers come from the full loaded analysis "
        f"with {sizes['phase']} mesh phases; errors are rotations of the pinion.",
        findings=[*findings(dataset), *remark_findings(attributes)],
        numbers=numbers(dataset),
        main_figures=_MAIN,
        figures=pictured(drawn_figures(dataset), figures),
        tables=[_values(dataset), _measures(dataset), *_error_tables(dataset)],
        inputs=[
            Input("torques", torques, "N·m"),
            Input("aim", str(attributes["aim"])),
            Input("mesh orders", ", ".join(str(one) for one in dataset["order"].values)),
            *file_inputs(better),
        ],
        limits=_LIMITS,
        files=(f"{pair_stem(attributes['name'])}.toml", "optimise.nc", "figures/"),
    )


def _values(dataset: xr.Dataset) -> Table:
    rows: list[list[Cell]] = []
    for name in dataset["parameter"].values:
        part = dataset.sel(parameter=name)
        before = float(part["value"].sel(design="before"))
        unit = str(part["value_unit"].values)
        rows.append(
            [
                str(name),
                "none" if math.isnan(before) else f"{before:.6g}",
                f"{float(part['value'].sel(design='better')):.6g}",
                f"{float(part['low']):g}",
                f"{float(part['high']):g}",
                _UNITS.get(unit, unit),
            ]
        )
    names = ("field", "before", "after", "low", "high", "unit")
    return Table(
        title="Fields of the gear file",
        caption="As the better gear file has them; low and high are the bounds.",
        columns=[Column(one) for one in names],
        rows=rows,
    )


def _measures(dataset: xr.Dataset) -> Table:
    rows: list[list[Cell]] = [
        [
            f"{one.torque:g}",
            one.what,
            _UNITS.get(one.unit, one.unit),
            f"{one.before:.4g}",
            f"{one.after:.4g}",
            one.change,
            "" if one.limit is None else "kept" if one.is_kept else "not kept",
        ]
        for one in measures_of(dataset)
    ]
    names = ("measure", "unit", "before", "after", "change", "limit")
    return Table(
        title="All measures before and after",
        columns=[Column("torque", "N·m"), *(Column(one) for one in names)],
        rows=rows,
        caption="Highest and mean values are taken over all errors.",
        folded=True,
    )


def _error_tables(dataset: xr.Dataset) -> list[Table]:
    found = []
    if dataset.sizes["error"] > 1:
        whine = _MICRO * dataset["whine"]
        names = [str(one) for one in dataset["design"].values]
        rows: list[list[Cell]] = [
            [
                f"{torque:g}",
                str(error),
                *(float(whine.sel(design=one, torque=torque, error=error)) for one in names),
            ]
            for torque in dataset["torque"].values
            for error in dataset["error"].values
        ]
        columns = [Column("torque", "N·m"), Column("error")]
        columns += [Column(NAMES[one], "µrad") for one in names]
        title = "With errors and without"
        found.append(Table(title=title, columns=columns, rows=rows, folded=True))
    if "front_whine" in dataset:
        fields = [str(one) for one in dataset["parameter"].values[:_MOST_FIELDS]]
        quantities = ("front_whine", "front_loss")
        rows = [
            [
                *(float(point[one]) for one in quantities),
                *(float(one) for one in point["front_value"].values[: len(fields)]),
            ]
            for point in (dataset.isel(front=k) for k in range(dataset.sizes["front"]))
        ]
        found.append(
            Table(
                title="Mesh orders against loss",
                caption="Relative to before, with the coarse cells of the search, and with the "
                "fields of each pair; optimise.nc has all pairs.",
                columns=[
                    Column("mesh orders"),
                    Column("sliding loss", digits=4),
                    *(Column(one, digits=5) for one in fields),
                ],
                rows=rows,
                folded=True,
            )
        )
    return found
