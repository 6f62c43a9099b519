"""The lines of spectra as bubbles, to hover over in the report."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import preload_label
from gearlube.report.charts import Axis, panels
from gearlube.studies.sweep.figures import bubbles
from gearlube.studies.sweep.figures.spectrum_map import MapChannel, default_top

_SPEED = Axis("vehicle speed", "km/h")
_LARGEST = 15.0  # pixels


def bubble_chart(dataset: xr.Dataset, channel: MapChannel) -> Any:
    """Return the lines of a spectrum over speed and frequency, a panel for each preload."""
    top = default_top(dataset)
    preloads = [preload_label(float(one)) for one in dataset["preload"].values]
    chart = panels(preloads, _SPEED, [Axis("frequency", "Hz") for _ in preloads], height=400)
    points = bubbles.all_lines(dataset, channel, top)
    peak = bubbles.highest(points, top)
    speeds = dataset["speed_kmh"].values
    for kind, words in enumerate(bubbles.KINDS):
        for row in range(len(preloads)):
            found = [points[row, column] for column in range(speeds.size)]
            seen = [(one.kind == kind) & (one.level > peak - bubbles.RANGE) for one in found]
            level = np.concatenate([one.level[s] for one, s in zip(found, seen, strict=True)])
            share = np.clip((level - peak + bubbles.RANGE) / bubbles.RANGE, 0.0, 1.0)
            chart.add_scatter(
                x=np.repeat(speeds, [int(s.sum()) for s in seen]),
                y=np.concatenate([one.frequency[s] for one, s in zip(found, seen, strict=True)]),
                mode="markers",
                name=words,
                legendgroup=words,
                showlegend=row == 0 and level.size > 0,
                marker={
                    "size": 2.0 + _LARGEST * share,
                    "color": bubbles.COLOURS[kind],
                    "line": {"width": 0.5, "color": "white"},
                },
                customdata=level,
                hovertemplate="%{customdata:.1f} dB re "
                f"{channel.reference_text}, %{{y:.0f}} Hz at %{{x:g}} km/h<extra>{words}</extra>",
                row=row + 1,
                col=1,
            )
    for row in range(len(preloads)):
        modes = bubbles.modes_below(dataset.isel(preload=row), top)
        # names of neighbours at opposite ends, where they do not touch
        for number, mode in enumerate(sorted(modes, key=modes.__getitem__)):
            chart.add_hline(
                modes[mode],
                line={"dash": "dot", "width": 1.0, "color": "#808080"},
                annotation={"text": mode, "font": {"size": 10}},
                annotation_position=("top left", "top right")[number % 2],
                row=row + 1,
                col=1,
            )
        chart.update_yaxes(range=[0.0, top], row=row + 1, col=1)
    return chart
