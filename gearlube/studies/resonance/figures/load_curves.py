"""Amplitude against load at one speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure

_NAMES = {"two_dof": "2-DOF, dry", "one_dof": "1-DOF, dry"}


def load_curves(dataset: xr.Dataset) -> Any:
    """Return peak to peak and time without contact over the pinion torque, by stability."""
    with house_style():
        figure = new_figure(8.4, 6.0)
        axes = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
        for colour, form in zip(SERIES, dataset["form"].values, strict=False):
            part = dataset.sel(form=form)
            label: str | None = _NAMES[form]
            for number in part["branch"].values:
                branch = part.sel(branch=number)
                torque = branch["torque"].values
                stable = branch["stable"].values == 1.0
                for ax, name, scale in zip(
                    axes, ("peak_to_peak", "separation_share"), (1e6, 100.0), strict=True
                ):
                    values = scale * branch[name].values
                    held = np.where(stable, values, np.nan)
                    ax.plot(torque, held, color=colour, label=label)
                    ax.plot(torque, values, color=colour, ls=(0, (4, 2)), lw=1.0)
                label = None
                folds = branch["special_torque"].values, 1e6 * branch["special_peak_to_peak"].values
                axes[0].plot(*folds, "o", mfc="white", mec=colour)
        axes[0].set_ylabel("transmission error p-p [µm]")
        axes[1].set_ylabel("time without\ncontact [%]")
        axes[1].set_xlabel("pinion torque [N·m]")
        axes[0].legend()
        figure.suptitle(
            f"Response over load at {dataset.attrs['relative_frequency']:g} of the natural "
            "frequency; dashed: unstable; circles: folds and bifurcations",
            fontsize=10.5,
        )
    return figure
