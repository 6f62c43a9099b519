"""Tooth contact analysis of a hypoid pair, and its results as one labelled dataset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import contact_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import closest_approach, ease_off
from gearlube_core.hypoid_contact.mesh_cycle import (
    MAP_SHAPE,
    PAIRS_BESIDE,
    SIDES,
    CycleSettings,
    Record,
    run_cycle,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_contact.unloaded_error import contact_ratio
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.units import labelled

PATH_POSITIONS = 161  # of the unloaded path of contact, over four pitches
ERROR_POSITIONS = 64  # of the unloaded transmission error, over one
EASE_GRID = (21, 41)
_LOADED = 0.85  # of the time
_REACH = 2.0  # pitches to either side of the reference points
PATH_PHASES = np.linspace(-_REACH, _REACH, PATH_POSITIONS)

_PAIR_DIMS = ("side", "phase", "torque", "pair")
_STATE_DIMS = ("side", "phase", "torque")
_UNITS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "rotation": (_STATE_DIMS, "rad", "pinion rotation under load beyond the teeth ratio"),
    "gear_torque": (_STATE_DIMS, "N.m", "torque on the gear"),
    "strain_energy": (_STATE_DIMS, "J", "strain energy"),
    "k_m": (_STATE_DIMS, "N/m", "secant mesh stiffness along the line of action"),
    "k_t": (_STATE_DIMS, "N/m", "tangent mesh stiffness along the line of action"),
    "R_p": (_STATE_DIMS, "m", "arm of the mesh force about the pinion axis"),
    "R_g": (_STATE_DIMS, "m", "arm of the mesh force about the gear axis"),
    "n": ((*_STATE_DIMS, "axis"), "1", "direction of the mesh force"),
    "share": (_PAIR_DIMS, "1", "part of the pinion torque"),
    "pressure_max": (_PAIR_DIMS, "Pa", "highest pressure of the pair"),
    "gear_s": (_PAIR_DIMS, "1", "centre of force on the gear, root 0 to tip 1"),
    "gear_t": (_PAIR_DIMS, "1", "centre of force on the gear, toe 0 to heel 1"),
    "R_x": (_PAIR_DIMS, "m", "relative radius along the minor axis of the contact ellipse"),
    "R_y": (_PAIR_DIMS, "m", "relative radius along the major axis"),
    "R_sliding": (_PAIR_DIMS, "m", "relative radius along the sliding direction"),
    "psi": (_PAIR_DIMS, "rad", "entrainment from the minor axis"),
    "chi": (_PAIR_DIMS, "rad", "sliding direction from the minor axis"),
    "entrainment_arm": (_PAIR_DIMS, "m", "mean surface speed per pinion speed"),
    "sliding_arm": (_PAIR_DIMS, "m", "sliding speed per pinion speed"),
    "friction_arm_p": (_PAIR_DIMS, "m", "arm of friction about the pinion axis"),
    "friction_arm_g": (_PAIR_DIMS, "m", "arm of friction about the gear axis"),
    "xi": ((*_PAIR_DIMS, "axis"), "1", "direction of the pinion's sliding over the gear"),
    "minor_axis": ((*_PAIR_DIMS, "axis"), "1", "direction of the contact ellipse's minor axis"),
    "pressure_map": (("side", "torque", "map_s", "map_t"), "Pa", "highest pressure over the mesh"),
    "pressure_cells": (
        ("side", "phase", "torque", "map_s", "map_t"),
        "Pa",
        "highest pressure at a mesh phase, all pairs on one flank",
    ),
    "error": (("side", "fine_phase"), "rad", "unloaded transmission error, the gear lags"),
    "e": (("side", "fine_phase"), "m", "the same along the line of action"),
    "path_s": (("side", "path_phase"), "1", "unloaded path of contact, root 0 to tip 1"),
    "path_t": (("side", "path_phase"), "1", "unloaded path of contact, toe 0 to heel 1"),
    "path_error": (("side", "path_phase"), "rad", "transmission error of one pair"),
    "ease_off": (("side", "ease_s", "ease_t"), "m", "gap to the conjugate gear flank"),
    "closest": (("side", "ease_s", "ease_t"), "m", "least gap of the unloaded mesh"),
    "path_contact_ratio": (("side",), "1", "pitches over which the unloaded path is on both teeth"),
}


def contact_dataset(
    file: HypoidGearFile, settings: CycleSettings, cycle: Mapping[Side, Record]
) -> xr.Dataset:
    """Return the analysis as a dataset; every variable has `units` and `long_name`.

    Parameters
    ----------
    file : HypoidGearFile
    settings : CycleSettings
        Those of `cycle`.
    cycle : mapping of side to Record
        From `run_cycle`.

    Notes
    -----
    `torque` is the magnitude of the pinion torque on the side. Signs of `n`, `error` and `e` as in
    docs/conventions.md. Where a pair carries nothing its data are NaN.
    """
    sides = [
        side_contact(FlankPair.from_file(file, side, settings.misalignment), cycle[side], settings)
        for side in SIDES
    ]
    data = {
        name: (dims, np.stack([part[name] for part in sides]), {"units": unit, "long_name": text})
        for name, (dims, unit, text) in _UNITS.items()
    }
    coords: dict[str, Any] = {
        "side": list(SIDES),
        "phase": ("phase", settings.phases, {"units": "1", "long_name": "mesh phase"}),
        "torque": labelled("torque", list(settings.torques), "N.m", "pinion torque"),
        "axis": ["x", "y", "z"],
    }
    places: dict[str, tuple[NDArray[Any], str]] = {
        "pair": (np.arange(-PAIRS_BESIDE, PAIRS_BESIDE + 1), "pair of teeth, 0 in the middle"),
        "map_s": ((np.arange(MAP_SHAPE[0]) + 0.5) / MAP_SHAPE[0], "root 0 to tip 1"),
        "map_t": ((np.arange(MAP_SHAPE[1]) + 0.5) / MAP_SHAPE[1], "toe 0 to heel 1"),
        "fine_phase": (np.arange(ERROR_POSITIONS) / ERROR_POSITIONS, "mesh phase"),
        "path_phase": (PATH_PHASES, "mesh phase of one pair"),
        "ease_s": (np.linspace(0.0, 1.0, EASE_GRID[0]), "root 0 to tip 1"),
        "ease_t": (np.linspace(0.0, 1.0, EASE_GRID[1]), "toe 0 to heel 1"),
    }
    coords |= {
        name: (name, values, {"units": "1", "long_name": text})
        for name, (values, text) in places.items()
    }
    return xr.Dataset(
        data,
        coords=coords,
        attrs={
            "name": file.name,
            "source": file.source,
            "pinion_teeth": file.pinion.teeth,
            "gear_teeth": file.gear.teeth,
            "face_width": file.gear.face_width_mm * 1e-3,
            "gear_file": file.model_dump_json(exclude_none=True, exclude_unset=True),
        },
    )


def side_contact(pair: FlankPair, cycle: Record, settings: CycleSettings) -> dict[str, Array]:
    """Return what `contact_dataset` keeps of one side, in its names, units and grids."""
    unloaded = unloaded_contact(pair) | {"error": mesh_error(pair)}
    torque = np.array(settings.torques)
    force = np.linalg.norm(cycle["force"], axis=-1)
    R_p = torque / force
    fine = np.append(unloaded["error"], unloaded["error"][0])
    grid = np.linspace(0.0, 1.0, ERROR_POSITIONS + 1)
    touching = pair.touching_sign * np.interp(settings.phases, grid, fine)
    closing = cycle["rotation"] - touching[:, None]
    if np.any(closing <= 0.0):
        raise ParameterError(
            f"The {pair.side} flanks close by {np.min(closing):.3g} rad under load, which must not "
            "be below 0: unloaded and loaded contact disagree. Use more cells or higher torques."
        )
    pair_torque = cycle["pair_torque"]
    result = {
        "rotation": cycle["rotation"],
        "gear_torque": cycle["gear_torque"],
        "strain_energy": cycle["strain_energy"],
        "k_m": torque / closing / R_p**2,
        "k_t": cycle["tangent"] / R_p**2,
        "R_p": R_p,
        "R_g": cycle["gear_torque"] / force,
        "n": pair.touching_sign * cycle["force"] / force[..., None],
        "share": pair_torque / pair_torque.sum(axis=-1, keepdims=True),
        "pressure_max": cycle["pressure_max"],
        "gear_s": cycle["gear_position"][..., 0],
        "gear_t": cycle["gear_position"][..., 1],
        "pressure_map": cycle["pressure_map"].max(axis=0),
        "pressure_cells": cycle["pressure_map"].astype(np.float32),
        **_pair_kinematics(pair, cycle, settings),
        **unloaded,
    }
    result["e"] = R_p[:, 0].mean() * unloaded["error"]
    return result


def unloaded_contact(pair: FlankPair) -> dict[str, Array]:
    """Return path of contact, its errors, ease-off and closest approach of a side without load.

    The names, units and grids are those of `contact_dataset`.
    """
    path = contact_path(pair, PATH_PHASES * pair.gear_pitch)
    inside = path.inside
    ease = ease_off(pair, s_count=EASE_GRID[0], t_count=EASE_GRID[1])
    return {
        "path_s": np.where(inside, path.gear_s, np.nan),
        "path_t": np.where(inside, path.gear_t, np.nan),
        "path_error": np.where(inside, path.transmission_error, np.nan),
        "ease_off": ease.normal_gap(),
        "closest": closest_approach(ease),
        "path_contact_ratio": np.array(contact_ratio(pair)),
    }


def mesh_error(pair: FlankPair) -> Array:
    """Return the error of the pair that touches first at each fine phase [rad], unloaded."""
    phases = np.arange(ERROR_POSITIONS) / ERROR_POSITIONS
    shifts = np.arange(-PAIRS_BESIDE, PAIRS_BESIDE + 1)
    angles = (phases[None, :] + shifts[:, None]) * pair.gear_pitch
    error = searched_transmission_error(pair, angles.ravel()).error.reshape(angles.shape)
    first = np.nanmin(pair.touching_sign * error, axis=0)
    return np.asarray(pair.touching_sign * first)


def _pair_kinematics(pair: FlankPair, cycle: Record, settings: CycleSettings) -> dict[str, Array]:
    """Return curvature and motion at each pair's centre of force."""
    shape = cycle["pair_torque"].shape
    offsets = np.arange(-PAIRS_BESIDE, PAIRS_BESIDE + 1)
    phase = np.broadcast_to(settings.phases[:, None, None] + offsets, shape)
    rotation = np.broadcast_to(cycle["rotation"][..., None], shape)
    loaded = (cycle["pair_torque"] > 0.0) & np.isfinite(cycle["gear_position"][..., 0])
    gear = pair.gear.parameters(*np.moveaxis(cycle["gear_position"][loaded], -1, 0))
    pinion = pair.pinion.parameters(*np.moveaxis(cycle["pinion_position"][loaded], -1, 0))
    k = contact_kinematics(
        pair,
        phase[loaded] * pair.gear_pitch,
        phase[loaded] * pair.pinion_pitch + pair.touching_sign * rotation[loaded],
        gear,
        pinion,
    )
    along = np.abs(np.einsum("ni,ni->n", k.xi, k.minor_axis))
    across = np.abs(np.einsum("ni,ni->n", k.xi, k.major_axis))
    values = {
        "R_x": k.R_x,
        "R_y": k.R_y,
        "R_sliding": k.R_sliding,
        "psi": k.psi,
        "chi": np.arctan2(across, along),
        "entrainment_arm": k.entrainment_arm,
        "sliding_arm": np.linalg.norm(k.sliding, axis=1),
        "friction_arm_p": k.friction_arm_p,
        "friction_arm_g": k.friction_arm_g,
        "xi": k.xi,
        "minor_axis": k.minor_axis,
    }
    result = {}
    for name, value in values.items():
        full = np.full((*shape, *value.shape[1:]), np.nan)
        full[loaded] = value
        result[name] = full
    return result


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSettings:
    """Loads, positions and elastic teeth of a contact analysis, for `run_contact`.

    Parameters
    ----------
    cycle : CycleSettings
        Torques and mesh positions.
    body : ToothBodySettings
        Elastic teeth.

    Examples
    --------
    >>> from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
    >>> ContactSettings(cycle=CycleSettings(torques=(10.0, 50.0), positions=12)).cycle.positions
    12
    """

    cycle: CycleSettings = field(default_factory=CycleSettings)
    body: ToothBodySettings = field(default_factory=ToothBodySettings)


def analyse_contact(
    file: HypoidGearFile,
    settings: ContactSettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return the tooth contact of a gear file, unloaded and loaded, on both sides.

    Parameters
    ----------
    file : HypoidGearFile
    settings : ContactSettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        When the flanks do not meet; it takes seconds and names the setting that is likely wrong.
    ConvergenceError
        When a position finds no equilibrium.
    """
    progress(0.0, "checking the gear file")
    check_pair(file, settings.cycle.misalignment)
    progress(0.0, "elastic teeth")
    stiffness = pair_stiffness(file, settings.body, cache=cache, jobs=jobs)
    progress(0.0, "loaded contact")
    loaded = part_of(progress, 0.0, _LOADED)
    cycle = run_cycle(file, stiffness, settings.cycle, store=store, jobs=jobs, progress=loaded)
    progress(_LOADED, "unloaded contact")
    found = contact_dataset(file, settings.cycle, cycle)
    progress(1.0, "contact without load and under it is known")
    return found
