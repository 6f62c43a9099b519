"""Units of the fields of input files, which the endings of their names write."""

from __future__ import annotations

import math
from decimal import Decimal
from functools import cache
from typing import Any

from gearlube_core.number import Number
from gearlube_core.units import ZERO_CELSIUS

_UNITS = {  # of names' endings; the longest that fits counts
    "_rpm": "rpm",
    "_rad_s": "rad/s",
    "_m_s": "m/s",
    "_hz": "Hz",
    "_mm": "mm",
    "_mm_per_rad": "mm/rad",
    "_um": "um",
    "_nm": "nm",
    "_us": "us",
    "_deg": "deg",
    "_mrad": "mrad",
    "_degc": "degC",
    "_kg": "kg",
    "_l": "l",
    "_kg_m3": "kg/m3",
    "_kg_m3_k": "kg/(m3.K)",
    "_kg_m2": "kg.m2",
    "_kg_mm2": "kg.mm2",
    "_m2": "m2",
    "_mm2_s": "mm2/s",
    "_m_s2": "m/s2",
    "_n": "N",
    "_kn": "kN",
    "_n_m": "N.m",
    "_n_m_per_rad": "N.m/rad",
    "_n_m_s_per_rad": "N.m.s/rad",
    "_n_s_per_m": "N.s/m",
    "_n_per_mm": "N/mm",
    "_n_per_um": "N/um",
    "_kn_per_rad": "kN/rad",
    "_knm_per_rad": "kN.m/rad",
    "_mpa": "MPa",
    "_gpa": "GPa",
    "_per_gpa": "1/GPa",
    "_pa_s": "Pa.s",
    "_per_k": "1/K",
    "_k_w": "K/W",
    "_w_m_k": "W/(m.K)",
    "_w_m_k2": "W/(m.K2)",
    "_j_kg_k": "J/(kg.K)",
}
# what a number is likely in that is far off: unit, times so many of the field's unit
_SLIPS: dict[str, tuple[tuple[str, float], ...]] = {
    "mm": (("m", 1e3), ("um", 1e-3), ("inch", 25.4), ("nm", 1e-6)),
    "um": (("mm", 1e3), ("m", 1e6), ("nm", 1e-3)),
    "us": (("ms", 1e3), ("s", 1e6), ("ns", 1e-3)),
    "kg": (("t", 1e3), ("g", 1e-3)),
    "l": (("m3", 1e3), ("ml", 1e-3)),
    "kg.m2": (("kg.mm2", 1e-6), ("kg.cm2", 1e-4), ("g.m2", 1e-3)),
    "kg.mm2": (("kg.m2", 1e6), ("kg.cm2", 1e2)),
    "kg/m3": (("g/cm3", 1e3),),
    "m2": (("cm2", 1e-4), ("mm2", 1e-6)),
    "deg": (("rad", 180.0 / math.pi), ("arcmin", 1.0 / 60.0)),
    "mrad": (("rad", 1e3), ("deg", 1e3 * math.pi / 180.0), ("arcmin", math.pi / 10.8)),
    "rpm": (("rad/s", 30.0 / math.pi), ("1/s", 60.0)),
    "N": (("kN", 1e3), ("mN", 1e-3)),
    "kN": (("N", 1e-3), ("MN", 1e3)),
    "N.m": (("kN.m", 1e3), ("N.mm", 1e-3)),
    "N/mm": (("N/m", 1e-3), ("kN/mm", 1e3)),
    "N.s/m": (("N.s/mm", 1e3),),
    "N/um": (("N/m", 1e-6), ("N/mm", 1e-3), ("kN/um", 1e3)),
    "N.m/rad": (("N.m/deg", 180.0 / math.pi), ("kN.m/rad", 1e3), ("N.mm/rad", 1e-3)),
    "N.m.s/rad": (("N.m.s/deg", 180.0 / math.pi), ("N.mm.s/rad", 1e-3)),
    "kN.m/rad": (("N.m/rad", 1e-3), ("MN.m/rad", 1e3)),
    "kN/rad": (("N/rad", 1e-3), ("MN/rad", 1e3)),
    "Hz": (("kHz", 1e3), ("1/min", 1.0 / 60.0)),
    "m/s": (("mm/s", 1e-3), ("km/h", 1.0 / 3.6)),
    "Pa.s": (("mPa.s", 1e-3), ("kPa.s", 1e3)),
    "J/(kg.K)": (("kJ/(kg.K)", 1e3),),
    "W/(m.K)": (("mW/(m.K)", 1e-3), ("kW/(m.K)", 1e3)),
    "MPa": (("Pa", 1e-6), ("GPa", 1e3), ("kPa", 1e-3)),
    "GPa": (("Pa", 1e-9), ("MPa", 1e-3)),
    "1/GPa": (("1/Pa", 1e9), ("1/MPa", 1e3)),
    "mm2/s": (("m2/s", 1e6),),
}
# power of ten from a unit to SI; what is absent is SI
_POWERS = {
    "mm": -3,
    "um": -6,
    "us": -6,
    "kg.mm2": -6,
    "l": -3,
    "kN": 3,
    "kN/rad": 3,
    "kN.m/rad": 3,
    "MPa": 6,
    "GPa": 9,
    "N/mm": 3,
    "N/um": 6,
    "1/GPa": -9,
}
_SI_WORDS = {"stiffness_constant": "N/m^n"}  # units that no ending writes


