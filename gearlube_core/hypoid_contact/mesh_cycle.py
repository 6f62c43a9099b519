"""Loaded contact over a mesh cycle: every position, torque and side, in parallel, resumable."""

from __future__ import annotations

import hashlib
from dataclasses import asdict, dataclass, field
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, LoadedState, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment, tooth_position
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import (
    MeshCycleSettings,
    compute_positions,
    stack_records,
)

SIDES: tuple[Side, ...] = ("drive", "coast")
PAIRS_BESIDE = 2  # tooth pairs looked at before and after the one at the mesh phase
MAP_SHAPE = (24, 48)  # profile and face cells of the pressure map on the gear flank
_FORMAT = 2  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSettings(MeshCycleSettings):
    """Positions and loads of the mesh to analyse.

    Parameters
    ----------
    torques : tuple of float
        Pinion torques [N.m], rising, 0.01 to 1e5; used on either flank.
    positions : int
        Mesh phases in a period.
    loaded : LoadedSettings
    misalignment : Misalignment
    """

    torque_range: ClassVar[tuple[float, float]] = (1e-2, 1e5)

    torques: tuple[float, ...] = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 300.0, 400.0)
    positions: int = 20
    loaded: LoadedSettings = field(default_factory=LoadedSettings)
    misalignment: Misalignment = ALIGNED


def position_record(
    pair: FlankPair, phase: float, stiffness: PairStiffness, settings: CycleSettings
) -> Record:
    """Return the loaded contact at one mesh phase for all torques, as plain arrays.

    Leading dimension torque (L); pairs J = 2 PAIRS_BESIDE + 1: rotation, unloaded_rotation [rad],
    gear_torque [N.m], strain_energy [J], tangent [N.m/rad], force (L, 3) [N], pair_torque (L, J)
    [N.m], pressure_max (L, J) [Pa], gear_position, pinion_position (L, J, 2) [-] (s, t of the
    centre of force), pressure_map (L, *MAP_SHAPE) [Pa].
    """
    position = MeshPosition.at(pair, phase, PAIRS_BESIDE)
    states: list[LoadedState] = []
    closing = 0.0
    for torque in settings.torques:
        state = position.load(torque, stiffness, settings.loaded, closing)
        states.append(state)
        arm = torque / float(np.linalg.norm(state.force))
        closing = 1.3 * arm * (state.rotation - state.unloaded_rotation)
        following = [t for t in settings.torques if t > torque]
        if following:
            closing *= following[0] / torque
    return stack_records(_state_record(pair, position, state) for state in states)


def _state_record(pair: FlankPair, position: MeshPosition, state: LoadedState) -> Record:
    count = len(position.phases)
    torque, pressure = np.zeros(count), np.zeros(count)
    centres = np.full((2, count, 2), np.nan)
    pressure_map = np.zeros(MAP_SHAPE)
    for loaded in state.pairs:
        j = position.phases.index(loaded.phase)
        torque[j], pressure[j] = loaded.torque, loaded.pressure.max()
        touching = loaded.forces > 0.0
        if not touching.any():
            continue
        weights = loaded.forces[touching] / loaded.forces[touching].sum()
        for k, (flank, parameters) in enumerate(
            (
                (pair.gear, loaded.strip.gear_parameters),
                (pair.pinion, loaded.strip.pinion_parameters),
            )
        ):
            s, t = tooth_position(flank, flank.sample_parameters(parameters[touching]).r)
            centres[k, j] = weights @ s, weights @ t
            if k == 0:
                row = np.clip((s * MAP_SHAPE[0]).astype(int), 0, MAP_SHAPE[0] - 1)
                column = np.clip((t * MAP_SHAPE[1]).astype(int), 0, MAP_SHAPE[1] - 1)
                np.maximum.at(pressure_map, (row, column), loaded.pressure[touching])
    return {
        "rotation": np.array(state.rotation),
        "unloaded_rotation": np.array(state.unloaded_rotation),
        "gear_torque": np.array(state.gear_torque),
        "strain_energy": np.array(state.strain_energy),
        "tangent": np.array(state.tangent),
        "force": state.force,
        "pair_torque": torque,
        "pressure_max": pressure,
        "gear_position": centres[0],
        "pinion_position": centres[1],
        "pressure_map": pressure_map,
    }


def run_cycle(
    file: HypoidGearFile,
    stiffness: dict[Side, PairStiffness],
    settings: CycleSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> dict[Side, Record]:
    """Return the loaded contact over a mesh cycle on both sides.

    Parameters
    ----------
    file : HypoidGearFile
    stiffness : dict of side to PairStiffness
    settings : CycleSettings
    store : Path, optional
        Folder that keeps finished positions; they are not computed again.
    jobs : int, optional
        Processes; one runs in this process. Default: all processors.
    progress : callable, optional
        Called after each new position with the share done [-] and which position it was.

    Returns
    -------
    dict of side to Record
        Arrays of `position_record` with a leading dimension of mesh phases.

    Raises
    ------
    ParameterError
        When a cutter leaves no flank or the settings are out of range.
    ConvergenceError
        When a position finds no equilibrium.
    """
    pairs = {side: FlankPair.from_file(file, side, settings.misalignment) for side in SIDES}
    found = compute_positions(
        [(side, float(phase)) for side in SIDES for phase in settings.phases],
        partial(_record_of, pairs, stiffness, settings),
        key=_key(file, stiffness, settings),
        folder=store,
        label=_label,
        jobs=jobs,
        progress=progress,
    )
    return {
        side: stack_records(found[side, float(phase)] for phase in settings.phases)
        for side in SIDES
    }


def _record_of(
    pairs: dict[Side, FlankPair],
    stiffness: dict[Side, PairStiffness],
    settings: CycleSettings,
    position: tuple[Side, float],
) -> Record:
    side, phase = position
    return position_record(pairs[side], phase, stiffness[side], settings)


def _label(position: tuple[Side, float]) -> tuple[str, str]:
    side, phase = position
    return f"{side}_{phase:.6f}", f"{side} flanks, mesh phase {phase:.2f}"


def _key(
    file: HypoidGearFile, stiffness: dict[Side, PairStiffness], settings: CycleSettings
) -> str:
    digest = hashlib.sha256(f"mesh cycle {_FORMAT}".encode())
    digest.update(file.model_dump_json(exclude={"tolerances"}).encode())
    digest.update(repr(asdict(settings)).encode())
    for side in SIDES:
        digest.update(repr(stiffness[side].contact_modulus).encode())
        for part in (stiffness[side].pinion, stiffness[side].gear):
            digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
