"""Figures of a variation: histograms and what they follow, or lines over an axis."""

from __future__ import annotations

from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.figure_files import save_figure_folder
from gearlube.plotting.style import HATCHES, MARKERS, SERIES, house_style, new_figure
from gearlube.variation.point_study import FINISHED
from gearlube.variation.store import gridded
from gearlube.variation.summary import cells, inputs_of, varies

_MOST_SERIES = len(SERIES)
_MOST_BARS = 12  # inputs of a chart of ranks
_BINS = 30
_DOTTED, _BAND = "95 % lie between", "line: median; band: 95 % of the points"
# letters in a line of a label, of a label on its side, of the title of a narrow panel
_LETTERS, _SIDE_LETTERS, _TITLE_LETTERS = 42, 32, 28


def save_variation_figures(results: xr.Dataset, summary: xr.Dataset, folder: Path) -> list[Path]:
    """Write the figures that the design and the finished points allow; return their paths."""
    made = {}
    if (results["status"] == FINISHED).any():
        if summary.sizes["input"]:
            made["histograms"] = histogram_figure(results, summary)
            if np.isfinite(summary["rank_correlation"].values).any():
                made["sensitivity"] = rank_figure(results, summary)
        if line_axis(summary):
            made["lines"] = line_figure(results, summary)
    return save_figure_folder(made, folder)


def scale_of(results: xr.Dataset, name: str) -> tuple[float, str]:
    """Return the factor and unit in which a quantity is drawn."""
    unit = str(results[name].attrs["units"])
    return (1e6, "µm") if unit == "m" else (1.0, _unit_words(unit))


def _unit_words(unit: str) -> str:
    for plain, drawn in (("degC", "°C"), ("N m", "N·m"), ("um", "µm")):
        unit = unit.replace(plain, drawn)
    return "-" if unit in ("", "1") else unit


def label_of(results: xr.Dataset, name: str, letters: int = _LETTERS) -> str:
    """Return the meaning of a quantity and the unit in which it is drawn, in lines."""
    unit = scale_of(results, name)[1]
    words = f"{results[name].attrs['long_name']}\u00a0[{unit}]"  # no line for a unit alone
    return fill(words, letters)


def _words(values: dict[str, Any]) -> str:
    return ", ".join(
        f"{name} = {value:g}" if isinstance(value, float | np.floating) else f"{name} = {value}"
        for name, value in values.items()
    )


