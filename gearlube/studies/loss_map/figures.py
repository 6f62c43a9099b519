"""Figures of a loss map."""

from __future__ import annotations

from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.figure_files import save_figure_folder
from gearlube.plotting.style import SERIES, house_style, label_contours, new_figure
from gearlube.plotting.words import source_colour, source_words
from gearlube.studies.loss_map.sampling import input_words, moving_inputs

_BAND = "between these lines: 95 % of the draws of uncertain data"
_MOST_PANELS = 6
_LETTERS = 13  # in an inch of the small print
_LIGHT = 0.6  # of the largest level, from which the colours are too light for white lines
LEAST_SHARE = 0.005  # of the largest loss, below which a source is not drawn


def save_loss_map_figures(dataset: xr.Dataset, folder: Path) -> None:
    """Write all figures as PNG; of a map without a point there are none, nor old ones."""
    figures = {}
    if np.isfinite(dataset["loss_torque"].values).any():
        figures["losses"] = loss_split(dataset)
        if min(dataset.sizes["speed"], dataset.sizes["torque"]) > 1:
            figures["loss_torque"] = loss_contours(dataset)
        if "swing" in dataset:
            figures["sensitivity"] = sensitivity(dataset)
    save_figure_folder(figures, folder)


def first_figure(dataset: xr.Dataset) -> Any:
    """Return the loss over speed and torque, of a lone speed or torque its sources."""
    grid = min(dataset.sizes["speed"], dataset.sizes["torque"]) > 1
    return loss_contours(dataset) if grid else loss_split(dataset)


def not_modelled(dataset: xr.Dataset) -> str:
    """Return a sentence on what the losses lack."""
    return f"Not modelled: {dataset.attrs['not_modelled']}."


