"""Findings of an optimisation as sentences with numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import xarray as xr

from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.optimise.dataset import MeasureRow, measures_of
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_MICRO = 1e6
_NEAR = 0.005  # of the bounds: a value counts as on its bound
_ACTIVE = 0.98  # of what a limit allows: from here on it holds the result back
_WORSE = 1.005  # times before: a smaller growth is what cells and positions change
_NAMED = 6
_UNITS = {"urad": "µrad", "um": "µm", "deg": "°", "1": ""}


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of an optimisation, the most important first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_optimise/optimise.nc"))[0].headline  # doctest: +SKIP
    'Without errors all mesh orders together change by −11.0 dB at 45 N·m, −8.6 dB at 84 N·m.'
    """
    rows = measures_of(dataset)
    return [
        _answer(dataset),
        *_limits(rows),
        _worse(rows),
        *_bounds(dataset),
        *_refused(dataset),
        *_not_improved(dataset),
        *_nominal(dataset),
    ]


def decibels(dataset: xr.Dataset, design: str = "better") -> dict[float, float]:
    """Return the change of all mesh orders together without errors [dB], by torque [N·m]."""
    whine = dataset["whine"].isel(error=0)
    before, after = (whine.sel(design=one).values for one in ("before", design))
    return {
        float(torque): float(change)
        for torque, change in zip(
            dataset["torque"].values, 20.0 * np.log10(after / before), strict=True
        )
    }


def _in_db(changes: dict[float, float]) -> str:
    return ", ".join(
        f"{_signed(change)} dB at {torque:g} N·m" for torque, change in changes.items()
    )


def _signed(value: float) -> str:
    return f"{value:+.1f}".replace("-", "−")


def _answer(dataset: xr.Dataset) -> Finding:
    changes = decibels(dataset)
    whine = _MICRO * dataset["whine"].isel(error=0)
    sizes = ", ".join(
        f"{number_text(float(whine.sel(design='before', torque=torque)))} to "
        f"{quantity_text(float(whine.sel(design='better', torque=torque)), 'µrad')} at "
        f"{torque:g} N·m"
        for torque in changes
    )
    with_errors, largest = "", ""
    worst = dict(changes)
    if dataset.sizes["error"] > 1:
        most = dataset["whine"].max("error")
        ratios = (most.sel(design="better") / most.sel(design="before")).values
        worst = dict(zip(changes, map(float, 20.0 * np.log10(ratios)), strict=True))
        at = dataset["whine"].sel(design="better").values
        _, error = np.unravel_index(int(np.argmax(at)), at.shape)
        with_errors = f"; with the worst of {dataset.sizes['error'] - 1} errors by {_in_db(worst)}"
        largest = f" With {_error_words(dataset['error'].values[error])} they are largest."
    return Finding(
        GOOD if max(*changes.values(), *worst.values()) < 0.0 else WARNING,
        f"Without errors all mesh orders together change by {_in_db(changes)}{with_errors}.",
        f"Without errors: {sizes} (root of the sum of squares).{largest}",
    )


def _error_words(name: object) -> str:
    return str(name).replace("_", " ").replace(" um", " µm")


def _limits(rows: list[MeasureRow]) -> list[Finding]:
    limited = [one for one in rows if one.limit is not None]
    broken = [one for one in limited if not one.is_kept]
    active = [one for one in limited if one.is_kept and one.after >= _ACTIVE * one.most > 0.0]
    found = [
        Finding(
            WARNING,
            f"At {one.torque:g} N·m the limit of {one.what} is not kept: {_text(one, one.after)}, "
            f"allowed {_text(one, one.most)}.",
            "Loosen limits, or free more fields.",
        )
        for one in broken
    ]
    if active:
        listed = "; ".join(f"{one.what} at {one.torque:g} N·m" for one in active[:_NAMED])
        found.append(
            Finding(
                NOTE,
                f"{len(active)} of {len(limited)} limits are active: {listed}.",
                "They limit the result: looser ones would give lower mesh orders.",
            )
        )
    elif limited and not broken:
        found.append(Finding(GOOD, f"All {len(limited)} limits are kept, none is active."))
    return found


