"""What a sweep reports after every point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Progress:
    """State of a sweep after a point.

    Parameters
    ----------
    done, total : int
        Points that are there, and points of the grid.
    speed_kmh, preload : float
        The point just added [km/h], [N].
    finished : bool
        Whether it was computed without a failure.
    reused : bool
        Whether it was read from the folder of results.
    """

    done: int
    total: int
    speed_kmh: float
    preload: float
    finished: bool
    reused: bool


ProgressCallback = Callable[[Progress], None]
