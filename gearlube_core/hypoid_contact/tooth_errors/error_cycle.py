"""Transmission error of a pair whose teeth differ, over its hunting turn and by shaft orders."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE, SIDES, CycleSettings
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.tooth_errors.pair_curves import (
    SAMPLES,
    TurnProblem,
    position_curves,
)
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.tooth_errors import MemberErrors, ToothErrors
from gearlube_core.mesh_table.table import MEMBERS, ZERO_PHASE, MeshTable
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import compute_positions, stack_records

_POSITIONS_PER_ORDER = 4  # as in the mesh table: what is above folds onto the rest
_MOST_ORDERS = 8  # kept of those that repeat with the hunting turn alone
_NOTHING = 1e-9  # of the largest error: rounding
_FORMAT = 2  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothErrorCycle:
    """Transmission error that errors of single teeth add to a mesh table.

    Parameters
    ----------
    phases : ndarray of shape (P,)
        Mesh phases [mesh periods].
    torque : ndarray of shape (L,)
        Signed pinion torque of the table's levels [N.m].
    error : ndarray of shape (L, H, P)
        Added error [m] after 0 to H - 1 mesh periods; after H the same teeth meet again.
    pinion_teeth, gear_teeth : int
    alike : tuple of str
        Members of which all teeth are alike.
    """

    phases: Array
    torque: Array
    error: Array
    pinion_teeth: int
    gear_teeth: int
    alike: tuple[str, ...]

    def turns(self) -> tuple[dict[str, Array], Array]:
        """Return the parts that repeat with pinion and with gear, and the rest's rms, all in [m].

        Returns
        -------
        parts : dict of str to ndarray of shape (L, z P)
            Over one turn of the member. What repeats with the mesh is in the first member whose
            teeth differ.
        rest : ndarray of shape (L,)
            Root mean square of what repeats with the hunting turn alone.
        """
        parts, rest = self._parts()
        return parts, np.sqrt(np.mean(rest**2, axis=(1, 2)))

    def _parts(self) -> tuple[dict[str, Array], Array]:
        """Return the parts of `turns`, and the rest (L, H, P) [m]."""
        levels, meshes, positions = self.error.shape
        rest = self.error.copy()
        parts = {}
        for member, teeth in zip(MEMBERS, (self.pinion_teeth, self.gear_teeth), strict=True):
            if member in self.alike:
                continue
            own = rest.reshape(levels, meshes // teeth, teeth, positions).mean(axis=1)
            rest -= np.tile(own, (1, meshes // teeth, 1))
            parts[member] = own.reshape(levels, teeth * positions)
        return parts, rest

    def hunting_orders(self) -> tuple[Array, Array]:
        """Return the largest orders of what repeats with the hunting turn alone.

        They are no whole numbers of either member's turn, and are not in the mesh table.

        Returns
        -------
        orders : ndarray of shape (K,)
            Of the pinion's turn [-], at most eight, the largest amplitude first; times gear teeth
            over pinion teeth they are those of the gear's turn.
        amplitudes : ndarray of shape (L, K)
            [m]
        """
        rest = self._parts()[1]
        levels, meshes, positions = rest.shape
        samples = meshes * positions
        spectrum = np.abs(np.fft.rfft(rest.reshape(levels, samples), axis=1)) * (2.0 / samples)
        spectrum = spectrum[:, : samples // _POSITIONS_PER_ORDER + 1]
        size = spectrum.max(axis=0)
        largest = np.argsort(-size)[:_MOST_ORDERS]
        largest = largest[size[largest] > _NOTHING * np.abs(self.error).max()]
        return largest * (self.pinion_teeth / meshes), spectrum[:, largest]

    def orders(self) -> dict[str, Array]:
        """Return cosine and sine coefficients [m] by orders 1, 2, ... of each member, (L, N, 2)."""
        found = {}
        for member, turn in self.turns()[0].items():
            samples = turn.shape[1]
            orders = np.arange(1, samples // _POSITIONS_PER_ORDER + 1)
            spectrum = (np.fft.rfft(turn, axis=1) * (2.0 / samples))[:, 1 : orders.size + 1]
            # the first sample is at mesh phase zero, pinion angle zero at ZERO_PHASE
            start = -2.0 * math.pi * ZERO_PHASE / (samples / self.phases.size)
            spectrum = spectrum * np.exp(-1j * orders * start)
            found[member] = np.stack([spectrum.real, -spectrum.imag], axis=2)
        return found

    def added_to(self, table: MeshTable) -> MeshTable:
        """Return the mesh table with these errors."""
        rest = self.turns()[1]
        return replace(
            table,
            shaft_error=self.orders(),
            settings={
                **table.settings,
                "tooth_error_positions": float(self.phases.size),
                "tooth_error_rest_rms": float(np.max(rest)),
            },
        )


def most_waves(teeth: int, positions: int) -> int:
    """Return the highest order of a member's turn that so many positions in a mesh resolve."""
    return teeth * positions // _POSITIONS_PER_ORDER


