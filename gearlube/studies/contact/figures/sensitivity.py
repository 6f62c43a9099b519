"""Figure of a sensitivity analysis: which tolerance matters."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.parameter_words import parameter_words, tolerance_words
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.mesh_cycle import SIDES

_PANELS = (
    ("unloaded_pp", 1e6, "unloaded transmission error,\npeak to peak [µrad]"),
    ("te_1", 1e6, "loaded transmission error,\nfirst mesh order [µrad]"),
    ("s", 1e2, "centre of force, root to tip\n[% of the height]"),
    ("t", 1e2, "centre of force, toe to heel\n[% of the face]"),
)


def sensitivity_figure(dataset: xr.Dataset) -> Any:
    """Return bars of what each parameter's tolerance changes, both sides; the largest on top."""
    order = np.argsort(_largest(dataset))
    part = dataset.isel(parameter=order)
    labels = [
        f"{parameter_words(str(name))}  +{tolerance_words(float(size), str(unit))}"
        for name, size, unit in zip(
            part["parameter"].values, part["tolerance"].values, part["unit"].values, strict=True
        )
    ]
    place = np.arange(len(labels))
    with house_style():
        figure = new_figure(12.5, 1.8 + 0.27 * len(labels))
        axes = figure.subplots(1, len(_PANELS), sharey=True)
        for ax, (name, scale, title) in zip(axes, _PANELS, strict=True):
            for row, side in enumerate(SIDES):
                change = scale * part["tolerance"].values * _rate(part.sel(side=side), name)
                ax.barh(place + 0.2 - 0.4 * row, change, 0.4, color=SERIES[row], label=side)
            ax.axvline(0.0, color="black", lw=0.7)
            ax.set_xlabel(title)
        axes[0].set_yticks(place, labels)
        axes[0].set_ylim(-0.7, len(labels) - 0.3)
        handles, words = axes[0].get_legend_handles_labels()
        figure.legend(handles, words, ncols=2, loc="outside lower center")
        torque = dataset.attrs["torque"]
        figure.suptitle(
            f"{dataset.attrs['name']}: change of the contact by small errors, {torque:g} N·m",
            fontsize=11.5,
        )
    return figure


def _rate(part: xr.Dataset, name: str) -> Array:
    values = part[f"{name}_rate"]
    return np.asarray((values.mean("phase") if "phase" in values.dims else values).values)


def _largest(dataset: xr.Dataset) -> Array:
    """Return the largest change of each parameter on either side, over all panels, (P,)."""
    found = np.zeros(dataset.sizes["parameter"])
    for name, _, _ in _PANELS:
        change = np.abs(
            [dataset["tolerance"].values * _rate(dataset.sel(side=side), name) for side in SIDES]
        )
        if np.isfinite(change).any() and np.nanmax(change) > 0.0:
            found = np.fmax(found, np.nanmax(change / np.nanmax(change), axis=0))
    return found
