"""What a variation says, in sentences with numbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.variation.summary import cells, inputs_of

_STRONG = 0.5  # rank correlation from which a quantity is said to follow an input
_NAMED = 2
_EVERYDAY = {"m": (1e6, "µm"), "1": (1.0, ""), "degC": (1.0, "°C"), "K": (1.0, "K")}


class Shown(NamedTuple):
    """A quantity that the reports show: name, meaning, and the unit they show it in."""

    name: str
    meaning: str
    factor: float
    unit: str


def shown_quantities(results: xr.Dataset) -> list[Shown]:
    """Return the quantities that figures and reports show."""
    found = []
    for name in results.attrs["shown"]:
        about = results[name].attrs
        unit = str(about["units"])
        factor, everyday = _EVERYDAY.get(unit, (1.0, unit.replace("N m", "N·m")))
        found.append(Shown(str(name), str(about["long_name"]), factor, everyday))
    return found


def findings(results: xr.Dataset, summary: xr.Dataset) -> list[Finding]:
    """Return the findings of a variation, the most important first."""
    failed, points = int(summary["failed"].sum()), results.sizes["point"]
    found = []
    if failed:
        found.append(
            Finding(WARNING, f"{failed} of {points} points failed.", "points.csv says why.")
        )
    if failed == points:
        return found
    found += [_range(summary, one) for one in shown_quantities(results)]
    return [*found, *_limits(summary), *_outside(results)]


def numbers(results: xr.Dataset, summary: xr.Dataset) -> list[Number]:
    """Return the key numbers of a variation: mean and ends of each shown quantity."""
    found = []
    for one in shown_quantities(results):
        values = one.factor * summary["statistics"].sel(quantity=one.name)
        found += [
            Number(f"{one.meaning}: {words}", _over_axes(values, statistic), one.unit)
            for statistic, words in (("low", "least"), ("mean", "mean"), ("high", "largest"))
        ]
    return found


def _over_axes(values: xr.DataArray, statistic: str) -> float:
    one = values.sel(statistic=statistic).values
    if not np.isfinite(one).any():
        return float("nan")
    return float({"low": np.nanmin, "high": np.nanmax}.get(statistic, np.nanmean)(one))


def _range(summary: xr.Dataset, one: Shown) -> Finding:
    values = one.factor * summary["statistics"].sel(quantity=one.name)
    low, mean, high = (_over_axes(values, name) for name in ("low", "mean", "high"))
    said = [*_axis_effects(values), *_strongest(summary, one.name)]
    if summary.sizes["input"]:
        said.append(_scatter(values, one))
    return Finding(
        NOTE,
        f"{one.meaning[0].upper()}{one.meaning[1:]}: {number_text(low)} to "
        f"{quantity_text(high, one.unit)}, mean {quantity_text(mean, one.unit)}.",
        " ".join(said),
    )


def _axis_effects(values: xr.DataArray) -> list[str]:
    """Return how the mean changes from the first to the last value of each axis with numbers."""
    mean = values.sel(statistic="mean")
    said = []
    for axis in mean.dims:
        if mean[axis].dtype.kind != "f" or mean.sizes[axis] < 2:
            continue
        first, last = (float(mean.isel({axis: i}).mean()) for i in (0, -1))
        if not (np.isfinite(first) and np.isfinite(last)) or first == 0.0:
            continue
        ends = (float(mean[axis][i]) for i in (0, -1))
        words = " to ".join(f"{end:g}" for end in ends)
        change = 100.0 * (last / first - 1.0)
        sign = "+" if change > 0.0 else ""
        said.append(f"Over {axis} {words} it changes by {sign}{number_text(change)} %.")
    return said


def _strongest(summary: xr.Dataset, name: str) -> list[str]:
    if not summary.sizes["input"]:
        return []
    ranks = summary["rank_correlation"].sel(quantity=name)
    mean = ranks.mean([d for d in ranks.dims if d != "input"]).values
    if not np.isfinite(mean).any():
        return []
    order = np.argsort(-np.abs(np.nan_to_num(mean)))
    strong = [
        f"{summary['input'].values[i]} ({mean[i]:+.2f})".replace("-", "−")
        for i in order[:_NAMED]
        if abs(np.nan_to_num(mean)[i]) >= _STRONG
    ]
    if not strong:
        return ["No single input dominates (rank correlations below 0.5)."]
    return [f"It follows most {' and '.join(strong)}, by rank correlation."]


def _scatter(values: xr.DataArray, one: Shown) -> str:
    low, high = (float(values.sel(statistic=p).mean()) for p in ("p2.5", "p97.5"))
    over = ", mean over the axes" if values.sel(statistic="mean").size > 1 else ""
    ends = f"{number_text(low)} and {quantity_text(high, one.unit)}"
    return f"95 % of the samples lie between {ends}{over}."


def _limits(summary: xr.Dataset) -> list[Finding]:
    if "limited" not in summary.coords:
        return []
    found = []
    for name, limit in zip(summary["limited"].values, summary["limit"].values, strict=True):
        unit = str(summary["unit"].sel(quantity=name).values)
        share = 100.0 * float(summary["share_above"].sel(limited=name).mean())
        found.append(
            Finding(
                GOOD if share == 0.0 else WARNING,
                f"{share:.3g} % of the points have a {name} above "
                f"{quantity_text(float(limit), '' if unit == '1' else unit)}.",
            )
        )
    return found


def _outside(results: xr.Dataset) -> list[Finding]:
    if "range_exceeded" not in results:
        return []
    outside = results["range_exceeded"].values
    share = 100.0 * float(np.mean(outside[np.isfinite(outside)] > 0.0))
    if share == 0.0:
        return [Finding(GOOD, "No point left the range of a formula or table.")]
    return [
        Finding(
            WARNING,
            f"{share:.3g} % of the points left the range of a formula or table.",
            "What is computed there is extrapolated; points.csv says which.",
        )
    ]


def conditions(summary: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Return words and statistics of each combination of the axes."""
    return [
        (
            ", ".join(
                f"{name} {value:g}" if isinstance(value, float | np.floating) else f"{name} {value}"
                for name, value in values.items()
            ),
            cell,
        )
        for values, cell in cells(summary)
    ]


def units_of(results: xr.Dataset) -> dict[str, str]:
    """Return the unit of each varied parameter."""
    return {one["key"]: str(one["unit"]) for one in inputs_of(results)}
