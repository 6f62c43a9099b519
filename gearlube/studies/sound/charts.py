"""Interactive charts of the sound for its report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, line_chart, panels
from gearlube.studies.sound.dataset import is_ramp, order_name, speed_axis
from gearlube.studies.sound.metrics import METRICS
from gearlube_core.arrays import Array

_RANGE = 60.0  # dB below the loudest


def level_chart(datasets: Sequence[xr.Dataset]) -> Any:
    """Return the level of the whole sound and of every order; dashed: the second run."""
    lines = []
    for dash, one in enumerate(datasets):
        x = _along(one)
        before = f"{one.attrs['name']}: " if len(datasets) > 1 else ""
        lines.append(
            Line(
                name=f"{before}whole, dB(A)",
                x=x,
                y=one["level_a"].values,
                group=len(one["order"]),
                dash=dash,
            )
        )
        for i, order in enumerate(one["order"].values):
            name = order_name(float(order), int(one.attrs["pinion_teeth"]))
            level = one["order_level"].values[i]
            lines.append(Line(name=f"{before}{name}", x=x, y=level, group=i, dash=dash))
    chart = line_chart(lines, _axis(datasets[0]), Axis("sound pressure level", "dB"), height=480)
    high = max(float(np.max(one["level"].values)) for one in datasets)
    chart.update_yaxes(range=[high - _RANGE, high + 4.0])
    return chart


def metric_chart(datasets: Sequence[xr.Dataset]) -> Any:
    """Return a panel for every metric; None without any."""
    names = [name for name in METRICS if name in datasets[0]]
    if not names:
        return None
    x = _axis(datasets[0])
    axes = [Axis(METRICS[name].words, METRICS[name].unit) for name in names]
    figure = panels([axis.name for axis in axes], x, axes, height=230)
    for row, (name, axis) in enumerate(zip(names, axes, strict=True), 1):
        for i, one in enumerate(datasets):
            if name in one:
                line = Line(
                    name=str(one.attrs["name"]),
                    x=_along(one),
                    y=one[name].values,
                    group=i,
                    dash=i,
                )
                first = row == 1 and len(datasets) > 1
                add_line(figure, line, i, x, axis, row=row, col=1, showlegend=first)
        figure.update_yaxes(rangemode="tozero", row=row, col=1)
    return figure


def _along(dataset: xr.Dataset) -> Array:
    return speed_axis(dataset)[0] if is_ramp(dataset) else dataset["time"].values


def _axis(dataset: xr.Dataset) -> Axis:
    if not is_ramp(dataset):
        return Axis("time", "s")
    _, unit, words = speed_axis(dataset)
    return Axis(words, unit)
