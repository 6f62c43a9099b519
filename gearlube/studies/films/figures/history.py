"""Convergence history of a solution."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure

_FLOOR = 1e-17  # drawn in place of an exact zero


def residual_history(dataset: xr.Dataset) -> Any:
    """Return the residuals of all Newton steps, from the coarsest to the finest grid.

    For a thermal film the changes of temperature from turn to turn.
    """
    with house_style():
        figure = new_figure(8.0, 4.2)
        ax = figure.subplots()
        if "temperature_change" in dataset:
            _turns(ax, dataset)
        else:
            _newton_steps(ax, dataset)
        ax.xaxis.get_major_locator().set_params(integer=True)
        figure.legend(ncols=2, loc="outside lower center")
        verdict = "converged" if dataset.attrs["converged"] else "NOT CONVERGED"
        figure.suptitle(f"{dataset.attrs['name']}: {verdict}", fontsize=11.5)
    return figure


def _turns(ax: Any, dataset: xr.Dataset) -> None:
    changes = dataset["temperature_change"].values
    turns = np.arange(1, changes.size + 1)
    ax.semilogy(turns, changes, "o-", color=BLUE, ms=3.5, lw=1.0, label="change of temperature")
    ax.set(xlabel="turn of film and energy", ylabel="largest change [K]")


def _newton_steps(ax: Any, dataset: xr.Dataset) -> None:
    steps = np.arange(1, dataset.sizes["iteration"] + 1)
    residual = np.maximum(dataset["residual_history"].values, _FLOOR)
    ax.semilogy(steps, residual, "o-", color=BLUE, ms=3.5, lw=1.0, label="unbalanced flow")
    words = "Newton step"
    if "load_error_history" in dataset:
        load = np.maximum(dataset["load_error_history"].values, _FLOOR)
        ax.semilogy(steps, load, "s", color=VERMILLION, ms=3.0, label="load error")
        nodes = dataset["nodes_history"].values
        for turn in np.flatnonzero(np.diff(nodes) != 0.0):
            ax.axvline(turn + 1.5, color=GREY, lw=0.8, ls=":")
        words += "; dotted: next finer grid; a load error of 1e-17 stands for zero"
    ax.set(xlabel=words, ylabel="relative error [-]")
