"""Mesh orders over speed: Campbell diagrams, order cuts, levels over friction and speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    GREEN,
    GREY,
    cell_edges,
    house_style,
    name_levels,
    new_figure,
    outlined,
)
from gearlube.studies.helical.figures.layout import (
    NOTHING,
    RPM,
    distinct,
    mesh_description,
    note_no_vibration,
)
from gearlube.studies.helical.settings import SHOWN_MU
from gearlube_core.arrays import Array

_RANGE = 60.0  # dB
_MAP_RANGE = 40.0  # dB of the map of sums of orders, which have no deep valleys
_FORCES = (("F_xp", "$F_{x}$"), ("F_yp", "$F_{y}$"), ("F_zp", "$F_{z}$"))
_CUTS = (
    ("delta_z_rate", r"$\dot\delta_z$ [mm/s]", 1e3),
    ("F_xp", "$F_{x}$ [N]", 1.0),
    ("F_yp", "$F_{y}$ [N]", 1.0),
    ("F_zp", "$F_{z}$ [N]", 1.0),
)
_ORDERS = (1, 2, 3)
_NAMED = 6  # orders with a number in a diagram
_CURVES = 4  # coefficients of friction in one panel


def _heading(sweep: xr.Dataset, what: str) -> str:
    at = sweep.attrs
    return f"{what}: {at['name']}, {at['pinion_torque']:.4g} N·m, mesh {mesh_description(sweep)}"


def campbell(sweep: xr.Dataset) -> Any:
    """Return levels of the pinion's bearing forces along the mesh orders, over speed."""
    part = sweep.sel(mu=SHOWN_MU[-1], method="nearest")
    speed, mesh = part["speed"].values / RPM, part["mesh_frequency"].values
    order = part["harmonic"].values
    modes = distinct(1e-3 * part["natural_frequency"].values)
    ceiling = 1.25 * modes[-1]
    with house_style():
        figure = new_figure(12.0, 5.6)
        axes = figure.subplots(1, len(_FORCES), sharex=True, sharey=True)
        shown = None
        for ax, (name, symbol) in zip(axes, _FORCES, strict=True):
            ax.set_title(f"{symbol} of the pinion's bearings")
            ax.set_xlabel("pinion speed [rpm]")
            amplitude = part[f"{name}_harmonic"].values
            if not np.nanmax(amplitude) > NOTHING:
                note_no_vibration(ax)
                continue
            level = 20.0 * np.log10(np.maximum(amplitude, NOTHING))
            top = 10.0 * np.ceil(0.1 * np.nanmax(level))
            for mode in modes:
                ax.axhline(mode, color=GREY, lw=1.0, ls=":", zorder=1)
            for column in range(order.size):
                frequency = 1e-3 * order[column] * mesh
                below = frequency < ceiling
                ax.plot(speed[below], frequency[below], color="0.75", lw=0.8, zorder=1)
                seen = below & (level[:, column] > top - _RANGE)
                size = 4.0 + 60.0 * np.clip(1.0 + (level[:, column] - top) / _RANGE, 0.0, 1.0) ** 2
                shown = ax.scatter(
                    speed[seen],
                    frequency[seen],
                    s=size[seen],
                    c=level[seen, column],
                    cmap="viridis",
                    vmin=top - _RANGE,
                    vmax=top,
                    lw=0,
                    zorder=2,
                )
            bar = figure.colorbar(shown, ax=ax, location="bottom", shrink=0.9)
            bar.set_label("level [dB re 1 N]")
        axes[0].set(xlim=(0.0, 1.02 * speed[-1]), ylim=(0.0, ceiling), ylabel="frequency [kHz]")
        slope = 1e-3 * mesh[-1] / speed[-1]
        for ax in axes:
            name_orders(ax, order[:_NAMED], slope, (1.02 * speed[-1], ceiling))
        names = {f"mode {n}: {mode:.1f}": float(mode) for n, mode in enumerate(modes, 1)}
        name_levels(axes[-1], names)
        figure.suptitle(
            _heading(sweep, f"Mesh orders 1 to {order[-1]}, µ = {float(part['mu']):g}")
            + "; lines: orders; dotted: natural frequencies [kHz]",
            fontsize=10.5,
        )
    return figure


def name_orders(ax: Any, orders: Array, slope: float, limits: tuple[float, float]) -> None:
    """Write the number of each order where its line leaves the axes, whose upper limits are given.

    `slope` is that of the first order, frequency over speed in the units of the axes.
    """
    for order in orders:
        x = min(limits[0], limits[1] / (slope * order))
        on_top = x < limits[0]
        ax.annotate(
            f"{order}",
            (0.955 * x, 0.955 * x * slope * order),
            ha="right" if on_top else "center",
            va="center" if on_top else "bottom",
            xytext=(-3, 0) if on_top else (0, 4),
            textcoords="offset points",
            fontsize=8.0,
            fontweight="bold",
        )


