"""Aim and limits of a problem as functions with derivatives, relative to the pair as it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.evaluation import Evaluation
from gearlube_core.flank_optimisation.problem_file import Limits


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """What is to be least, and what must stay below one.

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
        """Return what is to be least [-] and its rates (P,): a mean square, or a mean loss."""
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
