"""Measured flanks, what their smooth surfaces leave, and fitted settings as one dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.settings_fit import SettingsFit
from gearlube_core.hypoid_geometry.measured.measured_flanks import MeasuredFlanks


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
    data["teeth"] = (
        ("flank",),
        [len(one.teeth) for one in grids],
        {"units": "1", "long_name": "measured teeth"},
    )
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
