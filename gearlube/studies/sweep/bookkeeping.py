"""The points of a sweep: which are stored, which are due, and who is told."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

import xarray as xr

from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.store import PointStore

logger = logging.getLogger(__name__)

Place = tuple[float, float]  # speed [km/h], preload [N]


@dataclass(frozen=True, slots=True)
class Progress:
    """What an observer is told after every point."""

    done: int
    total: int
    speed_kmh: float
    preload: float
    finished: bool
    reused: bool


Observer = Callable[[Progress], None]


class Book:
    """Which points of a grid are there and which are due; keeps the finished ones on disk."""

    def __init__(
        self, keys: dict[Place, str], store: PointStore, observer: Observer | None
    ) -> None:
        self.keys = keys
        self.points: dict[Place, xr.Dataset] = {}
        self.reused = 0
        self._store = store
        self._observer = observer

    @property
    def finished(self) -> list[Place]:
        """Places whose point was computed without a failure."""
        return [at for at, dataset in self.points.items() if int(dataset["status"]) == FINISHED]

    @property
    def due(self) -> list[Place]:
        """Places without a point."""
        return [at for at in self.keys if at not in self.points]

    def reuse(self) -> None:
        """Take over every point that the store has."""
        for at, key in self.keys.items():
            dataset = self._store.load(key)
            if dataset is not None:
                self.reused += 1
                self._enter(at, dataset, reused=True)

    def add(self, at: Place, dataset: xr.Dataset) -> None:
        """Enter a point; a failed one is not stored, so that the next run tries it again."""
        if int(dataset["status"]) == FINISHED:
            self._store.save(self.keys[at], dataset)
        else:
            logger.warning("%g km/h, %g N failed: %s", *at, str(dataset["message"].values))
        self._enter(at, dataset, reused=False)

    def _enter(self, at: Place, dataset: xr.Dataset, *, reused: bool) -> None:
        self.points[at] = dataset
        if self._observer is not None:
            self._observer(
                Progress(
                    done=len(self.points),
                    total=len(self.keys),
                    speed_kmh=at[0],
                    preload=at[1],
                    finished=int(dataset["status"]) == FINISHED,
                    reused=reused,
                )
            )
