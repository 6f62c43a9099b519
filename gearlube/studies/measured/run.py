"""Lay measured flanks on a pair: from a measured-gear file to a gear file, with figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gearlube.output.toml_text import toml_text
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube_core.hypoid_contact.tooth_errors.error_cycle import ToothErrorCycle
from gearlube_core.hypoid_geometry.measured.measured_flanks import (
    MeasuredFlanks,
    read_measured_flanks,
)
from gearlube_core.storage.atomic_file import write_figure, write_text
from gearlube_core.storage.file_names import pair_stem

_LEAST = 1e-3  # um, amplitude that is shown


def measured_flanks(flanks: MeasuredFlanks) -> Any:
    """Return the mean deviation, the smooth surface and the rest of every measured flank."""
    with house_style():
        figure = new_figure(11.0, 0.8 + 2.5 * max(1, len(flanks.grids)))
        rows = figure.subplots(max(1, len(flanks.grids)), 3, squeeze=False, sharex=True)
        for axes, (key, grid) in zip(rows, flanks.grids.items(), strict=False):
            surface = flanks.surfaces[key]
            mean = 1e6 * grid.deviation.mean(axis=0)
            rest = 1e6 * surface.residual
            shown = (
                (f"{grid.name}: mean of {len(grid.teeth)} teeth [µm]", mean),
                ("smooth surface [µm]", mean - rest),
                (f"rest, {1e6 * surface.residual_rms:.2f} µm rms [µm]", rest),
            )
            for ax, (title, values) in zip(axes, shown, strict=True):
                top = max(float(np.max(np.abs(values))), 1e-3)
                drawn = ax.pcolormesh(
                    grid.places.t, grid.places.s, values, cmap="RdBu_r", vmin=-top, vmax=top
                )
                figure.colorbar(drawn, ax=ax)
                ax.set_title(title, fontsize=9.5)
                ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
                ax.grid(visible=False)
            axes[0].set_ylabel("root (0) to tip (1)")
        for ax in rows[-1]:
            ax.set_xlabel("toe (0) to heel (1)")
        figure.suptitle(
            f"{flanks.file.name}: deviation from the nominal flanks; plus is more material",
            fontsize=11.5,
        )
    return figure


def tooth_errors(cycle: ToothErrorCycle, name: str) -> Any:
    """Return what single teeth add to the transmission error: over each turn, and by orders.

    At the lowest and the highest torque on the drive flanks.
    """
    drive = np.flatnonzero(cycle.torque > 0.0)
    levels = dict.fromkeys((int(drive[0]), int(drive[-1])))
    turns, orders = cycle.turns()[0], cycle.orders()
    teeth = {"pinion": cycle.pinion_teeth, "gear": cycle.gear_teeth}
    with house_style():
        figure = new_figure(11.0, 3.4 * len(turns))
        rows = figure.subplots(len(turns), 2, squeeze=False)
        for (turn_axis, order_axis), member in zip(rows, turns, strict=True):
            values = turns[member]
            place = np.arange(values.shape[1]) / values.shape[1]
            amplitude = 1e6 * np.hypot(orders[member][..., 0], orders[member][..., 1])
            for level, colour in zip(levels, (BLUE, VERMILLION), strict=False):
                label = f"{cycle.torque[level]:g} N·m"
                turn_axis.plot(place, 1e6 * values[level], color=colour, lw=1.2, label=label)
                order = np.arange(1, amplitude.shape[1] + 1) + 0.25 * (colour == VERMILLION)
                order_axis.vlines(order, _LEAST, amplitude[level], color=colour, lw=1.6)
            for mesh in range(teeth[member], amplitude.shape[1] + 1, teeth[member]):
                order_axis.axvline(mesh, color=GREY, lw=0.8, zorder=0)
            turn_axis.set(xlabel=f"turns of the {member}", ylabel="added error [µm]", xlim=(0, 1))
            turn_axis.legend(title="torque", title_fontsize=8.5)
            order_axis.set(
                xlabel=f"order (periods per turn of the {member}); grey: mesh",
                ylabel="amplitude [µm]",
            )
            order_axis.set_yscale("log")
            order_axis.set_ylim(bottom=_LEAST)
        figure.suptitle(
            f"{name}: what single teeth add to the transmission error (drive)", fontsize=11.5
        )
    return figure


def run_measured(path: str | Path, *, folder: Path | None = None) -> MeasuredFlanks:
    """Return the measured flanks of a hypoid pair as a gear file.

    Parameters
    ----------
    path : str or Path
        Measured-gear file (TOML), with its CSV files beside it.
    folder : Path, optional
        Folder for the gear file NAME.toml, which `gearlube contact` takes, and for flanks.png.

    Raises
    ------
    ParameterError
        A file is missing or wrong; the message names the line.

    Examples
    --------
    >>> found = run_measured("axle_17.toml")  # doctest: +SKIP
    >>> found.surfaces["gear", "drive"].residual_rms  # [m]  # doctest: +SKIP
    """
    flanks = read_measured_flanks(path)
    file = flanks.gear_file()
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        text = toml_text(file.model_dump(exclude_defaults=True))
        write_text(text, folder / f"{pair_stem(file.name)}.toml")
        write_figure(measured_flanks(flanks), folder / "flanks.png")
    return flanks
