"""Mesh orders over speed, parametric instability and tooth separation."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    GREY,
    VERMILLION,
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
from gearlube.studies.helical.stability import LIGHT_DAMPING
from gearlube_core.arrays import Array

_ON_ALL = "#909090"  # seen on the light and the dark colours of a map
_COLOURS = (BLUE, VERMILLION)
_TICKS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
_RANGE = 60.0  # dB
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


def instability(stability: xr.Dataset) -> Any:
    """Return growth of disturbances over mesh frequency, against variation and damping."""
    at = stability.attrs
    frequency = 1e-3 * stability["mesh_frequency"].values
    panels = (
        ("growth_variation", "variation", f"damping ratio {at['mesh_damping_ratio']:g}"),
        ("growth_variation_light", "variation", f"damping ratio {LIGHT_DAMPING:g}"),
        ("growth_damping", "damping_ratio", "variation of the mesh as it is"),
    )
    modes = distinct(1e-3 * stability["natural_frequency"].values, 0.02)
    with house_style():
        figure = new_figure(10.0, 9.0)
        axes = figure.subplots(3, 1, sharex=True)
        extreme = max(float(np.abs(stability[name]).max()) for name, _, _ in panels)
        for ax, (name, axis, words) in zip(axes, panels, strict=True):
            values, growth = stability[axis].values, stability[name].values
            edges = np.maximum(cell_edges(values), 0.0)
            mesh = ax.pcolormesh(
                cell_edges(frequency), edges, growth, cmap="RdBu_r", vmin=-extreme, vmax=extreme
            )
            if growth.max() > 0.0 > growth.min():
                ax.contour(frequency, values, growth, levels=[0.0], colors="black", linewidths=1.2)
            for mode in modes:
                ax.axvline(2.0 * mode, color=_ON_ALL, lw=1.0, ls=":")
            ax.set_title(f"{words}; {_verdict(growth)}")
            ax.grid(False)
            bar = figure.colorbar(mesh, ax=ax, pad=0.01)
            bar.set_label("growth rate [1/s]")
        for ax in axes[:2]:
            ax.set_ylabel("factor on the\nmesh variation")
            ax.axhline(1.0, color=_ON_ALL, lw=1.0, ls="--")
            on_line = ax.get_yaxis_transform()
            text = ax.text(0.995, 1.0, "as it is", transform=on_line, ha="right", va="bottom")
            outlined(text, "white")
        axes[2].set_ylabel("damping ratio of\nmesh and supports")
        axes[2].set_yscale("log")
        axes[2].set_yticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
        axes[2].minorticks_off()
        axes[2].set_ylim(*stability["damping_ratio"].values[[0, -1]])
        axes[2].set_xlim(frequency[0], frequency[-1])
        axes[2].set_xlabel("mesh frequency [kHz]")
        figure.suptitle(
            f"Parametric instability: {at['name']}, {at['pinion_torque']:.4g} N·m, mesh "
            f"{mesh_description(stability)}\nred inside the black lines: motions grow; dotted: "
            "twice a natural frequency; other tongues: sums of two natural frequencies",
            fontsize=10.5,
        )
    return figure


def _verdict(growth: Any) -> str:
    if growth.max() <= 0.0:
        return "stable everywhere"
    return f"unstable in {100.0 * (growth > 0.0).mean():.2g} % of the map"


def separation(dataset: xr.Dataset) -> Any:
    """Return transmission error and loss of contact along the branches over speed."""
    at = dataset.attrs
    linear = dataset["linear_speed"].values / RPM
    with house_style():
        figure = new_figure(9.6, 6.6)
        top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": (2.2, 1.0)})
        for row, ratio in enumerate(dataset["damping"].values):
            part, colour = dataset.isel(damping=row), _COLOURS[row % 2]
            for number in range(2):
                rows = np.flatnonzero(part["segment"].values == number)
                if rows.size:
                    words = f"with separation, damping ratio {ratio:g}" if number == 0 else None
                    _draw_branch(top, bottom, part.isel(row=rows), colour, words)
            free = 1e6 * part["linear_peak_to_peak"].values
            label = f"springs that also pull, damping ratio {ratio:g}"
            top.plot(linear, free, ":", color=colour, lw=1.4, label=label)
            top.plot(
                part["special_speed"].values / RPM,
                1e6 * part["special_peak_to_peak"].values,
                "o",
                color=colour,
                mfc="white",
                ms=5,
                label="folds, bifurcations" if row == dataset.sizes["damping"] - 1 else None,
            )
        top.set_yscale("log")
        top.set_ylabel(r"$\delta_z$ peak to peak [µm]")
        bottom.set_ylabel("share of time [%]")
        bottom.set_ylim(0.0, max(5.0, *bottom.get_ylim()))
        bottom.set_title("without any contact (wide), part of the lines off (thin)", fontsize=9)
        bottom.set_xlabel("pinion speed [rpm]; dashed: unstable")
        bottom.set_xlim(linear[0], linear[-1])
        for ax in (top, bottom):
            ax.axvline(at["natural_speed"] / RPM, color=GREY, lw=1.0, ls="-.", zorder=0)
        figure.legend(*top.get_legend_handles_labels(), ncols=2, loc="outside lower center")
        figure.suptitle(
            f"Tooth separation, µ = {at['mu']:g}, backlash {1e6 * at['backlash']:.3g} µm: "
            f"{at['name']}, {at['pinion_torque']:.4g} N·m, mesh {mesh_description(dataset)}\n"
            "dash-dotted: resonance of the mesh",
            fontsize=10.0,
        )
    return figure


def _draw_branch(top: Any, bottom: Any, part: xr.Dataset, colour: str, words: str | None) -> None:
    """Draw one branch, stable rows solid, unstable dashed."""
    speed, stable = part["speed"].values / RPM, part["stable"].values > 0.5
    edges = np.flatnonzero(np.diff(stable.astype(int))) + 1
    for first, last in zip([0, *edges], [*edges, speed.size], strict=True):
        rows = slice(first, min(last + 1, speed.size))
        style, label = "-" if stable[first] else "--", words if first == 0 else None
        swing = 1e6 * part["peak_to_peak"].values
        top.plot(speed[rows], swing[rows], style, color=colour, label=label)
        for name, wide in (("separation_share", 1.6), ("lift_off_share", 0.8)):
            share = 100.0 * part[name].values
            bottom.plot(speed[rows], share[rows], style, color=colour, lw=wide)


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
