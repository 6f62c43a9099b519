"""The report of a whine study: findings, figures, tables, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.parameter_words import parameter_words, tolerance_words
from gearlube.report.charts import Axis, Line, heat_map, line_chart
from gearlube.report.inputs import file_inputs, origin_of, remark_findings
from gearlube.report.page import write_report
from gearlube.report.parts import Column, Figure, Input, Report, Table
from gearlube.studies.whine.figures import most_moving, order_changes
from gearlube.studies.whine.findings import findings, movers, numbers
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import rads_to_rpm

_SPEED = Axis("pinion speed", "rpm")
_RPM, _MICRO = rads_to_rpm(1.0), 1e6
_LETTERS = 18  # of a line of a label, so that a phone has room for the map
_LIMITS = (
    "The pair turns with two degrees of freedom on rigid shafts and bearings; there is no flank "
    "friction. A car has more natural frequencies.",
    "Changes are to first order: those of a small error. A change of more than a third of the "
    "amplitude is a hint only.",
    "One torque, drive flanks. All teeth are equal.",
    "The mesh table has the orders that its positions resolve: fewer than half of them.",
)


def write_whine_report(dataset: xr.Dataset, folder: Path | str, command_line: str = "") -> Path:
    """Write report.html into a folder; return its path.

    Examples
    --------
    >>> found = xr.load_dataset("gearlube_whine/whine.nc")  # doctest: +SKIP
    >>> write_whine_report(found, "gearlube_whine")  # doctest: +SKIP
    """
    return write_report(whine_report(dataset, command_line), folder)


def whine_report(dataset: xr.Dataset, command_line: str = "") -> Report:
    """Return the report of a whine study."""
    attributes = dataset.attrs
    speed = _RPM * dataset["pinion_speed"].values
    kind = attributes.get("kind", "hypoid")
    model = HypoidGearFile if kind == "hypoid" else HelicalGearFile
    file = model.model_validate_json(attributes["gear_file"])
    moved = "settings, reliefs and misalignments" if kind == "hypoid" else "reliefs and slopes"
    settings = [
        Input("pinion torque", f"{attributes['torque']:g}", "N·m", *origin_of("torque")),
        Input(
            "pinion speeds",
            f"{speed[0]:.0f} to {speed[-1]:.0f}, {speed.size} of them",
            "rpm",
            *origin_of("speeds_rpm"),
        ),
        Input(
            "positions of a mesh period", str(dataset.sizes["phase"]), "", *origin_of("positions")
        ),
    ]
    return Report(
        study="whine",
        title=f"Whine of the {kind} pair {attributes['name']}",
        subtitle=f"Mesh orders of the torsional pair at {attributes['torque']:g} N·m on the pinion "
        f"from {speed[0]:.0f} to {speed[-1]:.0f} rpm, and what {dataset.sizes['parameter']} "
        f"{moved} change of them.",
        findings=[*remark_findings(attributes), *findings(dataset)],
        numbers=numbers(dataset),
        figures=_figures(dataset),
        tables=[_table(dataset, int(order)) for order in dataset["order"].values],
        inputs=[*settings, *file_inputs(file)],
        limits=_LIMITS,
        facts=[("command", command_line)] if command_line else [],
        files=("whine.nc", "whine.csv", "figures/whine.png"),
    )


def _figures(dataset: xr.Dataset) -> list[Figure]:
    force, error = (
        line_chart(_lines(dataset[name], scale), _SPEED, axis)
        for name, scale, axis in (
            ("force", 1.0, Axis("mesh force, amplitude", "N", log=True)),
            ("transmission_error", _MICRO, Axis("transmission error, amplitude", "µrad", log=True)),
        )
    )
    return [
        Figure(
            name="force",
            title="Mesh force over the speed",
            caption="Amplitudes of the mesh orders. A peak is where an order meets the natural "
            "frequency of the mesh.",
            chart=force,
        ),
        Figure(
            name="changes",
            title="What small errors change of the first order",
            caption="Change of the amplitude of mesh order 1 by a growth of each parameter by its "
            "tolerance; point at a cell to read it. Red: louder, blue: quieter. Parameters with "
            "the largest mean over the speeds are on top.",
            chart=_changes(dataset),
        ),
        Figure(
            name="transmission_error",
            title="Transmission error over the speed",
            caption="Amplitudes of the mesh orders of the moving pair, rotation of the pinion.",
            chart=error,
        ),
    ]


def _lines(values: xr.DataArray, scale: float) -> list[Line]:
    speed = _RPM * values["pinion_speed"].values
    return [
        Line(name=f"mesh order {order}", x=speed, y=scale * values.sel(order=order).values)
        for order in values["order"].values
    ]


def _changes(dataset: xr.Dataset) -> Any:
    shown = most_moving(dataset)
    changes = order_changes(dataset)[:, shown].T
    limit = float(np.nanmax(np.abs(changes))) or 1.0
    rows = np.arange(len(shown), dtype=float)
    names = [
        f"{parameter_words(str(part['parameter'].values))} "
        f"+{tolerance_words(float(part['tolerance']), str(part['unit'].values))}"
        for part in (dataset.isel(parameter=int(k)) for k in shown)
    ]
    chart = heat_map(
        _RPM * dataset["pinion_speed"].values,
        rows,
        changes,
        (_SPEED, Axis(""), Axis("change", "N")),
        limits=(-limit, limit),
        height=180 + 32 * len(shown),
    )
    chart.update_traces(
        colorscale="RdBu",
        reversescale=True,
        colorbar={
            "orientation": "h",
            "y": 1.0,
            "yanchor": "bottom",
            "title": {"side": "top"},
            "nticks": 5,
        },
        customdata=np.repeat(np.array(names)[:, None], changes.shape[1], axis=1),
        hovertemplate="%{customdata}: %{z:.3g} N at %{x:.0f} rpm<extra></extra>",
    )
    words = [parameter_words(str(dataset["parameter"].values[k])) for k in shown]
    labels = ["<br>".join(wrap(one, _LETTERS)) for one in words]
    chart.update_yaxes(tickvals=rows.tolist(), ticktext=labels, automargin=True)
    return chart


def _table(dataset: xr.Dataset, order: int) -> Table:
    return Table(
        title=f"What small errors change of mesh order {order}",
        caption="Largest change of the mesh force over the speeds, to first order, by a growth of "
        "the parameter by its tolerance; what changes most on top.",
        columns=(
            Column("parameter"),
            Column("grows by"),
            Column("change of the force", "N"),
            Column("at", "rpm", 4),
            Column("force there", "N"),
            Column("change", "%"),
        ),
        rows=[
            [
                parameter_words(one.parameter),
                tolerance_words(one.tolerance, one.unit),
                one.change,
                one.speed_rpm,
                one.amplitude,
                100.0 * one.change / one.amplitude,
            ]
            for one in movers(dataset, order)
        ],
        folded=order != int(dataset["order"][0]),
    )
