"""Maps on the gear flank: ease-off, unloaded contact path and pattern, pressure under load."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import VERMILLION, house_style, new_figure

_MARKING = 6.35e-6  # m, customary thickness of marking compound
_SIDES = {"drive": "drive side", "coast": "coast side"}


def ease_off_map(dataset: xr.Dataset) -> Any:
    """Return ease-off, path of contact and marked pattern on the gear flank, both sides."""
    with house_style():
        figure = new_figure(9.6, 6.4)
        axes = figure.subplots(2, 1, sharex=True)
        top = float(np.nanpercentile(1e6 * dataset["ease_off"].values, 97))
        levels = np.linspace(0.0, top, 13)
        for ax, side in zip(axes, _SIDES, strict=True):
            part = dataset.sel(side=side)
            filled = ax.contourf(
                part["ease_t"],
                part["ease_s"],
                1e6 * part["ease_off"],
                levels=levels,
                cmap="viridis_r",
                extend="max",
            )
            ax.contour(
                part["ease_t"],
                part["ease_s"],
                part["closest"].fillna(1.0),
                levels=[_MARKING],
                colors=VERMILLION,
                linewidths=1.8,
            )
            ax.plot(part["path_t"], part["path_s"], color="black", lw=1.8)
            ax.set_title(
                f"{_SIDES[side]}: path over {float(part['path_contact_ratio']):.2f} pitches"
            )
            _flank_axes(ax)
        figure.colorbar(filled, ax=axes, label="ease-off [µm]")
        figure.suptitle(
            "Gear flank: ease-off, path of contact (black), pattern at 6.35 µm (red)",
            fontsize=11.5,
        )
    return figure


def pressure_maps(dataset: xr.Dataset) -> Any:
    """Return maps of the highest pressure at each point of the gear flank, per side and torque."""
    torques = _spread(dataset["torque"].values, 4)
    with house_style():
        figure = new_figure(10.5, 8.6)
        axes = figure.subplots(len(torques), 2, sharex=True, sharey=True, squeeze=False)
        top = 1e-9 * float(np.nanpercentile(dataset["pressure_map"].values, 99.5))
        for row, torque in zip(axes, torques, strict=True):
            for ax, side in zip(row, _SIDES, strict=True):
                part = dataset.sel(side=side, torque=torque)
                values = 1e-9 * part["pressure_map"].values
                image = ax.pcolormesh(
                    part["map_t"],
                    part["map_s"],
                    np.where(values > 0.0, values, np.nan),
                    vmin=0.0,
                    vmax=top,
                    cmap="magma_r",
                )
                ax.set_title(
                    f"{_SIDES[side]}, {torque:g} N·m: up to {np.nanmax(values):.2f} GPa",
                    fontsize=9.5,
                )
                _flank_axes(ax)
        for ax in axes[:-1].ravel():
            ax.set_xlabel("")
        for ax in axes[:, 1]:
            ax.set_ylabel("")
        figure.colorbar(image, ax=axes, label="highest pressure over the mesh [GPa]", extend="max")
        figure.suptitle("Gear flank: pressure under load", fontsize=11.5)
    return figure


def _flank_axes(ax: Any) -> None:
    ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), xlabel="toe  –  face width  –  heel")
    ax.set_ylabel("root  –  tip")
    ax.grid(visible=False)


def _spread(values: Any, count: int) -> list[float]:
    chosen = np.unique(np.linspace(0, len(values) - 1, min(count, len(values))).astype(int))
    return [float(values[i]) for i in chosen]
