"""Interactive charts of a sweep: functions from the merged dataset to a chart of plotly."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import preload_label
from gearlube.report.charts import (
    Axis,
    Line,
    add_line,
    add_map,
    add_stack,
    line_chart,
    mark_level,
    panels,
)
from gearlube.studies.sweep.crossings import ORDERS
from gearlube.studies.sweep.figures.efficiency import SOURCES, modelled
from gearlube.studies.sweep.figures.extremes import ExtremesChannel
from gearlube.studies.sweep.figures.order_cuts import harmonic_amplitude
from gearlube.studies.sweep.figures.spectrum_map import (
    DYNAMIC_RANGE,
    MapChannel,
    default_top,
    spectrum_levels,
)

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
    return line_chart(lines, SPEED, Axis("amplitude of the DTE", "nm", log=True))


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
        kept = [modelled(dataset, source) for source in SOURCES]
        parts = np.array(
            [
                one["loss"].sel(source=source).values if has else np.zeros(one.sizes["speed"])
                for source, has in zip(SOURCES, kept, strict=True)
            ]
        )
        names = [words for words, _ in SOURCES.values()]
        speed = one["speed_kmh"].values
        add_stack(chart, names, speed, parts, SPEED, power, kept=kept, bars=True, **place)
        chart.update_yaxes(range=[0.0, top], **place)
    return chart


def map_chart(dataset: xr.Dataset, channel: MapChannel, top: float | None = None) -> Any:
    """Return the spectra over speed and frequency, a panel for each preload.

    White lines are multiples of the mesh frequency, dotted ones natural frequencies.
    """
    rows = _preloads(dataset)
    top = top or default_top(dataset)
    edges, levels, peak = spectrum_levels(dataset, channel, top)
    axes = (SPEED, Axis("frequency", "Hz"), Axis("level", f"dB re {channel.reference_text}"))
    chart = panels([label for _, label, _ in rows], SPEED, [axes[1] for _ in rows], height=400)
    for row, _, one in rows:
        place: dict[str, Any] = {"row": row + 1, "col": 1}
        speed = one["speed_kmh"].values
        add_map(
            chart,
            speed,
            0.5 * (edges[1:] + edges[:-1]),
            levels[row],
            axes,
            limits=(peak - DYNAMIC_RANGE, peak),
            bar=row == 0,
            **place,
        )
        for order in ORDERS:
            frequency = order * one["mesh_frequency"].values
            frequency = np.where(frequency < top, frequency, np.nan)
            chart.add_scatter(
                x=speed,
                y=frequency,
                mode="lines",
                line={"color": "white", "width": 1.0, "dash": "dash"},
                showlegend=False,
                hovertemplate=f"mesh order {order}: %{{y:.0f}} Hz<extra></extra>",
                **place,
            )
        _add_modes(chart, one, top, place)
        chart.update_yaxes(range=[0.0, top], **place)
    return chart


def _add_modes(chart: Any, one: xr.Dataset, top: float, place: dict[str, int]) -> None:
    """Draw the natural frequencies below `top`, named at the left and right end in turn."""
    if "mode_frequency" not in one:
        return
    levels = sorted(
        (float(frequency), str(mode))
        for mode, frequency in zip(one["mode"].values, one["mode_frequency"].values, strict=True)
        if np.isfinite(frequency) and frequency < top
    )
    ends = [float(one["speed_kmh"].values[i]) for i in (0, -1)]
    for number, (frequency, mode) in enumerate(levels):
        right = number % 2
        words = [f"{mode}, {frequency:.0f} Hz", ""]
        chart.add_scatter(
            x=ends,
            y=[frequency, frequency],
            mode="lines+text",
            text=words[::-1] if right else words,
            textposition="top left" if right else "top right",
            textfont={"color": "white", "size": 10},
            line={"color": "#7FFFD4", "width": 1.0, "dash": "dot"},
            showlegend=False,
            hovertemplate=f"{words[0]}<extra></extra>",
            **place,
        )
