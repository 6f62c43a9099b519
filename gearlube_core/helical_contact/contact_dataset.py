"""Loaded contact of a helical pair as a labelled dataset: stiffness, sharing, Harris map."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, line_numbers
from gearlube_core.helical_geometry.contact_line import ContactPlane, clip_line, line_position
from gearlube_core.helical_geometry.load_sharing import unrelieved_plane
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.storage.result_store import Record

_STATE, _LINE = ("phase", "torque"), ("phase", "torque", "line")
_UNITS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "transmission_error": (_STATE, "m", "pinion ahead of the gear along the line of action"),
    "transmission_error_ptp": (("torque",), "m", "its range over the mesh: the Harris map"),
    "unloaded_error": (("phase",), "m", "the same at first touch, without load"),
    "K": (_STATE, "N/m", "mesh stiffness along the line of action, secant from Theta = 0"),
    "K_tangent": (_STATE, "N/m", "tangent mesh stiffness along the line of action"),
    "K_line": (_LINE, "N/m", "stiffness function of a tooth pair (He et al. 2007 eq. (1))"),
    "share": (_LINE, "1", "part of the pinion torque"),
    "length_share": (("phase", "line"), "1", "part of the length of all contact lines"),
    "contact_length": (("phase", "line"), "m", "of a line in the plane of contact"),
    "corner_share": (_STATE, "1", "part of the pinion torque outside the plane of contact"),
    "relief_length": (_LINE, "m", "loaded length in tip relief or beyond the plane of contact"),
    "loaded_length": (_LINE, "m", "loaded length of a line"),
    "pressure_max": (
        _LINE,
        "Pa",
        "highest pressure; at tip and side edges it rises with finer cells",
    ),
    "line_load": ((*_LINE, "station"), "N/m", "normal force per length of the line"),
    "gear_torque": (_STATE, "N.m", "torque on the gear"),
    "strain_energy": (_STATE, "J", "strain energy"),
}


def contact_dataset(modified: ModifiedPair, settings: CycleSettings, cycle: Record) -> xr.Dataset:
    """Return a loaded mesh period as a dataset; every variable has `units` and `long_name`.

    Parameters
    ----------
    modified : ModifiedPair
    settings : CycleSettings
        Those of `cycle`.
    cycle : Record
        From `run_cycle`.

    Notes
    -----
    K_line = (T_i/r_bp)/(r_bp Theta): N_i of [he_2007 (1)] is taken along the line of
    action, so that the sum is the mesh stiffness felt by the rotation. Theta counts from where
    unmodified rigid flanks touch; with modified flanks K therefore contains their removal.
    """
    pair = modified.pair
    r_bp, torque = pair.pinion_base_radius, np.array(settings.torques)
    cos_b = math.cos(pair.base_helix_angle)
    error = r_bp * cycle["rotation"]
    nominal = _segments(modified, settings, pair.plane)
    length = np.maximum(nominal[..., 1] - nominal[..., 0], 0.0) / cos_b
    loaded = np.nan_to_num(cycle["z_high"] - cycle["z_low"]) / cos_b
    plain = _segments(modified, settings, unrelieved_plane(modified))[:, None]
    common = np.minimum(cycle["z_high"], plain[..., 1]) - np.maximum(cycle["z_low"], plain[..., 0])
    values = {
        "transmission_error": error,
        "transmission_error_ptp": np.ptp(error, axis=0),
        "unloaded_error": r_bp * cycle["unloaded_rotation"][:, 0],
        "K": torque / r_bp / error,
        "K_tangent": cycle["tangent"] / r_bp**2,
        "K_line": cycle["line_torque"] / r_bp / error[..., None],
        "share": cycle["line_torque"] / torque[:, None],
        "length_share": length / length.sum(axis=1, keepdims=True),
        "contact_length": length,
        "corner_share": cycle["corner_torque"].sum(axis=-1) / torque,
        "relief_length": loaded - np.maximum(np.nan_to_num(common), 0.0) / cos_b,
        "loaded_length": loaded,
        "pressure_max": cycle["pressure_max"],
        "line_load": cycle["line_load"],
        "gear_torque": cycle["gear_torque"],
        "strain_energy": cycle["strain_energy"],
    }
    return xr.Dataset(
        {
            name: (dims, values[name], {"units": unit, "long_name": text})
            for name, (dims, unit, text) in _UNITS.items()
        },
        coords={
            "phase": ("phase", settings.phases, {"units": "1", "long_name": "mesh phase"}),
            "torque": ("torque", torque, {"units": "N.m", "long_name": "pinion torque"}),
            "line": (
                "line",
                line_numbers(pair),
                {"units": "1", "long_name": "contact line by age; -1 enters next"},
            ),
            "station": (
                "station",
                settings.station,
                {"units": "1", "long_name": "along a line, z_low 0 to z_high 1"},
            ),
        },
        attrs={
            "name": pair.name,
            "pinion_teeth": pair.pinion_teeth,
            "gear_teeth": pair.gear_teeth,
            "base_pitch": pair.base_pitch,
        },
    )


def _segments(modified: ModifiedPair, settings: CycleSettings, plane: ContactPlane) -> Array:
    """Return z_low and z_high of every line in a part of the plane of contact, (N, J, 2) [m]."""
    whole = modified.pair.plane  # lines are counted from its start
    segments = np.empty((settings.positions, line_numbers(modified.pair).size, 2))
    for n, phase in enumerate(settings.phases):
        for j, line in enumerate(line_numbers(modified.pair)):
            segment = clip_line(line_position(float(phase), int(line), whole), plane)
            segments[n, j] = segment.z_low, segment.z_high
    return segments
