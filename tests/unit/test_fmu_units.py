"""Units of the FMUs: their names say what their exponents and factors must be."""

import math
import re
from collections import Counter

import pytest

from fmu_src.model_description import UNITS, Unit, units_of
from fmu_src.variable import Variable
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

# of the SI, in base units
_NEWTON = {"kg": 1, "m": 1, "s": -2}
_JOULE = {"kg": 1, "m": 2, "s": -2}
KNOWN = {
    "1": {}, "m": {"m": 1}, "s": {"s": 1}, "kg": {"kg": 1}, "K": {"K": 1}, "rad": {"rad": 1},
    "Hz": {"s": -1}, "N": _NEWTON, "J": _JOULE, "W": {**_JOULE, "s": -3},
    "Pa": {"kg": 1, "m": -1, "s": -2},
}  # fmt: skip
PREFIX = {"um": 1e-6, "mm": 1e-3, "kN": 1e3, "GPa": 1e9, "N": 1.0, "m": 1.0}


def exponents_of(name):
    """Powers of the base units of a name such as kg.m/s2."""
    found = Counter()
    above, _, below = name.partition("/")
    for part, sign in [(p, 1) for p in above.split(".")] + [(p, -1) for p in below.split(".") if p]:
        symbol, power = re.fullmatch(r"([A-Za-z]+|1)(\d?)", part).groups()
        for base, exponent in KNOWN[symbol].items():
            found[base] += sign * exponent * int(power or 1)
    return {base: power for base, power in found.items() if power}


@each("name", [*UNITS, "N.m.s/rad", "W/m2", "Pa.s"])
def test_exponents_are_those_of_the_name(name):
    assert exponents_of(name) == Unit(name).exponents


@each(
    ("unit", "shown", "value", "expected"),
    [
        ("m", "um", 2e-6, 2.0), ("m", "mm", 2e-3, 2.0), ("rad", "deg", math.pi, 180.0),
        ("rad/s", "rpm", 2.0 * math.pi, 60.0), ("N", "kN", 3000.0, 3.0), ("Pa", "GPa", 4e9, 4.0),
        ("N/m2", "N/(mm.um)", 1.4e10, 14.0),  # as stiffness per length of a tooth is quoted
        ("K", "degC", 273.15, 0.0), ("K", "degC", 373.15, 100.0),
    ],
)  # fmt: skip
def test_display_units_show_what_their_names_say(unit, shown, value, expected):
    display = next(one for one in UNITS[unit].display if one.name == shown)
    assert display.factor * value + display.offset == pytest.approx(expected, abs=1e-12)


def output(unit, display=""):
    return Variable(
        name="x", type="Real", causality="output", description="x", unit=unit, display_unit=display
    )


def test_units_in_use_come_once_with_the_display_units_in_use():
    flag = Variable(name="on", type="Boolean", causality="output", description="on")
    found = units_of([output("m", "um"), flag, output("N"), output("m")])
    shown = [(unit.name, [one.name for one in unit.display]) for unit in found]
    assert shown == [("m", ["um"]), ("N", [])]
    assert [one.name for one in units_of([output("W/(m.K)"), output("m")])] == ["m", "W/(m.K)"]
    assert Unit("W/(m.K)").exponents == {"kg": 1, "m": 1, "s": -3, "K": -1}
    with pytest.raises(ParameterError, match=r"unit of x must be one of .* got 'furlong'"):
        units_of([output("furlong")])