def order_cuts(sweep: xr.Dataset) -> Any:
    """Return the first mesh orders over speed, with friction as parameter and the oil film."""
    import matplotlib

    speed, mesh = sweep["speed"].values / RPM, sweep["mesh_frequency"].values
    every = sweep["mu"].values
    rows = np.unique(np.linspace(0, every.size - 1, min(_CURVES, every.size)).round().astype(int))
    tints = matplotlib.colormaps["plasma"](np.linspace(0.0, 0.8, rows.size))
    modes = distinct(sweep["natural_frequency"].values)
    with house_style():
        figure = new_figure(11.0, 2.3 * len(_CUTS) + 1.0)
        axes = figure.subplots(len(_CUTS), len(_ORDERS), sharex=True, sharey="row")
        for line, (name, label, scale) in zip(axes, _CUTS, strict=True):
            for ax, order in zip(line, _ORDERS, strict=True):
                at = scale * sweep[f"{name}_harmonic"].sel(harmonic=order)
                for row, tint in zip(rows, tints, strict=True):
                    ax.plot(speed, at.isel(mu=int(row)), color=tint, label=f"µ = {every[row]:g}")
                if f"film_{name}_harmonic" in sweep:
                    film = scale * sweep[f"film_{name}_harmonic"].sel(harmonic=order)
                    ax.plot(speed, film, color=GREEN, ls="--", lw=1.3, label="oil film")
                for mode in modes:
                    place = mode / order * speed[-1] / mesh[-1]
                    if place < 1.02 * speed[-1]:
                        ax.axvline(place, color=GREY, lw=0.9, ls=":", zorder=0)
                ax.set_yscale("log")
            top = float(np.nanmax(scale * sweep[f"{name}_harmonic"]))
            if top > NOTHING:
                line[0].set_ylim(1e-4 * top, 2.0 * top)
            else:
                for ax in line:
                    ax.set_yscale("linear")
                    note_no_vibration(ax)
            line[0].set_ylabel(label)
        for ax, order in zip(axes[0], _ORDERS, strict=True):
            ax.set_title(f"mesh order {order}")
        for ax in axes[-1]:
            ax.set_xlabel("pinion speed [rpm]")
            ax.set_xlim(0.0, 1.02 * speed[-1])
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=5, loc="outside lower center")
        figure.suptitle(
            _heading(sweep, "Order cuts, amplitudes")
            + "; dotted: the order meets a natural frequency",
            fontsize=10.5,
        )
    return figure


def friction_speed_maps(sweep: xr.Dataset) -> Any:
    """Return the rms level of the vibrating bearing forces over friction and speed."""
    speed, mu = sweep["speed"].values / RPM, sweep["mu"].values
    with house_style():
        figure = new_figure(11.0, 4.4)
        axes = figure.subplots(1, len(_FORCES), sharex=True, sharey=True)
        for ax, (name, symbol) in zip(axes, _FORCES, strict=True):
            power = 0.5 * (sweep[f"{name}_harmonic"] ** 2).sum("harmonic", skipna=False)
            ax.set_title(f"{symbol} of the pinion's bearings")
            ax.set_xlabel("pinion speed [rpm]")
            ax.grid(False)
            if not np.nanmax(power) > NOTHING**2:
                note_no_vibration(ax)
                continue
            level = 10.0 * np.log10(np.maximum(power.transpose("mu", "speed").values, NOTHING**2))
            top = 5.0 * np.ceil(0.2 * np.nanmax(level))
            mesh = ax.pcolormesh(
                cell_edges(speed),
                cell_edges(mu),
                level,
                cmap="viridis",
                vmin=top - _MAP_RANGE,
                vmax=top,
            )
            # without friction a force may be zero: no contours towards minus infinity
            felt = np.nanmax(level, axis=1) > top - _MAP_RANGE
            lines = ax.contour(
                speed, mu[felt], level[felt], levels=np.arange(top - _MAP_RANGE, top, 10.0),
                colors="white", linewidths=0.7,
            ) if min(level[felt].shape) > 1 else None  # fmt: skip
            if lines is not None:
                for text in ax.clabel(lines, fmt="%.0f", fontsize=7.5):
                    outlined(text)
            bar = figure.colorbar(mesh, ax=ax, location="bottom", shrink=0.9)
            bar.set_label("rms level of orders 1 to 15 [dB re 1 N]")
        axes[0].set_ylabel("coefficient of friction µ [-]")
        axes[0].set_ylim(mu[0], max(mu[-1], mu[0] + 1e-3))
        figure.suptitle(_heading(sweep, "Vibrating bearing forces"), fontsize=10.5)
    return figure
