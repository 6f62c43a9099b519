"""How statements of Jamali 2015 on films are judged, and numbers from curves that serve for it."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence

import numpy as np
from scipy.signal import find_peaks

from docs.ehl.lines import LostFilmError
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import FAILS, Claims, Verdict
from gearlube_core.arrays import Array


def off_range(values: Array, low: float, high: float) -> float:
    """Return the larger relative difference of the ends of `values` from those printed."""
    return max(abs(float(np.min(values)) / low - 1.0), abs(float(np.max(values)) / high - 1.0))


def jumps(steps: Array, places: Array, least: float) -> list[float]:
    """Return the steps at which a place moves by more than `least` at once."""
    rows = np.flatnonzero(np.abs(np.diff(places)) > least)
    return [0.5 * float(steps[i] + steps[i + 1]) for i in rows]


def exponent(factors: Sequence[float], values: Sequence[float]) -> float:
    """Return the slope of the straight line through the logarithms."""
    return float(np.polyfit(np.log(factors), np.log(values), 1)[0])


def peaks(profile: Array, prominence: float) -> int:
    """Return the number of maxima that rise above both sides by a share of the largest value."""
    closed = np.concatenate([[0.0], profile, [0.0]])
    return len(find_peaks(closed, prominence=prominence * float(profile.max()))[0])


def first_above(places: Array, profile: Array, level: float) -> float:
    """Return the first place, between nodes, at which a profile reaches a level."""
    i = int(np.argmax(profile >= level))
    if i == 0:
        return float(places[0])
    share = (level - profile[i - 1]) / (profile[i] - profile[i - 1])
    return float(places[i - 1] + share * (places[i] - places[i - 1]))


def largest_change(reference: Array, other: Array) -> float:
    """Return the largest relative difference of two curves."""
    return float(np.max(np.abs(other / reference - 1.0)))


def highest_near(steps: Array, values: Array, middle: float) -> tuple[float, float]:
    """Return the steps of the largest values before and after `middle`."""
    first, second = steps < middle, steps >= middle
    return (
        float(steps[first][values[first].argmax()]),
        float(steps[second][values[second].argmax()]),
    )


GPA, UM, MM = 1e-9, 1e6, 1e3
logger = logging.getLogger("docs.ehl")


def verdicts(claims: Claims, store: Store) -> dict[str, Verdict]:
    """Return the verdicts on all claims but those whose films are missing, which the log names.

    A claim on a march whose film was lost fails.
    """
    found = {}
    for name, claim in claims.items():
        try:
            found[name] = claim(store)
        except MissingFilmError as error:
            logger.warning("%s stays as it is: %s is not computed yet", name, error)
        except LostFilmError as error:
            found[name] = Verdict("-", FAILS, f"The film of a march was {error}.")
    return found


def span(low: float, high: float, form: str = "{:.2f}") -> str:
    """Return "low to high"."""
    return f"{form.format(low)} to {form.format(high)}"


def listed(values: Iterable[float], form: str = "{:.2f}") -> str:
    """Return values with strokes between."""
    return " / ".join(form.format(v) for v in values)
