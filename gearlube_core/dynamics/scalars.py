"""Plain numbers of a model, each declared once beside the kernel that reads it.

A file of kernels may hold two classes for its own numbers: a dataclass of what a user gives, with
defaults and limits, and a NamedTuple of what its kernels take. The parameters of the model derive
from the first, and `constants_of` fills the second:

    class AdhesionScalars:
        adhesion: Annotated[float, Within(0.0, 9.0, "N")] = 0.25

    class AdhesionConstants(NamedTuple):
        adhesion: float  # N
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple, TypeVar, get_type_hints

from gearlube_core.checks import check_positive, check_within

_Constants = TypeVar("_Constants", bound=tuple[Any, ...])  # a NamedTuple


class Within(NamedTuple):
    """A number in the closed interval [low, high]."""

    low: float
    high: float
    unit: str = ""
    cure: str = ""  # a sentence for the error message

    def check(self, name: str, value: float) -> None:
        """Raise ParameterError outside the interval."""
        check_within(name, value, self.low, self.high, self.unit, self.cure)


class Positive(NamedTuple):
    """A finite number above zero."""

    unit: str

    def check(self, name: str, value: float) -> None:
        """Raise ParameterError for any other number."""
        check_positive(name, value, self.unit)


@cache
def _limits(kind: type) -> tuple[tuple[str, Within | Positive], ...]:
    """Return the limits of the fields of a class, in the order of declaration."""
    hints = get_type_hints(kind, include_extras=True)
    return tuple(
        (name, limits)
        for name, hint in hints.items()
        for limits in getattr(hint, "__metadata__", ())
        if isinstance(limits, (Within, Positive))
    )


def check_scalars(parameters: object) -> None:
    """Raise ParameterError when a field is outside the limits in its annotation."""
    kind: Any = type(parameters)
    for name, limits in _limits(kind):
        limits.check(name, getattr(parameters, name))


def constants_of(constants: type[_Constants], parameters: object, **given: Any) -> _Constants:
    """Return a NamedTuple of constants for kernels.

    Parameters
    ----------
    constants : type
        The NamedTuple class.
    parameters : object
        A constant that is not in `given` is its attribute of the same name, as a float.
    **given
        The other constants by name: floats or NamedTuples.
    """
    names: tuple[str, ...] = constants._fields  # type: ignore[attr-defined]
    same = {name: float(getattr(parameters, name)) for name in names if name not in given}
    return constants(**same, **given)
