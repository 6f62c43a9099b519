"""How a film model is fitted."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.checks import check_within


@dataclass(frozen=True, slots=True, kw_only=True)
class FitSettings:
    """How a net is made of the processes.

    Parameters
    ----------
    points
        Of the processes that the net learns from.
    steps
        Most steps of the net's fit.
    seed
        Of points and first weights.
    """

    points: int = 8000
    steps: int = 150
    seed: int = 1

    def __post_init__(self) -> None:
        check_within("points", self.points, 500, 1_000_000)
        check_within("steps", self.steps, 1, 1_000_000)
