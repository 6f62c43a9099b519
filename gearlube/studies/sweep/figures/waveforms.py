"""Waveforms of the transmission error and of a roller load over one revolution."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    SERIES,
    house_style,
    new_figure,
    outlined,
    preload_label,
    typical_speeds,
)


def waveforms(dataset: xr.Dataset) -> Any:
    """Return the DTE over one pinion revolution at a low, a medium and a high speed."""
    columns = typical_speeds(dataset)
    turns = dataset["pinion_angle"].values / (2.0 * np.pi)
    with house_style():
        figure = new_figure(9.0, 6.0)
        axes = np.atleast_1d(figure.subplots(max(len(columns), 1), 1, sharex=True))
        for ax, column in zip(axes, columns, strict=False):
            for row, preload in enumerate(dataset["preload"].values):
                wave = dataset["dte_wave"].values[row, column] * 1e6
                ax.plot(
                    turns,
                    wave,
                    color=SERIES[row % len(SERIES)],
                    lw=(2.6, 1.1)[row % 2],
                    label=preload_label(preload),
                )
            ax.set_title(f"{float(dataset['speed_kmh'][column]):g} km/h", loc="left", fontsize=9.5)
            ax.set_ylabel("DTE [µm]")
        axes[-1].set_xlabel("pinion revolutions [-]")
        axes[-1].set_xlim(0.0, 1.0)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=len(handles), loc="outside lower center")
        figure.suptitle("Dynamic transmission error over one pinion revolution", fontsize=11.5)
    return figure


def roller_zone(dataset: xr.Dataset) -> Any:
    """Return the polar plot of the load of one roller against cage angle: its loaded zone."""
    from matplotlib.ticker import MaxNLocator

    columns = typical_speeds(dataset)
    angle = dataset["cage_angle"].values
    closed = np.append(angle, angle[:1])
    with house_style():
        figure = new_figure(10.0, 4.4)
        axes = np.atleast_1d(
            figure.subplots(1, max(len(columns), 1), subplot_kw={"projection": "polar"})
        )
        top = float(np.nanmax(dataset["roller_zone_max"].values[:, columns])) if columns else 1.0
        for ax, column in zip(axes, columns, strict=False):
            for row, preload in enumerate(dataset["preload"].values):
                colour = SERIES[row % len(SERIES)]
                mean, low, high = (
                    np.append(values, values[:1])
                    for values in (
                        dataset[f"roller_zone_{part}"].values[row, column]
                        for part in ("mean", "min", "max")
                    )
                )
                ax.fill_between(closed, low, high, color=colour, alpha=0.2, lw=0)
                ax.plot(closed, mean, color=colour, label=preload_label(preload))
            ax.set_ylim(0.0, 1.05 * top)
            ticks = [t for t in MaxNLocator(4).tick_values(0.0, top) if 0.0 < t <= top]
            ax.set_yticks(ticks, [])
            for tick in ticks:
                text = ax.text(np.pi / 8, tick, f"{tick:g}", fontsize=8, ha="center", va="center")
                outlined(text, "white", 3.0)
            ax.tick_params(labelsize=8)
            ax.set_title(f"{float(dataset['speed_kmh'][column]):g} km/h", pad=14)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=len(handles), loc="outside lower center")
        figure.suptitle(
            "Load of one roller [N] against cage angle, pinion bearing 1", fontsize=11.5
        )
    return figure
