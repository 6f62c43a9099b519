"""Interactive charts of a sweep: functions from the merged dataset to a chart of plotly."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import SOURCE_COLOURS, SOURCE_WORDS
from gearlube.plotting.style import preload_label
from gearlube.report.charts import (
    Axis,
    Line,
    add_line,
    add_stack,
    line_chart,
    mark_level,
    panels,
)
from gearlube.studies.sweep.crossings import ORDERS
from gearlube.studies.sweep.figures.efficiency import modelled
from gearlube.studies.sweep.figures.extremes import ExtremesChannel
from gearlube.studies.sweep.figures.order_cuts import harmonic_amplitude

SPEED = Axis("vehicle speed", "km/h")
_PARTS = (("max", "largest", 0), ("mean", "mean", 2), ("min", "least", 1))


def _preloads(dataset: xr.Dataset) -> list[tuple[int, str, xr.Dataset]]:
    return [
        (row, preload_label(float(preload)), dataset.isel(preload=row))
        for row, preload in enumerate(dataset["preload"].values)
    ]


def order_chart(dataset: xr.Dataset) -> Any:
    """Return the amplitudes of the first mesh orders of the transmission error over speed."""
    lines = [
        Line(
            name=f"order {order}, {label}",
            x=one["speed_kmh"].values,
            y=1e9 * harmonic_amplitude(one, order),
            group=row,
            dash=order - 1,
        )
        for row, label, one in _preloads(dataset)
        for order in ORDERS
    ]
    return line_chart(lines, SPEED, Axis("amplitude of the transmission error", "nm", log=True))


def extremes_chart(dataset: xr.Dataset, channel: ExtremesChannel) -> Any:
    """Return largest, mean and least value of a quantity over speed for every preload."""
    unit = "µm" if channel.scale != 1.0 else "N"
    lines = [
        Line(
            name=f"{words}, {label}",
            x=one["speed_kmh"].values,
            y=channel.scale * one[f"{channel.name}_{part}"].values,
            group=row,
            dash=dash,
        )
        for row, label, one in _preloads(dataset)
        for part, words, dash in _PARTS
    ]
    chart = line_chart(lines, SPEED, Axis(channel.label.partition(" [")[0], unit))
    if channel.zero:
        mark_level(chart, 0.0, channel.zero.replace("\n", " "))
    return chart


def efficiency_chart(dataset: xr.Dataset) -> Any:
    """Return the efficiency of mesh and axle over speed, and below the losses by source."""
    rows = _preloads(dataset)
    titles = ["efficiency", *(f"losses, {label}" for _, label, _ in rows)]
    percent, power = Axis("efficiency", "%"), Axis("power lost", "W")
    chart = panels(titles, SPEED, [percent, *(power for _ in rows)])
    place = {"row": 1, "col": 1}
    for row, label, one in rows:
        for part, words, dash in (("mesh", "gear mesh", 0), ("axle", "axle", 1)):
            line = Line(
                name=f"{words}, {label}",
                x=one["speed_kmh"].values,
                y=100.0 * one[f"efficiency_{part}"].values,
                dash=dash,
            )
            add_line(chart, line, row, SPEED, percent, **place)
    top = 1.05 * float(dataset["loss"].sum("source").max())
    for row, _, one in rows:
        place = {"row": row + 2, "col": 1}
        kept = [modelled(dataset, source) for source in SOURCE_WORDS]
        parts = np.array(
            [
                one["loss"].sel(source=source).values if has else np.zeros(one.sizes["speed"])
                for source, has in zip(SOURCE_WORDS, kept, strict=True)
            ]
        )
        names, colours = list(SOURCE_WORDS.values()), list(SOURCE_COLOURS.values())
        speed = one["speed_kmh"].values
        looks: dict[str, Any] = {"kept": kept, "colours": colours, "bars": True, **place}
        add_stack(chart, names, speed, parts, SPEED, power, **looks)
        chart.update_yaxes(range=[0.0, top], **place)
    return chart