def panels_of(
    results: xr.Dataset, what: str, count: int, height: float = 3.3
) -> tuple[Any, list[Any]]:
    """Return a figure with a title and `count` axes, two in a row of so many inches."""
    figure = new_figure(4.4 * min(count, 2), height * -(-count // 2))
    axes = figure.subplots(-(-count // 2), min(count, 2), squeeze=False).ravel()
    for empty in axes[count:]:
        empty.set_visible(False)
    words = f"{what}: {results.attrs['title'].partition(',')[0]}"
    figure.suptitle(fill(words, 40 * min(count, 2)), fontsize=11)
    return figure, list(axes[:count])


def _shown(results: xr.Dataset) -> list[str]:
    return [str(name) for name in results.attrs["shown"]]


def histogram_figure(results: xr.Dataset, summary: xr.Dataset) -> Any:
    """Return histograms of the shown quantities, up to six combinations of the axes in each."""
    from matplotlib.ticker import MaxNLocator

    over = gridded(results)[_shown(results)].load()
    with house_style():
        figure, panels = panels_of(results, "How the results scatter", len(_shown(results)))
        some = list(cells(summary))[:_MOST_SERIES]
        for name, ax in zip(_shown(results), panels, strict=True):
            for i, (values, _) in enumerate(some):
                column = over[name].sel(values).values
                column = scale_of(results, name)[0] * column[np.isfinite(column)]
                if column.size and varies(column):
                    ax.hist(
                        column,
                        bins=min(_BINS, max(5, column.size // 10)),
                        histtype="step" if i else "stepfilled",
                        alpha=1.0 if i else 0.45,
                        color=SERIES[i],
                        label=_words(values) or None,
                    )
                    for end in np.percentile(column, [2.5, 97.5]):
                        ax.axvline(end, color=SERIES[i], linestyle=":", linewidth=1.1)
                    ax.plot([], [], ":", color=SERIES[i], label=_DOTTED if i == 0 else None)
            ax.set_xlabel(label_of(results, name))
            ax.set_ylabel("number of points")
            ax.xaxis.set_major_locator(MaxNLocator(4))
            ax.yaxis.set_major_locator(MaxNLocator(6, integer=True))
        if panels[0].get_legend_handles_labels()[1]:
            panels[0].legend()
    return figure


def rank_figure(results: xr.Dataset, summary: xr.Dataset) -> Any:
    """Return bars of the rank correlation of each shown quantity with the sampled inputs.

    The mean over the combinations of the axes is drawn.
    """
    axes = list(summary["failed"].dims)
    ranks = summary["rank_correlation"].mean(axes)
    strength = np.nan_to_num(np.abs(ranks.sel(quantity=_shown(results)).values)).max(axis=0)
    chosen = np.argsort(strength)[::-1][:_MOST_BARS][::-1]
    with house_style():
        figure, panels = panels_of(results, "Which input each result follows", len(_shown(results)))
        for name, ax in zip(_shown(results), panels, strict=True):
            bars = ranks.sel(quantity=name).values[chosen]
            ax.barh(np.arange(chosen.size), bars, color=SERIES[0], hatch=HATCHES[0])
            if ax in panels[::2]:  # panels to the right have the same rows
                ax.set_yticks(np.arange(chosen.size), list(summary["input"].values[chosen]))
            else:
                ax.set_yticks(np.arange(chosen.size), [""] * chosen.size)
            ax.set_xlim(-1.0, 1.0)
            ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
            ax.axvline(0.0, color="black", lw=0.7)
            ax.set_xlabel("rank correlation [-]")
            ax.set_title(fill(results[name].attrs["long_name"], _TITLE_LETTERS), fontsize=9)
    return figure


def line_axis(summary: xr.Dataset) -> str:
    """Return the longest axis with numbers, "" where there is none of two values or more."""
    axes = [
        str(axis)
        for axis in summary["failed"].dims
        if summary[axis].dtype.kind == "f" and summary.sizes[axis] > 1
    ]
    return max(axes, key=lambda axis: summary.sizes[axis], default="")


def line_figure(results: xr.Dataset, summary: xr.Dataset) -> Any:
    """Return the shown quantities over the longest axis; with samples the median and 95 %."""
    along = line_axis(summary)
    unit = {one["key"]: one["unit"] for one in inputs_of(results)}[along]
    first = summary.isel({along: 0})
    with house_style():
        figure, panels = panels_of(results, "Results over an input", len(_shown(results)))
        for name, ax in zip(_shown(results), panels, strict=True):
            chosen = scale_of(results, name)[0] * summary["statistics"].sel(quantity=name)
            for i, (values, _) in enumerate(list(cells(first))[:_MOST_SERIES]):
                one = chosen.sel(values)
                x, middle = summary[along].values, one.sel(statistic="p50").values
                ax.plot(x, middle, marker=MARKERS[i], color=SERIES[i], label=_words(values) or None)
                if summary.sizes["input"]:
                    low, high = (one.sel(statistic=p).values for p in ("p2.5", "p97.5"))
                    label = None if i else _BAND
                    ax.fill_between(
                        x, low, high, color=SERIES[i], alpha=0.2, linewidth=0, label=label
                    )
            ax.set_xlabel(f"{along} [{_unit_words(unit)}]")
            ax.set_ylabel(label_of(results, name, _SIDE_LETTERS))
        if panels[0].get_legend_handles_labels()[1]:
            panels[0].legend()
    return figure
