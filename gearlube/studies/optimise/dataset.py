"""Results of an optimisation: one labelled dataset, measures with limits before and after."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.held_position import Evaluation
from gearlube_core.flank_optimisation.optimise import Optimised
from gearlube_core.flank_optimisation.problem import values_of
from gearlube_core.flank_optimisation.search import KEPT
from gearlube_core.input_file.field_units import field_unit

_MICRO = 1e-6
_COLUMNS = ("torque", "name", "unit", "before", "after", "limit")
_EACH = ("design", "torque", "error")
_VARIABLES = {
    "transmission_error": ((*_EACH, "phase"), "rad", "rotation of the pinion under load"),
    "pressure": ((*_EACH, "phase"), "Pa", "highest pressure"),
    "sliding_loss": ((*_EACH, "phase"), "1", "sliding power over power, friction coefficient 1"),
    "edge_share": ((*_EACH, "phase"), "1", "part of the load in the border of the flanks"),
    "force": ((*_EACH, "phase"), "N", "sum of the normal forces"),
    "amplitude": ((*_EACH, "order"), "rad", "mesh orders of the transmission error"),
    "whine": (_EACH, "rad", "root of the sum of squares of the mesh orders"),
    "spread": (("design", "torque"), "rad", "how far errors move the mesh orders, rms"),
}


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


def designs(found: Optimised) -> dict[str, Evaluation]:
    """Return the evaluations by the plain analysis: before, better and, if asked, nominal."""
    named = {"before": found.before, "better": found.better.checked}
    if found.nominal is not None:
        named["nominal"] = found.nominal.checked
    return named


def optimise_dataset(found: Optimised) -> xr.Dataset:
    """Return loaded measures of all designs, their values and the front; units as attributes."""
    given, problem = found.problem.given, found.problem
    named = designs(found)

    def stacked(get: Any) -> Any:
        return np.stack([get(one) for one in named.values()])

    values = {
        "transmission_error": stacked(lambda one: one.rotation),
        "pressure": stacked(lambda one: one.pressure),
        "sliding_loss": stacked(lambda one: one.sliding),
        "edge_share": stacked(lambda one: one.edge_share),
        "force": stacked(lambda one: one.force),
        "amplitude": stacked(lambda one: np.abs(one.orders(given.orders)[0])),
        "whine": stacked(lambda one: one.whine(given.orders)),
        "spread": stacked(lambda one: one.spread(given.orders)),
    }
    data: dict[str, Any] = {
        name: (dims, values[name], {"units": unit, "long_name": text})
        for name, (dims, unit, text) in _VARIABLES.items()
    }
    settings = [values_of(problem.file, problem.names), found.better.values]
    if found.nominal is not None:
        settings.append(found.nominal.values)
    data["value"] = (("design", "parameter"), np.stack(settings), {"long_name": "as in the file"})
    data["value_unit"] = (("parameter",), [unit_of(name) for name in problem.names])
    for name, bounds in (("low", problem.low), ("high", problem.high)):
        data[name] = (("parameter",), bounds, {"long_name": f"{name} bound, as in the file"})
    data |= _measures(measure_rows(found))
    if found.front:
        for name, text in (("whine", "mesh orders"), ("loss", "sliding loss")):
            front = np.array([getattr(point, name) for point in found.front])
            note = {"units": "1", "long_name": f"{text} over those before, held cells"}
            data[f"front_{name}"] = (("front",), front, note)
        points = np.array([point.values for point in found.front])
        data["front_value"] = (("front", "parameter"), points, {"long_name": "as in the file"})
    count = found.before.rotation.shape[-1]
    return xr.Dataset(
        data,
        coords={
            "design": list(named),
            "torque": ("torque", list(given.torques_n_m), {"units": "N.m"}),
            "error": [one.name for one in problem.scenarios],
            "phase": ("phase", np.arange(count) / count, {"units": "1"}),
            "order": list(given.orders),
            "parameter": list(problem.names),
        },
        attrs={
            "name": given.name,
            "gear_file": found.better.file.model_dump_json(exclude_none=True, exclude_unset=True),
            **remark_attributes(found.better.file),
            "pair": problem.file.name,
            "kind": "hypoid" if problem.is_hypoid else "helical",
            "aim": given.aim,
            "improved": int(any(one.kept for one in found.better.rounds[1:])),
        },
    )


def _measures(rows: list[MeasureRow]) -> dict[str, Any]:
    """Return the measures before and after, a row for each measure at each torque."""
    named = {
        "torque": ("N.m", [one.torque for one in rows]),
        "name": ("", [one.what for one in rows]),
        "unit": ("", [one.unit for one in rows]),
        "before": ("as in measure_unit", [one.before for one in rows]),
        "after": ("as in measure_unit", [one.after for one in rows]),
        "limit": ("1", [math.nan if one.limit is None else one.limit for one in rows]),
    }
    return {
        f"measure_{name}": (("measure",), np.array(values), {"units": unit})
        for name, (unit, values) in named.items()
    }


def measures_of(dataset: xr.Dataset) -> list[MeasureRow]:
    """Return the measures that a dataset keeps."""
    columns = [dataset[f"measure_{name}"].values for name in _COLUMNS]
    return [
        MeasureRow(
            float(torque),
            str(name),
            str(unit),
            float(before),
            float(after),
            None if math.isnan(limit) else float(limit),
        )
        for torque, name, unit, before, after, limit in zip(*columns, strict=True)
    ]


def unit_of(name: str) -> str:
    """Return the unit of a dotted field, "1" without."""
    return field_unit(name.rpartition(".")[2])[0] or "1"
