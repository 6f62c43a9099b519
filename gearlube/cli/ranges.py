"""Ranges of numbers on the command line."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gearlube.cli.oil_option import kelvin_hint
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError


def numbers_from(
    option: str,
    texts: Sequence[str],
    unit: str,
    low: float,
    high: float,
    *,
    example: str,
    most: int = 2000,
) -> tuple[float, ...]:
    """Return the numbers of ranges "first:last:step" and single values, in rising order.

    Parameters
    ----------
    option
        Name of the option, for error messages.
    texts
        Ranges and values as typed; commas may separate them.
    unit, low, high
        Limits of each number.
    example
        A sensible range, for error messages.
    most
        Largest number of values of all ranges together.

    Raises
    ------
    ParameterError
        A text is not a range, or a number is outside its limits.

    Examples
    --------
    >>> numbers_from("--mu", ["0:0.3:0.1", "0.05"], "", 0.0, 1.0, example="0:0.3:0.01")
    (0.0, 0.05, 0.1, 0.2, 0.3)
    """
    cure = f"Write first:last:step, for instance {example}, or single values."
    space = f" {unit}" if unit else ""
    values: list[float] = []
    for text in (part for whole in texts for part in whole.split(",")):
        pieces = [check_finite(option, p, unit, cure) for p in text.split(":")]  # type: ignore[arg-type]
        if len(pieces) == 1:
            values += pieces
            continue
        if len(pieces) != 3:
            raise ParameterError(f"{option} must be a range of three numbers, got {text!r}. {cure}")
        first, last, step = pieces
        check_positive(f"the step of {option}", step, unit, cure)
        if last < first:
            raise ParameterError(
                f"The last value of {option} must be at least the first, {first:g}{space}, "
                f"got {last:g}{space}. {cure}"
            )
        steps = (last - first) / step * (1.0 + 1e-9)
        if not len(values) + steps < most:
            raise ParameterError(
                f"{option} must give at most {most} values, got {len(values) + steps + 1.0:.6g}. "
                "Use a larger step."
            )
        count = math.floor(steps) + 1
        values += [first + i * step for i in range(count)]
    rising = sorted({round(value, 12) for value in values})
    for value in rising:
        hint = kelvin_hint(value) if unit == "degC" else ""
        check_within(option, value, low, high, unit, cure + hint)
    return tuple(rising)


def two_numbers(option: str, text: str, example: str, what: str = "numbers") -> tuple[float, float]:
    """Return the numbers of "first:last"; `what` are they, for the error message.

    Examples
    --------
    >>> two_numbers("--range", "0.2:1.6", "0.5:1.5")
    (0.2, 1.6)
    """
    try:
        first, last = (float(piece) for piece in text.split(":"))
    except ValueError:
        first = last = math.nan
    if not math.isfinite(first + last):
        raise ParameterError(
            f"{option} must be two {what}, got {text!r}. Write FIRST:LAST, for instance {example}."
        )
    return first, last
