"""Ranges of a gear model's tables and formulas, in words."""

from __future__ import annotations

from gearlube_core.dynamics.ranges import HERTZ_LIMIT, RANGE_OUTPUTS, TORQUE_MARGIN, Range
from gearlube_core.friction.evans_johnson_1986 import MAP_RANGE
from gearlube_core.oil.lubricant import Lubricant


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
