"""Amplitude, harmonics and stability over mesh frequency."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    GREY,
    OLIVE,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    WINE,
    house_style,
    new_figure,
)
from gearlube.studies.resonance.settings import MODELS
from gearlube.studies.resonance.summary import main_special
from gearlube_core.arrays import Array

COLOURS = {
    "two_dof": BLUE,
    "one_dof": VERMILLION,
    "two_dof_lubricated": GREEN,
    "two_dof_mean_radii": PURPLE,
}
MARKS = {
    "fold": ("o", "fold"),
    "branch point": ("s", "branch point"),
    "period doubling": ("D", "period doubling"),
    "Neimark-Sacker": ("^", "Neimark-Sacker"),
}
# wide lines show behind others that coincide
WIDTHS = {"two_dof": 2.6, "one_dof": 1.4, "two_dof_lubricated": 0.9}
FREQUENCY = "mesh frequency / natural frequency [-]"
_SHOWN = ("two_dof", "one_dof", "two_dof_lubricated")


def segments(dataset: xr.Dataset, model: str) -> list[xr.Dataset]:
    """Return the rows of each branch of a model."""
    part = dataset.sel(model=model)
    part = part.isel(row=np.flatnonzero(np.isfinite(part["segment"].values)))
    numbers = part["segment"].values
    return [part.isel(row=np.flatnonzero(numbers == number)) for number in np.unique(numbers)]


def shown_models(dataset: xr.Dataset) -> list[str]:
    """Return which of the compared models a dataset holds."""
    return [model for model in _SHOWN if model in dataset["model"].values]


def draw_branch(ax: Any, branch: xr.Dataset, values: Array, colour: str, **style: Any) -> None:
    """Draw a branch, stable rows solid, unstable dashed; neighbouring stretches are joined."""
    x, stable = branch["relative_frequency"].values, branch["stable"].values > 0.5
    edges = np.flatnonzero(np.diff(stable.astype(int))) + 1
    for first, last in zip([0, *edges], [*edges, x.size], strict=True):
        rows = slice(first, min(last + 1, x.size))
        ax.plot(x[rows], values[rows], color=colour, ls="-" if stable[first] else "--", **style)


def response_curves(dataset: xr.Dataset) -> Any:
    """Return amplitude over frequency, with branches, stability, separation and time sweeps.

    Compare [karagiannis_2012 fig. 8].
    """
    models = shown_models(dataset)
    with house_style():
        figure = new_figure(9.6, 10.5)
        top, middle, bottom = figure.subplots(
            3, 1, sharex=True, gridspec_kw={"height_ratios": (3.0, 1.6, 1.3)}
        )
        for model in models:
            lw = WIDTHS[model]
            for branch in segments(dataset, model):
                colour = COLOURS[model]
                draw_branch(top, branch, 1e6 * branch["peak_to_peak"].values, colour, lw=lw)
                draw_branch(middle, branch, 1e6 * branch["minimum"].values, colour, lw=lw)
                share = 100.0 * branch["separation_share"].values
                draw_branch(bottom, branch, share, colour, lw=lw)
            _mark_special(top, dataset.sel(model=model))
        _sweep_dots(top, dataset)
        _contact_lost(middle, dataset)
        top.set_ylabel("transmission error p-p [µm]")
        top.set_ylim(bottom=0.0)
        middle.set_ylabel("least transmission error [µm]")
        bottom.set_ylabel("time without\ncontact [%]")
        bottom.set_xlabel(FREQUENCY)
        bottom.set_xlim(dataset.attrs["first"], dataset.attrs["last"])
        _legend(top, models, dataset)
        figure.suptitle(
            f"Response over mesh frequency, {dataset.attrs['pinion_torque']:g} N·m, "
            f"radii {dataset.attrs['radii']}, mesh {dataset.attrs.get('mesh', '')}, "
            f"$f_n$ = {dataset.attrs.get('natural_frequency', np.nan):.0f} Hz",
            fontsize=11.5,
        )
    return figure


def _mark_special(ax: Any, part: xr.Dataset) -> None:
    part = part.isel(special=main_special(part))
    for kind, x, y in zip(
        part["special_kind"].values,
        part["special_relative_frequency"].values,
        part["special_peak_to_peak"].values,
        strict=True,
    ):
        if kind in MARKS:
            ax.plot(x, 1e6 * y, MARKS[kind][0], mfc="white", mec="black", ms=5.5, zorder=5)


def _sweep_dots(ax: Any, dataset: xr.Dataset) -> None:
    if "sweep_peak_to_peak" not in dataset:
        return
    for model in dataset["swept_model"].values:
        for direction, marker in (("up", "^"), ("down", "v")):
            part = dataset.sel(swept_model=model, direction=direction)
            ax.plot(
                part["sweep_relative_frequency"],
                1e6 * part["sweep_peak_to_peak"],
                marker,
                color=COLOURS[str(model)],
                ms=3.6,
                mew=0.6,
                mfc="none",
                alpha=0.9,
                zorder=4,
            )


def _contact_lost(ax: Any, dataset: xr.Dataset) -> None:
    """Shade where the teeth are apart, and where the coast flanks are hit."""
    backlash = 1e6 * dataset.attrs.get("backlash", np.nan)
    low, high = ax.get_ylim()
    if np.isfinite(backlash) and low < -0.7 * backlash:
        ax.axhspan(min(low, -1.1 * backlash), -backlash, color=VERMILLION, alpha=0.12, lw=0)
        note = "coast flanks in contact"
        ax.text(0.01, 0.03, note, transform=ax.transAxes, fontsize=8.0)
        low = min(low, -1.1 * backlash)
    ax.axhspan(max(low, -backlash), 0.0, color=GREY, alpha=0.3, lw=0)
    ax.axhline(0.0, color="black", lw=0.7)
    ax.text(
        0.99,
        -0.02 * (high - low),
        "teeth apart",
        ha="right",
        va="top",
        fontsize=8.0,
        transform=ax.get_yaxis_transform(),
    )
    ax.set_ylim(low, high)


def _legend(ax: Any, models: list[str], dataset: xr.Dataset) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=COLOURS[model], lw=WIDTHS[model], label=MODELS[model])
        for model in models
    ]
    handles += [
        Line2D([], [], color="#404040", ls="-", label="stable"),
        Line2D([], [], color="#404040", ls="--", label="unstable"),
    ]
    kinds = set(dataset["special_kind"].values.ravel().tolist())
    handles += [
        Line2D([], [], ls="", marker=marker, mfc="white", mec="black", label=label)
        for kind, (marker, label) in MARKS.items()
        if kind in kinds
    ]
    if "sweep_peak_to_peak" in dataset:
        handles += [
            Line2D([], [], ls="", marker=mark, mfc="none", color="#404040", ms=4, label=label)
            for mark, label in (("^", "time sweep up"), ("v", "time sweep down"))
        ]
    ax.legend(handles=handles, loc="upper left", ncols=2)


def harmonics(dataset: xr.Dataset) -> Any:
    """Return the amplitudes of the mesh orders over frequency."""
    models = shown_models(dataset)
    orders = dataset["harmonic"].values[:4]
    colours = (SKY, ORANGE, WINE, OLIVE)  # not those of models
    with house_style():
        figure = new_figure(9.6, 2.7 * len(models) + 0.6)
        axes = np.atleast_1d(figure.subplots(len(models), 1, sharex=True, sharey=True))
        for ax, model in zip(axes, models, strict=True):
            for branch in segments(dataset, model):
                for order, colour in zip(orders, colours, strict=False):
                    values = 1e6 * branch["harmonics"].sel(harmonic=order).values
                    draw_branch(ax, branch, values, colour, lw=1.2)
            ax.set(yscale="log", ylabel="amplitude [µm]", title=MODELS[model])
            for order in range(2, 7):
                if dataset.attrs["first"] < 1.0 / order:
                    ax.axvline(1.0 / order, color=GREY, lw=0.8, zorder=0)
                    ax.text(
                        1.0 / order,
                        0.99,
                        f" 1/{order}",
                        va="top",
                        fontsize=8.0,
                        transform=ax.get_xaxis_transform(),
                    )
        axes[0].set_ylim(bottom=1e-3)
        axes[-1].set_xlabel(FREQUENCY)
        axes[-1].set_xlim(dataset.attrs["first"], dataset.attrs["last"])
        for order, colour in zip(orders, colours, strict=False):
            axes[0].plot([], [], color=colour, label=f"mesh order {order}")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
        figure.suptitle("Orders of the transmission error; unstable motions dashed", fontsize=11.5)
    return figure


def _mark_folds(ax: Any, part: xr.Dataset, colour: str) -> None:
    part = part.isel(special=main_special(part))
    for kind, place in zip(
        part["special_kind"].values, part["special_relative_frequency"].values, strict=True
    ):
        if kind == "fold":
            ax.axvline(place, color=colour, lw=1.0, ls=":", zorder=0)


def stability(dataset: xr.Dataset) -> Any:
    """Return the factors on a disturbance in a mesh period over frequency.

    They are the moduli of the Floquet multipliers; a motion with one above 1 is unstable.
    """
    models = shown_models(dataset)
    with house_style():
        figure = new_figure(9.6, 5.2)
        ax = figure.subplots()
        for model in models:
            _mark_folds(ax, dataset.sel(model=model), COLOURS[model])
            for branch in segments(dataset, model):
                for moduli in branch["multipliers"].values.T:
                    draw_branch(ax, branch, moduli, COLOURS[model], lw=WIDTHS[model])
            ax.plot([], [], color=COLOURS[model], lw=WIDTHS[model], label=MODELS[model])
        top = max(1.3, min(ax.get_ylim()[1], 5.0))
        ax.axhspan(1.0, top, color=VERMILLION, alpha=0.08, lw=0)
        ax.axhline(1.0, color="black", lw=0.8)
        ax.set_ylim(0.0, top)
        place = {"transform": ax.get_yaxis_transform(), "fontsize": 9.0}
        ax.text(0.01, 0.5 * (1.0 + top), "disturbances grow: unstable", va="center", **place)
        ax.text(0.01, 0.04, "disturbances die out fast", va="bottom", **place)
        ax.text(
            0.99,
            0.97,
            "the lines at 1 are the slow hold of the speed",
            ha="right",
            va="top",
            **place,
        )
        ax.set(xlabel=FREQUENCY, ylabel="factor on a disturbance\nin one mesh period [-]")
        ax.set_xlim(dataset.attrs["first"], dataset.attrs["last"])
        ax.legend()
        figure.suptitle(
            "Stability of the motions (moduli of Floquet multipliers); dashed: unstable motions, "
            "dotted: folds",
            fontsize=11.0,
        )
    return figure