def _text(row: MeasureRow, value: float) -> str:
    return quantity_text(value, _UNITS.get(row.unit, row.unit))


def _worse(rows: list[MeasureRow]) -> Finding:
    worse = [one for one in rows if one.after > _WORSE * one.before > 0.0 or
             one.after > 0.0 == one.before]  # fmt: skip
    if not worse:
        return Finding(GOOD, "No measure got worse at any torque.")
    listed = "; ".join(_growth(one) for one in worse[:_NAMED])
    more = f"; and {len(worse) - _NAMED} more" if len(worse) > _NAMED else ""
    return Finding(
        NOTE,
        f"{len(worse)} of {len(rows)} measures got worse: {listed}{more}.",
        "The table has all measures before and after.",
    )


def _growth(row: MeasureRow) -> str:
    change = f" ({row.change})" if row.before > 0.0 else ""
    return f"{row.what} at {row.torque:g} N·m, {_text(row, row.after)}{change}"


def _bounds(dataset: xr.Dataset) -> list[Finding]:
    part = dataset.sel(design="better")
    value, low, high = (part[name].values for name in ("value", "low", "high"))
    near = _NEAR * (high - low)
    listed = [
        f"{name} = {quantity_text(at, _UNITS.get(str(unit), str(unit)))}"
        for name, unit, at, reached in zip(
            part["parameter"].values,
            part["value_unit"].values,
            value,
            (np.abs(value - low) < near) | (np.abs(value - high) < near),
            strict=True,
        )
        if reached
    ]
    if not listed:
        return []
    verb = "is at its bound" if len(listed) == 1 else "are at their bounds"
    return [
        Finding(
            NOTE,
            f"{len(listed)} of {value.size} fields {verb}: {'; '.join(listed)}.",
            "Wider bounds, if they can be manufactured, may give lower mesh orders.",
        )
    ]


def _refused(dataset: xr.Dataset) -> list[Finding]:
    if dataset.attrs["kind"] != "hypoid":
        return []
    try:
        check_pair(HypoidGearFile.model_validate_json(dataset.attrs["gear_file"]))
    except ParameterError as reason:
        return [Finding(WARNING, "The better gear file would be refused.", str(reason))]
    return []


def _not_improved(dataset: xr.Dataset) -> list[Finding]:
    if dataset.attrs["improved"]:
        return []
    return [
        Finding(
            WARNING,
            "The search found nothing better than its start.",
            "Give another start, wider bounds, looser limits or more fields.",
        )
    ]


def _nominal(dataset: xr.Dataset) -> list[Finding]:
    if "nominal" not in dataset["design"].values:
        return []
    worst = _MICRO * dataset["whine"].max(("torque", "error"))
    own, other = (float(worst.sel(design=one)) for one in ("better", "nominal"))
    return [
        Finding(
            NOTE,
            f"The pair that is best without errors has {quantity_text(other, 'µrad')} with the "
            f"worst error, the better pair {quantity_text(own, 'µrad')}.",
            f"Without errors it changes by {_in_db(decibels(dataset, 'nominal'))}.",
        )
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of an optimisation, with the same names in every run."""
    rows = measures_of(dataset)
    limited = [one for one in rows if one.limit is not None]
    whine = _MICRO * dataset["whine"].isel(error=0)
    found = [
        Number(f"change of all mesh orders at {torque:g} N·m", change, "dB")
        for torque, change in decibels(dataset).items()
    ]
    pressure = [(one.before, one.after) for one in rows if one.what == "highest pressure"]
    return [
        *found,
        Number("largest mesh orders before", float(whine.sel(design="before").max()), "µrad"),
        Number("largest mesh orders after", float(whine.sel(design="better").max()), "µrad"),
        Number("highest pressure before", _away_from_edges(one for one, _ in pressure), "GPa"),
        Number("highest pressure after", _away_from_edges(one for _, one in pressure), "GPa"),
        Number("limits not kept", float(sum(not one.is_kept for one in limited)), digits=1),
    ]


def _away_from_edges(pressures: Iterable[float]) -> float:
    """Return the highest pressure [GPa]; NaN if a sharp edge presses, which has no finite value."""
    highest = max(pressures)
    return highest if highest < 1e-9 * EDGE_PRESSURE else math.nan