@cache
def field_unit(key: str) -> tuple[str, str]:
    """Return the unit of a field and the ending of its name that says so; both may be empty.

    >>> field_unit("tip_relief_um")
    ('um', '_um')
    """
    endings = [ending for ending in _UNITS if key.endswith(ending)]
    longest = max(endings, key=len, default="")
    return _UNITS.get(longest, ""), longest


def unit_ending(unit: str) -> str:
    """Return the ending of a field's name for a unit; "" where no ending says it.

    >>> unit_ending("N/um")
    '_n_per_um'
    """
    return next((ending for ending, one in _UNITS.items() if one == unit), "")


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
    return to_si(unit_of(key), value)


def to_si(unit: str, value: Any) -> Any:
    """Return a value in a unit of a file in SI units."""
    if value is None:
        return None
    if isinstance(value, tuple | list):
        return tuple(to_si(unit, one) for one in value)
    if unit == "deg":
        return math.radians(value)
    if unit == "degC":
        return value + ZERO_CELSIUS
    return _scaled(value, _POWERS[unit]) if unit in _POWERS else value


def field_value(key: str, value: Any) -> Any:
    """Return a number of a model in the unit of a field; the inverse of `si_value`."""
    return from_si(unit_of(key), value)


def from_si(unit: str, value: Any) -> Any:
    """Return a value in SI units in a unit of a file; the inverse of `to_si`."""
    if value is None:
        return None
    if isinstance(value, tuple | list):
        return tuple(from_si(unit, one) for one in value)
    if unit == "deg":
        return float(f"{math.degrees(value):.12g}")
    if unit == "degC":
        return float(f"{value - ZERO_CELSIUS:.12g}")
    return _scaled(value, -_POWERS[unit]) if unit in _POWERS else value


def limits_in(unit: str, number: Number) -> tuple[float, float]:
    """Return the limits of a number in a unit of a file.

    >>> limits_in("um", Number("m", 1e-9, 2e-5))
    (0.001, 20.0)
    """
    return from_si(unit, number.low), from_si(unit, number.high)


def in_other_units(unit: str, value: float) -> list[tuple[str, float]]:
    """Return the units that a number may be in, each with the number in the field's unit."""
    if unit == "degC":
        return [("K", value - ZERO_CELSIUS)]
    return [(other, factor * value) for other, factor in _SLIPS.get(unit, ())]