def loss_contours(dataset: xr.Dataset) -> Any:
    """Return the loss torque over speed and torque of the pinion, a panel for each temperature."""
    from matplotlib.ticker import MaxNLocator

    temperatures = some_temperatures(dataset)
    loss = dataset["loss_torque"]
    levels = MaxNLocator(12).tick_values(0.0, float(np.nanmax(loss.values)))
    columns = min(2, len(temperatures))
    rows = -(-len(temperatures) // columns)
    with house_style():
        figure = new_figure(4.6 * columns + 0.8, 3.3 * rows + 0.5)
        panels = np.atleast_1d(figure.subplots(rows, columns, sharex=True, sharey=True)).ravel()
        for ax, temperature in zip(panels, temperatures, strict=False):
            one = loss.sel(temperature=temperature).transpose("torque", "speed")
            drawn = ax.contourf(one["speed"], one["torque"], one.values, levels, cmap="cividis")
            lines = ax.contour(
                one["speed"],
                one["torque"],
                one.values,
                levels[1::2],
                colors=["white" if one < _LIGHT * levels[-1] else "black" for one in levels[1::2]],
                linewidths=0.6,
            )
            label_contours(ax, lines, "%g")
            ax.axhline(0.0, color="white", lw=0.8, ls=":")
            ax.set_title(f"oil {temperature:g} °C")
        for ax in panels[len(temperatures) :]:
            ax.set_visible(False)
        for ax in panels[-columns:]:
            ax.set_xlabel("pinion speed [rpm]")
        for ax in panels[::columns]:
            ax.set_ylabel("pinion torque [N·m]")
        figure.colorbar(drawn, ax=panels.tolist(), label="loss torque [N·m]")
        figure.suptitle("Torque lost in the axle, at the pinion", fontsize=11)
        figure.supxlabel(_lines_of_not_modelled(dataset, figure), fontsize=8.5, color="#555555")
    return figure


def _lines_of_not_modelled(dataset: xr.Dataset, figure: Any) -> str:
    return fill(not_modelled(dataset), int(_LETTERS * figure.get_figwidth()))


def loss_split(dataset: xr.Dataset) -> Any:
    """Return the losses by source over torque at three speeds, at a middle temperature."""
    temperature = dataset["temperature"].values[dataset.sizes["temperature"] // 2]
    chosen = shown_speeds(dataset)
    narrow = len(chosen) < 3
    with house_style():
        figure = new_figure(6.0 if narrow else 2.9 * len(chosen) + 0.9, 5.0 if narrow else 4.1)
        panels = np.atleast_1d(figure.subplots(1, len(chosen)))
        for ax, j in zip(panels, chosen, strict=True):
            _split(ax, dataset.sel(temperature=temperature).isel(speed=j))
        panels[0].set_ylabel("power lost [W]")
        labels = {
            label: handle
            for ax in panels
            for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
        }
        columns = 1 if narrow else 3
        figure.legend(labels.values(), labels.keys(), loc="outside lower center", ncols=columns)
        missing = _lines_of_not_modelled(dataset, figure)
        figure.suptitle(f"Losses by source, oil at {temperature:g} °C\n{missing}", fontsize=10)
    return figure


def _split(ax: Any, one: xr.Dataset) -> None:
    torque = one["torque"].values
    loss = one["loss"].transpose("source", "torque").values
    largest = np.nanmax(loss.sum(axis=0))
    names = [str(name) for name in one["source"].values]
    drawn = [i for i in range(len(names)) if np.nanmax(loss[i]) > LEAST_SHARE * largest]
    ax.stackplot(
        torque,
        np.nan_to_num(loss[drawn]),
        labels=[source_words(names[i]) for i in drawn],
        colors=[source_colour(names[i]) for i in drawn],
        alpha=0.85,
    )
    if "loss_torque_low" in one:
        turning = float(one["speed"]) * np.pi / 30.0
        for name, label in (("loss_torque_low", _BAND), ("loss_torque_high", None)):
            ax.plot(torque, one[name].values * turning, color="black", lw=1.0, ls="--", label=label)
    ax.set(xlabel="pinion torque [N·m]", title=f"{float(one['speed']):.0f} rpm")
    ax.set_ylim(bottom=0.0)


def sensitivity(dataset: xr.Dataset) -> Any:
    """Return which uncertain input moves the loss most, as a mean over the map."""
    swings, still = moving_inputs(dataset)
    words = dict(part.split(": ", 1) for part in dataset.attrs["uncertain"].split("; "))
    names = list(swings)[::-1]  # the largest on top
    mean = 100.0 * np.array([swings[name] for name in names])
    with house_style():
        figure = new_figure(7.4, 0.45 * len(names) + 2.0)
        ax = figure.subplots()
        ax.barh([input_words(name) for name in names], mean, color=SERIES[0])
        for row, name in enumerate(names):
            factor = words[name].split(",")[0].removesuffix(" (k = 2)").removeprefix("factor ")
            known = f"  {mean[row]:.1f} %; known to a factor of {factor}"
            ax.text(mean[row], row, known, va="center", fontsize=8)
        ax.set_xlim(0.0, 1.55 * mean.max())
        ax.set_xlabel("mean change of the loss torque by this input alone [%]")
        figure.suptitle("What makes the loss uncertain: measure the longest bar first", fontsize=10)
        if still:
            none = ", ".join(map(input_words, still))
            figure.supxlabel(f"No effect in this axle: {none}.", fontsize=8.5, color="#555555")
        ax.grid(visible=False, axis="y")
    return figure


def shown_speeds(dataset: xr.Dataset) -> list[int]:
    """Return the places of a low, a middle and the highest speed."""
    last = dataset.sizes["speed"] - 1
    return sorted({round(share * last) for share in (0.15, 0.5, 1.0)})


def some_temperatures(dataset: xr.Dataset) -> list[float]:
    """Return up to six temperatures, the ends among them."""
    values = dataset["temperature"].values
    if values.size <= _MOST_PANELS:
        return [float(one) for one in values]
    chosen = np.linspace(0, values.size - 1, _MOST_PANELS).astype(int)
    return [float(values[i]) for i in chosen]
