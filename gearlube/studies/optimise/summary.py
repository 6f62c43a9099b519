"""Measures of an optimisation before and after, torque by torque, with their limits."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.held_position import Evaluation
from gearlube_core.flank_optimisation.optimise import Optimised
from gearlube_core.flank_optimisation.search import KEPT

_MICRO = 1e-6


class MeasureRow(NamedTuple):
    """One measure at one torque, before and after."""

    torque: float  # [N.m]
    what: str
    unit: str
    before: float
    after: float
    limit: float | None  # times that before, or a share; None: no limit

    @property
    def change(self) -> str:
        """Of amplitudes in dB, else in percent."""
        if not self.before > 0.0 or not self.after > 0.0:
            return "-"
        if self.unit == "urad":
            return f"{20.0 * math.log10(self.after / self.before):+.1f} dB"
        return f"{100.0 * (self.after / self.before - 1.0):+.1f} %"

    @property
    def is_kept(self) -> bool:
        """Whether the limit holds, within what positions and cells change."""
        if self.limit is None:
            return True
        return self.after <= KEPT * self.most

    @property
    def most(self) -> float:
        """The most that the limit allows, in the unit of the measure; infinite without limit."""
        if self.limit is None:
            return math.inf
        return self.limit if self.what.startswith(EDGE) else self.limit * self.before


EDGE = "largest share of load in the border"


def measure_rows(found: Optimised, after: Evaluation | None = None) -> list[MeasureRow]:
    """Return all measures by the plain analysis, torque by torque; `after`: of another design."""
    problem, given, limits = found.problem, found.problem.given, found.problem.given.limits
    pair = found.before, after or found.better.checked
    rows = []
    for j, torque in enumerate(given.torques_n_m):

        def add(what: str, unit: str, values: list[Array], limit: float | None = None) -> None:
            rows.append(MeasureRow(torque, what, unit, float(values[0]), float(values[1]), limit))  # noqa: B023

        amplitude = [np.abs(one.orders(given.orders)[0])[j] for one in pair]
        for k, order in enumerate(given.orders):
            add(f"mesh order {order}", "urad", [one[0, k] / _MICRO for one in amplitude])
        whine = [one.whine(given.orders)[j] / _MICRO for one in pair]
        add("all orders", "urad", [one[0] for one in whine])
        if len(problem.scenarios) > 1:
            add("all orders, root mean square over errors", "urad", [_rms(one) for one in whine])
            add("all orders, worst error", "urad", [one.max() for one in whine])
            spread = [one.spread(given.orders)[j] / _MICRO for one in pair]
            add("sensitivity to errors", "urad", spread, limits.sensitivity)
        add(
            "highest pressure", "GPa", [1e-9 * p.highest_pressure[j] for p in pair], limits.pressure
        )
        add(
            "sliding loss over friction coefficient",
            "1",
            [p.mean_sliding[j] for p in pair],
            limits.loss,
        )
        if problem.is_hypoid:
            swing = [one.swing(given.orders)[0][j] for one in pair]
            add("mesh orders of the force over its mean", "1", swing, limits.force_swing)
        add(EDGE, "1", [one.largest_edge_share[j] for one in pair], limits.edge_share)
    for k, torque in enumerate(limits.other_side_torques_n_m):
        old, new = (1e-9 * float(one.highest_other_pressure[k]) for one in pair)
        what = f"highest pressure, {problem.other_side} flanks"
        most = limits.other_side_pressure
        rows.append(MeasureRow(torque, what, "GPa", old, new, most))
        old, new = (float(one.largest_other_edge_share[k]) for one in pair)
        what = f"{EDGE}, {problem.other_side} flanks"
        rows.append(MeasureRow(torque, what, "1", old, new, limits.other_side_edge_share))
    return rows


def _rms(values: Array) -> Array:
    return np.asarray(np.sqrt(np.mean(values**2)))
