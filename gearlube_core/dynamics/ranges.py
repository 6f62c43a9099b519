"""Ranges of the formulas and tables of a gear model: what they are, and what has left them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.friction.evans_johnson_1986 import MAP_RANGE
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant

# Outputs of every model. A value of zero: not in use now, for instance no flank carries load.
RANGE_EXCEEDED = "range.exceeded"
RANGE_OUTPUTS = (
    RANGE_EXCEEDED,  # sum of 1, 2, 4, ... for each quantity below that is outside its range
    "range.torque",  # of the mesh data or carried by the teeth; below 0 on the coast flanks [N.m]
    "range.film_load",  # load group M of Moes where the load is largest [-]
    "range.film_material",  # material group L of Moes there [-]
    "range.traction",  # number of the traction map there [-]
    "range.temperature",  # of the film there [K]
    "range.pressure",  # largest Hertz pressure there [Pa]
)
TORQUE, FILM_LOAD, FILM_MATERIAL, TRACTION, TEMPERATURE, PRESSURE = range(1, len(RANGE_OUTPUTS))

# Data of the end of a mesh table hold this far beyond it; further on, steps are refused. The
# stiffness of the shipped table rises by 13 % over the last factor of 1.5 below its end, so 600
# N.m with the data of 400 N.m is about as much too soft; at 5000 N.m it is no longer that pair.
TORQUE_MARGIN = 1.5
# Pa, static rating of hardened steel after ISO 76: above it the contact does not stay elastic
HERTZ_LIMIT = 4.0e9
# Below this film ratio roughness carries the load: no film formula is in use. So it is near rest.
LEAST_FILM_RATIO = 0.05
# rad, of shafts and cages: 55 hours at the highest speed. An angle is then known to 1e-7 rad, about
# 1e-6 of a mesh period; much further on the phase of the mesh is lost in rounding.
MAX_ANGLE = 1e9
TOO_FAR = 9  # status of a step or a state with an angle beyond it
MAX_SPEED = 5e3  # rad/s, of either shaft; 48 000 rpm is twice what electric drives reach


class Range(NamedTuple):
    """Range of one quantity, and what to do where it is left."""

    output: str
    what: str  # in words
    low: float
    high: float
    unit: str
    beyond: str  # a sentence: what is computed there, and the cure

    def sentence(self, value: float) -> str:
        """Return the message for a value outside."""
        unit = "" if self.unit == "1" else f" {self.unit}"
        return (
            f"{self.output}: {self.what} should be within {self.low:g} to {self.high:g}{unit}, "
            f"got {value:.4g}{unit}. {self.beyond}"
        )


# of outputs that only models of solved films give; not in `range.exceeded`
FILM_SHARES = tuple(
    Range(output, f"share of the {whose} load outside their film model", 0.0, MOST_OUTSIDE, "1",
          "Formulas stand in there, which may lose several times as much.")
    for output, whose in (
        ("film.share_outside", "flanks'"),
        ("bearing.share_outside", "rollers'"),
    )
)  # fmt: skip


class RangeLimits(NamedTuple):
    """Limits of all ranges for the kernels; floats."""

    torque_low: float  # N.m
    torque_high: float
    film_load_low: float  # [-]
    film_load_high: float
    film_material_low: float  # [-]
    film_material_high: float
    traction_low: float  # [-]
    traction_high: float
    temperature_low: float  # K
    temperature_high: float
    pressure_low: float  # Pa
    pressure_high: float


def range_limits(ranges: Sequence[Range]) -> RangeLimits:
    """Return the limits of ranges in the order of `RANGE_OUTPUTS`, the first left out."""
    return RangeLimits(*(float(limit) for one in ranges for limit in (one.low, one.high)))


def left_ranges(ranges: Sequence[Range], exceeded: float) -> list[Range]:
    """Return the ranges that the sum `range.exceeded` names."""
    return [one for bit, one in enumerate(ranges) if int(exceeded) >> bit & 1]


@kernel
def write_ranges(
    torque: float,
    film_load: float,
    film_material: float,
    traction: float,
    temperature: float,
    pressure: float,
    limits: RangeLimits,
    first: int,
    out: Array,
) -> None:
    """Write all `RANGE_OUTPUTS` from place `first` of `out`."""
    values = (torque, film_load, film_material, traction, temperature, pressure)
    exceeded = 0.0
    bit = 1.0
    for i in range(6):
        value = values[i]
        out[first + 1 + i] = value
        if value != 0.0 and not limits[2 * i] <= value <= limits[2 * i + 1]:
            exceeded += bit
        bit *= 2.0
    out[first] = exceeded


def model_ranges(
    torque: tuple[float, float],
    torque_cure: str,
    oil: Lubricant,
    film_load: tuple[float, float],
    film_material: tuple[float, float],
) -> tuple[Range, ...]:
    """Return all ranges in the order of `RANGE_OUTPUTS`, the first left out.

    Parameters
    ----------
    torque : tuple of 2 floats
        Pinion torques at the ends of the mesh data [N.m].
    torque_cure : str
        A sentence: where data for higher torques come from.
    oil : Lubricant
        Its range of temperatures holds for films too.
    film_load, film_material : tuple of 2 floats
        Groups M and L of Moes where the film formula holds [-].
    """
    described = (
        (
            "torque of the mesh data or carried by the teeth",
            torque,
            "N.m",
            f"The data of the end hold, up to {TORQUE_MARGIN:g} times its torque. {torque_cure}",
        ),
        (
            "Moes load M of the most loaded contact",
            film_load,
            "1",
            "The film formula is extrapolated; below its range films of rigid solids are thicker.",
        ),
        (
            "Moes material number L of the most loaded contact",
            film_material,
            "1",
            "The film formula is extrapolated. Check speed and oil temperature.",
        ),
        (
            "traction number of the most loaded contact",
            MAP_RANGE,
            "1",
            "The traction formula is extrapolated; below its range the film is too thick for it.",
        ),
        (
            "film temperature of the most loaded contact",
            (oil.temperature_low, oil.temperature_high),
            "K",
            f"The data of {oil.name} end there. Lower the load, the speed or the oil temperature.",
        ),
        (
            "Hertz pressure of the most loaded contact",
            (0.0, HERTZ_LIMIT),
            "Pa",
            "Steel does not stay elastic there, the model does. Lower the torque.",
        ),
    )
    return tuple(
        Range(output, what, *limits, unit, beyond)
        for output, (what, limits, unit, beyond) in zip(RANGE_OUTPUTS[1:], described, strict=True)
    )
