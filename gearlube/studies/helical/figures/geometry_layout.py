"""Shared parts of the geometry figures: one column of axes per pair, names and marks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import new_figure
from gearlube_core.arrays import Array

MILLI, MICRO, KILO = 1e3, 1e6, 1e-3


def pair_name(dataset: xr.Dataset) -> str:
    """Return the pair's name with its teeth."""
    of = dataset.attrs
    return f"{of['name']} ({of['pinion_teeth']}:{of['gear_teeth']})"


def shown_name(dataset: xr.Dataset, number: int) -> str:
    """Return the number and position of a shown contact line."""
    position = MILLI * float(dataset["shown_position"].sel(shown=number))
    return f"line {number}: $s_i$ = ${position:.1f}$ mm"


def columns(datasets: Sequence[xr.Dataset], rows: int, height: float, **share: Any) -> Any:
    """Return a figure and its axes, shape (rows, pairs), each column headed by its pair."""
    figure = new_figure(max(6.4, 5.2 * len(datasets)), height)
    axes = figure.subplots(rows, len(datasets), squeeze=False, **share)
    for ax, dataset in zip(axes[0], datasets, strict=True):
        ax.set_title(pair_name(dataset))
    return figure, axes


def legend_below(figure: Any, axes: Sequence[Any], count: int) -> None:
    """Put the legend of some axes together below the figure."""
    entries = [ax.get_legend_handles_labels() for ax in axes]
    handles = [handle for found, _ in entries for handle in found]
    labels = [label for _, found in entries for label in found]
    figure.legend(handles, labels, ncols=count, loc="outside lower center")


def line_legend(ax: Any) -> None:
    """Name the shown contact lines below their axes: each pair has its own positions."""
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, fontsize=8)


def pitch_line(ax: Any, label: bool = True) -> None:
    """Mark s = 0."""
    ax.axvline(0.0, color="#707070", lw=0.8, ls=(0, (6, 3)))
    if label:
        ax.annotate(
            "pitch line", (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(4, -4),
            textcoords="offset points", va="top", fontsize=8, color="#505050",
        )  # fmt: skip


def scaled(dataset: xr.Dataset, name: str, factor: float = 1.0, **at: Any) -> Array:
    """Return the values of a variable times a factor, at some of its coordinates."""
    return factor * np.asarray(dataset[name].sel(**at).values, dtype=float)
