"""Input checks. Their errors name the quantity, its value, the limit with unit and a cure."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from pathlib import Path

from gearlube_core.errors import GearLubeError, ParameterError, unread


def _quantity(value: float, unit: str) -> str:
    return f"{value:g}" if unit in ("", "1") else f"{value:g} {unit}"


def check_finite(name: str, value: float, unit: str = "", cure: str = "") -> float:
    """Return `value` as float; raise ParameterError when it is not a finite number."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        kind = "a number" if unit in ("", "1") else f"a number in {unit}"
        message = f"{name} must be {kind}, got {value!r}."
        raise ParameterError(f"{message} {cure}".strip()) from None
    if not math.isfinite(number):
        raise ParameterError(
            f"{name} must be finite, got {_quantity(number, unit)}. {cure}".strip()
        )
    return number


def check_within(
    name: str, value: float, low: float, high: float, unit: str = "", cure: str = ""
) -> float:
    """Return `value` as float; raise ParameterError outside the closed interval [low, high]."""
    number = check_finite(name, value, unit, cure)
    if not low <= number <= high:
        limits = f"within {low:g} to {_quantity(high, unit)}"
        message = f"{name} must be {limits}, got {_quantity(number, unit)}."
        raise ParameterError(f"{message} {cure}".strip())
    return number


def check_positive(name: str, value: float, unit: str = "", cure: str = "") -> float:
    """Return `value` as float; raise ParameterError unless it is finite and above zero."""
    number = check_finite(name, value, unit, cure)
    if not number > 0.0:
        message = f"{name} must be above {_quantity(0.0, unit)}, got {_quantity(number, unit)}."
        raise ParameterError(f"{message} {cure}".strip())
    return number


def check_option(name: str, value: str, options: Iterable[str]) -> str:
    """Return `value`; raise ParameterError unless it is one of `options`."""
    allowed = tuple(options)
    if value not in allowed:
        raise ParameterError(f"{name} must be one of {', '.join(allowed)}; got {value!r}.")
    return value


def read_content(
    path: str | Path, what: str, error: type[GearLubeError] = ParameterError, cure: str = ""
) -> bytes:
    """Return the bytes of a file; raise `error` where it cannot be read, with its folder.

    Parameters
    ----------
    path
        Of the file.
    what
        Kind of file in errors, such as "mesh table".
    error
        Class of the error.
    cure
        Sentence at the end of the error, on what to do.
    """
    try:
        return Path(path).read_bytes()
    except OSError as reason:
        raise error(f"{unread(what, path, reason)}. {cure}".strip()) from None


def check_address(scheduler: str, name: str = "--scheduler") -> str:
    """Return the address of a Dask scheduler; raise ParameterError unless it looks like one."""
    if not re.fullmatch(r"[a-z]+://[^\s/]+", scheduler):
        raise ParameterError(
            f"{name} must be an address such as tcp://host:8786, got {scheduler!r}. "
            "Take the one that the Dask scheduler prints when it starts."
        )
    return scheduler
