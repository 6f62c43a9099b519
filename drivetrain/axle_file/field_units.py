"""Fields of the axle file and the SI numbers of the models: names, scales, and back."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Any

from gearlube_core.input_file.field_notes import field_unit
from gearlube_core.units import ZERO_CELSIUS

# power of ten from a unit to SI; what is absent is SI
_POWERS = {
    "mm": -3,
    "um": -6,
    "l": -3,
    "kN": 3,
    "MPa": 6,
    "GPa": 9,
    "1/GPa": -9,
}
_SI_WORDS = {"stiffness_constant": "N/m^n"}  # units that no ending writes


def unit_of(key: str) -> str:
    """Return the unit of a field, "" for a pure number or a text."""
    return _SI_WORDS.get(key) or field_unit(key)[0]


def attribute_of(key: str) -> str:
    """Return the name of a field without its unit, as the models have it.

    >>> attribute_of("contact_angle_deg")
    'contact_angle'
    """
    unit, ending = field_unit(key)
    return key if unit == "rpm" else key.removesuffix(ending)  # models have crank speeds in rpm


def _scaled(value: float, power: int) -> float:
    """Return value times a power of ten, rounded once: 83.7 mm is 0.0837 m to the last bit."""
    return float(Decimal(repr(float(value))).scaleb(power))


def si_value(key: str, value: Any) -> Any:
    """Return the value of a field in SI units; texts and whole numbers as they are."""
    if isinstance(value, tuple | list):
        return tuple(si_value(key, one) for one in value)
    unit = unit_of(key)
    if unit == "deg":
        return math.radians(value)
    if unit == "degC":
        return value + ZERO_CELSIUS
    return _scaled(value, _POWERS[unit]) if unit in _POWERS else value


def field_value(key: str, value: Any) -> Any:
    """Return a number of a model in the unit of a field; the inverse of `si_value`."""
    if isinstance(value, tuple | list):
        return tuple(field_value(key, one) for one in value)
    unit = unit_of(key)
    if unit == "deg":
        return float(f"{math.degrees(value):.12g}")
    if unit == "degC":
        return float(f"{value - ZERO_CELSIUS:.12g}")
    return _scaled(value, -_POWERS[unit]) if unit in _POWERS else value
