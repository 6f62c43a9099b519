"""The measures of a pair by the plain loaded analysis, cells cut anew at every position."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.flank_optimisation import helical_positions, hypoid_positions
from gearlube_core.flank_optimisation.evaluation import Evaluation
from gearlube_core.flank_optimisation.held_model import Teeth
from gearlube_core.flank_optimisation.held_position import LoadedMeasures
from gearlube_core.flank_optimisation.problem import GearFile, Load, Problem, with_error
from gearlube_core.helical_contact.loaded_contact import LoadedSettings as HelicalLoaded
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings as HypoidLoaded
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.storage.result_store import Record
from gearlube_core.tooth_contact.mesh_cycle import compute_positions

_FORMAT = 3  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckSettings:
    """Resolution of the check.

    Parameters
    ----------
    positions : int
        Mesh phases.
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
    digest = hashlib.sha256(f"plain check {_FORMAT}".encode())
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
