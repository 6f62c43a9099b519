"""Gaps between unloaded flanks: crown, tip relief along and about contact lines, facets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREY, SERIES, VERMILLION, house_style, new_figure
from gearlube.studies.helical.figures.geometry import (
    MICRO,
    MILLI,
    columns,
    legend_below,
    pair_name,
    scaled,
)

_HIGHEST_GAP = 22e-6  # m, shown along lines and about them
_OFFSET = 4e-6  # m, between lines of one figure
_SEEN = 8  # points of a line in sight that are worth a label
_HALF_CHORD = 0.5  # mm, over which the inclination of a line is taken
_ALONG = "$y$: along the contact line, from mid-face [mm]"
_ACROSS = "$x$: across the contact line [mm]"


def crown_forms(datasets: Sequence[xr.Dataset]) -> Any:
    """Return forms of crown, and the gap about a line with one of them: [jamali_2015 fig. 4.5]."""
    with house_style():
        figure = new_figure(max(6.4, 5.2 * len(datasets)), 8.0)
        rows = figure.subfigures(2, 1, height_ratios=(1.0, 1.35))
        axes = rows[0].subplots(1, len(datasets), squeeze=False, sharey=True)[0]
        for ax, dataset in zip(axes, datasets, strict=True):
            y = scaled(dataset, "y", MILLI)
            for row, part in enumerate(dataset["crown_start"].values):
                ax.plot(
                    y, scaled(dataset, "crown_form", MICRO, crown_start=part),
                    color=SERIES[row], label=f"$F_o$ = {part:g} $F$",
                )  # fmt: skip
            ax.set(title=pair_name(dataset), xlabel=_ALONG, xlim=(y[0], y[-1]))
        axes[0].set_ylabel("crown of one tooth, normal [µm]")
        axes[0].legend(loc="upper center")
        for column, dataset in enumerate(datasets):
            ax = rows[1].add_subplot(1, len(datasets), column + 1, projection="3d")
            _surface(ax, dataset)
        figure.suptitle("Crown, and gap of both flanks about the middle line", fontsize=11.5)
    return figure


def _surface(ax: Any, dataset: xr.Dataset) -> None:
    x, y = scaled(dataset, "surface_x", MILLI), scaled(dataset, "surface_y", MILLI)
    gap = scaled(dataset, "surface_gap", MICRO)
    grid_x, grid_y = np.meshgrid(x, y, indexing="ij")
    ax.plot_surface(
        grid_y, grid_x, gap, cmap="viridis_r", rcount=61, ccount=89, linewidth=0, antialiased=True
    )
    ax.set_box_aspect((1.9, 1.1, 0.9), zoom=0.88)
    ax.view_init(elev=28, azim=-62)
    ax.locator_params(axis="y", nbins=4)
    ax.set(xlabel="$y$ [mm]", ylabel="$x$ [mm]", zlabel="gap [µm]")
    start = float(dataset["surface_crown_start"])
    ax.set_title(f"{pair_name(dataset)}: gap, $F_o$ = {start:g} $F$", fontsize=9.5, y=0.98)


def relief_gaps(datasets: Sequence[xr.Dataset]) -> Any:
    """Return gaps along the shown lines for forms of tip relief: [jamali_2015 fig. 5.2] to 5.4."""
    forms = datasets[0]["k"].values
    words = {0.0: "linear", 1.0: "parabolic"}
    with house_style():
        figure, axes = columns(datasets, len(forms), 3.0 * len(forms) + 0.6, sharey=True)
        for column, dataset in enumerate(datasets):
            for ax, k in zip(axes[:, column], forms, strict=True):
                _line_gaps(ax, dataset, float(k))
                word = words.get(float(k), "mixed")
                ax.text(
                    0.02, 0.04, f"$k$ = {k:g}, {word} relief", transform=ax.transAxes,
                    fontsize=9,
                )  # fmt: skip
                ax.set_ylim(-4.0, MICRO * (_HIGHEST_GAP + 2 * _OFFSET))
            axes[-1, column].set_xlabel(_ALONG)
        for ax in axes[:, 0]:
            ax.set_ylabel("gap, each line 4 µm higher [µm]")
        legend_below(figure, axes[0, :1], 3)
        figure.suptitle(
            "Gap along contact lines; dashed: crowns alone, circles: starts of tip relief",
            fontsize=11.5,
        )
    return figure


def _line_gaps(ax: Any, dataset: xr.Dataset, k: float) -> None:
    y, crown = scaled(dataset, "y", MILLI), scaled(dataset, "crown_gap", MICRO)
    for row, number in enumerate(dataset["shown"].values):
        colour, offset = SERIES[row % len(SERIES)], MICRO * _OFFSET * row
        gap = scaled(dataset, "line_gap_by_form", MICRO, shown=number, k=k)
        ax.plot(y, gap + offset, color=colour, label=f"line {number}")
        ax.plot(y, crown + offset, color=colour, ls="--", lw=0.9)
        for member in ("pinion", "gear"):
            start = MILLI * float(dataset[f"{member}_relief_start"].sel(shown=number))
            if y[0] <= start <= y[-1]:
                ax.plot(
                    start, np.interp(start, y, gap) + offset, "o", color=colour, mfc="white",
                    ms=6.0, zorder=5,
                )  # fmt: skip
    ax.set_xlim(y[0], y[-1])


def equal_relief(datasets: Sequence[xr.Dataset]) -> Any:
    """Return lines of equal tip relief on the tangent plane of a line: [jamali_2015 fig. 5.17]."""
    cells = [(dataset, member) for dataset in datasets for member in dataset["relieved"].values]
    with house_style():
        figure = new_figure(max(6.4, 3.1 * len(cells)), 7.0)
        axes = figure.subplots(1, len(cells), squeeze=False)[0]
        for ax, (dataset, member) in zip(axes, cells, strict=True):
            _relief_lines(ax, dataset, member)
        axes[0].set_ylabel(_ALONG)
        figure.suptitle(
            "Lines of equal tip relief on the tangent plane of a contact line;\n"
            "heavy: start of relief, dotted: the contact line; x is stretched",
            fontsize=11.5,
        )
    return figure


def _relief_lines(ax: Any, dataset: xr.Dataset, member: str) -> None:
    part = dataset.sel(relieved=member)
    x, y = scaled(dataset, "x", MILLI), scaled(dataset, "y", MILLI)
    removal, lines = scaled(part, "relief_removal", MICRO), scaled(part, "relief_line", MILLI)
    for row in range(removal.size):
        first = row == 0
        ax.plot(lines[row], y, color=VERMILLION if first else BLUE, lw=2.8 if first else 1.0)
    ax.axvline(0.0, color="black", lw=1.0, ls=":")
    width = x[-1]
    number = int(part["relief_line_shown"])
    start = MILLI * float(dataset[f"{member}_relief_start"].sel(shown=number))
    at = np.clip(start, y[0] + _HALF_CHORD, y[-1] - _HALF_CHORD)
    lean = np.ptp(np.interp([at - _HALF_CHORD, at + _HALF_CHORD], y, lines[0])) / (2 * _HALF_CHORD)
    reach = width / lean
    if member == "pinion":  # relieved above its start, the gear below
        low, high = at - 1.15 * reach, at + 1.6 * reach
    else:
        low, high = at - 1.6 * reach, at + 1.15 * reach
    low, high = max(low, y[0]), min(high, y[-1])
    ax.set(xlim=(-width, width), ylim=(low, high), xlabel=_ACROSS)
    for row in range(2, removal.size, 2):
        _label_line(ax, lines[row], y, f"{removal[row]:.1f} µm", (low, high), width)
    angle = np.degrees(np.arctan(lean))
    ax.set_title(
        f"{pair_name(dataset)}\n{member}, line {number}: {angle:.1f}° to $y$", fontsize=9.5
    )
    ax.grid(visible=False)


def _label_line(
    ax: Any, x: Any, y: Any, text: str, limits: tuple[float, float], width: float
) -> None:
    """Write the name of a line at the middle of its visible part."""
    seen = np.flatnonzero((y > limits[0]) & (y < limits[1]) & (np.abs(x) < width))
    if seen.size > _SEEN:
        at = seen[seen.size // 2]
        ax.text(
            x[at], y[at], text, fontsize=7, ha="center", va="center", color=BLUE,
            bbox={"fc": "white", "ec": "none", "pad": 0.6},
        )  # fmt: skip


def facet_gaps(datasets: Sequence[xr.Dataset]) -> Any:
    """Return smooth and faceted profiles from the tangent plane: [jamali_2015 fig. 6.5]."""
    counts = datasets[0]["facets"].values
    with house_style():
        figure, axes = columns(
            datasets, len(counts), 2.7 * len(counts) + 0.8, sharex="col", sharey=True
        )
        for column, dataset in enumerate(datasets):
            x, smooth = scaled(dataset, "x", MILLI), scaled(dataset, "smooth_height", MICRO)
            half = MILLI * float(dataset["hertz_half_width"])
            for ax, count in zip(axes[:, column], counts, strict=True):
                faceted = scaled(dataset, "faceted_height", MICRO, facets=count)
                ax.axvspan(-half, half, color=GREY, alpha=0.3, lw=0, label="dry contact, $2a$")
                ax.plot(x, faceted, color=BLUE, label="faceted")
                ax.plot(x, smooth, color=VERMILLION, ls="--", lw=1.2, label="smooth")
                depth = np.nanmax(np.abs(faceted - smooth))
                ax.text(
                    0.5, 0.95, f"$n_f$ = {count}: {depth:.2f} µm off at most",
                    transform=ax.transAxes, ha="center", va="top", fontsize=9,
                )  # fmt: skip
            axes[-1, column].set(xlabel=_ACROSS, xlim=(x[0], x[-1]))
        for ax in axes[:, 0]:
            ax.set_ylabel("pinion flank from\nthe tangent plane [µm]")
        legend_below(figure, axes[0, :1], 3)
        figure.suptitle("Profile with facets at mid-face of the middle line", fontsize=11.5)
    return figure
