"""Figures of a design: ease-off and contact pattern, transmission error, form of the teeth."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.drawn_tooth import DrawnTooth, ease_off_levels
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.report.pictures import Picture

_TITLES = {"drive": "drive flanks", "coast": "coast flanks"}


def contact_patterns(dataset: xr.Dataset) -> Any:
    """Return ease-off, path and marked pattern on the gear tooth, with the place asked for."""
    tooth, levels = DrawnTooth.of_dataset(dataset), ease_off_levels(dataset)
    with house_style():
        figure = new_figure(9.6, 5.4)
        axes = figure.subplots(2, 1)
        for ax, side in zip(axes, _TITLES, strict=True):
            part = dataset.sel(side=side)
            filled = tooth.draw_ease_off(ax, part, levels, 1.8)
            asked = tooth.along(part["asked_t"]), tooth.up(part["asked_s"])
            ax.plot(*asked, "o", color="white", mec="black", ms=7, zorder=7)
            ratio = float(part["path_contact_ratio"])
            tooth.draw(ax, f"{_TITLES[side]}: path over {ratio:.2f} pitches")
        figure.colorbar(filled, ax=axes, label="ease-off [µm]")
        figure.suptitle(
            "Gear tooth: ease-off, path (black), pattern at 6.35 µm (red), wanted place (white "
            "dot)",
            fontsize=11.5,
        )
    return figure


def transmission_error(dataset: xr.Dataset) -> Any:
    """Return the unloaded transmission error of single pairs and of the mesh, both sides."""
    with house_style():
        figure = new_figure(9.6, 3.8)
        errors = [dataset["error"].sel(side=side) for side in _TITLES]
        swings = [1e6 * float(one.max() - one.min()) for one in errors]  # without nan
        half = 0.9 * max(*swings, 1.0)  # of the axis, the same for both sides
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
            middle = 0.5 * float(np.nanmin(values) + np.nanmax(values))
            ax.set(
                xlim=(0.0, 2.0),
                ylim=(middle - half, middle + half),
                xlabel="pinion rotation [mesh periods]",
                ylabel="gear lags [µrad of the pinion]",
                title=f"{_TITLES[side]}: {1e6 * float(part['found_error']):.0f} µrad",
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
            ax.set(
                xlim=(0.0, 1.0),
                xlabel="place along the face: 0 toe, 1 heel",
                ylabel="normal width [mm]",
            )
            ax.set_ylim(bottom=0.0)
            ax.set_title("topland" if name == "topland" else "slot at the root")
            ax.legend()
        figure.suptitle("Normal widths over the face", fontsize=11.5)
    return figure


DESIGN_CATALOGUE = {
    "contact_pattern": Picture(
        contact_patterns,
        "Contact on the gear tooth",
        "Gap between the pinion flank and the conjugate one. Black: path of contact without load; "
        "red: where marking compound of 6.35 µm would be wiped off; white dot: the wanted place. "
        "The pinion does not reach white areas. Grid of 21 x 41 points.",
    ),
    "transmission_error": Picture(
        transmission_error,
        "Transmission error without load",
        "Flanks as cut. Parabolas that cross at a low error are quiet without load and tolerate "
        "errors of assembly. Gaps: edges would touch.",
    ),
    "tooth_widths": Picture(
        tooth_widths,
        "Widths of the teeth",
        "Normal width of topland, and of the slot at the root: blade points must not be wider "
        "than the narrowest slot.",
    ),
}
