"""Parametric instability and tooth separation over mesh frequency."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREY,
    VERMILLION,
    cell_edges,
    house_style,
    new_figure,
    outlined,
)
from gearlube.studies.helical.figures.layout import RPM, distinct, mesh_description
from gearlube.studies.helical.stability import LIGHT_DAMPING

_ON_ALL = "#909090"  # seen on the light and the dark colours of a map
_COLOURS = (BLUE, VERMILLION)
_TICKS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)


def instability(stability: xr.Dataset) -> Any:
    """Return growth of disturbances over mesh frequency, against variation and damping."""
    at = stability.attrs
    frequency = 1e-3 * stability["mesh_frequency"].values
    panels = (
        (
            "growth_variation",
            "variation",
            f"damping ratio {at['mesh_damping_ratio']:g}",
        ),
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
