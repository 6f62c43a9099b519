"""Interactive charts of the sound for its report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, line_chart, panels
from gearlube.studies.sound.dataset import (
    is_ramp,
    level_names,
    level_range,
    level_values,
    speed_axis,
)
from gearlube.studies.sound.metrics import METRICS
from gearlube_core.arrays import Array


def level_chart(datasets: Sequence[xr.Dataset]) -> Any:
    """Return the level of the whole sound and of every order; two runs: a panel for each."""
    x, y = _axis(datasets[0]), Axis("level", "dB(A)")
    names, ends = level_names(datasets[0]), level_range(datasets)
    if len(datasets) == 1:
        values = [level_values(datasets[0], i) for i in range(len(names))]
        lines = [
            Line(name=name, x=_along(datasets[0]), y=one)
            for name, one in zip(names, values, strict=True)
            if one is not None
        ]
        chart = line_chart(lines, x, y, height=460)
    else:
        chart = panels(names, x, [y] * len(names), height=210)
        for i in range(len(names)):
            for j, one in enumerate(datasets):
                level = level_values(one, i)
                if level is not None:
                    run = str(one.attrs["name"])
                    line = Line(name=run, x=_along(one), y=level, group=j, dash=j)
                    add_line(chart, line, j, x, y, row=i + 1, col=1, showlegend=i == 0)
    chart.update_yaxes(range=list(ends))
    chart.update_layout(showlegend=True)
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
    figure.update_layout(showlegend=len(datasets) > 1)
    return figure


def _along(dataset: xr.Dataset) -> Array:
    return speed_axis(dataset)[0] if is_ramp(dataset) else dataset["time"].values


def _axis(dataset: xr.Dataset) -> Axis:
    if not is_ramp(dataset):
        return Axis("time", "s")
    _, unit, words = speed_axis(dataset)
    return Axis(words, unit)
