"""Input checks. Their errors name the quantity, its value, the limit with unit and a cure."""

from __future__ import annotations

import math
import re
import stat
from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

from gearlube_core.errors import GearLubeError, ParameterError, unread

LARGEST_FILE = 50_000_000_000  # bytes of results that are not read at once


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


def is_it(name: object, known: Iterable[str]) -> str:
    """Return " Is it X?" with the known name that is most like a wrong one, "" if none is."""
    near = get_close_matches(str(name), list(known), 1)
    return f" Is it {near[0]}?" if near else ""


def check_file(
    path: str | Path,
    what: str,
    error: type[GearLubeError] = ParameterError,
    cure: str = "",
    largest: int = LARGEST_FILE,
) -> None:
    """Raise `error` unless there is an ordinary file of at most `largest` bytes.

    A device or a pipe may never end; a larger file is not what it should be. Parameters as of
    `read_content`.
    """
    try:
        found = Path(path).stat()
        if stat.S_ISDIR(found.st_mode):
            raise IsADirectoryError
    except ValueError:  # NUL
        raise error(
            f"The path of the {what} must be without control characters, got "
            f"{str(path)[:100]!r}. {cure}".strip()
        ) from None
    except OSError as reason:
        raise error(f"{unread(what, path, reason)}. {cure}".strip()) from None
    if not stat.S_ISREG(found.st_mode):
        raise error(
            f"The {what} {path} must be an ordinary file, got a device or a pipe. Write its "
            "content into a file first."
        )
    if found.st_size > largest:
        raise error(
            f"The {what} {path} must have at most {largest / 1e6:g} MB, got "
            f"{found.st_size / 1e6:.3g} MB. {cure}".strip()
        )


def read_content(
    path: str | Path,
    what: str,
    error: type[GearLubeError] = ParameterError,
    cure: str = "",
    largest: int = 50_000_000,
) -> bytes:
    """Return the bytes of a file; raise `error` where it cannot be read, with its folder.

    Parameters
    ----------
    path
        Path of the file to read.
    what
        Kind of file in errors, such as "mesh table".
    error
        Class of the error.
    cure
        Sentence at the end of the error, on what to do.
    largest
        Bytes that the file may have.
    """
    check_file(path, what, error, cure, largest)
    try:
        with Path(path).open("rb") as file:
            return file.read(largest)
    except OSError as reason:
        raise error(f"{unread(what, path, reason)}. {cure}".strip()) from None


def check_address(scheduler: str) -> str:
    """Return the address of a Dask scheduler; raise ParameterError unless it looks like one."""
    if not re.fullmatch(r"[a-z]+://[^\s/]+", scheduler):
        raise ParameterError(
            f"--scheduler must be an address such as tcp://host:8786, got {scheduler!r}. "
            "Take the one that the Dask scheduler prints when it starts."
        )
    return scheduler
