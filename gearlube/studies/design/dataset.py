"""Unloaded contact of a designed pair as one labelled dataset."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.design.findings import design_inputs, design_settings, design_warnings
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_dataset import EASE_GRID, PATH_PHASES, unloaded_contact
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_design.chosen_relief import LEAST
from gearlube_core.hypoid_design.design import Design, misses
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.tooth_form import ToothForm
from gearlube_core.input_file.input_file import InputNote
from gearlube_core.units import labelled

_PERIOD = round(1.0 / float(PATH_PHASES[1] - PATH_PHASES[0]))  # positions of the path a pitch
_FINER = 10  # times as many of the mesh, so that it shows where one pair takes over from another
_ASKED = (
    ("s", "1", "profile position of the mean contact on the gear"),
    ("t", "1", "face position of the mean contact on the gear"),
    ("error", "rad", "transmission error, peak to peak"),
    ("length", "m", "contact ellipse at 6.35 um"),
    ("path_angle", "rad", "direction of the path of contact on the gear flank"),
)
_MISSED = ("error", "path_angle", "centre", "length")
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
        name: labelled(("side", *dims), np.stack([side[name] for side in sides]), unit, text)
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
    data |= _asked_and_found(design)
    data |= _limits(forms)
    data |= _relief(design)
    return xr.Dataset(
        data,
        coords={
            "side": list(SIDES),
            "member": list(forms),
            "edge": list(LEAST),
            **{
                name: (name, values, {"units": "1"})
                for name, values in (
                    ("face", forms["gear"].t),
                    ("path_phase", PATH_PHASES),
                    ("mesh_phase", np.arange(_FINER * _PERIOD) / (_FINER * _PERIOD)),
                    ("ease_s", np.linspace(0.0, 1.0, EASE_GRID[0])),
                    ("ease_t", np.linspace(0.0, 1.0, EASE_GRID[1])),
                )
            },
        },
        attrs={
            "name": design.file.name,
            "gear_file": design.file.model_dump_json(exclude_none=True, exclude_unset=True),
            "method": design.designed.file.design_method,
            "cut": design.designed.file.machine.gear,
            "relief_torque": design.relief.torque,
            "warnings": json.dumps(design_warnings(design, forms)),
            "inputs": json.dumps(_noted(design_inputs(design))),
            "blank": json.dumps(_noted(design.designed.results())),
            "settings": json.dumps(design_settings(design)),
        },
    )


def _asked_and_found(design: Design) -> dict[str, Any]:
    """Return the numbers of the contact that were asked, those found, and how far they are."""
    found: dict[str, Any] = {}
    for name, unit, text in _ASKED:
        asked = [getattr(design.targets[side], name) for side in SIDES]
        values = [getattr(design.measured[side], name, math.nan) for side in SIDES]
        found[f"asked_{name}"] = (("side",), asked, {"units": unit, "long_name": f"asked: {text}"})
        found[f"found_{name}"] = (("side",), values, {"units": unit, "long_name": f"found: {text}"})
    relieved = [getattr(design.relieved[side], "error", math.nan) for side in SIDES]
    note = {"units": "rad", "long_name": "transmission error of flanks with relief"}
    found["relieved_error"] = (("side",), relieved, note)
    missed: list[Array] = [
        np.full(4, math.nan)
        if isinstance(one := design.measured[side], str)
        else misses(design.targets[side], one, design.designed)
        for side in SIDES
    ]
    for name, unit, values in zip(
        _MISSED, ("1", "rad", "m", "1"), np.transpose(missed), strict=True
    ):
        note = {"units": unit, "long_name": f"what the {name} missed"}
        found[f"missed_{name}"] = (("side",), values, note)
    return found


def _limits(forms: dict[str, ToothForm]) -> dict[str, Any]:
    """Return undercut, reach of the mate and module of both members."""
    deepest = [
        [float(one.s[one.undercut].max()) if one.undercut.any() else math.nan
         for one in (form.drive, form.coast)]
        for form in forms.values()
    ]  # fmt: skip
    return {
        "undercut": (
            ("member", "side"),
            deepest,
            {"units": "1", "long_name": "flank undercut below, root 0 to tip 1; NaN: not undercut"},
        ),
        "active": (
            ("member",),
            [form.active for form in forms.values()],
            {"units": "1", "long_name": "reach of the mate's tip, root 0 to tip 1"},
        ),
        "normal_module": labelled(
            ("member",), [form.normal_module for form in forms.values()], "m", "mean normal module"
        ),
    }


def _relief(design: Design) -> dict[str, Any]:
    """Return the relief of both sides, and the pressure with it."""
    relief = design.relief
    return {
        "relief": (
            ("side", "edge"),
            [[1e-6 * relief.amounts[side][edge] for edge in LEAST] for side in SIDES],
            {"units": "m", "long_name": "removed at the edge"},
        ),
        "relief_pressure": (
            ("side",),
            [relief.pressure[side] for side in SIDES],
            {"units": "Pa", "long_name": "highest pressure at the torque of the relief"},
        ),
    }


def _noted(notes: list[InputNote]) -> list[list[str]]:
    return [[one.field, one.value_text, one.unit, one.origin, one.why] for one in notes]


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