def tooth_error_cycle(
    file: HypoidGearFile,
    stiffness: Mapping[Side, PairStiffness],
    table: MeshTable,
    errors: ToothErrors,
    settings: CycleSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> ToothErrorCycle:
    """Return what errors of single teeth add to the transmission error of a pair.

    At each mesh phase every tooth pair has a curve of torque by rotation; the errors of its two
    teeth shift it. The rotation at which the pairs together carry the torque, less that of nominal
    teeth, times the mean arm of the mesh force is the added error.

    Parameters
    ----------
    file : HypoidGearFile
    stiffness : mapping of side to PairStiffness
    table : MeshTable
        Of the same file, all teeth alike; its torques are those of the errors.
    errors : ToothErrors
    settings : CycleSettings
        Positions, resolution and misalignment; its torques are not used.
    store, jobs, progress
        As in `run_cycle`.

    Raises
    ------
    ParameterError
        Table and file differ in their teeth, or waves are too many for the positions.
    ConvergenceError
        A position finds no equilibrium, or errors are too large beside the deflection.

    Notes
    -----
    Exact where an error moves a whole flank about its axis, as pitch does. Displacements and waves
    vary over the contact of a pair; their mean is taken, weighted with the growth of the forces at
    the nominal load: of first order in the variation. Stiffness and the sharing of load between
    the flanks' films stay those of nominal teeth; where a tooth loses contact they would change.
    """
    _check(file, table, errors, settings)
    pairs = {side: FlankPair.from_file(file, side, settings.misalignment) for side in SIDES}
    levels = {
        side: [abs(float(t)) for t in table.torque if (t < 0.0) == (side == "coast")]
        for side in SIDES
    }
    wanted = [side for side in SIDES if levels[side]]
    highest = {side: max(levels[side]) for side in wanted}
    spans = {side: _span(errors, pairs[side], table) for side in wanted}
    found = compute_positions(
        [(side, float(phase)) for side in wanted for phase in settings.phases],
        partial(_curves_of, pairs, dict(stiffness), settings, errors, highest, spans),
        key=_key(file, stiffness, settings, errors, highest, spans),
        folder=store,
        label=_label,
        jobs=jobs,
        progress=progress,
    )
    curves = {
        side: stack_records(found[side, float(phase)] for phase in settings.phases)
        for side in wanted
    }
    rows = []
    for torque in table.torque:
        side: Side = "coast" if torque < 0.0 else "drive"
        arm = pairs[side].touching_sign * table.mean("R_p", float(torque))
        turn = added_rotation(
            pairs[side], abs(float(torque)), settings.phases, curves[side], errors
        )
        rows.append(arm * turn)
    return ToothErrorCycle(
        phases=settings.phases,
        torque=table.torque,
        error=np.stack(rows),
        pinion_teeth=file.pinion.teeth,
        gear_teeth=file.gear.teeth,
        alike=tuple(member for member in MEMBERS if errors.of(member).is_none),  # type: ignore[arg-type]
    )


def added_rotation(
    pair: FlankPair, torque: float, phases: Array, curves: Record, errors: ToothErrors
) -> Array:
    """Return the rotation that errors of teeth add under a torque [rad], (H, P).

    Towards the gear, over the mesh periods after which the same teeth meet again.
    """
    meshes = np.arange(math.lcm(pair.pinion.teeth, pair.gear.teeth))
    columns = []
    for i, phase in enumerate(phases):
        own = {name: values[i] for name, values in curves.items()}
        problem = TurnProblem(pair, float(phase), torque, own)
        shifts = problem.shifts(errors, meshes)
        nominal = problem.rotation(np.zeros((1, shifts.shape[1])))
        columns.append(problem.rotation(shifts) - nominal)
    return np.stack(columns, axis=1)


def _curves_of(
    pairs: dict[Side, FlankPair],
    stiffness: dict[Side, PairStiffness],
    settings: CycleSettings,
    errors: ToothErrors,
    highest: dict[Side, float],
    spans: dict[Side, float],
    position: tuple[Side, float],
) -> Record:
    side, phase = position
    return position_curves(
        pairs[side],
        phase,
        highest[side],
        spans[side],
        (_counts(errors.pinion, side), _counts(errors.gear, side)),
        PAIRS_BESIDE,
        stiffness[side],
        settings.loaded,
    )


def _counts(member: MemberErrors, side: Side) -> tuple[int, ...]:
    return tuple(wave.waves for wave in member.waves.get(side, ()))


def _span(errors: ToothErrors, pair: FlankPair, table: MeshTable) -> float:
    """Return a bound of the difference of the shifts of two pairs [rad]."""
    side = pair.side
    arm = table.mean("R_p", float(table.torque[-1]))
    span = 0.0
    for member, ratio in ((errors.pinion, 1.0), (errors.gear, pair.ratio)):
        if side in member.pitch:
            span += ratio * float(np.ptp(member.pitch[side]))
        amplitudes = sum(wave.amplitude for wave in member.waves.get(side, ()))
        moved = member.eccentricity + member.wobble * pair.gear.region.outer_cone_distance
        span += 2.0 * (amplitudes + moved) / arm
    return span


def _check(
    file: HypoidGearFile, table: MeshTable, errors: ToothErrors, settings: CycleSettings
) -> None:
    teeth = file.pinion.teeth, file.gear.teeth
    if teeth != (table.pinion_teeth, table.gear_teeth):
        raise ParameterError(
            f"The mesh table must be that of the pair, {teeth[0]} and {teeth[1]} teeth, got one of "
            f"{table.pinion_teeth} and {table.gear_teeth}. Give the table of `gearlube contact`."
        )
    for role, count in zip(MEMBERS, teeth, strict=True):
        most = most_waves(count, settings.positions)
        for side, waves in errors.of(role).waves.items():  # type: ignore[arg-type]
            highest = max((wave.waves for wave in waves), default=0)
            if highest > most:
                raise ParameterError(
                    f"waves of the {role}'s {side} flank must be at most {most} a turn with "
                    f"{settings.positions} positions, got {highest}. Take at least "
                    f"{math.ceil(highest * _POSITIONS_PER_ORDER / count)} positions."
                )


def _label(position: tuple[Side, float]) -> tuple[str, str]:
    side, phase = position
    return f"teeth_{side}_{phase:.6f}", f"single pairs, {side} flanks, mesh phase {phase:.2f}"


def _key(
    file: HypoidGearFile,
    stiffness: Mapping[Side, PairStiffness],
    settings: CycleSettings,
    errors: ToothErrors,
    highest: Mapping[Side, float],
    spans: Mapping[Side, float],
) -> str:
    digest = hashlib.sha256(f"pair curves {_FORMAT} {SAMPLES}".encode())
    digest.update(file.model_dump_json(exclude={"tolerances"}).encode())
    digest.update(repr((asdict(settings.loaded), asdict(settings.misalignment))).encode())
    counts = [[_counts(errors.of(role), side) for side in SIDES] for role in ("pinion", "gear")]  # type: ignore[arg-type]
    digest.update(repr((dict(highest), dict(spans), counts)).encode())
    for side in SIDES:
        digest.update(repr(stiffness[side].contact_modulus).encode())
        for part in (stiffness[side].pinion, stiffness[side].gear):
            digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
