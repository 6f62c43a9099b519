"""The report of a bearing study: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, panels
from gearlube.report.inputs import origin_of
from gearlube.report.parts import GIVEN, Column, Figure, Input, Report, Table
from gearlube.studies.bearing.figures import LAW_NAMES, axis_values, drawn_places, place_words
from gearlube.studies.bearing.findings import findings, numbers
from gearlube.studies.bearing.summary import bearing_summary
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

_TORQUE = Axis("friction torque", "N·m")
_AXES = {
    "speed": Axis("shaft speed", "rpm"),
    "axial_load": Axis("axial load", "N"),
    "radial_load": Axis("radial load", "N"),
    "temperature": Axis("oil temperature", "°C"),
}
_FIELDS = {
    "speed_rpm": "speed_rpm",
    "axial_load": "axial_load_n",
    "radial_load": "radial_load_n",
    "temperature": "temperature_degc",
}  # options and fields of [operation], in the order of the axes
_GIVEN = GIVEN, "setting"
_LIMITS = (
    "Unless the bearing file has a measured torque, the torque is only known within the error "
    "bar, because it is not known how much oil reaches the contacts and how warm it is there.",
    "Seals, churning of the oil around the bearing and misalignment are not in the torque.",
    "A law outside the range of its fit is extrapolated; see the findings.",
)


def bearing_report(dataset: xr.Dataset, inputs: Sequence[Input] = ()) -> Report:
    """Return the report of a bearing study; `inputs` are those of the bearing file."""
    attributes = dataset.attrs
    laws = ", ".join(LAW_NAMES[str(law)] for law in dataset["law"].values)
    return Report(
        study="bearing",
        title=f"Friction of the bearing {attributes['name']}",
        subtitle=f"Torque and power loss with oil {attributes['oil']} by {laws}.",
        findings=findings(dataset),
        numbers=numbers(dataset),
        figures=[
            Figure(
                name="torque",
                title="Torque by all laws",
                caption="Thick line: the first law; dashed: the ends of its error bar (95 %). A "
                "law inside these lines agrees with it as far as either is known.",
                chart=law_chart(dataset),
            ),
            Figure(
                name="parts",
                title="Parts of the torque of the first law",
                caption="The axis is logarithmic, so that small parts show. A change should aim "
                "at the highest part.",
                chart=part_chart(dataset),
            ),
        ],
        tables=[_table(dataset)],
        # conditions and oil stand once, as they were taken
        inputs=[
            *_conditions(dataset, {one.name: (one.origin, one.why) for one in inputs}),
            *(one for one in inputs if one.name != "oil" and not one.name.startswith("operation.")),
        ],
        limits=_LIMITS,
        facts=[("source of the bearing", str(attributes["source"]))],
        files=("bearing.nc", "bearing.csv", "figures/"),
    )


def law_chart(dataset: xr.Dataset) -> Any:
    """Return the torque of every law along the longest axis, a panel for each of some places."""
    along, places = drawn_places(dataset)
    axis, x = _AXES[along], axis_values(along, dataset[along].values)
    chart = panels([place_words(p) or "torque" for p in places], axis, [_TORQUE] * len(places))
    for row, place in enumerate(places, 1):
        at = dataset.sel(place)
        for number, law in enumerate(dataset["law"].values):
            one = at.sel(law=law)
            line = Line(name=LAW_NAMES[str(law)], x=x, y=one["torque"].values)
            add_line(chart, line, number, axis, _TORQUE, row=row, col=1, showlegend=row == 1)
            for end in ("low", "high") if number == 0 else ():
                bar = Line(name=f"error bar, {end} end", x=x, y=one[f"torque_{end}"].values, dash=1)
                add_line(chart, bar, 0, axis, _TORQUE, row=row, col=1, showlegend=row == 1)
        chart.update_yaxes(rangemode="tozero", row=row, col=1)
    return chart


def part_chart(dataset: xr.Dataset) -> Any:
    """Return the parts of the torque of the first law along the longest axis."""
    along, places = drawn_places(dataset)
    axis, x = _AXES[along], axis_values(along, dataset[along].values)
    torque = Axis(_TORQUE.name, _TORQUE.unit, log=True)
    chart = panels([place_words(p) or "torque" for p in places], axis, [torque] * len(places))
    for row, place in enumerate(places, 1):
        at = dataset.isel(law=0).sel(place)
        for number, part in enumerate(at["part"].values):
            values = at["part_torque"].sel(part=part).values
            if not np.isfinite(values).all() or not (values > 0.0).any():
                continue
            line = Line(name=str(part), x=x, y=np.where(values > 0.0, values, np.nan))
            add_line(chart, line, number, axis, torque, row=row, col=1, showlegend=row == 1)
    return chart


def _table(dataset: xr.Dataset) -> Table:
    rows = bearing_summary(dataset)
    parts = list(rows[0].parts) if rows else []
    return Table(
        title=f"Torque by {LAW_NAMES[str(dataset['law'].values[0])]}",
        columns=[
            Column("speed", "rpm", 4),
            Column("axial load", "N", 4),
            Column("radial load", "N", 4),
            Column("oil", "°C"),
            *(Column(part, "N·m") for part in parts),
            Column("torque", "N·m"),
            Column("power loss", "W"),
        ],
        rows=[
            [
                float(rads_to_rpm(row.speed)),
                row.axial_load,
                row.radial_load,
                float(kelvin_to_celsius(row.temperature)),
                *(row.parts.get(part) for part in parts),
                row.torque,
                row.power,
            ]
            for row in rows
        ],
        caption="Up to 24 conditions, spread over all; bearing.csv lists all laws and conditions.",
    )


def _conditions(dataset: xr.Dataset, of_file: Mapping[str, tuple[str, str]]) -> list[Input]:
    found = [
        Input(
            f"bearing: {axis.name}",
            ", ".join(
                f"{one:.4g}" for one in np.atleast_1d(axis_values(name, dataset[name].values))
            ),
            axis.unit,
            *origin_of(option, otherwise=of_file.get(f"operation.{field}", _GIVEN)),
        )
        for (name, axis), (option, field) in zip(_AXES.items(), _FIELDS.items(), strict=True)
    ]
    attributes, layer = dataset.attrs, origin_of("inlet_layer_um")
    rise = f"{attributes['temperature_rise_k']:g}"
    return [
        *found,
        Input(
            "bearing: oil",
            str(attributes["oil"]),
            "",
            *origin_of("oil", otherwise=of_file.get("oil", _GIVEN)),
        ),
        Input("bearing: oil at the inlet of the raceways", _layer(attributes), "", *layer),
        Input("bearing: oil in the contacts warmer by", rise, "K", *origin_of("temperature_rise")),
    ]


def _layer(attributes: dict[str, Any]) -> str:
    layer = float(attributes["inlet_layer_m"])
    return f"{1e6 * layer:g} µm" if layer > 0.0 else "flooded"
