"""Shared by the mesh cycles of all gear pairs: torques, mesh phases, stored positions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, TypeVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore, resumable_results

Position = TypeVar("Position")


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshCycleSettings:
    """Positions and loads of the mesh to analyse.

    Parameters
    ----------
    torques : tuple of float
        Pinion torques [N.m], rising, above zero.
    positions : int
        Mesh phases in a period.
    """

    torque_range: ClassVar[tuple[float, float]]  # [N.m]

    torques: tuple[float, ...]
    positions: int

    def __post_init__(self) -> None:
        check_within("positions", self.positions, 4, 400)
        for torque in self.torques:
            check_within("torques", torque, *self.torque_range, "N.m")
        if not self.torques or any(np.diff(self.torques) <= 0.0):
            raise ParameterError(f"torques must rise [N.m], got {self.torques}. Sort them.")

    @property
    def phases(self) -> Array:
        """Mesh phases [mesh periods], (positions,)."""
        return np.arange(self.positions) / self.positions


def stack_records(records: Iterable[Record]) -> Record:
    """Stack records with equal arrays into one, each array with a new leading dimension."""
    rows = list(records)
    return {name: np.stack([row[name] for row in rows]) for name in rows[0]}


def compute_positions(
    positions: Sequence[Position],
    compute: Callable[[Position], Record],
    *,
    key: str,
    folder: Path | None,
    label: Callable[[Position], tuple[str, str]],
    jobs: int | None,
    progress: Progress,
) -> dict[Position, Record]:
    """Return the record of each position, in parallel; stored ones are not computed again.

    Parameters
    ----------
    positions
        Inputs of `compute`.
    compute
        Called in the processes, so it and the positions can be pickled.
    key
        Hash of everything that the positions share; part of the names of their files.
    folder
        Where finished positions are found and kept; None: nowhere.
    label
        What follows `key` in the name of a position's file, and the sentence that is reported
        when it is done.
    jobs
        Processes; one runs in this process. None: all processors.
    progress
        Called after each new position.
    """
    found = {}
    for position, record, stored in resumable_results(
        positions,
        lambda position: f"{key}_{label(position)[0]}",
        compute,
        ResultStore(folder, ARRAYS),
        ProcessPool(jobs=jobs),
    ):
        found[position] = record
        if not stored:
            progress(len(found) / len(positions), label(position)[1])
    return found
