"""Operating points, waveforms over a revolution, flank load and film over a mesh cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    GREEN,
    INK,
    ORANGE,
    SERIES,
    house_style,
    name_levels,
    new_figure,
    preload_label,
    speed_limits,
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
                        color=SERIES[preload],
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
                colour = SERIES[row % len(SERIES)]
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


_FIRING = 2  # engine order of a four-stroke engine with four cylinders that is drawn


def operating_points(dataset: xr.Dataset) -> Any:
    """Return mean torques against speed, beside the Campbell diagram of the sweep."""
    with house_style():
        figure = new_figure(10.0, 4.6)
        left, right = figure.subplots(1, 2)
        _torques(left, dataset.isel(preload=0))
        _campbell(right, dataset)
        for ax in (left, right):
            ax.set_xlabel("vehicle speed [km/h]")
        figure.suptitle("Operating points", fontsize=11.5)
    return figure


def _torques(ax: Any, row: xr.Dataset) -> None:
    speed = row["speed_kmh"].values
    ax.set_xlim(*speed_limits(row))
    ax.plot(speed, row["wheel_torque"], color=INK, ls="--", marker="s", label="wheel gear, load")
    ax.plot(speed, row["pinion_torque"], color=INK, marker="o", label="pinion, drive")
    ax.set_ylabel("mean torque [N·m]")
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="upper left")
    ax.set_title("torques from the road load")


def _campbell(ax: Any, dataset: xr.Dataset) -> None:
    row = dataset.isel(preload=0)
    speed = row["speed_kmh"].values
    ax.set_xlim(*speed_limits(dataset))
    for multiple, style in ((1, "-"), (2, (0, (5, 2))), (3, (0, (1, 1.2)))):
        ax.plot(
            speed,
            multiple * row["mesh_frequency"],
            color=GREEN,
            ls=style,
            label=f"mesh order {multiple}",
        )
    if "crank_frequency" in dataset:
        ax.plot(
            speed,
            _FIRING * row["crank_frequency"],
            color=ORANGE,
            marker="o",
            ms=3.0,
            lw=0.9,
            label=f"engine order {_FIRING}, gear by speed",
        )
    _modes(ax, dataset)
    ax.set_ylabel("frequency [Hz]")
    ax.set_title("excitation and natural frequencies")
    ax.figure.legend(*ax.get_legend_handles_labels(), loc="outside lower right", ncols=5)


def _modes(ax: Any, dataset: xr.Dataset) -> None:
    """Shade each natural frequency from its value at the lowest to that at the highest preload."""
    if "mode_frequency" not in dataset:
        return
    middles = {}
    for name, values in zip(
        dataset["mode"].values, dataset["mode_frequency"].values.T, strict=True
    ):
        if not np.any(np.isfinite(values)):
            continue
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        middle = 0.5 * (low + high)
        ax.axhspan(low, high, color="#404040", alpha=0.3, lw=0)
        ax.axhline(middle, color="#404040", lw=0.8)
        middles[str(name)] = middle
    ax.set_ylim(0.0, max([ax.get_ylim()[1], *(1.05 * one for one in middles.values())]))
    name_levels(ax, middles, size=7.5)
