"""Unloaded contact of a designed pair as one labelled dataset."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_dataset import (
    EASE_GRID,
    PATH_PHASES,
    unloaded_contact,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_design.design import Design
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.tooth_form import ToothForm

_PERIOD = round(1.0 / float(PATH_PHASES[1] - PATH_PHASES[0]))  # positions of the path a pitch
_FINER = 10  # times as many of the mesh, so that it shows where one pair takes over from another
_VARIABLES = {
    "path_s": (("path_phase",), "1", "unloaded path of contact, root 0 to tip 1"),
    "path_t": (("path_phase",), "1", "unloaded path of contact, toe 0 to heel 1"),
    "path_error": (("path_phase",), "rad", "transmission error of one pair"),
    "error": (("mesh_phase",), "rad", "unloaded transmission error, the gear lags"),
    "ease_off": (("ease_s", "ease_t"), "m", "gap to the conjugate gear flank"),
    "closest": (("ease_s", "ease_t"), "m", "least gap of the unloaded mesh"),
    "path_contact_ratio": ((), "1", "pitches over which the unloaded path is on both teeth"),
}


def design_dataset(design: Design, forms: dict[str, ToothForm]) -> xr.Dataset:
    """Return contact of both sides as cut, and form of both teeth; units as attributes.

    Parameters
    ----------
    design : Design
    forms : dict of str to ToothForm
        Of "pinion" and "gear".
    """
    sides = []
    for side in SIDES:
        found = unloaded_contact(FlankPair.from_file(design.as_cut, side))
        found["error"] = mesh_error(found["path_error"], 1.0 if side == "drive" else -1.0)
        sides.append(found)
    data = {
        name: (
            ("side", *dims),
            np.stack([side[name] for side in sides]),
            {"units": unit, "long_name": text},
        )
        for name, (dims, unit, text) in _VARIABLES.items()
    }
    for name, text in (
        ("topland", "normal width of the top"),
        ("slot", "normal width of the slot on the root cone"),
    ):
        data[name] = (
            ("member", "face"),
            np.stack([getattr(form, name) for form in forms.values()]),
            {"units": "m", "long_name": text},
        )
    for name in ("s", "t"):
        data[f"asked_{name}"] = (
            ("side",),
            np.array([getattr(design.targets[side], name) for side in SIDES]),
            {"units": "1", "long_name": "wanted mean contact on the gear"},
        )
    return xr.Dataset(
        data,
        coords={
            "side": list(SIDES),
            "member": list(forms),
            "face": forms["gear"].t,
            "path_phase": PATH_PHASES,
            "mesh_phase": np.arange(_FINER * _PERIOD) / (_FINER * _PERIOD),
            "ease_s": np.linspace(0.0, 1.0, EASE_GRID[0]),
            "ease_t": np.linspace(0.0, 1.0, EASE_GRID[1]),
        },
        attrs={
            "name": design.file.name,
            "gear_file": design.file.model_dump_json(exclude_none=True),
        },
    )


def mesh_error(path_error: Array, sign: float) -> Array:
    """Return the error over a mesh period [rad], (10 n,): that of the pair that touches first.

    Of points of contact within both flanks; where only edges would touch it is NaN. Between the
    positions of the path errors run straight: 0.02 urad off the parabola of 50 urad.

    Parameters
    ----------
    path_error : ndarray of shape (4 n + 1,)
        Error of one pair over four pitches [rad]; NaN off the teeth.
    sign : float
        +1 drive, -1 coast.
    """
    last = len(path_error) - 1
    fine = np.interp(np.arange(last * _FINER) / _FINER, np.arange(last + 1), sign * path_error)
    pairs = np.where(np.isnan(fine), np.inf, fine).reshape(-1, _FINER * _PERIOD)
    first = pairs.min(axis=0)
    return np.asarray(sign * np.where(np.isinf(first), np.nan, first))
