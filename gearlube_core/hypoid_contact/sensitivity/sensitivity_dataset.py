"""Results of a sensitivity analysis as one labelled dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE, SIDES
from gearlube_core.hypoid_contact.sensitivity.parameter import Parameter
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.resumable import Record

_EASE = ("ease_s", "ease_t")
_PHASE = ("phase",)
UNITS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "unloaded_pp": ((), "rad", "unloaded transmission error, peak to peak, at the pinion"),
    "unloaded_s": ((), "1", "unloaded mean contact on the gear, root 0 to tip 1"),
    "unloaded_t": ((), "1", "unloaded mean contact on the gear, toe 0 to heel 1"),
    "ease_off": (_EASE, "m", "gap to the conjugate gear flank"),
    "te_pp": ((), "rad", "loaded transmission error, peak to peak, at the pinion"),
    "te_1": ((), "rad", "first mesh order of the loaded transmission error, amplitude"),
    "rotation": (_PHASE, "rad", "pinion rotation under load beyond the teeth ratio"),
    "touching": (_PHASE, "rad", "the same without load, at the first of the loaded cells"),
    "gear_torque": (_PHASE, "N.m", "torque on the gear"),
    "force": (_PHASE, "N", "mesh force"),
    "secant_stiffness": (_PHASE, "N/m", "secant mesh stiffness along the line of action"),
    "pressure_max": (_PHASE, "Pa", "pressure in the cell that carries most"),
    "sliding_loss": (_PHASE, "1", "sliding power over power, per coefficient of friction"),
    "s": (_PHASE, "1", "centre of force on the gear, root 0 to tip 1"),
    "t": (_PHASE, "1", "centre of force on the gear, toe 0 to heel 1"),
    "share": (("phase", "pair"), "1", "part of the pinion torque"),
}


def sensitivity_dataset(
    file: HypoidGearFile,
    parameters: Sequence[Parameter],
    parts: Mapping[Side, Record],
    phases: Array,
    places: tuple[Array, Array],
    torque: float,
) -> xr.Dataset:
    """Return values and rates of both sides; every variable has `units` and `long_name`.

    A rate has the name of its quantity with `_rate`, a dimension `parameter`, and is per unit of
    the parameter: `unit` along that dimension. `tolerance` there is a small change to compare
    parameters by (`Parameter.tolerance`).

    Parameters
    ----------
    file : HypoidGearFile
    parameters : sequence of Parameter
    parts : mapping of side to Record
        Values and rates; those of positions with a leading dimension of phases.
    phases : ndarray of shape (N,)
    places : tuple of ndarray
        Profile and face positions of the ease-off.
    torque : float
        [N.m]
    """
    whole = {side: {**parts[side], **_cycle_error(parts[side])} for side in SIDES}
    data: dict[str, Any] = {}
    for name, (dims, unit, text) in UNITS.items():
        values = np.stack([whole[side][name] for side in SIDES])
        rates = np.stack(
            [
                # positions lead what each of them has
                np.moveaxis(whole[side][f"{name}_rate"], 1, 0)
                if "phase" in dims
                else whole[side][f"{name}_rate"]
                for side in SIDES
            ]
        )
        data[name] = (("side", *dims), values, {"units": unit, "long_name": text})
        data[f"{name}_rate"] = (
            ("side", "parameter", *dims),
            rates,
            {"units": f"{unit} per unit of the parameter", "long_name": f"rate of: {text}"},
        )
    own, one_each = {"units": "unit of the parameter"}, {"units": "1"}
    return xr.Dataset(
        data,
        coords={
            "side": list(SIDES),
            "parameter": [one.name for one in parameters],
            "unit": ("parameter", [one.unit for one in parameters]),
            "value": ("parameter", [one.value for one in parameters], own),
            "tolerance": ("parameter", [one.tolerance for one in parameters], own),
            "phase": ("phase", phases, {"units": "1", "long_name": "mesh phase"}),
            "pair": ("pair", np.arange(-PAIRS_BESIDE, PAIRS_BESIDE + 1), one_each),
            "ease_s": ("ease_s", places[0], one_each),
            "ease_t": ("ease_t", places[1], one_each),
        },
        attrs={
            "name": file.name,
            "torque": torque,
            "gear_file": file.model_dump_json(exclude_none=True, exclude_unset=True),
        },
    )


def _cycle_error(part: Record) -> Record:
    """Return peak to peak and first mesh order of the loaded error, and their rates."""
    rotation, rate = part["rotation"], part["rotation_rate"]
    high, low = int(np.argmax(rotation)), int(np.argmin(rotation))
    wave = np.exp(-2j * np.pi * np.arange(rotation.size) / rotation.size) * 2.0 / rotation.size
    order = rotation @ wave
    return {
        "te_pp": np.array(rotation[high] - rotation[low]),
        "te_pp_rate": rate[high] - rate[low],
        "te_1": np.array(abs(order)),
        "te_1_rate": np.real(np.conj(order) * (wave @ rate)) / abs(order),
    }
