"""Losses of a pair alone over speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure
from gearlube_core.film_model.model import MOST_OUTSIDE

_MOST = 4


def pair_losses(dataset: xr.Dataset) -> Any:
    """Return the loss torque over speed, a line for each torque, a panel for each temperature."""
    temperatures = _some(dataset["temperature"].values)
    torques = _some(dataset["torque"].values)
    with house_style():
        figure = new_figure(max(4.2 * len(temperatures) + 1.2, 6.4), 4.6)
        panels = np.atleast_1d(figure.subplots(1, len(temperatures), sharey=True))
        for ax, temperature in zip(panels, temperatures, strict=True):
            for row, torque in enumerate(torques):
                one = dataset.sel(temperature=temperature, torque=torque)
                colour = SERIES[row % len(SERIES)]
                ax.plot(
                    one["speed"],
                    one["loss_torque"],
                    color=colour,
                    marker=MARKERS[row % len(MARKERS)],
                    label=f"{torque:.4g} N·m",
                )
                if "by_formulas" in one:
                    by = one.where(one["by_formulas"] > 0)
                    hollow = {"color": "white", "marker": MARKERS[row % len(MARKERS)], "ls": ""}
                    ax.plot(by["speed"], by["loss_torque"], mec=colour, zorder=3, **hollow)
                if "loss_torque_low" in one:
                    ax.fill_between(
                        one["speed"],
                        one["loss_torque_low"],
                        one["loss_torque_high"],
                        color=colour,
                        alpha=0.18,
                        lw=0.0,
                    )
            ax.set(xlabel="pinion speed [rpm]", title=f"oil {temperature:g} °C")
            ax.set_ylim(bottom=0.0)
        panels[0].set_ylabel("loss torque at the pinion [N·m]")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(
            handles, names, title="pinion torque", ncols=_MOST, loc="outside lower center"
        )
        bands = "; bands: 95 % of the draws" if "loss_torque_low" in dataset else ""
        films = ""
        if "by_formulas" in dataset:
            films = (
                f"Solved films; hollow: formulas, more than {MOST_OUTSIDE:.0%} of load outside.\n"
            )
        figure.suptitle(
            f"Sliding and rolling of the teeth{bands}.\n{films}"
            f"Not modelled: {dataset.attrs['not_modelled']}.",
            fontsize=8.5,
        )
    return figure


def _some(values: np.ndarray) -> list[float]:
    chosen = np.unique(np.linspace(0, values.size - 1, min(values.size, _MOST)).astype(int))
    return [float(values[i]) for i in chosen]
