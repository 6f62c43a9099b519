"""The search for the best values: SLSQP on held cells, in rounds that cut the cells again."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from scipy.optimize import minimize

from gearlube_core.arrays import Array
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.flank_optimisation.held_model import HeldModel
from gearlube_core.flank_optimisation.held_position import Evaluation
from gearlube_core.flank_optimisation.problem_file import Limits

KEPT = 1.005  # a limit counts as kept up to here: what cells and positions change
_BREACH = 20.0  # price of a limit that is broken by its own size, in parts of the aim before
_LEAST_GAIN = 0.02  # of the aim: a round that gains less is the last
_TOO_FAR = 0.25  # factor on the region where flanks do not meet or are twice as bad
_SMALLEST = 0.01  # region of a round, in parts of the bounds


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """Goal that is minimised, and limits that must stay below one.

    Parameters
    ----------
    before : Evaluation
        Of the pair as it is; torques, scenarios and phases as those that are judged.
    orders : tuple of int
    worst : bool
        Whether the highest of all torques and errors counts, not their mean square.
    limits : Limits
    loss : bool
        Whether the loss is to be least instead of the mesh orders.
    most_square : float, optional
        Limit of the mean square of the mesh orders over that before [-].
    """

    before: Evaluation
    orders: tuple[int, ...]
    worst: bool
    limits: Limits
    loss: bool = False
    most_square: float | None = None

    def squares(self, found: Evaluation) -> tuple[Array, Array]:
        """Return the squares of the whine over that before (J, S), and their rates (J, S, P).

        Before: the root mean square over errors at the same torque.
        """
        values, rates = found.orders(self.orders)
        scale = (self.before.whine(self.orders) ** 2).mean(axis=1)[:, None]
        square = (np.abs(values) ** 2).sum(axis=2) / scale
        rate = 2.0 * np.real(np.einsum("jsk,jskp->jsp", np.conj(values), rates))
        return square, rate / scale[..., None]

    def aim(self, found: Evaluation) -> tuple[float, Array]:
        """Return the goal [-] and its rates (P,): a mean square, or a mean loss."""
        if self.loss:
            part = found.sliding.mean(axis=(1, 2)) / self.before.mean_sliding
            rate = found.sliding_rate.mean(axis=(1, 2)) / self.before.mean_sliding[:, None]
            return float(part.mean()), rate.mean(axis=0)
        square, rate = self.squares(found)
        return float(square.mean()), rate.mean(axis=(0, 1))

    def highest(self, found: Evaluation) -> float:
        """Return the number by which two sets of values are compared [-], least is best."""
        if self.worst and not self.loss:
            return float(self.squares(found)[0].max())
        return self.aim(found)[0]

    def used(self, found: Evaluation) -> tuple[Array, Array]:
        """Return how much of each limit is used (C,), 1 at it, and the rates (C, P)."""
        parts: list[tuple[Array, Array]] = []
        count = found.rotation_rate.shape[-1]

        def add(value: Array, rate: Array) -> None:
            parts.append((np.reshape(value, -1), np.reshape(rate, (np.size(value), count))))

        limits = self.limits
        if limits.pressure is not None:
            most = limits.pressure * self.before.highest_pressure[:, None, None]
            add(found.pressure / most, found.pressure_rate / most[..., None])
        if limits.loss is not None:
            most = limits.loss * self.before.mean_sliding
            add(found.mean_sliding / most, found.sliding_rate.mean(axis=(1, 2)) / most[:, None])
        if limits.edge_share is not None:
            add(found.edge_share / limits.edge_share, found.edge_share_rate / limits.edge_share)
        if limits.other_side_pressure is not None:
            most = limits.other_side_pressure * self.before.highest_other_pressure[:, None, None]
            add(found.other_pressure / most, found.other_pressure_rate / most[..., None])
        if limits.other_side_edge_share is not None:
            share = limits.other_side_edge_share
            add(found.other_edge_share / share, found.other_edge_share_rate / share)
        if limits.force_swing is not None:
            swing, rate = found.swing(self.orders)
            most = limits.force_swing * self.before.swing(self.orders)[0]
            add(swing / most, rate / most[:, None])
        if self.most_square is not None:
            square, rate = self.squares(found)
            add(square.mean() / self.most_square, rate.mean(axis=(0, 1)) / self.most_square)
        spread = self.before.spread(self.orders)
        if limits.sensitivity is not None and spread.all():
            values, rates = found.orders(self.orders)
            moved, moved_rate = values[:, 1:] - values[:, :1], rates[:, 1:] - rates[:, :1]
            most = limits.sensitivity * spread
            here = np.maximum(found.spread(self.orders), 1e-6 * most)
            rate = np.real(np.einsum("jsk,jskp->jp", np.conj(moved), moved_rate))
            add(here / most, rate / (moved.shape[1] * here * most)[:, None])
        for part, rate in zip(found.settings_used, found.settings_used_rate, strict=True):
            for sign in (1.0, -1.0):
                add(sign * part, sign * rate)
        if not parts:
            return np.empty(0), np.empty((0, count))
        return np.concatenate([a for a, _ in parts]), np.concatenate([b for _, b in parts])


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """How long is searched.

    Parameters
    ----------
    rounds : int
        Times that cells are cut again, at most.
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
    A round holds the cells, moves within a region, and is kept when the pair with cells cut again
    is better: aim plus a price for broken limits. What cutting again adds to each limit is added in
    the next rounds too, until one is kept. A round that is not kept and adds nothing to a limit
    halves or quarters the region; a kept one that gains much doubles it. Within a round the contact
    is solved again at every step; what is linear there are machine settings alone.

    References
    ----------
    SLSQP of scipy.
    """
    settings = settings or SearchSettings()
    low, high = bounds
    values, region = np.array(start, float), settings.region
    here = model(values)
    found = here.evaluate(values)
    merit = _merit(goal, found)
    added = np.zeros_like(goal.used(found)[0])
    rounds = [_round(goal, values, found, True)]
    for number in range(1, settings.rounds + 1):
        observe(number, f"aim {rounds[-1].aim:.3f}")
        reach = region * (high - low)
        box = np.maximum(low, values - reach), np.minimum(high, values + reach)
        tried = best_in_box(here, goal, values, box, low, high, settings, added)
        if np.all(np.abs(tried - values) < 1e-6 * (high - low)):
            if not added.any() and _round(goal, values, found, True).limits <= KEPT:
                break
            added = np.zeros_like(added)
            region *= 0.5
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
        if better:
            here, values, found, merit = there, tried, moved, reached
            added = np.zeros_like(added)
            if gain > 0.1:
                region = min(1.0, 2.0 * region)
            else:
                region *= 0.5
        else:
            off = goal.used(moved)[0] - goal.used(here.evaluate(tried))[0]
            more = np.where(goal.used(moved)[0] > KEPT, np.maximum(off, added), added)
            if np.all(more - added < KEPT - 1.0):
                region *= 0.5 if gain > -1.0 else _TOO_FAR
            added = more
        if region < _SMALLEST or (better and gain < _LEAST_GAIN and rounds[-1].limits <= KEPT):
            break
    return Found(values, found, tuple(rounds))


def _merit(goal: Goal, found: Evaluation, added: Array | float = 0.0) -> float:
    over = np.maximum(goal.used(found)[0] + added - KEPT, 0.0)
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
    added: Array | float = 0.0,
) -> Array:
    """Return the best values in a box on held cells; unknowns are parts of the bounds low and high.

    `added` (C,) is added to what is used of each limit. Unknowns beyond the values are the highest
    of all torques and errors, where that is the aim, and the largest breach of a limit. It has its
    price, so that there is a way from values that break limits.
    """
    span, count = high - low, low.size
    seen: dict[bytes, Evaluation] = {}
    best = (_merit(goal, model.evaluate(values), added), values)

    def at(x: Array) -> Evaluation:
        nonlocal best
        place = np.clip(low + span * x[:count], *box)
        key = place.tobytes()
        if key not in seen:
            seen[key] = model.evaluate(place)
            merit = _merit(goal, seen[key], added)
            if merit < best[0]:
                best = (merit, place)
        return seen[key]

    worst = goal.worst and not goal.loss
    x = (values - low) / span
    limits = list(zip((box[0] - low) / span, (box[1] - low) / span, strict=True))
    start = at(x)
    if worst:
        x = np.append(x, goal.highest(start))
        limits.append((0.0, 10.0 * max(1.0, float(x[-1]))))
    over = goal.used(start)[0] + added - 1.0
    limited = over.size > 0
    if limited:
        x = np.append(x, max(float(over.max()), 0.0))
        limits.append((0.0, 2.0 * float(x[-1]) + 1.0))

    def slack(x: Array) -> Array:
        parts = []
        if limited:
            parts.append(1.0 + x[-1] - added - goal.used(at(x))[0])
        if worst:
            parts.append(x[count] - goal.squares(at(x))[0].ravel())
        return np.concatenate(parts)

    def slack_rate(x: Array) -> Array:
        parts = []
        if limited:
            parts.append(_moved(-goal.used(at(x))[1] * span, x.size, -1))
        if worst:
            rate = goal.squares(at(x))[1].reshape(-1, count)
            parts.append(_moved(-rate * span, x.size, count))
        return np.concatenate(parts)

    def aim(x: Array) -> tuple[float, Array]:
        rates = np.zeros(x.size)
        if worst:
            value, rates[count] = float(x[count]), 1.0
        else:
            value, rate = goal.aim(at(x))
            rates[:count] = rate * span
        if limited:
            value, rates[-1] = value + _BREACH * float(x[-1]), _BREACH
        return value, rates

    with suppress(ConvergenceError):  # without equilibrium: what was found till then counts
        minimize(
            aim,
            x,
            jac=True,
            method="SLSQP",
            bounds=limits,
            constraints=[{"type": "ineq", "fun": slack, "jac": slack_rate}]
            if limited or worst
            else (),
            options={"maxiter": settings.steps, "ftol": settings.tolerance},
        )
    return best[1]


def _moved(rates: Array, size: int, place: int) -> Array:
    """Return rates (C, P) by all unknowns (C, size): 1 by that at a place beyond the values."""
    found = np.zeros((rates.shape[0], size))
    found[:, : rates.shape[1]] = rates
    found[:, place] = 1.0
    return found
