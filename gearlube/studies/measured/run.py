"""Lay measured flanks on a pair: from a measured-gear file to a gear file, with figures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.toml_text import toml_text
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.settings_fit import SettingsFit
from gearlube_core.hypoid_contact.tooth_errors.error_cycle import ToothErrorCycle
from gearlube_core.hypoid_geometry.measured.measured_flanks import (
    MeasuredFlanks,
    read_measured_flanks,
)
from gearlube_core.storage.atomic_file import write_figure, write_text
from gearlube_core.storage.file_names import pair_stem
from gearlube_core.units import labelled

_LEAST = 1e-3  # um, amplitude that is shown


def flank_dataset(flanks: MeasuredFlanks, fits: Sequence[SettingsFit] = ()) -> xr.Dataset:
    """Return mean deviations and what is left of every measured flank; units as attributes.

    Grids of flanks that have fewer rows or columns than others are filled up with NaN.
    """
    keys = list(flanks.grids)
    grids = [flanks.grids[key] for key in keys]
    surfaces = [flanks.surfaces[key] for key in keys]
    places = [np.broadcast_arrays(one.places.s[:, None], one.places.t) for one in grids]
    means = [one.deviation.mean(axis=0) for one in grids]
    maps: dict[str, tuple[str, str, list[Array]]] = {
        "s": ("1", "profile position, root 0 to tip 1", [s for s, _ in places]),
        "t": ("1", "face position, toe 0 to heel 1", [t for _, t in places]),
        "deviation": ("m", "mean of the teeth, plus is material", means),
        "rest": ("m", "what the smooth surface leaves", [one.residual for one in surfaces]),
    }
    data: dict[str, Any] = {
        name: (("flank", "row", "column"), _padded(values), {"units": unit, "long_name": text})
        for name, (unit, text, values) in maps.items()
    }
    data["teeth"] = labelled(("flank",), [len(one.teeth) for one in grids], "1", "measured teeth")
    data["rest_rms"] = (
        ("flank",),
        [one.residual_rms for one in surfaces],
        {"units": "m", "long_name": "what the smooth surface leaves, rms"},
    )
    data["scatter_rms"] = (
        ("flank",),
        [one.scatter_rms for one in surfaces],
        {"units": "m", "long_name": "how far teeth are from their mean, rms"},
    )
    data |= _settings(fits)
    return xr.Dataset(
        data,
        coords={"flank": [one.name for one in grids]},
        attrs={
            "name": flanks.file.name,
            "source": flanks.file.source,
            "degree": flanks.file.degree,
            "single_teeth": int(not flanks.errors.is_none),
            "gear_file": flanks.gear_file().model_dump_json(exclude_none=True, exclude_unset=True),
        },
    )


def _settings(fits: Sequence[SettingsFit]) -> dict[str, Any]:
    """Return fitted settings, a row each; `before` and `after` are those of the member's fit."""
    if not fits:
        return {}
    count = [len(fit.fields) for fit in fits]
    notes = {"units": "as in setting_unit"}
    found: dict[str, Any] = {
        f"setting_{name}": (
            ("setting",),
            np.concatenate([getattr(fit, name) for fit in fits]),
            notes,
        )
        for name in ("nominal", "change", "uncertainty", "corrective")
    }
    found["setting"] = (("setting",), [field for fit in fits for field in fit.fields])
    found["setting_unit"] = (("setting",), [unit for fit in fits for unit in fit.units])
    for name in ("before", "after"):
        values = np.repeat([getattr(fit, name) for fit in fits], count)
        found[f"fit_{name}"] = (("setting",), values, {"units": "m", "long_name": f"rms {name}"})
    return found


def _padded(maps: Sequence[Array]) -> Array:
    rows = max((one.shape[0] for one in maps), default=0)
    columns = max((one.shape[1] for one in maps), default=0)
    found = np.full((len(maps), rows, columns), np.nan)
    for k, one in enumerate(maps):
        found[k, : one.shape[0], : one.shape[1]] = one
    return found


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
    """Return the transmission error that single teeth add: over each turn, and by orders.

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
