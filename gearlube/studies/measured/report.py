"""The reports of measured flanks and of errors of single teeth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, heat_map
from gearlube.report.inputs import file_inputs
from gearlube.report.parts import Column, Figure, Input, Report, Table
from gearlube.report.pictures import kept_figure
from gearlube.studies.measured.findings import (
    flank_findings,
    flank_numbers,
    members_of,
    tooth_findings,
    tooth_numbers,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.file_names import pair_stem

_MICRO = 1e6


def flank_report(flanks: xr.Dataset, picture: Path) -> Report:
    """Return the report of measured flanks; `picture` is the PNG of them."""
    attributes = flanks.attrs
    top = max(_MICRO * float(np.abs(flanks["deviation"]).max()), 1e-3)
    tables = [_settings_table(flanks)] if "setting" in flanks else []
    return Report(
        study="measured",
        title=f"Measured flanks of {attributes['name']}",
        subtitle=f"{flanks.sizes['flank']} flanks, {attributes['source']}; smooth surfaces of "
        f"degree {attributes['degree']} are added to the nominal flanks.",
        findings=flank_findings(flanks),
        numbers=flank_numbers(flanks),
        main_figures=[str(name).replace(" ", "_") for name in flanks["flank"].values],
        figures=[
            *(_map(flanks, str(name), top) for name in flanks["flank"].values),
            Figure(
                name="flanks",
                title="Deviations, smooth surfaces and what they leave",
                caption="Red: more material than nominal. A pattern in the rest is a form that "
                "the smooth surface cannot follow; noise without a pattern comes from "
                "measuring.",
                picture=picture.read_bytes(),
            ),
        ],
        tables=[*tables, _flank_table(flanks)],
        inputs=file_inputs(HypoidGearFile.model_validate_json(attributes["gear_file"])),
        limits=(
            "All teeth get the mean of the measured teeth.",
            "Outside the measured grid the surface is extrapolated; keep its degree low.",
            "Roughness is not in a smooth surface.",
        ),
        facts=[("source", str(attributes["source"]))],
        files=(f"{pair_stem(attributes['name'])}.toml", "flanks.nc", "flanks.png"),
    )


def _map(flanks: xr.Dataset, name: str, top: float) -> Figure:
    part = flanks.sel(flank=name)
    rows, columns = (np.isfinite(part["s"].values).any(axis=axis) for axis in (1, 0))
    values = _MICRO * part["deviation"].values[rows][:, columns]
    chart = heat_map(
        part["t"].values[0, columns],
        part["s"].values[rows, 0],
        values,
        (Axis("toe 0 to heel 1"), Axis("root 0 to tip 1"), Axis("deviation", "µm")),
        limits=(-top, top),
        height=260,
    )
    chart.update_traces(colorscale="RdBu", reversescale=True)
    return Figure(
        name=name.replace(" ", "_"),
        title=f"Deviation of the {name} flank",
        caption="Mean of the measured teeth from nominal; red: more material. All flanks have one "
        "scale.",
        chart=chart,
    )


def _flank_table(flanks: xr.Dataset) -> Table:
    return Table(
        title="Measured flanks",
        caption=(
            "Rest: difference from the smooth surface. Apart: how far teeth are from their mean."
        ),
        columns=[
            Column("flank"),
            Column("teeth"),
            Column("least deviation", "µm"),
            Column("largest deviation", "µm"),
            Column("rest", "µm rms"),
            Column("apart", "µm rms"),
        ],
        rows=[
            [
                str(name),
                int(part["teeth"]),
                _MICRO * float(part["deviation"].min()),
                _MICRO * float(part["deviation"].max()),
                _MICRO * float(part["rest_rms"]),
                _MICRO * float(part["scatter_rms"]),
            ]
            for name, part in ((name, flanks.sel(flank=name)) for name in flanks["flank"].values)
        ],
    )


def _settings_table(flanks: xr.Dataset) -> Table:
    columns = ("nominal", "change", "uncertainty", "corrective")
    return Table(
        title="Settings that explain the deviations",
        caption="The flanks were cut with the nominal setting and the change; the corrective one "
        "brings them back to nominal, to first order.",
        columns=[Column("setting"), Column("unit"), *(Column(one) for one in columns)],
        rows=[
            [
                str(part["setting"].values),
                str(part["setting_unit"].values),
                *(f"{float(part[f'setting_{one}']):.6g}" for one in columns),
            ]
            for part in (flanks.isel(setting=k) for k in range(flanks.sizes["setting"]))
        ],
    )


def tooth_report(teeth: xr.Dataset, picture: Path) -> Report:
    """Return the report of errors of single teeth; `picture` is the PNG of them."""
    attributes = teeth.attrs
    torques = ", ".join(f"{one:g}" for one in teeth["torque"].values)
    return Report(
        study="measured --table",
        title=f"Errors of single teeth of {attributes['name']}",
        subtitle="What pitch, eccentricity and waves add to the transmission error, at "
        f"{torques} N·m on the pinion.",
        findings=tooth_findings(teeth),
        numbers=tooth_numbers(teeth),
        figures=[
            kept_figure(
                "tooth_errors",
                "Added error over a turn, and orders of the turns",
                "At the lowest and the highest torque on the drive flanks: the mean over all turns "
                "after which the same teeth meet again. Sidebands are on both sides of the mesh "
                "orders.",
                picture,
            ),
        ],
        tables=[
            *(_order_table(teeth, member) for member in members_of(teeth)),
            *_hunting_table(teeth),
        ],
        inputs=[
            Input("torques", torques, "N·m"),
            Input("positions of a mesh period", str(teeth.sizes["phase"])),
        ],
        limits=(
            "Quasi-static: the mesh table carries these errors into the dynamics.",
            "The part that repeats only when the same teeth meet again (hunting turn) is not in "
            "the mesh table; a table shows it.",
            "Orders above a quarter of the positions times the teeth are not kept.",
        ),
        files=(f"{pair_stem(attributes['name'])}.nc", "tooth_errors.nc", "tooth_errors.png"),
    )


def _order_table(teeth: xr.Dataset, member: str) -> Table:
    amplitude = _MICRO * teeth[f"{member}_amplitude"]
    torques = teeth["torque"].values
    largest = np.argsort(-amplitude.max("torque").values)[:12]
    return Table(
        title=f"Largest orders of the {member}",
        columns=[Column("order"), *(Column(f"{one:g} N·m", "µm") for one in torques[:10])],
        rows=[
            [
                int(amplitude[f"{member}_order"].values[k]),
                *(float(one) for one in amplitude.values[:10, k]),
            ]
            for k in largest
        ],
        folded=True,
    )


def _hunting_table(teeth: xr.Dataset) -> list[Table]:
    """Return the table of the orders of the hunting turn alone; nothing where there are none."""
    if not teeth.sizes.get("hunting_order"):
        return []
    amplitude = _MICRO * teeth["hunting_amplitude"]
    ratio = teeth.attrs["gear_teeth"] / teeth.attrs["pinion_teeth"]
    return [
        Table(
            title="Orders of the hunting turn alone",
            caption="The largest of those that repeat only when the same teeth meet again. They "
            "are whole orders of neither member, and are not in the mesh table.",
            columns=[
                Column("order of the pinion"),
                Column("order of the gear"),
                *(Column(f"{one:g} N·m", "µm") for one in teeth["torque"].values[:10]),
            ],
            rows=[
                [
                    f"{float(order):.4f}",
                    f"{float(order) * ratio:.4f}",
                    *(float(one) for one in amplitude.values[:10, k]),
                ]
                for k, order in enumerate(teeth["hunting_order"].values)
            ],
        )
    ]
