"""What reports call the ranges of formulas and tables that an axle can leave."""

from __future__ import annotations

from gearlube_core.dynamics.ranges import RANGE_OUTPUTS

_WORDS = (
    "torque (the mesh table ends)",
    "load of the film formula (Moes number M)",
    "speed and viscosity of the film formula (Moes number L)",
    "traction formula (its pressure, film and temperature together)",
    "film temperature (the oil data end)",
    "Hertz pressure (steel yields)",
)
RANGE_WORDS = dict(zip(RANGE_OUTPUTS[1:], _WORDS, strict=True))


def range_words(output: str) -> str:
    """Return the words for an output that has a range.

    >>> range_words("range.temperature")
    'film temperature (the oil data end)'
    """
    return RANGE_WORDS[output]
