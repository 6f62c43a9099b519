"""Parsing of the options `--vary` and `--design`."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any, NamedTuple

from gearlube.cli.ranges import numbers_from
from gearlube.variation.design import METHODS, Axis, Sampling, Spread
from gearlube.variation.keys import Key, Keys, understood
from gearlube.variation.scatter import spread_about
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.tolerance import Tolerance

_EXAMPLE = "--vary pinion.bearing.preload_n=2000:6000:1000 oil.temperature=40,80"
MOST_VALUES = 100_000
_SCATTERS = "+-"
SCATTER_DESIGN = "lhs:1000"  # unless another is given


class Varied(NamedTuple):
    """Axes and spreads of a command line."""

    axes: tuple[Axis, ...]
    spreads: tuple[Spread, ...]


def varied_from(texts: Sequence[str], keys: Keys) -> Varied:
    """Return the axes and spreads of texts such as "oil.temperature=40,80".

    Parameters
    ----------
    texts
        KEY=first:last:step and KEY=a,b,c make axes, KEY=low:high a range to sample, and
        KEY=value+-width a normal distribution to sample, three standard deviations to the width.
    keys
        What can be varied.

    Raises
    ------
    ParameterError
        A key is unknown, or a value no number of its kind.

    Examples
    --------
    >>> key = Key("pinion.speed_rpm", "number", "rpm", "", "operand", 2000.0, 1.0, 47000.0)
    >>> varied_from(["pinion.speed=1000:3000:1000"], {key.name: key}).axes[0].values
    (1000.0, 2000.0, 3000.0)
    """
    axes: list[Axis] = []
    spreads: list[Spread] = []
    for text in texts:
        name, equals, given = text.partition("=")
        if not equals or not name.strip() or not given.strip():
            raise ParameterError(f"--vary must be KEY=VALUES, got {text!r}. Write {_EXAMPLE}.")
        key = understood(name.strip(), keys)
        middle, scatters, width = given.replace("±", _SCATTERS).partition(_SCATTERS)
        if key.kind != "text" and scatters:
            spreads.append(_scatter(key, middle, width))
        elif key.kind != "text" and given.count(":") == 1 and "," not in given:
            spreads.append(_range(key, given))
        else:
            axes.append(Axis(key.name, _values(key, given)))
    return Varied(tuple(axes), tuple(spreads))


def _check_sampled(key: Key, text: str) -> None:
    if key.kind != "number":
        raise ParameterError(
            f"{key.name} must be a {key.kind}, so it cannot be sampled between two values, got "
            f"{text!r}. Write first:last:step or single values."
        )


def _scatter(key: Key, middle: str, width: str) -> Spread:
    _check_sampled(key, f"{middle}{_SCATTERS}{width}")
    given: Any = width
    value = _number(key, middle)
    reach = check_positive(f"the width of {key.name}", given, key.unit, "Write 0+-30.")
    for end in (value - reach, value + reach):
        check_within(key.name, end, key.low, key.high, key.unit, "The ends must be in range.")
    return spread_about(key.name, value, Tolerance(plus_minus=reach))


def _range(key: Key, text: str) -> Spread:
    _check_sampled(key, text)
    low, high = (_number(key, part) for part in text.split(":"))
    return Spread(key=key.name, low=low, high=high)


def _number(key: Key, text: str) -> float:
    """Return a number within the limits of an operand; a file checks those of its fields."""
    number: Any = text
    return check_within(key.name, number, key.low, key.high, key.unit)


def _values(key: Key, text: str) -> tuple[Any, ...]:
    if key.kind == "text":
        parts = [part.strip() for part in text.split(",")]
        if not all(parts):
            raise ParameterError(f"{key.name} must be texts with commas between, got {text!r}.")
        return tuple(dict.fromkeys(parts))
    numbers = numbers_from(
        key.name, [text], key.unit, key.low, key.high, example="2000:6000:1000", most=MOST_VALUES
    )
    if key.kind == "number":
        return numbers
    for number in numbers:
        if number != int(number):
            raise ParameterError(f"{key.name} must be a whole number, got {number:g}.")
    return tuple(int(number) for number in numbers)


def sampling_from(text: str | None, seed: int) -> Sampling | None:
    """Return the sampling of a text such as "lhs:200"; None, "" or "grid": none.

    Examples
    --------
    >>> sampling_from("sobol:256", 1)
    Sampling(method='sobol', count=256, seed=1)
    """
    check_within("--seed", seed, 0, 2**32 - 1)
    if text is None or text == "grid":
        return None
    method, colon, count = text.partition(":")
    if method not in METHODS or not colon or not count.isdecimal() or len(count) > 9:
        raise ParameterError(
            "--design must be grid, or the method and number of samples, "
            f"{', '.join(f'{one}:256' for one in METHODS)}, got {text!r}."
        )
    return Sampling(method, int(count), seed)  # type: ignore[arg-type]


def limits_from(texts: Sequence[str], quantities: Sequence[str]) -> dict[str, float]:
    """Return the limits of texts such as "loss=500" by quantity.

    Examples
    --------
    >>> limits_from(["loss=500"], ["loss", "efficiency"])
    {'loss': 500.0}
    """
    limits: dict[str, float] = {}
    for text in texts:
        name, equals, given = text.partition("=")
        if not equals or name not in quantities:
            near = get_close_matches(name, quantities, 3, 0.5)
            cure = (
                f"Is it {' or '.join(near)}?" if near else "`gearlube vary STUDY --keys` lists all."
            )
            raise ParameterError(f"--limit must be QUANTITY=VALUE, got {text!r}. {cure}")
        number: Any = given
        limits[name] = check_finite(f"--limit of {name}", number)
    return limits
