"""What reports call the ranges of formulas and tables that an axle can leave."""

from __future__ import annotations

import re

from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.units import kelvin_to_celsius

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


def range_text(message: str) -> str:
    """Return the messages of left ranges for a reader: without output names, degC in place of K.

    >>> range_text("range.temperature: film should be within 273.15 to 423.15 K, got 430.15 K.")
    'Film should be within 0 to 150 °C, got 157 °C.'
    """

    def celsius(found: re.Match[str]) -> str:
        low, high, value = (kelvin_to_celsius(float(one)) for one in found.groups())
        return f"within {low:.4g} to {high:.4g} °C, got {value:.4g} °C"

    text = re.sub(r"within ([\d.]+) to ([\d.]+) K, got ([\d.]+) K", celsius, message)
    return re.sub(r"(?:range|film|bearing)\.\w+: (\w)", lambda found: found[1].upper(), text)
