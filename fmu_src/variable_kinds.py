"""Short functions that make the variables of the tables."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import fields, replace
from typing import Any, get_type_hints

from fmu_src.variable import Variable
from gearlube_core.number import numbers_of

# unit of a state -> unit and typical size of its derivative
_RATES = {
    "m": ("m/s", 0.01),
    "m/s": ("m/s2", 10.0),
    "rad": ("rad/s", 100.0),
    "rad/s": ("rad/s2", 1e3),
    "J": ("W", 1e3),
    "N.m": ("N.m/s", 1e3),
}


def input_(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    """Return a Real input."""
    return Variable(
        name=name, type="Real", causality="input", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def parameter(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    """Return a Real parameter."""
    return Variable(
        name=name, type="Real", causality="parameter", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def declared(model: type, argument: str, name: str = "", text: str = "", **shown: Any) -> Variable:
    """Return the parameter of a number that a model declares: its unit, limits and default.

    Parameters
    ----------
    model : type
        Dataclass with the number.
    argument : str
        Name of the field.
    name, text : str
        FMI name and description; by default those of the declaration.
    **shown
        Nominal value and display unit; a start value where the field has no default.
    """
    one = numbers_of(model)[argument]
    given: dict[str, Any] = {field.name: field.default for field in fields(model)}
    given = {"start": given[argument]} | shown
    real = get_type_hints(model)[argument] is not int
    return Variable(
        name=name or one.fmi, type="Real" if real else "Integer", causality="parameter",
        description=text or one.text, unit=one.unit if real else "", argument=argument,
        minimum=one.low, maximum=one.high, **given,
    )  # fmt: skip


def declared_in(model: type, known: Collection[str]) -> tuple[Variable, ...]:
    """Return the parameters of all numbers with an FMI name, but those `known` by argument."""
    found = numbers_of(model).items()
    return tuple(declared(model, name) for name, one in found if one.fmi and name not in known)


def option(name: str, description: str, *literals: str, start: str, argument: str) -> Variable:
    """Return an enumeration for a model option."""
    return Variable(
        name=name, type="Enumeration", causality="parameter", description=description,
        start=1 + literals.index(start), literals=literals, argument=argument,
    )  # fmt: skip


def options_by_number(variables: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return an Integer parameter for each enumeration, for hosts without enumerations."""
    return tuple(
        Variable(
            name=f"{one.name}.number", type="Integer", causality="parameter",
            description=f"{one.name} by number, starting at 1; 0 keeps the value of {one.name}",
            start=0, minimum=0, maximum=len(one.literals), option_of=one.name,
        )
        for one in variables if one.literals
    )  # fmt: skip


def count(
    name: str, description: str, start: int, minimum: int, maximum: int, argument: str
) -> Variable:
    """Return an Integer parameter."""
    return Variable(
        name=name, type="Integer", causality="parameter", description=description,
        start=start, minimum=minimum, maximum=maximum, argument=argument,
    )  # fmt: skip


def local(
    name: str, unit: str, description: str, nominal: float = 1.0, display_unit: str = ""
) -> Variable:
    """Return a Real that a solver needs and no connection."""
    return replace(output(name, unit, description, nominal, display_unit), causality="local")


def rates(states: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the derivative by time of each continuous state."""
    return tuple(
        replace(
            local(f"der({one.name})", unit, f"Time derivative: {_in_a_sentence(one)}", nominal),
            rate_of=one.name,
        )
        for one in states
        for unit, nominal in [_RATES[one.unit]]
    )  # fmt: skip


def _in_a_sentence(variable: Variable) -> str:
    return variable.description[0].lower() + variable.description[1:]


def output(
    name: str, unit: str, description: str, nominal: float = 1.0, display_unit: str = ""
) -> Variable:
    """Return a Real output."""
    return Variable(
        name=name, type="Real", causality="output", unit=unit, description=description,
        nominal=nominal, display_unit=display_unit,
    )  # fmt: skip
