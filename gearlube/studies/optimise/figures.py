"""Figures of an optimisation: error over the mesh, mesh orders, errors, whine against loss."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube.report.pictures import Picture

_COLOURS = {"before": GREY, "better": BLUE, "nominal": GREEN}
NAMES = {"before": "before", "better": "after", "nominal": "best without errors"}
_SHAPES = {"before": "s", "better": "o", "nominal": "^"}
_MICRO = 1e6


def errors_over_mesh(dataset: xr.Dataset) -> Any:
    """Return the loaded transmission error over two mesh periods, a panel for each torque."""
    with house_style():
        torques = dataset["torque"].values
        figure = new_figure(max(4.2, 3.2 * torques.size), 3.6)
        axes = np.atleast_1d(figure.subplots(1, torques.size, sharey=True))
        for ax, torque in zip(axes, torques, strict=True):
            for design in dataset["design"].values:
                part = dataset["transmission_error"].sel(torque=torque, design=design)
                for s in range(part.sizes["error"] - 1, -1, -1):
                    values = _MICRO * (part.values[s] - part.values[s].mean())
                    phase = np.arange(2 * values.size + 1) / values.size
                    ax.plot(
                        phase,
                        np.append(np.tile(values, 2), values[0]),
                        color=_COLOURS[str(design)],
                        lw=1.8 if s == 0 else 0.6,
                        label=NAMES[str(design)] if s == 0 else None,
                    )
            ax.set(xlim=(0.0, 2.0), xlabel="time [mesh periods]", title=f"{torque:g} N·m")
        axes[0].set_ylabel("transmission error [µrad]")
        _legend_below(figure, axes[0])
        figure.suptitle(
            "Loaded transmission error without its mean; thin: with errors of assembly",
            fontsize=11.5,
        )
    return figure


def mesh_orders(dataset: xr.Dataset) -> Any:
    """Return amplitudes of the mesh orders without errors, a panel for each torque."""
    with house_style():
        torques, orders = dataset["torque"].values, dataset["order"].values
        figure = new_figure(max(4.2, 3.2 * torques.size), 3.6)
        axes = np.atleast_1d(figure.subplots(1, torques.size, sharey=True))
        names = [str(one) for one in dataset["design"].values]
        for ax, torque in zip(axes, torques, strict=True):
            for k, design in enumerate(names):
                part = dataset["amplitude"].sel(torque=torque, design=design).isel(error=0)
                place = np.arange(orders.size) + 0.8 * (k + 0.5) / len(names) - 0.4
                ax.bar(
                    place,
                    _MICRO * part.values,
                    0.75 / len(names),
                    color=_COLOURS[design],
                    label=NAMES[design],
                )
            ax.set_xticks(np.arange(orders.size), [f"{order}" for order in orders])
            ax.set(xlabel="mesh order", title=f"{torque:g} N·m")
        axes[0].set_ylabel("amplitude [µrad]")
        _legend_below(figure, axes[0])
        figure.suptitle("Mesh orders of the loaded transmission error", fontsize=11.5)
    return figure


def sensitivity_to_errors(dataset: xr.Dataset) -> Any:
    """Return all orders together under each error, a panel for each torque."""
    with house_style():
        torques, errors = dataset["torque"].values, dataset["error"].values
        figure = new_figure(max(5.0, 3.2 * torques.size + 1.2), 0.35 * errors.size + 2.0)
        axes = np.atleast_1d(figure.subplots(1, torques.size, sharex=True, sharey=True))
        for ax, torque in zip(axes, torques, strict=True):
            for design in dataset["design"].values:
                part = dataset["whine"].sel(torque=torque, design=design)
                place = np.arange(errors.size)
                ax.plot(
                    _MICRO * part.values,
                    place,
                    _SHAPES[str(design)],
                    color=_COLOURS[str(design)],
                    label=NAMES[str(design)],
                )
            ax.set_yticks(np.arange(errors.size), [error_words(str(one)) for one in errors])
            ax.set(xlabel="root of the sum of squares [µrad]", title=f"{torque:g} N·m")
            ax.set_ylim(errors.size - 0.5, -0.5)
        axes[0].set_xlim(left=0.0)
        _legend_below(figure, axes[0])
        figure.suptitle("All mesh orders together, under each error of assembly", fontsize=11.5)
    return figure


def whine_against_loss(dataset: xr.Dataset) -> Any:
    """Return the front of mesh orders and loss, both over those before."""
    with house_style():
        figure = new_figure(5.2, 3.8)
        ax = figure.subplots()
        ax.plot(dataset["front_whine"], dataset["front_loss"], "o-", color=BLUE, label="after")
        ax.plot(1.0, 1.0, "s", color=VERMILLION, label="before")
        ax.set(xlabel="mesh orders, relative to before", ylabel="sliding loss, relative to before")
        ax.set_xlim(left=0.0)
        ax.legend()
        figure.suptitle("Quieter or less loss: the best pairs found", fontsize=11.5)
    return figure


def error_words(error: str) -> str:
    """Return an error as labels show it.

    Examples
    --------
    >>> error_words("lead_slope +10 um"), error_words("none")
    ('lead slope +10 µm', 'no error')
    """
    if error == "none":
        return "no error"
    return error.replace("_", " ").replace(" um", " µm").replace(" deg", "°").replace(" -", " −")


def _legend_below(figure: Any, ax: Any) -> None:
    handles, names = ax.get_legend_handles_labels()
    figure.legend(handles, names, ncols=len(names), loc="outside lower center")


OPTIMISE_CATALOGUE = {
    "transmission_error": Picture(
        errors_over_mesh,
        "Loaded transmission error",
        "Over two mesh periods, mean removed; thin: with errors. The flatter, the quieter.",
    ),
    "mesh_orders": Picture(
        mesh_orders,
        "Mesh orders before and after",
        "Amplitudes of the loaded transmission error without errors, at each torque.",
    ),
    "errors": Picture(
        sensitivity_to_errors,
        "Mesh orders with errors",
        "All orders together under each error of assembly and making. The closer together the "
        "points of a pair are, the less the errors matter.",
    ),
    "front": Picture(
        whine_against_loss,
        "Mesh orders against loss",
        "The smallest loss for each level of the mesh orders, with the coarse cells of the search.",
    ),
}


def drawn_figures(dataset: xr.Dataset) -> dict[str, Picture]:
    """Return the figures for which a dataset holds data, by name."""
    there = {"errors": dataset.sizes["error"] > 1, "front": "front_whine" in dataset}
    return {name: one for name, one in OPTIMISE_CATALOGUE.items() if there.get(name, True)}
