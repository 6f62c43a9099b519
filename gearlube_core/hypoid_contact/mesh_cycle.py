"""Loaded contact over a mesh cycle: every position, torque and side, in parallel, resumable."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.loaded_contact import (
    LoadedSettings,
    LoadedState,
    MeshPosition,
    PairStiffness,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placed_flank import tooth_position
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.result_store import ARRAYS, Record, ResultStore
from gearlube_core.storage.resumable import resumable_results

SIDES: tuple[Side, ...] = ("drive", "coast")
PAIRS_BESIDE = 2  # tooth pairs looked at before and after the one at the mesh phase
MAP_SHAPE = (24, 48)  # profile and face cells of the pressure map on the gear flank
_FORMAT = 2  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSettings:
    """Which positions and loads of the mesh are analysed.

    Parameters
    ----------
    positions : int
        Mesh phases in a period.
    torques : tuple of float
        Pinion torques [N.m], rising, above zero; used on either flank.
    loaded : LoadedSettings
    misalignment : Misalignment
    """

    positions: int = 20
    torques: tuple[float, ...] = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 300.0, 400.0)
    loaded: LoadedSettings = field(default_factory=LoadedSettings)
    misalignment: Misalignment = ALIGNED

    def __post_init__(self) -> None:
        check_within("positions", self.positions, 4, 400)
        for torque in self.torques:
            check_within("torques", torque, 1e-2, 1e5, "N.m")
        if not self.torques or any(np.diff(self.torques) <= 0.0):
            raise ParameterError(f"torques must rise [N.m], got {self.torques}. Sort them.")

    @property
    def phases(self) -> Array:
        """Mesh phases [mesh periods], (positions,)."""
        return np.arange(self.positions) / self.positions


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
    rows = [_state_record(pair, position, state) for state in states]
    return {key: np.stack([row[key] for row in rows]) for key in rows[0]}


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


@dataclass(frozen=True, slots=True)
class CycleProgress:
    """How far an analysis has come."""

    done: int
    total: int
    side: Side
    phase: float


def run_cycle(
    file: HypoidGearFile,
    stiffness: dict[Side, PairStiffness],
    settings: CycleSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    observer: Callable[[CycleProgress], None] | None = None,
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
    observer : callable, optional
        Called after each position.

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
    tasks = [(side, float(phase)) for side in SIDES for phase in settings.phases]
    found: dict[tuple[Side, float], Record] = {}
    key = _key(file, stiffness, settings)
    for task, record, stored in resumable_results(
        tasks,
        lambda task: f"{key}_{task[0]}_{task[1]:.6f}",
        _position,
        ResultStore(store, ARRAYS),
        ProcessPool(jobs=jobs, prepare=_prepare, arguments=(file, stiffness, settings)),
    ):
        found[task] = record
        if observer is not None and not stored:
            observer(CycleProgress(len(found), len(tasks), *task))
    return {
        side: {
            name: np.stack([found[side, float(phase)][name] for phase in settings.phases])
            for name in found[side, 0.0]
        }
        for side in SIDES
    }


_work: dict[str, object] = {}  # what every position of a run shares, set once in each process


def _prepare(
    file: HypoidGearFile, stiffness: dict[Side, PairStiffness], settings: CycleSettings
) -> None:
    _work["pairs"] = {
        side: FlankPair.from_file(file, side, settings.misalignment) for side in SIDES
    }
    _work["stiffness"] = stiffness
    _work["settings"] = settings


def _position(task: tuple[Side, float]) -> Record:
    side, phase = task
    pairs, stiffness = _work["pairs"], _work["stiffness"]
    return position_record(pairs[side], phase, stiffness[side], _work["settings"])  # type: ignore[index, arg-type]


def _key(
    file: HypoidGearFile, stiffness: dict[Side, PairStiffness], settings: CycleSettings
) -> str:
    digest = hashlib.sha256(f"mesh cycle {_FORMAT}".encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr(asdict(settings)).encode())
    for side in SIDES:
        digest.update(repr(stiffness[side].contact_modulus).encode())
        for part in (stiffness[side].pinion, stiffness[side].gear):
            digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
