"""The main numbers of a resonance study."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivetrain.resonance.response import Response, Segment, visited
from drivetrain.resonance.study import ResonanceStudy

_MOST_LISTED = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelSummary:
    """Main numbers of one response; frequencies are mesh over natural frequency [-].

    Parameters
    ----------
    model : str
    natural_frequency : float
        [Hz]
    special : list of (str, float)
        Kind and frequency of folds and bifurcations of the first branches, along them.
    peak, peak_at : float
        Largest peak-to-peak transmission error of a stable motion [m], and where.
    separated_up, separated_down : list of (float, float)
        Where slow sweeps along stable motions lose contact and where they regain it.
    remarks : list of str
        What a reader should know about branches that ended early.
    """

    model: str
    natural_frequency: float
    special: list[tuple[str, float]]
    peak: float
    peak_at: float
    separated_up: list[tuple[float, float]]
    separated_down: list[tuple[float, float]]
    remarks: list[str]


def summaries(study: ResonanceStudy) -> list[ModelSummary]:
    """Return the main numbers of every model that was run."""
    return [_summary(response) for response in study.responses.values()]


def _summary(response: Response) -> ModelSummary:
    peak, peak_at = 0.0, float("nan")
    special: list[tuple[str, float]] = []
    for segment in response.segments:
        branch = segment.branch
        for row in np.flatnonzero(branch.stable):
            size = float(np.ptp(segment.orbit(row).x))
            if size > peak:
                peak, peak_at = size, float(response.relative(branch.parameter[row]))
        if segment.problem.periods == 1:
            special += [
                (point.kind, float(response.relative(point.parameter)))
                for point in branch.special
                if point.kind != "exchange"
            ]
    remarks = [
        f"branch {number + 1} ended at {float(response.relative(s.branch.parameter[-1])):.3f} "
        f"of the natural frequency ({s.branch.ending})."
        for number, s in enumerate(response.segments)
        if s.branch.ending in ("step limit", "point limit")
    ]
    if len(special) > _MOST_LISTED:
        remarks.append(f"{len(special)} folds and bifurcations, the first {_MOST_LISTED} listed.")
    return ModelSummary(
        model=response.model,
        natural_frequency=response.natural_frequency,
        special=special[:_MOST_LISTED],
        peak=peak,
        peak_at=peak_at,
        separated_up=separated_ranges(response, "up"),
        separated_down=separated_ranges(response, "down"),
        remarks=remarks,
    )


def separated_ranges(response: Response, direction: str) -> list[tuple[float, float]]:
    """Return where a slow sweep loses contact and where it regains it, in its order."""
    segments = [segment for segment in response.segments if segment.problem.periods == 1]
    segment = segments[0] if direction == "up" else segments[-1]
    rows = visited(segment.branch, direction)
    apart = np.array([segment.orbit(row).separation_share > 0.0 for row in rows], dtype=bool)
    return _runs(response, segment, rows, apart)


def _runs(
    response: Response, segment: Segment, rows: NDArray[np.intp], apart: NDArray[np.bool_]
) -> list[tuple[float, float]]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], apart.astype(int), [0]])))
    relative = response.relative(segment.branch.parameter)
    return [
        (float(relative[rows[first]]), float(relative[rows[last - 1]]))
        for first, last in edges.reshape(-1, 2)
    ]
