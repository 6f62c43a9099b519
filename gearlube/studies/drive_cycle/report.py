"""The report of a drive cycle: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import source_colour, source_words
from gearlube.plotting.range_words import range_words
from gearlube.report.charts import Axis, Line, add_line, line_chart, mark_level, panels, stack_chart
from gearlube.report.inputs import origin_of
from gearlube.report.parts import Cell, Column, Figure, Input, Report, Table
from gearlube.studies.drive_cycle.figures import LEAST_SHARE
from gearlube.studies.drive_cycle.findings import findings, numbers

TIME = Axis("time", "s")
_NOTHING = 1e-6  # kJ
_SETTINGS = {
    "start_temperature_degc": ("temperature of oil and housing at the start", "°C"),
    "air_temperature_degc": ("air temperature", "°C"),
    "regeneration": ("share of the braking through the axle", ""),
    "coast_torque_n_m": ("drag of engine and gearbox at the pinion", "N·m"),
    "capacity_j_k": ("heat capacity of oil and housing", "J/K"),
    "conductance_at_rest_w_k": ("conductance of the housing at rest", "W/K"),
    "conductance_at_100_kmh_w_k": ("conductance of the housing at 100 km/h", "W/K"),
}
_OPTIONS = (
    "start_temperature", "air_temperature", "regeneration", "coast_torque", "heat_capacity",
    "conductance_at_rest", "conductance_at_100",
)  # fmt: skip
_LIMITS = (
    "The loss in each step is that of steady running at the torque, speed and oil temperature in "
    "the middle of the step. At standstill nothing is lost.",
    "One temperature for oil and housing; heat from brakes, gearbox and exhaust is left out.",
    "With draws, low and high contain 95 % of the draws of all uncertain data; without draws they "
    "contain only the assumed heat data. The dashed temperatures contain only the heat data.",
)


def cycle_report(dataset: xr.Dataset, inputs: Sequence[Input] = ()) -> Report:
    """Return the report of a drive cycle; `inputs` are those of the axle file."""
    attributes = dataset.attrs
    way = float((dataset["vehicle_speed"] * dataset["duration"]).sum()) / 3600.0
    return Report(
        study="cycle",
        title=f"Axle losses over the drive cycle {attributes['cycle']}",
        subtitle=f"Axle {attributes['axle']}, oil {attributes['oil']}: "
        f"{float(dataset['time'][-1]):.0f} s and {way:.2f} km.",
        findings=findings(dataset),
        numbers=numbers(dataset),
        figures=_figures(dataset),
        tables=_tables(dataset),
        inputs=[*_settings(dataset), *inputs],
        limits=_LIMITS,
        files=("drive_cycle.nc", "drive_cycle.csv", "summary.csv", "figures/"),
    )


def _settings(dataset: xr.Dataset) -> list[Input]:
    attributes = dataset.attrs
    return [
        Input("cycle: name", str(attributes["cycle"]), "", *origin_of("cycle")),
        *(
            Input(f"cycle: {words}", f"{attributes[name]:g}", unit, *origin_of(option))
            for option, (name, (words, unit)) in zip(_OPTIONS, _SETTINGS.items(), strict=True)
        ),
    ]


def _figures(dataset: xr.Dataset) -> list[Figure]:
    return [
        Figure(
            name="demand",
            title="Speed and torque of the cycle",
            caption="Vehicle speed, and the torque on the pinion; below zero the car coasts or "
            "brakes through the axle.",
            chart=demand_chart(dataset),
        ),
        Figure(
            name="losses",
            title="Power lost by source",
            caption="Areas add up. Peaks come from high torque; the level between them is drag.",
            chart=loss_chart(dataset),
        ),
        Figure(
            name="temperature",
            title="Oil temperature",
            caption="Oil and housing warm up together. Dashed: with heat capacity and conductances "
            "at the ends of their assumed intervals.",
            chart=temperature_chart(dataset),
        ),
    ]


def demand_chart(dataset: xr.Dataset) -> Any:
    """Return vehicle speed above pinion torque over time."""
    speed, torque = Axis("vehicle speed", "km/h"), Axis("pinion torque", "N·m")
    chart = panels(["vehicle speed", "pinion torque"], TIME, [speed, torque], height=240)
    for row, (name, axis) in enumerate((("vehicle_speed", speed), ("pinion_torque", torque)), 1):
        line = Line(name=axis.name, x=dataset["step"].values, y=dataset[name].values)
        add_line(chart, line, row - 1, TIME, axis, row=row, col=1)
    return chart.update_layout(showlegend=False)


def loss_chart(dataset: xr.Dataset) -> Any:
    """Return the power lost by source over time."""
    energy = dataset["energy_lost"].values
    kept = energy > LEAST_SHARE * energy.sum()
    sources = [str(name) for name in dataset["source"].values]
    names, colours = [source_words(s) for s in sources], [source_colour(s) for s in sources]
    power = Axis("power lost", "W")
    powers = dataset["loss"].values.T
    return stack_chart(
        names, dataset["step"].values, powers, TIME, power, kept=kept, colours=colours
    )


def temperature_chart(dataset: xr.Dataset) -> Any:
    """Return the oil temperature over time with its ends, and the air."""
    time = dataset["time"].values
    lines = [
        Line(name="oil and housing", x=time, y=dataset["oil_temperature"].values, group=0),
        *(
            Line(
                name=f"{words} warming",
                x=time,
                y=dataset[f"oil_temperature_{end}"].values,
                group=0,
                dash=1,
            )
            for end, words in (("low", "slowest"), ("high", "fastest"))
        ),
    ]
    chart = line_chart(lines, TIME, Axis("temperature", "°C"), height=360)
    mark_level(chart, float(dataset.attrs["air_temperature_degc"]), "air")
    return chart


def _tables(dataset: xr.Dataset) -> list[Table]:
    energy = dataset["energy_lost"].values
    energy = np.where(energy > _NOTHING, energy, 0.0)
    total = max(float(energy.sum()), _NOTHING)
    each = [*zip(dataset["source"].values, energy, strict=True), ("all", energy.sum())]
    rows: list[list[Cell]] = [
        [source_words(str(name)), float(one), float(one) / 3.6, 100.0 * float(one) / total]
        for name, one in each
    ]
    return [
        Table(
            title="Energy lost by source",
            columns=[
                Column("source"),
                Column("energy", "kJ", 4),
                Column("energy", "Wh", 4),
                Column("share", "%"),
            ],
            rows=rows,
            caption="A source with zero is not modelled in this axle, or loses nothing.",
        ),
        Table(
            title="Ranges",
            columns=[
                Column("range of a formula or table"),
                Column("running time outside", "%", 2),
                Column("energy lost outside", "%", 2),
            ],
            rows=[
                [
                    range_words(str(one["range"].values)),
                    100.0 * float(one),
                    100.0 * float(energy_share),
                ]
                for one, energy_share in zip(
                    dataset["time_outside_range"], dataset["energy_outside_range"], strict=True
                )
            ],
        ),
    ]
