"""Report of an optimisation: values and measures before and after, limits, what bounds it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube.studies.optimise.dataset import designs, unit_of
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.evaluation import Evaluation
from gearlube_core.flank_optimisation.optimise import Optimised
from gearlube_core.flank_optimisation.problem import values_of
from gearlube_core.flank_optimisation.search import KEPT
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_MICRO = 1e-6
_NEAR = 0.005  # of the bounds: a value counts as on its bound


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
        most = self.limit if self.what == EDGE else self.limit * self.before
        return self.after <= KEPT * most


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
    return rows


def sentences(found: Optimised) -> list[str]:
    """Return what a user should know of the result: limits that are broken, values on bounds."""
    said = []
    for row in measure_rows(found):
        if not row.is_kept:
            said.append(
                f"At {row.torque:g} N.m the limit of {row.what} is not kept: {row.after:.4g} "
                f"{row.unit} after {row.before:.4g} before. Loosen limits, or free more fields."
            )
    problem = found.problem
    span = problem.high - problem.low
    for name, value, low, high, width in zip(
        problem.names, found.better.values, problem.low, problem.high, span, strict=True
    ):
        for bound, word in ((low, "low"), (high, "high")):
            if abs(value - bound) < _NEAR * width:
                said.append(f"{name} stands on its bound {word} = {bound:g} {unit_of(name)}.")
    if isinstance(found.better.file, HypoidGearFile):
        try:
            check_pair(found.better.file)
        except ParameterError as reason:
            said.append(f"The better gear file would be refused: {reason}")
    if not any(one.kept for one in found.better.rounds[1:]):
        said.append(
            "The search found nothing better than its start. Give another start, wider bounds, "
            "looser limits or more fields."
        )
    return said


def report(found: Optimised) -> str:
    """Return report.md."""
    problem, given = found.problem, found.problem.given
    lines = [
        f"# {given.name}",
        "",
        f"Better flanks of {problem.file.name}: {len(problem.names)} fields, "
        f"{len(given.torques_n_m)} torques, {len(problem.scenarios) - 1} errors, aim "
        f"{given.aim}. All numbers below are from the plain loaded analysis with "
        f"{found.before.rotation.shape[-1]} mesh phases; transmission errors are those of the "
        "pinion.",
        "",
        "| Field | Before | After | Low | High | Unit |",
        "|---|---|---|---|---|---|",
    ]
    before = values_of(problem.file, problem.names)
    for k, name in enumerate(problem.names):
        old = "-" if math.isnan(before[k]) else f"{before[k]:.6g}"
        lines.append(
            f"| `{name}` | {old} | {found.better.values[k]:.6g} | {problem.low[k]:g} | "
            f"{problem.high[k]:g} | {unit_of(name)} |"
        )
    lines += [
        "",
        "| Torque | | Unit | Before | After | Change | Limit |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in measure_rows(found):
        limit = "-" if row.limit is None else "kept" if row.is_kept else "not kept"
        lines.append(
            f"| {row.torque:g} | {row.what} | {row.unit} | {row.before:.4g} | {row.after:.4g} | "
            f"{row.change} | {limit} |"
        )
    lines += ["", *(f"- {one}" for one in sentences(found))]
    if found.nominal is not None:
        lines += ["", "## With errors and without", "", _table_of_errors(found)]
    if found.front:
        lines += [
            "",
            "## Mesh orders against loss",
            "",
            "Over those before, on the coarse cells of the search; the fields follow.",
            "",
            "| Mesh orders | Loss | " + " | ".join(f"`{name}`" for name in problem.names) + " |",
            "|---|---|" + "---|" * len(problem.names),
        ]
        for point in found.front:
            cells = " | ".join(f"{one:.5g}" for one in point.values)
            lines.append(f"| {point.whine:.3f} | {point.loss:.4f} | {cells} |")
    return "\n".join(lines) + "\n"


def _table_of_errors(found: Optimised) -> str:
    """Return the mesh orders of all designs under each error, as a table."""
    given, named = found.problem.given, designs(found)
    lines = [
        "All orders [urad]; nominal is the pair that is best without errors.",
        "",
        "| Torque | Error | " + " | ".join(named) + " |",
        "|---|---|" + "---|" * len(named),
    ]
    whine = {name: one.whine(given.orders) / _MICRO for name, one in named.items()}
    for j, torque in enumerate(given.torques_n_m):
        for s, scenario in enumerate(found.problem.scenarios):
            cells = " | ".join(f"{whine[name][j, s]:.3g}" for name in named)
            lines.append(f"| {torque:g} | {scenario.name} | {cells} |")
    return "\n".join(lines)


def _rms(values: Array) -> Array:
    return np.asarray(np.sqrt(np.mean(values**2)))
