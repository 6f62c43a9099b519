"""The report of a loss map: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.words import source_colour, source_words
from gearlube.report.charts import Axis, Line, add_line, add_map, add_stack, bar_chart, panels
from gearlube.report.inputs import OF_AXLE, origin_of
from gearlube.report.numbers import number_text
from gearlube.report.parts import Column, Figure, Input, Report, Table
from gearlube.studies.loss_map.figures import LEAST_SHARE, shown_speeds, some_temperatures
from gearlube.studies.loss_map.findings import findings, numbers
from gearlube.studies.loss_map.sampling import input_words, mean_swings, moving_inputs
from gearlube_core.arrays import Array

SPEED, TORQUE = Axis("pinion speed", "rpm"), Axis("pinion torque", "N·m")
_POWER = Axis("power lost", "W")
_ROWS = 8  # torques and speeds of a table
_COOLING = {
    "air_temperature_degc": ("air temperature", "°C", "air_temperature"),
    "conductance_at_rest_w_k": ("conductance of the housing at rest", "W/K", "conductance_at_rest"),
    "conductance_at_100_kmh_w_k": (
        "conductance of the housing at 100 km/h",
        "W/K",
        "conductance_at_100",
    ),
}
_LIMITS = (
    "Steady running: torque, speed and oil temperature are constant at each point. Vibration adds "
    "no loss here.",
    "The oil temperature is that at the inlet of the flanks.",
    "The error bar contains the uncertain data and laws of the table, but not what is left out of "
    "the model.",
)
_FORMULAS = "Films and friction of the flanks are from formulas, not from a solution of the film."


def loss_map_report(
    dataset: xr.Dataset, inputs: Sequence[Input] = (), axle: str = "an axle"
) -> Report:
    """Return the report of a loss map; `inputs` are those of the axle file, `axle` is its name."""
    torque, speed, temperature = (
        dataset[name].values for name in ("torque", "speed", "temperature")
    )
    finished = bool(np.isfinite(dataset["loss_torque"].values).any())
    return Report(
        study="map",
        title=f"Loss map of {axle}",
        subtitle=f"Gear set {dataset.attrs['mesh']}, oil {dataset.attrs['oil']}: "
        f"{dataset['status'].size} points from {number_text(torque[0])} to "
        f"{number_text(torque[-1])} N·m and "
        f"{speed[0]:.4g} to {speed[-1]:.4g} rpm at the pinion, with oil of "
        f"{', '.join(f'{t:g}' for t in temperature)} °C.",
        findings=findings(dataset),
        numbers=numbers(dataset),
        figures=_figures(dataset) if finished else (),
        tables=_tables(dataset) if finished else (),
        inputs=[*_settings(dataset), *inputs],
        limits=_LIMITS if "share_outside" in dataset else (*_LIMITS, _FORMULAS),
        files=("map.nc", "map.csv", "map.mat", "files for VECTO, GEM and Modelica", "figures/"),
    )


def _figures(dataset: xr.Dataset) -> list[Figure]:
    found = []
    if min(dataset.sizes["speed"], dataset.sizes["torque"]) > 1:
        found.append(
            Figure(
                name="loss_torque",
                title="Loss torque",
                caption="Loss torque at the pinion over speed and torque; torques below zero are "
                "coast. The numbers on the lines are N·m. Low torques lose the largest share.",
                chart=contour_chart(dataset, "loss_torque", Axis("loss torque", "N·m")),
            )
        )
        found.append(
            Figure(
                name="efficiency",
                title="Efficiency",
                caption="Output over input. White: next to no torque, where at a point of the map "
                "more than half of the input is lost.",
                chart=contour_chart(dataset, "efficiency", Axis("efficiency", "%"), 100.0),
            )
        )
        if "share_outside" in dataset:
            covered = dataset.assign(covered=1.0 - dataset["share_outside"])
            found.append(
                Figure(
                    name="covered",
                    title="Load that solved films cover",
                    caption="Below 95 % the losses are in part those of formulas, with the error "
                    "bars of formulas.",
                    chart=contour_chart(covered, "covered", Axis("covered load", "%"), 100.0),
                )
            )
    found.append(
        Figure(
            name="losses",
            title="Losses by source",
            caption="Power lost over the torque at a low, a middle and the highest speed. Dashed: "
            "95 % of the draws of the uncertain data lie between these lines.",
            chart=split_chart(dataset),
        )
    )
    if "swing" in dataset:
        swings, still = moving_inputs(dataset)
        names = [input_words(name) for name in swings]
        none = f" No effect here: {', '.join(map(input_words, still))}." if still else ""
        found.append(
            Figure(
                name="sensitivity",
                title="What makes the loss uncertain",
                caption="Mean change of the loss torque when one uncertain input goes to its "
                "factor. Measure the input with the longest bar first." + none,
                chart=bar_chart(
                    names, [100.0 * one for one in swings.values()], Axis("change of loss", "%")
                ),
            )
        )
    return found


def contour_chart(dataset: xr.Dataset, name: str, colour: Axis, factor: float = 1.0) -> Any:
    """Return contours over speed and torque, a panel for each of some temperatures."""
    values = factor * dataset[name]
    degrees = some_temperatures(dataset)
    chart = panels([f"oil {t:g} °C" for t in degrees], SPEED, [TORQUE] * len(degrees), height=330)
    low, high = (float(pick.reduce(values.values, axis=None)) for pick in (np.fmin, np.fmax))
    for row, degree in enumerate(degrees, 1):
        one = values.sel(temperature=degree).transpose("torque", "speed")
        add_map(
            chart,
            one["speed"].values,
            one["torque"].values,
            one.values,
            (SPEED, TORQUE, colour),
            limits=(low, high),
            contours=True,
            bar=row == 1,
            row=row,
            col=1,
        )
    return chart


def split_chart(dataset: xr.Dataset) -> Any:
    """Return the losses by source over torque at some speeds, at a middle temperature."""
    degree = dataset["temperature"].values[dataset.sizes["temperature"] // 2]
    places = shown_speeds(dataset)
    speeds = dataset["speed"].values[places]
    titles = [f"{speed:.0f} rpm, oil {degree:g} °C" for speed in speeds]
    chart = panels(titles, TORQUE, [_POWER] * len(titles), height=300)
    largest = float(np.nanmax(dataset["loss"].sum("source").values))
    for row, place in enumerate(places, 1):
        one = dataset.sel(temperature=degree).isel(speed=place)
        loss = one["loss"].transpose("source", "torque").values
        kept = np.nanmax(loss, axis=1) > LEAST_SHARE * largest
        sources = [str(name) for name in one["source"].values]
        names, colours = [source_words(s) for s in sources], [source_colour(s) for s in sources]
        looks: dict[str, Any] = {"kept": kept, "colours": colours, "row": row, "col": 1}
        add_stack(chart, names, one["torque"].values, loss, TORQUE, _POWER, **looks)
        for end in ("low", "high") if "loss_torque_low" in one else ():
            _add_end(chart, one, end, row)
    return chart


def _add_end(chart: Any, one: xr.Dataset, end: str, row: int) -> None:
    turning = float(one["speed"]) * np.pi / 30.0
    line = Line(
        name=f"95 % of draws, {end} end",
        x=one["torque"].values,
        y=one[f"loss_torque_{end}"].values * turning,
        dash=1,
    )
    add_line(chart, line, 7, TORQUE, _POWER, row=row, col=1, showlegend=row == 1)


def _tables(dataset: xr.Dataset) -> list[Table]:
    found = [
        Table(
            title=f"Loss torque at the pinion [N·m] with oil of {float(one['temperature']):g} °C",
            columns=[
                Column("torque", "N·m", 3),
                *(Column(f"{float(v):.0f} rpm", "N·m") for v in one["speed"].values),
            ],
            rows=[
                [float(torque), *(float(x) for x in row)]
                for torque, row in zip(one["torque"].values, one.values, strict=True)
            ],
            caption="Some torques and speeds of the map; map.csv lists all.",
            folded=i > 0,
        )
        for i, one in enumerate(
            _some(dataset["loss_torque"]).sel(temperature=degree).transpose("torque", "speed")
            for degree in some_temperatures(dataset)
        )
    ]
    found[:0] = no_load_table(dataset)
    if dataset.attrs["uncertain"] and "swing" in dataset:
        swings = mean_swings(dataset)
        found.append(
            Table(
                title="Uncertain data and laws",
                columns=[
                    Column("input"),
                    Column("known to (95 %)"),
                    Column("moves the loss by", "%", 2),
                    Column("why"),
                ],
                rows=[
                    [input_words(name), factor, 100.0 * swings[name], why]
                    for name, factor, why in _uncertain(dataset)
                ],
            )
        )
    return found


def no_load_table(dataset: xr.Dataset) -> list[Table]:
    """Return the torque of each part when the axle turns without load.

    None where no torque is near zero, or where an older map does not know the parts.
    """
    torque = dataset["torque"].values
    if not torque[0] <= 0.0 <= torque[-1] or "pinion_bearing_loss" not in dataset:
        return []
    degree = dataset["temperature"].values[dataset.sizes["temperature"] // 2]
    idle = dataset.isel(torque=int(np.argmin(np.abs(torque))), speed=shown_speeds(dataset))
    idle = idle.sel(temperature=degree)
    turning = idle["speed"].values * np.pi / 30.0
    loss = {str(one): idle["loss"].sel(source=one).values for one in idle["source"].values}
    pinion, whole = idle["pinion_bearing_loss"].values, sum(loss.values())
    drag, seals, churning = (loss.pop(one) for one in ("bearing_torque", "seals", "churning"))
    seal = np.minimum(dataset.attrs["pinion_seal_torque"] * turning, seals)
    parts = {
        "bearings of the pinion's shaft": pinion,
        "bearings of the gear's shaft (differential)": drag - pinion,
        "seal of the pinion": seal,
        "wheel ends: seals and hubs": seals - seal,
        "churning": churning,
        "flanks and damping": sum(loss.values()),
        "whole": whole,
    }
    columns = [Column(f"{float(v):.0f} rpm", "N·m", 3) for v in idle["speed"].values]
    return [
        Table(
            title=f"Turning without load [N·m at the pinion] with oil of {degree:g} °C",
            columns=[Column("part"), *columns],
            rows=[[words, *(power / turning).tolist()] for words, power in parts.items()],
            caption=f"At {float(idle['torque']):.3g} N·m. The preload of bearings is in it.",
        )
    ]


def _some(values: xr.DataArray) -> xr.DataArray:
    """Return values at up to 8 torques and speeds, the ends among them."""
    chosen = {
        name: np.unique(np.linspace(0, values.sizes[name] - 1, _ROWS).round().astype(int))
        for name in ("torque", "speed")
    }
    return values.isel(chosen)


def _uncertain(dataset: xr.Dataset) -> list[tuple[str, str, str]]:
    found = []
    for part in dataset.attrs["uncertain"].split("; "):
        name, _, rest = part.partition(": ")
        factor, _, why = rest.partition(", ")
        found.append((name, factor.replace(" (k = 2)", ""), why))
    return found


def _settings(dataset: xr.Dataset) -> list[Input]:
    attributes, oil = dataset.attrs, str(dataset.attrs["oil"])
    draws = f"{attributes['draws']}"
    torques, speeds, temperatures = (
        _span(dataset[name].values) for name in ("torque", "speed", "temperature")
    )
    lines = [
        Input("map: oil", oil, "", *origin_of("oil", otherwise=OF_AXLE)),
        Input("map: torques", torques, "N·m", *origin_of("torques")),
        Input("map: pinion speeds", speeds, "rpm", *origin_of("speeds")),
        Input("map: oil temperatures", temperatures, "°C", *origin_of("temperatures")),
        Input("map: draws of the uncertain data", draws, "", *origin_of("draws")),
        Input("map: seed of the draws", f"{attributes['seed']}", "", *origin_of("seed")),
    ]
    return lines + [
        Input(f"map: {words}", f"{attributes[name]:g}", unit, *origin_of(option))
        for name, (words, unit, option) in _COOLING.items()
        if name in attributes
    ]


def _span(values: Array) -> str:
    return f"{values[0]:.4g} to {values[-1]:.4g}, {values.size} values"
