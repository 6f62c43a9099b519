"""Numbers of pinion and gear, the standards' units, and limits in words."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

Pair = tuple[float, float]  # of pinion and gear
Factors = dict[str, float | Pair]
MM, MPA, UM = 1e3, 1e-6, 1e6  # the standards' units in 1 m, 1 Pa, 1 m
_One = TypeVar("_One")


def both(function: Callable[..., _One], *pairs: tuple[object, object]) -> tuple[_One, _One]:
    """Return a function of both members."""
    return function(*(one[0] for one in pairs)), function(*(one[1] for one in pairs))


def said(*limits: tuple[bool, str]) -> tuple[str, ...]:
    """Return the texts of limits that do not hold."""
    return tuple(text for holds, text in limits if not holds)
