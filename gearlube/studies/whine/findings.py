"""What a whine study says, in sentences with numbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.plotting.parameter_words import parameter_words, tolerance_words
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube_core.units import rads_to_rpm

_RPM = rads_to_rpm(1.0)
_STRAIGHT = 0.3  # change over the amplitude above which a first-order change is only a hint
_NAMED = 3


class Mover(NamedTuple):
    """What the tolerance of one parameter changes of one mesh order, at most over the speeds."""

    parameter: str
    tolerance: float
    unit: str
    change: float  # of the mesh force, with sign [N]
    speed_rpm: float  # where
    amplitude: float  # of the mesh force there [N]

    @property
    def words(self) -> str:
        """The parameter and its tolerance as sentences name them."""
        name = parameter_words(self.parameter).replace(": ", " ")
        return f"{name}, +{tolerance_words(self.tolerance, self.unit)}"


def movers(dataset: xr.Dataset, order: int) -> list[Mover]:
    """Return the parameters of a whine dataset, what moves the force of a mesh order most first.

    Parameters that move nothing, or at no speed, are left out.
    """
    part = dataset.sel(order=order)
    force, speed = part["force"].values, _RPM * part["pinion_speed"].values
    found = []
    for name in part["parameter"].values:
        one = part.sel(parameter=name)
        tolerance = float(one["tolerance"])
        change = tolerance * one["force_rate"].values
        if not np.any(np.abs(np.nan_to_num(change)) > 0.0):
            continue
        at = int(np.nanargmax(np.abs(change)))
        found.append(
            Mover(
                str(name),
                tolerance,
                str(one["unit"].values),
                float(change[at]),
                float(speed[at]),
                float(force[at]),
            )
        )
    return sorted(found, key=lambda one: -abs(one.change))


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a whine study, the most important first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_whine/whine.nc"))[0].headline  # doctest: +SKIP
    'The largest mesh force is that of mesh order 1: 412 N, at 4100 rpm.'
    """
    return [_largest(dataset), *_moved(dataset), *_motions(dataset)]


def _crest(dataset: xr.Dataset, order: int) -> tuple[float, float]:
    """Return the largest force of an order [N] and its pinion speed [rpm]."""
    force = dataset["force"].sel(order=order).values
    at = int(np.nanargmax(force))
    return float(force[at]), float(_RPM * dataset["pinion_speed"].values[at])


def _largest(dataset: xr.Dataset) -> Finding:
    crests = {int(order): _crest(dataset, int(order)) for order in dataset["order"].values}
    order = max(crests, key=lambda one: crests[one][0])
    others = "; ".join(
        f"order {one}: {quantity_text(force, 'N')} at {speed:.0f} rpm"
        for one, (force, speed) in crests.items()
        if one != order
    )
    meets = meeting_speed(dataset, order)
    return Finding(
        NOTE,
        f"The largest mesh force is that of mesh order {order}: "
        f"{quantity_text(crests[order][0], 'N')}, at {crests[order][1]:.0f} rpm.",
        f"This order meets the natural frequency, {dataset.attrs['natural_frequency']:.0f} Hz, at "
        f"{meets:.0f} rpm. {others[:1].upper()}{others[1:]}{'.' if others else ''}",
    )


def meeting_speed(dataset: xr.Dataset, order: int) -> float:
    """Return the pinion speed [rpm] at which a mesh order meets the natural frequency."""
    attributes = dataset.attrs
    return float(60.0 * attributes["natural_frequency"] / (order * attributes["pinion_teeth"]))


def _moved(dataset: xr.Dataset) -> list[Finding]:
    found = []
    for order in dataset["order"].values:
        most = movers(dataset, int(order))
        if not most:
            continue
        top = most[0]
        share = abs(top.change) / top.amplitude
        next_ones = "; ".join(
            f"{one.words}: {quantity_text(one.change, 'N')} at {one.speed_rpm:.0f} rpm"
            for one in most[1:_NAMED]
        )
        detail = f"Next: {next_ones}. " if next_ones else ""
        if share > _STRAIGHT:
            detail += (
                f"It is a first-order change of {100.0 * share:.0f} % of the force there: sign "
                "and ranking are right, the size is a rough estimate. Halve "
                "the tolerance, or compute the "
                "changed pair."
            )
        found.append(
            Finding(
                WARNING if share > 1.0 else NOTE,
                f"Mesh order {order} is most sensitive to {top.words}: "
                f"{quantity_text(top.change, 'N')} at {top.speed_rpm:.0f} rpm, "
                f"{100.0 * share:.0f} % of its force.",
                detail.strip(),
            )
        )
    return found


def _motions(dataset: xr.Dataset) -> list[Finding]:
    missing = dataset["force"].isel(order=0).isnull().values
    unstable = ~missing & (dataset["stable"].values < 0.5)
    if not missing.any() and not unstable.any():
        return [Finding(GOOD, f"At all {missing.size} speeds the pair has a stable motion.")]
    speed = _RPM * dataset["pinion_speed"].values
    found = []
    for kept, words, cure in (
        (missing, "no periodic motion was found", "They are gaps in the figures."),
        (
            unstable,
            "the motion is not stable",
            "The real motion differs from the computed one there.",
        ),
    ):
        if kept.any():
            found.append(
                Finding(
                    WARNING,
                    f"At {int(kept.sum())} of {kept.size} speeds {words}, from "
                    f"{speed[kept].min():.0f} to {speed[kept].max():.0f} rpm.",
                    f"{cure} `gearlube resonance` follows all motions of such a pair.",
                )
            )
    return found


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a whine study, with the same names in every run."""
    found = [Number("natural frequency", float(dataset.attrs["natural_frequency"]), "Hz", 4)]
    for order in dataset["order"].values:
        force, speed = _crest(dataset, int(order))
        most = movers(dataset, int(order))
        error = 1e6 * float(dataset["transmission_error"].sel(order=order).max())
        found += [
            Number(f"largest mesh force, order {order}", force, "N"),
            Number(f"pinion speed of that force, order {order}", speed, "rpm", 4),
            Number(f"largest transmission error, order {order}", error, "µrad"),
            Number(
                f"largest change of the force by one tolerance, order {order}",
                abs(most[0].change) if most else float("nan"),
                "N",
            ),
        ]
    return found
