"""Units of FMI variables: exponents of the SI base units, and display units."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from fmu_src.variable import Variable
from gearlube_core.errors import ParameterError
from gearlube_core.units import ZERO_CELSIUS


@dataclass(frozen=True, slots=True, kw_only=True)
class DisplayUnit:
    """A display unit: shown value = factor * value + offset."""

    name: str
    factor: float
    offset: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """A coherent SI unit as a product of powers of base units."""

    name: str
    exponents: dict[str, int] = field(default_factory=dict)
    display: tuple[DisplayUnit, ...] = ()


_ALL = (
    Unit(name="1"),
    Unit(
        name="m",
        exponents={"m": 1},
        display=(DisplayUnit(name="um", factor=1e6), DisplayUnit(name="mm", factor=1e3)),
    ),
    Unit(
        name="m/s",
        exponents={"m": 1, "s": -1},
        display=(DisplayUnit(name="km/h", factor=3.6),),
    ),
    Unit(
        name="rad",
        exponents={"rad": 1},
        display=(DisplayUnit(name="deg", factor=180.0 / math.pi),),
    ),
    Unit(
        name="rad/s",
        exponents={"s": -1, "rad": 1},
        display=(DisplayUnit(name="rpm", factor=30.0 / math.pi),),
    ),
    Unit(name="rad/s2", exponents={"s": -2, "rad": 1}),
    Unit(name="m/s2", exponents={"m": 1, "s": -2}),
    Unit(name="Hz", exponents={"s": -1}),
    Unit(name="m3", exponents={"m": 3}, display=(DisplayUnit(name="l", factor=1e3),)),
    Unit(name="kg", exponents={"kg": 1}),
    Unit(name="kg.m2", exponents={"kg": 1, "m": 2}),
    Unit(
        name="N",
        exponents={"kg": 1, "m": 1, "s": -2},
        display=(DisplayUnit(name="kN", factor=1e-3),),
    ),
    Unit(name="N/m", exponents={"kg": 1, "s": -2}),
    Unit(
        name="N/m2",
        exponents={"kg": 1, "m": -1, "s": -2},
        display=(DisplayUnit(name="N/(mm.um)", factor=1e-9),),
    ),
    Unit(
        name="Pa",
        exponents={"kg": 1, "m": -1, "s": -2},
        display=(DisplayUnit(name="GPa", factor=1e-9),),
    ),
    Unit(name="N.m", exponents={"kg": 1, "m": 2, "s": -2}),
    Unit(name="N.m/s", exponents={"kg": 1, "m": 2, "s": -3}),
    Unit(name="J", exponents={"kg": 1, "m": 2, "s": -2}),
    Unit(name="W", exponents={"kg": 1, "m": 2, "s": -3}),
    Unit(
        name="K",
        exponents={"K": 1},
        display=(DisplayUnit(name="degC", factor=1.0, offset=-ZERO_CELSIUS),),
    ),
)
UNITS = {unit.name: unit for unit in _ALL}


def units_of(variables: Iterable[Variable]) -> tuple[Unit, ...]:
    """Return the units that `variables` use, each with only the display units in use."""
    shown: dict[str, set[str]] = {}
    for variable in variables:
        if variable.unit:
            if variable.unit not in UNITS:
                raise ParameterError(
                    f"The unit of {variable.name} must be one of {', '.join(UNITS)}; "
                    f"got {variable.unit!r}. Add it to fmu_src/units.py."
                )
            shown.setdefault(variable.unit, set()).add(variable.display_unit)
    return tuple(
        replace(unit, display=tuple(d for d in unit.display if d.name in shown[unit.name]))
        for unit in _ALL
        if unit.name in shown
    )
