"""Figures of a design: ease-off and contact pattern, transmission error, form of the teeth."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube_core.hypoid_contact.contact_pattern import MARKING_COMPOUND

_TITLES = {"drive": "drive flanks", "coast": "coast flanks"}


def contact_patterns(dataset: xr.Dataset) -> Any:
    """Return ease-off, path and marked pattern on the gear flank, with the place asked for."""
    with house_style():
        figure = new_figure(9.6, 6.4)
        axes = figure.subplots(2, 1, sharex=True)
        top = float(np.nanpercentile(1e6 * dataset["ease_off"].values, 97))
        for ax, side in zip(axes, _TITLES, strict=True):
            part = dataset.sel(side=side)
            filled = ax.contourf(
                part["ease_t"],
                part["ease_s"],
                1e6 * part["ease_off"],
                levels=np.linspace(0.0, top, 13),
                cmap="viridis_r",
                extend="max",
            )
            ax.contour(
                part["ease_t"],
                part["ease_s"],
                part["closest"].fillna(1.0),
                levels=[MARKING_COMPOUND],
                colors=VERMILLION,
                linewidths=1.8,
            )
            ax.plot(part["path_t"], part["path_s"], color="black", lw=1.8)
            ax.plot(part["asked_t"], part["asked_s"], "o", color="white", mec="black", ms=7)
            ax.set_title(
                f"{_TITLES[side]}: path over {float(part['path_contact_ratio']):.2f} pitches"
            )
            ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), ylabel="root  -  tip")
            ax.grid(visible=False)
        axes[-1].set_xlabel("toe  -  face width  -  heel")
        figure.colorbar(filled, ax=axes, label="ease-off [µm]", format="%.0f")
        figure.suptitle(
            "Gear flank: ease-off, path (black), pattern at 6.35 µm (red), asked (white dot)\n"
            "White: out of reach of the pinion, on a grid of 21 x 41 points",
            fontsize=11.5,
        )
    return figure


def transmission_error(dataset: xr.Dataset) -> Any:
    """Return the unloaded transmission error of single pairs and of the mesh, both sides."""
    with house_style():
        figure = new_figure(9.6, 3.8)
        for ax, side in zip(figure.subplots(1, 2), _TITLES, strict=True):
            part = dataset.sel(side=side)
            error = part["error"].values
            zero = np.nanmin(error) if side == "drive" else np.nanmax(error)
            for shift in (-1, 0, 1, 2):
                single = 1e6 * (part["path_error"].values - zero)
                ax.plot(part["path_phase"].values + shift, single, color=GREY, lw=1.2)
            phase = np.append(part["mesh_phase"].values, part["mesh_phase"].values + 1.0)
            values = 1e6 * np.tile(error - zero, 2)
            ax.plot(phase, values, color=BLUE)
            span = max(float(np.nanmax(values) - np.nanmin(values)), 1.0)
            ax.set(
                xlim=(0.0, 2.0),
                ylim=(np.nanmin(values) - 0.3 * span, np.nanmax(values) + 0.5 * span),
                xlabel="pinion rotation [mesh periods]",
                ylabel="gear lags [µrad of the pinion]",
                title=f"{_TITLES[side]}: {span:.0f} µrad",
            )
        figure.suptitle("Transmission error without load; single pairs grey", fontsize=11.5)
    return figure


def tooth_widths(dataset: xr.Dataset) -> Any:
    """Return topland and slot of both members over the face."""
    with house_style():
        figure = new_figure(9.6, 3.8)
        for ax, name in zip(figure.subplots(1, 2), ("topland", "slot"), strict=True):
            for member, colour in (("pinion", BLUE), ("gear", VERMILLION)):
                ax.plot(
                    dataset["face"],
                    1e3 * dataset[name].sel(member=member),
                    color=colour,
                    label=member,
                )
            ax.set(xlim=(0.0, 1.0), xlabel="toe  -  face width  -  heel", ylabel="mm")
            ax.set_ylim(bottom=0.0)
            ax.set_title("topland" if name == "topland" else "slot at the root")
            ax.legend()
        figure.suptitle("Normal widths over the face", fontsize=11.5)
    return figure


DESIGN_CATALOGUE = {
    "contact_pattern": contact_patterns,
    "transmission_error": transmission_error,
    "tooth_widths": tooth_widths,
}


def save_design_figures(dataset: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure into `directory` as PNG and return the files."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, draw in DESIGN_CATALOGUE.items():
        path = directory / f"{name}.png"
        draw(dataset).savefig(path, dpi=150)
        files.append(path)
    return files
