"""Interactive charts of a run-up: functions from its dataset to a chart of plotly."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, heat_map, panels
from gearlube.studies.runup import levels
from gearlube.studies.runup.figures.maps import DYNAMIC_RANGE, force_cells
from gearlube.studies.runup.figures.tracks import critical_marks

_SPEED = Axis("pinion speed", "rpm")
_MOST = 260  # slices of the map in the report


def track_chart(dataset: xr.Dataset) -> Any:
    """Return levels of mesh orders and of everything, of bearing forces and DTE."""
    force = Axis("level", levels.FORCE_TEXT)
    length = Axis("level", levels.LENGTH_TEXT)
    chart = panels(["bearing forces", "transmission error"], _SPEED, [force, length])
    speed = levels.rpm(dataset)
    kinds = (
        (
            levels.total_force(dataset, "bearing_force_track").values,
            levels.total_force(dataset, "bearing_force_overall").values,
            levels.FORCE,
            force,
        ),
        (
            levels.track_rms(dataset, "dte_track").values,
            dataset["dte_overall"].values,
            levels.LENGTH,
            length,
        ),
    )
    for row, (tracks, overall, reference, axis) in enumerate(kinds, 1):
        lines = [("all frequencies", overall)]
        lines += [
            (f"mesh order {order}", tracks[:, i])
            for i, order in enumerate(dataset["mesh_order"].values)
        ]
        for number, (name, values) in enumerate(lines):
            line = Line(name=name, x=speed, y=levels.level(values, reference), dash=number % 4)
            add_line(
                chart, line, number, _SPEED, axis, row=row, col=1,
                legendgroup=name, showlegend=row == 1,
            )  # fmt: skip
    for speed_rpm, words, order in critical_marks(dataset):
        for row in (1, 2):
            chart.add_vline(
                speed_rpm,
                line={"dash": "dot", "width": 1.0, "color": "#808080"},
                annotation={"text": words if order == 1 and row == 1 else "", "font": {"size": 11}},
                annotation_position="bottom right",
                row=row,
                col=1,
            )
    return chart


def map_chart(dataset: xr.Dataset) -> Any:
    """Return the level of all bearing forces over pinion speed and frequency."""
    speed, rows, cells = force_cells(dataset)
    step = max(1, speed.size // _MOST)
    peak = 5.0 * np.ceil(float(cells.max()) / 5.0)
    chart = heat_map(
        speed[::step],
        rows,
        cells[::step].T,
        (_SPEED, Axis("frequency", "Hz"), Axis("level", levels.FORCE_TEXT)),
        limits=(peak - DYNAMIC_RANGE, peak),
        height=520,
    )
    ends = np.array([speed[0], speed[-1]])
    for order in (1, 2, 3, 4):
        place = min(ends[1], 60.0 * rows[-1] / (order * levels.teeth(dataset)))
        _name(
            chart, place, order * levels.teeth(dataset) * place / 60.0, f"H{order}", "bottom left"
        )
    for mode in dataset["mode"].values:
        frequency = dataset["mode_frequency"].sel(mode=mode).values
        if frequency[0] > rows[-1]:
            continue
        chart.add_scatter(
            x=levels.rpm(dataset, "mode_speed"),
            y=frequency,
            mode="lines",
            line={"color": "white", "width": 1.0, "dash": "dot"},
            showlegend=False,
            hovertemplate=f"{mode}: %{{y:.0f}} Hz<extra></extra>",
        )
        _name(chart, ends[0], float(frequency[0]), str(mode), "top right")
    chart.update_xaxes(range=[float(one) for one in ends])
    return chart


def _name(chart: Any, x: float, y: float, words: str, where: str) -> None:
    chart.add_scatter(
        x=[x],
        y=[y],
        mode="text",
        text=[words],
        textposition=where,
        textfont={"color": "white", "size": 11},
        showlegend=False,
        hoverinfo="skip",
    )
