"""Plain numbers of a model or a part, each declared once beside what reads it.

The declaration is the field of a dataclass, with a `Number` in its annotation. From it follow the
check of its limits, and for the numbers of a part the field of an input file, the FMI variable, the
uncertain input and the row of a reference page.

A file of kernels may hold two classes for its own numbers: a dataclass of what a user gives, with
defaults and limits, and a NamedTuple of what its kernels take. The parameters of the model derive
from the first, and `constants_of` fills the second:

    class AdhesionScalars:
        adhesion: Annotated[float, Number("N", 0.0, 9.0)] = 0.25

    class AdhesionConstants(NamedTuple):
        adhesion: float  # N
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any, Literal, NamedTuple, TypeVar, get_args, get_origin, get_type_hints

from gearlube_core.checks import check_option, check_positive, check_within

_Constants = TypeVar("_Constants", bound=tuple[Any, ...])  # a NamedTuple


class Number(NamedTuple):
    """A number in the closed interval [low, high].

    Examples
    --------
    >>> Number("N.m", 0.0, 1e4).check("torque", 5.0)
    """

    unit: str  # "1" for a pure number
    low: float
    high: float
    cure: str = ""  # a sentence for the error message
    text: str = ""  # what it is, in a line
    source: str = ""  # of its default and of its factor
    factor: float = 1.0  # the true value lies between value/factor and value * factor with 95 %
    fmi: str = ""  # name of its parameter of the FMU, if it is one
    shown: str = ""  # unit in files, if it is another

    def check(self, name: str, value: float) -> None:
        """Raise ParameterError when a value is outside of the interval."""
        check_within(name, value, self.low, self.high, self.unit, self.cure)


class Output(NamedTuple):
    """A number that a model computes, as an output of its FMU."""

    name: str
    unit: str  # "1" for a pure number
    text: str  # what it is, in a line
    nominal: float = 1.0  # typical magnitude
    shown: str = ""  # unit to show it in, if it is another


class Positive(NamedTuple):
    """A finite number above zero."""

    unit: str
    cure: str = ""


@cache
def _declared(kind: type) -> Mapping[str, tuple[Any, ...]]:
    """Return what the annotations of a dataclass declare by field: numbers, or names to choose."""
    found = {}
    for name, hint in get_type_hints(kind, include_extras=True).items():
        marks = [one for one in getattr(hint, "__metadata__", ()) if isinstance(one, _Mark)]
        if marks or get_origin(hint) is Literal:
            found[name] = tuple(marks) or get_args(hint)
    return found


_Mark = Number | Positive


def numbers_of(kind: type) -> Mapping[str, Number]:
    """Return the declared numbers of a dataclass by name, in the order of declaration."""
    declared: Any = _declared(kind)  # type: ignore[arg-type]
    return {name: one for name, (one, *_) in declared.items() if isinstance(one, Number)}


def check_fields(parameters: object) -> None:
    """Raise ParameterError when a field is not as its annotation says.

    A number must be within the limits of its `Number` or above zero, a `Literal` one of its texts.
    A field whose default is None may be None, in a class without slots.
    """
    kind: Any = type(parameters)
    for name, declared in _declared(kind).items():
        value, one = getattr(parameters, name), declared[0]
        if value is None and getattr(kind, name, 0) is None:
            continue
        if isinstance(one, Number):
            one.check(name, value)
        elif isinstance(one, Positive):
            check_positive(name, value, one.unit, one.cure)
        else:
            check_option(name, value, declared)


class Checked:
    """A dataclass that cannot be made with fields which `check_fields` refuses."""

    __slots__ = ()

    def __post_init__(self) -> None:
        check_fields(self)


def constants_of(constants: type[_Constants], parameters: object, **given: Any) -> _Constants:
    """Return a NamedTuple of constants for kernels.

    Parameters
    ----------
    constants : type
        NamedTuple class of the constants.
    parameters : object
        A constant that is not in `given` is its attribute of the same name, as a float.
    **given
        The other constants by name: floats or NamedTuples.
    """
    names: tuple[str, ...] = constants._fields  # type: ignore[attr-defined]
    same = {name: float(getattr(parameters, name)) for name in names if name not in given}
    return constants(**same, **given)
