"""A pair near one set of values: all positions held, evaluations kept."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation import helical_positions, hypoid_positions
from gearlube_core.flank_optimisation.held_position import Evaluation, HeldPosition, LoadedMeasures
from gearlube_core.flank_optimisation.problem import (
    GearFile,
    Load,
    Problem,
    Scenario,
    unchecked,
    with_error,
)
from gearlube_core.helical_contact.loaded_contact import LoadedSettings as HelicalLoaded
from gearlube_core.helical_contact.strips import StripSettings as HelicalStrips
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings as HypoidLoaded
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.parameter import Parameter
from gearlube_core.hypoid_contact.strips import StripSettings as HypoidStrips
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import compute_positions

_FORMAT = 5  # raise with every change of the model that changes results
OTHER_SLOPE = 4e-3  # rad, of flanks that do not carry; gear files are refused beyond 10 mrad
PLANE = 0.05e-3  # m, pinion cutter's plane from mid-depth; gear files are refused beyond 0.1 mm
Teeth = Mapping[Side, PairStiffness]  # of the flanks that carry, by their side
HELICAL_CELLS = HelicalLoaded(strips=HelicalStrips(cells_across=13, cells_along=22))
HYPOID_CELLS = HypoidLoaded(strips=HypoidStrips(cells_across=14, cells_along=24))
_PLAIN_FORMAT = 3  # raise with every change of the model that changes results


@dataclass
class HeldModel:
    """A problem's pair with its cells cut where it stands at one set of values.

    Parameters
    ----------
    problem : Problem
    stiffness : Teeth
        Of the sides of the problem's loads; of a helical pair both are alike.
    at : ndarray of shape (P,), optional
        Where cells are cut [unit of each]; None: the pair as its file gives it.
    folder : Path, optional
        Keeps evaluations, so that an interrupted search goes on.
    progress : callable
        Called with the share of positions that are cut [-] and a sentence.
    """

    problem: Problem
    stiffness: Teeth
    at: Array | None
    folder: Path | None = None
    progress: Progress = no_progress
    _positions: list[HeldPosition] = field(default_factory=list)

    @property
    def shape(self) -> tuple[int, int, int]:
        """J torques, S scenarios, N phases."""
        given = self.problem.given
        return len(given.torques_n_m), len(self.problem.scenarios), given.positions

    def evaluate(self, values: Array | None = None) -> Evaluation:
        """Return the measures with values (P,) [unit of each]; None: as the file gives it.

        Raises
        ------
        ConvergenceError
            A position finds no equilibrium.
        """
        store: ResultStore[Record] = ResultStore(self.folder, ARRAYS)
        key = self._key(values)
        kept = store.read(key)
        if kept is not None:
            return Evaluation.from_record(kept)
        with single_threaded():
            if not self._positions:
                self._positions = self._cut()
            flanks = {
                side: [self._flanks(values, one, side) for one in self.problem.scenarios]
                for side in self._sides
            }
            places = product(self.problem.loads, range(self.shape[1]), range(self.shape[2]))
            rows = [
                position.measures(flanks[load.side][scenario])
                for position, (load, scenario, _) in zip(self._positions, places, strict=True)
            ]
        found = Evaluation.of(rows, self.shape, self._settings_used(values))
        store.keep(key, found.record())
        return found

    @property
    def _sides(self) -> list[Side]:
        return list(dict.fromkeys(load.side for load in self.problem.loads))

    def _key(self, values: Array | None) -> str:
        digest = hashlib.sha256(f"flank optimisation {_FORMAT}".encode())
        digest.update(self.problem.file.model_dump_json().encode())
        given = self.problem.given
        whole = (self.problem.loads, given.positions, given.limits.edge_band)
        digest.update(repr((whole, self.problem.names, self.problem.scenarios)).encode())
        for side in self._sides:
            for part in (self.stiffness[side].pinion, self.stiffness[side].gear):
                digest.update(np.ascontiguousarray(part.image).tobytes())
        for one in (self.at, values):
            digest.update(b"given" if one is None else np.round(one, 12).tobytes())
        return digest.hexdigest()[:20]

    def _file(self, values: Array | None, scenario: Scenario) -> Any:
        if values is None:
            return with_error(self.problem.file, scenario)
        return self.problem.tried(values, scenario)

    def _ends(self, values: Array | None) -> list[tuple[str, float, float]]:
        return [] if values is None else self.problem.ends(values)

    def _flanks(self, values: Array | None, scenario: Scenario, side: Side) -> Any:
        file, ends = self._file(values, scenario), self._ends(values)
        ends = [
            (name, low + scenario.added.get(name, 0.0), high + scenario.added.get(name, 0.0))
            for name, low, high in ends
        ]
        if not self.problem.is_hypoid:
            return helical_positions.HelicalFlanks.of(file, ends)
        moves = np.zeros(len(ends))
        if values is not None and self.at is not None:
            settings = [_is_setting(name) for name, _, _ in ends]
            moves = np.where(settings, values - self.at, 0.0)
        return hypoid_positions.HypoidFlanks.of(file, side, ends, moves)

    def _settings_used(self, values: Array | None) -> tuple[Array, Array] | None:
        """Return what the check of a gear file leaves settings, and its rates; None: they stay.

        Both flanks of a member are cut in one set-up: slopes between those that do not carry, and
        the depth of the cut.
        """
        if values is None or not self.problem.is_hypoid:
            return None
        ends = self._ends(values)
        if not any(_is_setting(name) for name, _, _ in ends):
            return None
        side = self.problem.other_side

        def used(changes: dict[str, float]) -> Array:
            file = unchecked(self.problem.tried(values, self.problem.scenarios[0]), changes)
            slopes = hypoid_positions.side_slopes(file, side) / OTHER_SLOPE
            return np.append(slopes, hypoid_positions.plane_distance(file) / PLANE)

        rates = [
            (used({name: high}) - used({name: low})) / (high - low)
            if _is_setting(name)
            else np.zeros(3)
            for name, low, high in ends
        ]
        return used({}), np.array(rates).T

    def _cut(self) -> list[HeldPosition]:
        loads, band = self.problem.loads, self.problem.given.limits.edge_band
        phases = np.arange(self.shape[2]) / self.shape[2]
        bodies = {
            side: [self._body(one, side) for one in self.problem.scenarios] for side in self._sides
        }
        found = []
        for load in loads:
            for body in bodies[load.side]:
                for phase in phases:
                    found.append(body(float(phase), load.torque, band))
                    share = len(found) / (len(loads) * self.shape[1] * phases.size)
                    self.progress(share, f"cells at {load.torque:g} N.m, {load.side}")
        return found

    def _body(self, scenario: Scenario, side: Side) -> Any:
        """Return what cuts a position of a scenario from phase, torque and border."""
        file = self._file(self.at, scenario)
        if not self.problem.is_hypoid:
            modified = file.modified_pair()
            return lambda phase, torque, band: helical_positions.held_position(
                modified, phase, torque, self.stiffness[side], HELICAL_CELLS, band
            )
        ends = self._ends(self.at)
        pair = FlankPair.from_file(file, side, scenario.misalignment)
        about = {
            k: _setting_ends(file, pair, name)
            for k, (name, _, _) in enumerate(ends)
            if _is_setting(name)
        }
        return lambda phase, torque, band: hypoid_positions.held_position(
            *(pair, about, len(ends), phase, torque, self.stiffness[side], HYPOID_CELLS, band)
        )


def _is_setting(name: str) -> bool:
    return name.split(".")[1] in ("machine", "cutter")


def _setting_ends(file: Any, pair: FlankPair, name: str) -> tuple[float, FlankPair, FlankPair]:
    parameter = Parameter.named(name, file, pair.misalignment)
    lower, upper = parameter.about(file, pair)
    return 2.0 * parameter.step, lower, upper


def differences(model: HeldModel, values: Array, steps: Sequence[float]) -> list[Evaluation]:
    """Return evaluations one step above and below each value in turn, for checks of rates."""
    found = []
    for k, step in enumerate(steps):
        for sign in (1.0, -1.0):
            moved = np.array(values, float)
            moved[k] += sign * step
            found.append(model.evaluate(moved))
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckSettings:
    """Resolution of the check.

    Parameters
    ----------
    positions : int
        Number of phases of the mesh.
    helical, hypoid : LoadedSettings
        Cells of either kind of pair: those of the plain analyses.
    """

    positions: int = 16
    helical: HelicalLoaded = field(default_factory=HelicalLoaded)
    hypoid: HypoidLoaded = field(default_factory=HypoidLoaded)


_Task = tuple[Load, int, float]  # with the number of the scenario, and the phase


def plain_check(
    problem: Problem,
    file: GearFile,
    stiffness: Teeth,
    settings: CheckSettings | None = None,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Evaluation:
    """Return the measures of a gear file at the torques and errors of a problem, without rates.

    Parameters
    ----------
    problem : Problem
    file : HypoidGearFile or HelicalGearFile
        Of the pair as it is or a better one.
    stiffness : Teeth
        As of `HeldModel`.
    settings : CheckSettings, optional
    folder : Path, optional
        Keeps finished positions.
    jobs : int, optional
        Processes; default: all processors.
    progress : callable, optional

    Raises
    ------
    ConvergenceError
        A position finds no equilibrium.
    """
    settings = settings or CheckSettings()
    phases = (np.arange(settings.positions) / settings.positions).tolist()
    tasks: list[_Task] = [
        (load, number, phase)
        for load in problem.loads
        for number in range(len(problem.scenarios))
        for phase in phases
    ]
    sides = {load.side for load in problem.loads}
    bodies = {
        side: [_body(problem, file, number, side) for number in range(len(problem.scenarios))]
        for side in sides
    }
    band = problem.given.limits.edge_band
    cells: Any = settings.hypoid if problem.is_hypoid else settings.helical
    digest = hashlib.sha256(f"plain check {_PLAIN_FORMAT}".encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr((problem.scenarios, band, cells)).encode())
    for side in sorted(sides):
        for part in (stiffness[side].pinion, stiffness[side].gear):
            digest.update(np.ascontiguousarray(part.image).tobytes())
    with single_threaded():
        found = compute_positions(
            tasks,
            partial(_record, bodies, dict(stiffness), cells, band),
            key=digest.hexdigest()[:16],
            folder=folder,
            label=_label,
            jobs=jobs,
            progress=progress,
        )
    none = LoadedMeasures(*(np.empty(0) for _ in LoadedMeasures._fields))
    rows = [(LoadedMeasures(*found[task]["measures"].tolist()), none) for task in tasks]
    shape = len(problem.given.torques_n_m), len(problem.scenarios), settings.positions
    return Evaluation.of(rows, shape)


def _body(problem: Problem, file: GearFile, number: int, side: Side) -> Any:
    scenario = problem.scenarios[number]
    changed: Any = with_error(file, scenario)
    if problem.is_hypoid:
        return FlankPair.from_file(changed, side, scenario.misalignment)
    return changed.modified_pair()


def _record(
    bodies: dict[Side, list[Any]], stiffness: Teeth, cells: Any, band: float, task: _Task
) -> Record:
    (torque, side), number, phase = task
    body = bodies[side][number]
    measures = (
        hypoid_positions.plain_measures
        if isinstance(body, FlankPair)
        else helical_positions.plain_measures
    )
    return {"measures": np.array(measures(body, phase, torque, stiffness[side], cells, band))}


def _label(task: _Task) -> tuple[str, str]:
    (torque, side), number, phase = task
    words = f"plain analysis at {torque:g} N.m, {side}"
    return f"{side}_{torque:g}_{number}_{phase:.6f}", words
