"""Waveforms over one revolution, and flank load, film and temperature over a mesh cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    SERIES,
    house_style,
    new_figure,
    preload_label,
    typical_speeds,
)
from gearlube_core.units import kelvin_to_celsius

_ROWS = (
    ("flank_load", "load [kN]", lambda x: 1e-3 * x),
    ("flank_film_thickness", "film thickness [µm]", lambda x: 1e6 * x),
    ("flank_film_ratio", "film ratio λ [-]", lambda x: x),
    ("flank_temperature", "film temperature [°C]", kelvin_to_celsius),
)
_LOADED = 0.01  # share of the largest load above which a flank is drawn
_STYLES = ("-", (0, (5, 2)), (0, (1, 1.2)))
_DASHES = ("-", (0, (5, 1.5)), (0, (1.5, 1.0)))


def film_over_mesh_cycle(dataset: xr.Dataset, preload: int = 0) -> Any:
    """Return load, film thickness, film ratio and temperature while tooth pairs pass the mesh.

    Columns are a low, a medium and a high speed of the sweep. `preload` is a position.
    Each flank is drawn while it carries load.
    """
    columns = typical_speeds(dataset)
    phase = dataset["mesh_phase"].values
    with house_style():
        figure = new_figure(9.6, 8.0)
        axes = figure.subplots(
            len(_ROWS), max(len(columns), 1), sharex=True, sharey="row", squeeze=False
        )
        for at, speed in enumerate(columns):
            point = dataset.isel(preload=preload, speed=speed)
            load = point["flank_load"].values
            loaded = load > _LOADED * np.nanmax(load)
            for ax, (name, label, scaled) in zip(axes[:, at], _ROWS, strict=True):
                for flank, style in enumerate(_STYLES):
                    values = np.where(loaded[flank], scaled(point[name].values[flank]), np.nan)
                    ax.plot(
                        phase,
                        values,
                        color=SERIES[flank],
                        ls=style,
                        label=f"tooth pair {flank + 1}",
                    )
                if at == 0:
                    ax.set_ylabel(label)
            axes[0, at].set_title(f"{float(point['speed_kmh']):g} km/h")
            axes[-1, at].set_xlabel("mesh cycles [-]")
        for ax in axes[0]:
            ax.set_ylim(bottom=0.0)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=3, loc="outside lower center", handlelength=3.0)
        force = float(dataset["preload"][preload])
        figure.suptitle(
            f"Flank films while tooth pairs pass the mesh, preload {force:g} N", fontsize=11.5
        )
    return figure


def waveforms(dataset: xr.Dataset) -> Any:
    """Return the DTE about its mean over one pinion revolution at three speeds, on one scale."""
    columns = typical_speeds(dataset)
    turns = dataset["pinion_angle"].values / (2.0 * np.pi)
    with house_style():
        figure = new_figure(9.0, 6.0)
        axes = np.atleast_1d(figure.subplots(max(len(columns), 1), 1, sharex=True, sharey=True))
        for ax, column in zip(axes, columns, strict=False):
            means = []
            for row, preload in enumerate(dataset["preload"].values):
                wave = dataset["dte_wave"].values[row, column] * 1e6
                mean = float(np.nanmean(wave)) if np.any(np.isfinite(wave)) else np.nan
                means.append(f"{mean:.2f}")
                ax.plot(
                    turns,
                    wave - mean,
                    color=SERIES[row % len(SERIES)],
                    lw=(2.6, 1.1)[row % 2],
                    label=preload_label(preload),
                )
            speed = float(dataset["speed_kmh"][column])
            ax.set_title(f"{speed:g} km/h, mean {' and '.join(means)} µm", loc="left", fontsize=9.5)
            ax.set_ylabel("DTE less its\nmean [µm]")
        axes[-1].set_xlabel("pinion revolutions [-]")
        axes[-1].set_xlim(0.0, 1.0)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=len(handles), loc="outside lower center")
        figure.suptitle("Dynamic transmission error over one pinion revolution", fontsize=11.5)
    return figure


def roller_zone(dataset: xr.Dataset) -> Any:
    """Return the load of one roller over the cage angle: its loaded zone, a panel a preload."""
    columns = typical_speeds(dataset)
    angle = np.degrees(dataset["cage_angle"].values)
    preloads = dataset["preload"].values
    with house_style():
        figure = new_figure(max(4.4 * preloads.size + 0.6, 6.0), 4.2)
        axes = np.atleast_1d(figure.subplots(1, preloads.size))
        for row, (ax, preload) in enumerate(zip(axes, preloads, strict=True)):
            for number, column in enumerate(columns):
                mean, low, high = (
                    dataset[f"roller_zone_{part}"].values[row, column]
                    for part in ("mean", "min", "max")
                )
                colour = SERIES[number % len(SERIES)]
                ax.fill_between(angle, low, high, color=colour, alpha=0.25, lw=0)
                speed = float(dataset["speed_kmh"][column])
                ax.plot(angle, mean, color=colour, ls=_DASHES[number], label=f"{speed:g} km/h")
            ax.set_xlim(0.0, 360.0)
            ax.set_xticks(range(0, 361, 60))
            ax.set_xlabel("position of the roller, from z towards y [°]")
            ax.set_title(preload_label(preload))
        axes[0].set_ylabel("load of the roller [N]")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=3, loc="outside lower center", handlelength=3.0)
        figure.suptitle("Loaded zone of pinion bearing 1: load of one roller", fontsize=11.5)
    return figure
