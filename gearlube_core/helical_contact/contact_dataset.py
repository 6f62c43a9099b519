"""Tooth contact analysis of a helical pair: labelled dataset and line mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, line_numbers, run_cycle
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    clip_line,
    line_position,
    segment_length,
)
from gearlube_core.helical_geometry.load_sharing import unrelieved_plane
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import Record
from gearlube_core.units import labelled

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
            "line": labelled(
                "line", line_numbers(pair), "1", "contact line by age; -1 enters next"
            ),
            "station": labelled(
                "station", settings.station, "1", "along a line, z_low 0 to z_high 1"
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


def line_mesh(modified: ModifiedPair, settings: CycleSettings, cycle: Record) -> LineMesh:
    """Return the line mesh of a loaded mesh period.

    k = d(w)/d(delta),  e = delta - w/k,  delta = r_bp cos(beta_b) (Theta - Theta_0)

    Parameters
    ----------
    modified : ModifiedPair
    settings : CycleSettings
        Those of `cycle`.
    cycle : Record
        From `run_cycle`.

    Raises
    ------
    ParameterError
        Load that no line of the plane of contact can take over.

    Notes
    -----
    Theta_0 is the least rotation to first touch of all phases. k is the change of the line load
    there while the gears close evenly: what one point's closing does to its neighbours is counted
    at the neighbours. Load and stiffness at corners, outside the plane of contact, are given to
    all stations of the phase in proportion, so that the sums over all lines are those of the
    loaded contact. Where a station carries nothing, k = 0 and e = delta.
    """
    pair, plane = modified.pair, modified.pair.plane
    arm = pair.pinion_base_radius * math.cos(pair.base_helix_angle)
    start = float(cycle["unloaded_rotation"].min())
    approach = arm * (cycle["rotation"] - start)
    lines = slice(1, -1)  # those that the plane of contact may hold
    count = cycle["line_load"].shape[2] - 2
    length = np.array(
        [
            [segment_length(clip_line(line_position(phase, i, plane), plane), plane)
             for i in range(count)]
            for phase in settings.phases
        ]
    )  # fmt: skip
    part = length[:, None, :, None] / settings.stations
    load, density = cycle["line_load"][:, :, lines], cycle["density"][:, :, lines]
    inside = arm * (load * part).sum(axis=(2, 3))
    stiff = arm**2 * (density * part).sum(axis=(2, 3))
    if not (inside > 0.5 * np.array(settings.torques)).all():
        raise ParameterError(
            "More than half of a torque is carried outside the plane of contact. Lower the "
            "torques, or relieve the tips."
        )
    load = load * (np.array(settings.torques) / inside)[..., None, None]
    density = density * (cycle["tangent"] / stiff)[..., None, None]
    closed = np.broadcast_to(approach[..., None, None], load.shape)
    offset = closed - np.divide(load, density, out=np.zeros_like(load), where=density > 0.0)
    offset = np.where((density > 0.0) & (load > 0.0), offset, closed)
    density = np.where(load > 0.0, density, 0.0)
    corner = 1.0 - inside / np.array(settings.torques)
    return LineMesh(
        name=pair.name,
        source="loaded tooth contact",
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        torque=np.array(settings.torques),
        phase=settings.phases,
        station=settings.station,
        density=density.swapaxes(0, 1),
        offset=offset.swapaxes(0, 1),
        provenance={
            "density": "inferred: tangent of the loaded contact under even closing; up to "
            f"{100.0 * corner.max():.2g} % corner contact spread over all lines",
            "offset": "inferred: from first contact of the mesh cycle",
        },
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSettings:
    """Loads and positions of an analysis, and the elastic bodies.

    Parameters
    ----------
    cycle : CycleSettings
    body : HelicalBodySettings
    """

    cycle: CycleSettings
    body: HelicalBodySettings = field(default_factory=HelicalBodySettings)


class HelicalContact(NamedTuple):
    """Results of a loaded mesh period: a dataset, and the line mesh for dynamics."""

    dataset: xr.Dataset
    line_mesh: LineMesh


def analyse_contact(
    modified: ModifiedPair,
    settings: ContactSettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    cycle_jobs: int | None = None,
    progress: Progress = no_progress,
) -> HelicalContact:
    """Return the loaded contact of a pair over a mesh period.

    Parameters
    ----------
    modified : ModifiedPair
        Gears with the modifications of their flanks.
    settings : ContactSettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    cycle_jobs : int, optional
        Processes for the positions, if other than `jobs`.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        When a tooth is pointed or cannot be meshed, or corners carry most of a torque.
    ConvergenceError
        When a position finds no equilibrium.
    """
    cycle = settings.cycle
    progress(0.0, "elastic teeth (kept for the next run)")
    stiffness = pair_stiffness(modified.pair, settings.body, cache=cache, jobs=jobs)
    progress(0.0, "loaded contact")
    record = run_cycle(
        modified, stiffness, cycle, store=store, jobs=cycle_jobs or jobs, progress=progress
    )
    return HelicalContact(
        contact_dataset(modified, cycle, record), line_mesh(modified, cycle, record)
    )
