"""Figure of measured flanks: deviations, the smooth surface, and what it leaves."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube.plotting.style import house_style, new_figure
from gearlube_core.hypoid_geometry.measured.measured_flanks import MeasuredFlanks


def measured_flanks(flanks: MeasuredFlanks) -> Any:
    """Return the mean deviation, the smooth surface and the rest of every measured flank."""
    with house_style():
        figure = new_figure(11.0, 0.8 + 2.5 * max(1, len(flanks.grids)))
        rows = figure.subplots(max(1, len(flanks.grids)), 3, squeeze=False, sharex=True)
        for axes, (key, grid) in zip(rows, flanks.grids.items(), strict=False):
            surface = flanks.surfaces[key]
            mean = 1e6 * grid.deviation.mean(axis=0)
            rest = 1e6 * surface.residual
            shown = (
                (f"{grid.name}: mean of {len(grid.teeth)} teeth [µm]", mean),
                ("smooth surface [µm]", mean - rest),
                (f"rest, {1e6 * surface.residual_rms:.2f} µm rms [µm]", rest),
            )
            for ax, (title, values) in zip(axes, shown, strict=True):
                top = max(float(np.max(np.abs(values))), 1e-3)
                drawn = ax.pcolormesh(
                    grid.places.t, grid.places.s, values, cmap="RdBu_r", vmin=-top, vmax=top
                )
                figure.colorbar(drawn, ax=ax)
                ax.set_title(title, fontsize=9.5)
                ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
                ax.grid(visible=False)
            axes[0].set_ylabel("root  -  tip")
        for ax in rows[-1]:
            ax.set_xlabel("toe  -  heel")
        figure.suptitle(f"{flanks.file.name}: plus is more material", fontsize=11.5)
    return figure
