"""Loaded contact over a mesh period: every phase and torque, in parallel, resumable."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.helical_contact.loaded_contact import (
    LoadedLine,
    LoadedSettings,
    LoadedState,
    MeshPosition,
)
from gearlube_core.helical_geometry.contact_line import clip_line, line_count
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import (
    MeshCycleSettings,
    compute_positions,
    stack_records,
)

_FORMAT = 1  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSettings(MeshCycleSettings):
    """Positions and loads of the mesh to analyse.

    Parameters
    ----------
    torques : tuple of float
        Pinion torques [N.m], rising, 0.001 to 1e6.
    positions : int
        Mesh phases in a period.
    stations : int
        Equal parts of a line's segment in the plane of contact, over which line loads are taken.
    loaded : LoadedSettings
    """

    torque_range: ClassVar[tuple[float, float]] = (1e-3, 1e6)

    positions: int = 24
    stations: int = 16
    loaded: LoadedSettings = field(default_factory=LoadedSettings)

    def __post_init__(self) -> None:
        MeshCycleSettings.__post_init__(self)
        check_within("stations", self.stations, 1, 200)

    @property
    def station(self) -> Array:
        """Middles of the stations along a segment, 0 at z_low to 1 at z_high [-], (stations,)."""
        return (np.arange(self.stations) + 0.5) / self.stations


def line_numbers(pair: HelicalPair) -> NDArray[np.int64]:
    """Return the numbers of the lines in a record's axis J: -1 to the most lines at once."""
    return np.arange(-1, line_count(pair.plane) + 1, dtype=np.int64)


def position_record(
    modified: ModifiedPair, stiffness: PairStiffness, settings: CycleSettings, phase: float
) -> Record:
    """Return the loaded contact at one mesh phase for all torques, as plain arrays.

    Leading dimension torque L; lines J of `line_numbers`; stations S.

    (L,): rotation, unloaded_rotation [rad], gear_torque [N.m], strain_energy [J],
    tangent [N.m/rad]. (L, J): line_torque [N.m], line_tangent [N.m/rad], corner_torque (part of
    line_torque outside the plane of contact) [N.m], pressure_max [Pa], z_low, z_high (loaded
    extent) [m]. (L, J, S): line_load [N/m] and its density d(w)/d(delta) [N/m2].
    """
    position = MeshPosition.at(modified, phase)
    rows: list[Record] = []
    closing, before = 0.0, 0.0
    for torque in settings.torques:
        state = position.load(
            torque, stiffness, settings.loaded, 1.1 * closing * torque / before if before else 0.0
        )
        closing, before = state.rotation - state.unloaded_rotation, torque
        rows.append(_state_record(modified.pair, state, settings))
    return stack_records(rows)


def _state_record(pair: HelicalPair, state: LoadedState, settings: CycleSettings) -> Record:
    count = line_numbers(pair).size
    record: Record = {
        "rotation": np.array(state.rotation),
        "unloaded_rotation": np.array(state.unloaded_rotation),
        "gear_torque": np.array(state.gear_torque),
        "strain_energy": np.array(state.strain_energy),
        "tangent": np.array(state.tangent),
    }
    for name in ("line_torque", "line_tangent", "corner_torque", "pressure_max"):
        record[name] = np.zeros(count)
    for name in ("z_low", "z_high"):
        record[name] = np.full(count, np.nan)
    for name in ("line_load", "density"):
        record[name] = np.zeros((count, settings.stations))
    arm = pair.pinion_base_radius * np.cos(pair.base_helix_angle)
    for line in state.lines:
        j = line.strip.line + 1
        record["line_torque"][j] = line.torque
        record["line_tangent"][j] = np.sum(line.tangents * line.strip.arm)
        record["pressure_max"][j] = line.pressure.max()
        record["z_low"][j], record["z_high"][j] = line.loaded_extent
        record["line_load"][j] = _per_station(pair, line, line.forces, settings.stations)
        densities = _per_station(pair, line, line.tangents, settings.stations) / arm
        record["density"][j] = np.maximum(densities, 0.0)
        inside = _inside(pair, line)
        record["corner_torque"][j] = line.torque - np.sum(line.forces * line.strip.arm * inside)
    return record


def _shares(pair: HelicalPair, line: LoadedLine, edges: Array) -> Array:
    """Return which part of each of the strip's rows lies between edges z, (rows, parts)."""
    z = line.strip.z
    width = z[1] - z[0]
    low, high = (z - 0.5 * width)[:, None], (z + 0.5 * width)[:, None]
    common = np.minimum(high, edges[1:]) - np.maximum(low, edges[:-1])
    return np.maximum(common, 0.0) / width


def _inside(pair: HelicalPair, line: LoadedLine) -> Array:
    """Return which part of each row lies in the plane of contact, (rows,)."""
    segment = clip_line(line.strip.X, pair.plane)
    return _shares(pair, line, np.array([segment.z_low, segment.z_high]))[:, 0]


def _per_station(pair: HelicalPair, line: LoadedLine, cells: Array, stations: int) -> Array:
    """Return sums over stations per length of the contact line, zero for an empty segment."""
    segment = clip_line(line.strip.X, pair.plane)
    length = (segment.z_high - segment.z_low) / np.cos(pair.base_helix_angle)
    if length <= 0.0:
        return np.zeros(stations)
    edges = np.linspace(segment.z_low, segment.z_high, stations + 1)
    return np.asarray(cells.sum(axis=0) @ _shares(pair, line, edges) * stations / length)


def run_cycle(
    modified: ModifiedPair,
    stiffness: PairStiffness,
    settings: CycleSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Record:
    """Return the loaded contact over a mesh period.

    Parameters
    ----------
    modified : ModifiedPair
    stiffness : PairStiffness
    settings : CycleSettings
    store : Path, optional
        Folder that keeps finished positions; they are not computed again.
    jobs : int, optional
        Processes; one runs in this process. Default: all processors.
    progress : callable, optional
        Called after each new position with the share done [-] and which position it was.

    Returns
    -------
    Record
        Arrays of `position_record` with a leading dimension of mesh phases.

    Raises
    ------
    ConvergenceError
        When a position finds no equilibrium.
    """
    phases = [float(phase) for phase in settings.phases]
    found = compute_positions(
        phases,
        partial(position_record, modified, stiffness, settings),
        key=_key(modified, stiffness, settings),
        folder=store,
        label=_label,
        jobs=jobs,
        progress=progress,
    )
    return stack_records(found[phase] for phase in phases)


def _label(phase: float) -> tuple[str, str]:
    return f"{phase:.6f}", f"loaded contact, mesh phase {phase:.2f}"


def _key(modified: ModifiedPair, stiffness: PairStiffness, settings: CycleSettings) -> str:
    digest = hashlib.sha256(f"helical mesh cycle {_FORMAT}".encode())
    digest.update(repr((modified, settings, stiffness.contact_modulus)).encode())
    for part in (stiffness.pinion, stiffness.gear):
        digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
