"""Errors of a film model at solved contacts, and bounds that hold for most others."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

CONFIDENCE = 0.95


class Misses(NamedTuple):
    """Relative errors of a model at solved contacts, (n, 2) of film and friction [-]."""

    values: Array

    def summary(self) -> dict[str, float | int]:
        """Return number, root mean square and largest of both [%]."""
        rms = 100.0 * np.sqrt((self.values**2).mean(axis=0))
        most = 100.0 * np.abs(self.values).max(axis=0)
        return {
            "contacts": len(self.values),
            "film_rms_percent": round(float(rms[0]), 4),
            "film_max_percent": round(float(most[0]), 4),
            "friction_rms_percent": round(float(rms[1]), 4),
            "friction_max_percent": round(float(most[1]), 4),
        }

    def violations(self, bounds: tuple[float, float]) -> tuple[int, int]:
        """Return how many errors of film and friction are above the bounds."""
        over = (np.abs(self.values) > np.array(bounds)).sum(axis=0)
        return int(over[0]), int(over[1])


def conformal_bounds(errors: Array, confidence: float = CONFIDENCE) -> tuple[float, float]:
    """Return the bounds of split conformal prediction from errors (n, 2).

    The ceil((n + 1) confidence)-th smallest amount: the next contact drawn alike exceeds it with
    a probability of at most 1 - confidence [vovk_2005].

    Examples
    --------
    >>> import numpy as np
    >>> conformal_bounds(np.arange(1.0, 20.0)[:, None] * np.array([[1.0, -2.0]]))
    (19.0, 38.0)
    """
    rank = math.ceil((len(errors) + 1) * confidence)
    if rank > len(errors):
        raise ParameterError(f"Bounds need at least 19 calibration contacts, got {len(errors)}.")
    ordered = np.sort(np.abs(errors), axis=0)
    return float(ordered[rank - 1, 0]), float(ordered[rank - 1, 1])


def tests_table(predicted: Mapping[str, Array], solved: Mapping[str, Array]) -> str:
    """Return films [m] and frictions of a model beside solved ones as CSV, by kind of contact."""
    lines = ["kind,film_model_m,film_solved_m,friction_model,friction_solved"]
    for kind in predicted:
        for own, true in zip(predicted[kind], solved[kind], strict=True):
            numbers = (own[0], true[0], own[1], true[1])
            lines.append(",".join([kind, *(f"{number:.6g}" for number in numbers)]))
    return "\n".join(lines) + "\n"
