"""The report of a bearing study: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import COLOURS, Axis, add_stack, panels
from gearlube.report.films import model_of
from gearlube.report.inputs import origin_of
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import (
    GIVEN,
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
from gearlube.report.pictures import shown
from gearlube.studies.bearing.figures import (
    LAW_NAMES,
    axis_values,
    drawn_places,
    place_words,
    torque_of_laws,
)
from gearlube.studies.bearing.summary import bearing_summary, bearing_warnings, error_sentences
from gearlube_core.film_model.model import ROLLER
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

_NAMED, _LEAST_SHARE = 3, 0.005  # parts that are listed, if they are not smaller
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


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a bearing study, the most important first."""
    return [
        _largest(dataset),
        *_laws(dataset),
        *_films(dataset),
        *_warmth(dataset),
        *_warned(dataset),
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a bearing study: those of its first law, and the spread."""
    first = dataset.isel(law=0)
    torque, power, factor = (float(first[name].max()) for name in ("torque", "power", "factor"))
    found = [
        Number("largest torque", torque, "N·m", band=(torque / factor, torque * factor)),
        Number("largest power loss", power, "W", band=(power / factor, power * factor)),
        Number("error bar, factor (k = 2)", factor, "", 2),
        Number("mean torque", float(first["torque"].mean()), "N·m"),
    ]
    ratio = float(first["film_ratio"].where(first["speed"] > 0.0).min())
    if np.isfinite(ratio):
        found.append(Number("least film ratio of the raceways", ratio, "", 2))
    if dataset.sizes["law"] > 1:
        found.append(Number("largest over least law, mean", _spread(dataset)))
    return found


def words_of(point: xr.Dataset) -> str:
    """Return where a condition is."""
    return (
        f"{rads_to_rpm(float(point['speed'])):.4g} rpm, {float(point['axial_load']):g} N axial, "
        f"{float(point['radial_load']):g} N radial and "
        f"{kelvin_to_celsius(float(point['temperature'])):.3g} °C"
    )


def _largest(dataset: xr.Dataset) -> Finding:
    first = dataset.isel(law=0)
    power = first["power"]
    worst = first.isel(power.argmax(list(power.dims)))  # type: ignore[arg-type]
    parts = worst["part_torque"].values
    least = _LEAST_SHARE * float(worst["torque"])
    known = np.flatnonzero(np.isfinite(parts) & (parts > least))
    order = known[np.argsort(parts[known])[::-1]][:_NAMED]
    words = ", ".join(
        f"{worst['part'].values[i]} {100.0 * parts[i] / float(worst['torque']):.0f} %"
        for i in order
    )
    most, factor = float(worst["power"]), float(worst["factor"].max())
    return Finding(
        NOTE,
        f"The bearing loses at most {quantity_text(most, 'W')} ({number_text(most / factor)} to "
        f"{number_text(most * factor)}, 95 %), with a torque of "
        f"{quantity_text(float(worst['torque']), 'N·m')}, at {words_of(worst)}.",
        f"By {_name(first)}. "
        + (f"Parts of the torque: {words}. " if words else "")
        + next(one for one in error_sentences(dataset) if str(first["law"].values) in one),
    )


def _laws(dataset: xr.Dataset) -> list[Finding]:
    if dataset.sizes["law"] < 2:
        return []
    mean = dataset["torque"].mean([d for d in dataset["torque"].dims if d != "law"])
    low, high = (mean.isel(law=int(at)) for at in (mean.argmin("law"), mean.argmax("law")))
    return [
        Finding(
            NOTE,
            f"Mean torques by {_name(low)} and {_name(high)} are a factor of "
            f"{_spread(dataset):.3g} apart: {quantity_text(float(low), 'N·m')} and "
            f"{quantity_text(float(high), 'N·m')}.",
            "A measured torque in the bearing file removes this uncertainty.",
        )
    ]


def _films(dataset: xr.Dataset) -> list[Finding]:
    model = model_of(dataset, ROLLER)
    if not model:
        return []
    out = dataset["out_of_range"].sel(law="solved_films")
    return [
        Finding(
            NOTE,
            "Rolling force and films of the raceways by solved_films come from a model of solved "
            "films.",
            f"Model: {model}. Up to {100.0 * float(out.max()):.2g} % of the loaded contacts lie "
            "outside its domain, where formulas are used.",
        )
    ]


def _spread(dataset: xr.Dataset) -> float:
    mean = dataset["torque"].mean([d for d in dataset["torque"].dims if d != "law"]).values
    return float(mean.max() / mean.min())


def _warmth(dataset: xr.Dataset) -> list[Finding]:
    if dataset.sizes["temperature"] < 2:
        return []
    first = dataset["torque"].isel(law=0)
    order = np.argsort(first["temperature"].values)
    cold, warm = first.isel(temperature=order[0]), first.isel(temperature=order[-1])
    change = float(warm.mean() / cold.mean()) - 1.0
    return [
        Finding(
            NOTE,
            f"Warming the oil from {kelvin_to_celsius(float(cold['temperature'])):.3g} to "
            f"{kelvin_to_celsius(float(warm['temperature'])):.3g} °C "
            f"{'lowers' if change < 0.0 else 'raises'} the mean torque by "
            f"{100.0 * abs(change):.0f} %.",
        )
    ]


def _warned(dataset: xr.Dataset) -> list[Finding]:
    said = bearing_warnings(dataset)
    if said:
        return [Finding(WARNING, *_split(one)) for one in said]
    return [Finding(GOOD, "All laws are within their range, and the raceways have a full film.")]


def _name(at: xr.Dataset | xr.DataArray) -> str:
    return LAW_NAMES[str(at["law"].values)]


def _split(sentence: str) -> tuple[str, str]:
    """Return the head of a sentence up to its first semicolon as a sentence, and the rest."""
    head, mark, rest = sentence.partition("; ")
    return (f"{head}.", f"{rest[0].upper()}{rest[1:]}") if mark else (sentence, "")


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
            shown(
                "torque",
                "Torque by all laws",
                "Band: error bar of the first law (95 %). A law inside it agrees with the first as "
                "far as either is known.",
                torque_of_laws(dataset),
            ),
            Figure(
                name="parts",
                title="Parts of the torque of the first law",
                caption="Parts add up to the torque. A change should aim at the largest.",
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


def part_chart(dataset: xr.Dataset) -> Any:
    """Return the parts of the torque of the first law along the longest axis."""
    along, places = drawn_places(dataset)
    axis, x = _AXES[along], axis_values(along, dataset[along].values)
    chart = panels([place_words(p) or "torque" for p in places], axis, [_TORQUE] * len(places))
    first = dataset.isel(law=0)
    found = (first["part_torque"] > 0.0).any(["speed", "axial_load", "radial_load", "temperature"])
    names = [str(one) for one in first["part"].values[found.values]]
    for row, place in enumerate(places, 1):
        torque = first["part_torque"].sel(place).sel(part=names).transpose("part", along)
        look: Any = {"colours": COLOURS[5::-1], "row": row, "col": 1}
        add_stack(chart, names, x, torque.values, axis, _TORQUE, **look)
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
