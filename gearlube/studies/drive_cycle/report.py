"""The report of a drive cycle: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.cycle import LEAST_SHARE
from gearlube.plotting.range_words import range_words
from gearlube.plotting.words import NAMED_SHARE, source_colour, source_words
from gearlube.report.charts import Axis, Line, add_line, line_chart, mark_level, panels, stack_chart
from gearlube.report.churning import regime_findings
from gearlube.report.cycle import WH, energy_lost, energy_table
from gearlube.report.films import (
    bearing_drag,
    covered_share,
    flank_friction,
    model_of,
    points_beyond,
    solved_films,
    solved_rollers,
)
from gearlube.report.inputs import origin_of
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Input,
    Number,
    Report,
    Table,
)
from gearlube.studies.drive_cycle.tables import range_sentence
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FLANK, ROLLER

_DRAWN = "efficiency_low"  # a variable of cycles with draws of all uncertain data
_BAND, _LITTLE = 10.0, 0.1  # km/h; share of the loss that may be extrapolated
TIME = Axis("time", "s")
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
    "One temperature for oil and housing.",
    "With draws, low and high contain 95 % of the draws of all uncertain data; without draws they "
    "contain only the assumed heat data. The dashed temperatures contain only the heat data.",
)


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a drive cycle, the most important first."""
    return [
        _lost(dataset),
        _temperature(dataset),
        *_brakes(dataset),
        *_solved(dataset),
        *_rollers(dataset),
        *_churning(dataset),
        _ranges(dataset),
        *(Finding(WARNING, note) for note in dataset.attrs.get("trace_notes", "").splitlines()),
        Finding(NOTE, f"Not modelled: {dataset.attrs['not_modelled']}."),
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a drive cycle."""
    oil = dataset["oil_temperature"].values
    return [
        Number("energy lost in the axle", float(dataset["energy_lost"].sum()), "kJ", 4),
        Number("energy lost in the axle, in Wh", WH * float(dataset["energy_lost"].sum()), "Wh", 4),
        Number("energy lost in the axle, low end", float(dataset["energy_lost_low"]), "kJ", 4),
        Number("energy lost in the axle, high end", float(dataset["energy_lost_high"]), "kJ", 4),
        Number("energy into the axle", float(dataset["energy_in"]), "kJ", 4),
        Number("efficiency over the cycle", 100.0 * float(dataset["efficiency"]), "%", 4),
        Number("oil at the end", float(oil[-1]), "°C"),
        Number("warmest oil", float(oil.max()), "°C"),
        *(
            Number(f"lost by {source_words(str(one['source'].values))}", float(one), "kJ")
            for one in dataset["energy_lost"]
            if float(one) > NAMED_SHARE * float(dataset["energy_lost"].sum())
        ),
    ]


def _lost(dataset: xr.Dataset) -> Finding:
    low, high = (float(dataset[f"energy_lost_{end}"]) for end in ("low", "high"))
    detail = f"{_bounds_text(dataset)} it is {number_text(low)} to {quantity_text(high, 'kJ')}."
    if causes := dataset.attrs.get("causes"):
        detail += f" Most of this bar, and of that of the efficiency, comes from: {causes}."
    return energy_lost(dataset, "The axle", source_words, detail)


def _bounds_text(dataset: xr.Dataset) -> str:
    """Return the bounds of energy and last temperature as text."""
    if _DRAWN in dataset:
        return "With the uncertain data of axle and heat (95 % of the draws)"
    return "With heat capacity and conductances at the ends of their assumed intervals"


def _temperature(dataset: xr.Dataset) -> Finding:
    oil = dataset["oil_temperature"].values
    low, high = (
        float(
            dataset[f"end_temperature_{end}"]
            if _DRAWN in dataset
            else dataset[f"oil_temperature_{end}"].values[-1]
        )
        for end in ("low", "high")
    )
    return Finding(
        NOTE,
        f"The oil goes from {oil[0]:.0f} to {oil[-1]:.0f} °C.",
        f"{_bounds_text(dataset)} it ends between {low:.0f} and {high:.0f} °C; air is at "
        f"{dataset.attrs['air_temperature_degc']:g} °C.",
    )


def _brakes(dataset: xr.Dataset) -> list[Finding]:
    brakes = float(dataset["energy_brakes"])
    if brakes <= 0.0:
        return []
    return [
        Finding(
            NOTE,
            f"The friction brakes take {quantity_text(brakes, 'kJ')}.",
            f"Share of the braking that goes through the axle: {dataset.attrs['regeneration']:g}.",
        )
    ]


def _solved(dataset: xr.Dataset) -> list[Finding]:
    """Say how far the model of solved films is to be trusted, where the axle took it."""
    if "energy_lost_bound" not in dataset:
        return []
    lost = float(dataset["energy_lost_bound"])
    if not float(flank_friction(dataset["energy_lost"])) > 0.0:
        return []
    friction = flank_friction(dataset["loss"]) * dataset["duration"]
    outside = float((friction * dataset["share_outside"]).sum() / friction.sum())
    effect = f"That is {quantity_text(lost, 'kJ', 2)} of energy lost"
    error = float(dataset["efficiency_bound"])
    if np.isfinite(error):
        effect += f" and {quantity_text(100.0 * error, '%', 2)} of efficiency over the cycle"
    words = f"with {100.0 * outside:.1f} % of the flanks' friction loss"
    words += points_beyond(dataset["share_outside"], "steps")
    bound = covered_share(dataset["friction_bound"] * dataset["duration"], friction)
    return [solved_films(bound, outside, words, f"{effect}.", model_of(dataset, FLANK))]


def _rollers(dataset: xr.Dataset) -> list[Finding]:
    """Say the same of the model of rollers."""
    if "drag_bound" not in dataset:
        return []
    lost = float(dataset["energy_drag_bound"])
    if not float(bearing_drag(dataset["energy_lost"])) > 0.0:
        return []
    drag = bearing_drag(dataset["loss"]) * dataset["duration"]
    outside = float((drag * dataset["rollers_outside"]).sum() / drag.sum())
    effect = f"That is {quantity_text(lost, 'kJ', 2)} of energy lost."
    words = f"with {100.0 * outside:.1f} % of the bearings' drag loss"
    words += points_beyond(dataset["rollers_outside"], "steps")
    bound = covered_share(dataset["drag_bound"] * dataset["duration"], drag)
    return [solved_rollers(bound, outside, words, effect, model_of(dataset, ROLLER))]


def _churning(dataset: xr.Dataset) -> list[Finding]:
    if "churning_regime" not in dataset:
        return []
    oil = dataset["oil_temperature"].values
    return regime_findings(
        dataset["churning_regime"].values,
        dataset["pinion_speed"].values,
        "rpm",
        dataset["loss"].sel(source="churning").values,
        0.5 * (oil[1:] + oil[:-1]),
    )


def _ranges(dataset: xr.Dataset) -> Finding:
    left = range_sentence(dataset)
    if not left:
        return Finding(GOOD, "No step left the range of a formula or table.")
    lost, outside = _lost_outside(dataset)
    share = 100.0 * float(outside.sum() / max(lost.sum(), 1e-9))
    return Finding(
        WARNING,
        f"{number_text(share, 2)} % of the energy is lost outside the range of a formula or table.",
        f"{_usable(dataset)} {left}",
    )


def _lost_outside(dataset: xr.Dataset) -> tuple[Array, Array]:
    """Return the energy lost in each step, and the part of it that is lost outside a range."""
    lost = dataset["loss"].sum("source").values * dataset["duration"].values
    return lost, lost * dataset["outside_range"].max("range").values


def _usable(dataset: xr.Dataset) -> str:
    """Return up to which speed at most a tenth of the loss is extrapolated, as a sentence."""
    speed = dataset["vehicle_speed"].values
    lost, outside = _lost_outside(dataset)

    def share(where: Any) -> float:
        return float(outside[where].sum() / max(lost[where].sum(), 1e-9))

    ends = np.arange(_BAND, speed.max() + _BAND, _BAND)
    good = [end for end in ends if share(speed <= end) <= _LITTLE]
    inside = speed <= (good[-1] if good else 0.0)
    if not good or inside.all():
        usable = "Usable with care" if good else "Usable for no speed"
        return f"{usable}: {100.0 * share(speed >= 0.0):.0f} % of the loss is extrapolated."
    return (
        f"Usable for {good[-1]:g} km/h and below ({100.0 * share(inside):.0f} % of the loss there "
        f"is extrapolated), not for higher speeds ({100.0 * share(~inside):.0f} %)."
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
        files=(
            "drive_cycle.nc",
            "drive_cycle.csv",
            "summary.csv",
            "fastsim.yaml",
            "co2mpas.csv",
            "figures/",
        ),
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
    caption = "A source with zero is not modelled in this axle, or loses nothing."
    return [
        energy_table(dataset, source_words, caption),
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
