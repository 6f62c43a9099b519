"""The search for the best values: SLSQP on held cells, in rounds that cut the cells anew."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from scipy.optimize import minimize

from gearlube_core.arrays import Array
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.flank_optimisation.evaluation import Evaluation
from gearlube_core.flank_optimisation.goal import Goal
from gearlube_core.flank_optimisation.held_model import HeldModel

KEPT = 1.005  # a limit counts as kept up to here: what cells and positions change
_BREACH = 20.0  # price of a limit that is broken by its own size, in parts of the aim before
_LEAST_GAIN = 0.02  # of the aim: a round that gains less is the last
_MOST_MARGIN = 0.05
_TOO_FAR = 0.25  # factor on the region where flanks do not meet or are twice as bad
_SMALLEST = 0.01  # region of a round, in parts of the bounds


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """How long is searched.

    Parameters
    ----------
    rounds : int
        Times that cells are cut anew, at most.
    steps : int
        Of SLSQP in a round, at most.
    region : float
        How far the first round may move each value, in parts of its bounds [-].
    tolerance : float
        Of the aim, relative to that before [-].
    """

    rounds: int = 6
    steps: int = 20
    region: float = 0.35
    tolerance: float = 1e-3


class Round(NamedTuple):
    """One round of a search: where its cells were cut and what was found there."""

    values: Array  # (P,)
    aim: float  # [-], 1 before
    limits: float  # the limit that is used most [-], 1 at it
    kept: bool  # whether it is better than those before


class Found(NamedTuple):
    """The best values, with the evaluation on cells cut there."""

    values: Array
    evaluation: Evaluation
    rounds: tuple[Round, ...]


def search(
    model: Callable[[Array], HeldModel],
    goal: Goal,
    bounds: tuple[Array, Array],
    start: Array,
    settings: SearchSettings | None = None,
    observe: Callable[[int, str], None] = lambda number, sentence: None,
) -> Found:
    """Return values within bounds that make the aim least under the limits.

    Parameters
    ----------
    model : callable
        Returns the pair with its cells cut at values (P,).
    goal : Goal
    bounds : tuple of ndarray of shape (P,)
        Least and largest values [unit of each].
    start : ndarray of shape (P,)
    settings : SearchSettings, optional
    observe : callable, optional
        Called with the number of the round and a sentence.

    Raises
    ------
    ConvergenceError
        The pair has no loaded equilibrium at the start.

    Notes
    -----
    A round holds the cells, moves within a region, and is kept when the pair with cells cut anew
    is better: aim plus a price for broken limits. The region doubles when it is, and halves or
    quarters when it is not; limits that a round broke are tightened in the next. Within a round the
    contact is solved anew at every step; what is linear there are machine settings alone.

    References
    ----------
    SLSQP of scipy.
    """
    settings = settings or SearchSettings()
    low, high = bounds
    values, region, margin = np.array(start, float), settings.region, 0.0
    here = model(values)
    found = here.evaluate(values)
    merit = _merit(goal, found)
    rounds = [_round(goal, values, found, True)]
    for number in range(1, settings.rounds + 1):
        observe(number, f"aim {rounds[-1].aim:.3f}")
        reach = region * (high - low)
        box = np.maximum(low, values - reach), np.minimum(high, values + reach)
        tried = best_in_box(here, goal, values, box, low, high, settings, margin)
        if np.all(np.abs(tried - values) < 1e-6 * (high - low)):
            if margin == 0.0:
                break
            margin = 0.0
            continue
        try:
            there = model(tried)
            moved = there.evaluate(tried)
            reached = _merit(goal, moved)
        except (ConvergenceError, ParameterError):
            region *= _TOO_FAR
            continue
        better = reached < merit
        rounds.append(_round(goal, tried, moved, better))
        gain = (merit - reached) / merit
        over = max(rounds[-1].limits - 1.0, 0.0)
        if not better and over < _MOST_MARGIN:  # held cells are off by so much of a limit
            margin = min(margin + over, _MOST_MARGIN)
        if better:
            here, values, found, merit = there, tried, moved, reached
        if gain > 0.1:
            region = min(1.0, 2.0 * region)
        else:
            region *= 0.5 if gain > -1.0 else _TOO_FAR
        if region < _SMALLEST or (better and gain < _LEAST_GAIN and rounds[-1].limits <= KEPT):
            break
    return Found(values, found, tuple(rounds))


def _merit(goal: Goal, found: Evaluation, margin: float = 0.0) -> float:
    used = goal.used(found)[0]
    over = np.maximum(used + margin - KEPT, 0.0)
    return goal.highest(found) + _BREACH * float(over.max(initial=0.0))


def _round(goal: Goal, values: Array, found: Evaluation, kept: bool) -> Round:
    used = goal.used(found)[0]
    return Round(values.copy(), goal.highest(found), float(used.max(initial=0.0)), kept)


class Evaluated(Protocol):
    """A pair whose cells are held."""

    def evaluate(self, values: Array) -> Evaluation:
        """Return what the cells find at values (P,)."""


def best_in_box(
    model: Evaluated,
    goal: Goal,
    values: Array,
    box: tuple[Array, Array],
    low: Array,
    high: Array,
    settings: SearchSettings,
    margin: float,
) -> Array:
    """Return the best values in a box on held cells; unknowns are parts of the bounds low and high.

    Limits are tightened by `margin`, in parts of themselves.
    """
    span = high - low
    seen: dict[bytes, Evaluation] = {}
    best = (_merit(goal, model.evaluate(values), margin), values)

    def at(x: Array) -> Evaluation:
        nonlocal best
        place = np.clip(low + span * x[: low.size], *box)
        key = place.tobytes()
        if key not in seen:
            seen[key] = model.evaluate(place)
            merit = _merit(goal, seen[key], margin)
            if merit < best[0]:
                best = (merit, place)
        return seen[key]

    worst = goal.worst and not goal.loss
    x = (values - low) / span
    limits = list(zip((box[0] - low) / span, (box[1] - low) / span, strict=True))

    def slack(x: Array) -> Array:
        parts = [1.0 - margin - goal.used(at(x))[0]]
        if worst:
            parts.append(x[-1] - goal.squares(at(x))[0].ravel())
        return np.concatenate(parts)

    def slack_rate(x: Array) -> Array:
        parts = [-goal.used(at(x))[1] * span]
        if worst:
            rate = goal.squares(at(x))[1]
            parts = [np.hstack([parts[0], np.zeros((parts[0].shape[0], 1))])]
            moved = -rate.reshape(-1, span.size) * span
            parts.append(np.hstack([moved, np.ones((moved.shape[0], 1))]))
        return np.concatenate(parts)

    def aim(x: Array) -> tuple[float, Array]:
        if worst:
            rate = np.zeros(x.size)
            rate[-1] = 1.0
            return float(x[-1]), rate
        value, rate = goal.aim(at(x))
        return value, rate * span

    if worst:
        x = np.append(x, goal.highest(at(x)))
        limits.append((0.0, 10.0 * max(1.0, float(x[-1]))))
    limited = slack(x).size > 0
    with suppress(ConvergenceError):  # without equilibrium: what was found till then counts
        minimize(
            aim,
            x,
            jac=True,
            method="SLSQP",
            bounds=limits,
            constraints=[{"type": "ineq", "fun": slack, "jac": slack_rate}] if limited else (),
            options={"maxiter": settings.steps, "ftol": settings.tolerance},
        )
    return best[1]
