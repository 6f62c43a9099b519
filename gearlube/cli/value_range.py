"""Ranges of numbers as people type them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError

_MOST = 2000


def values_from(
    option: str, texts: Sequence[str], unit: str, low: float, high: float
) -> tuple[float, ...]:
    """Return the numbers that ranges "first:last:step" and single values ask for, rising.

    Parameters
    ----------
    option
        Its name, for errors.
    texts
        As typed; also separated by commas.
    unit, low, high
        Limits of each number.

    Examples
    --------
    >>> values_from("--mu", ["0:0.3:0.1", "0.05"], "", 0.0, 1.0)
    (0.0, 0.05, 0.1, 0.2, 0.3)
    """
    cure = "Write first:last:step, for instance 0:0.3:0.01, or single values."
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
                f"the last value of {option} must be at least the first, {first:g}, got {last:g}. "
                f"{cure}"
            )
        count = math.floor((last - first) / step * (1.0 + 1e-9)) + 1
        check_within(f"number of values of {option}", count, 1, _MOST, "", "Use a larger step.")
        values += [first + i * step for i in range(count)]
    rising = sorted({round(value, 12) for value in values})
    for value in rising:
        check_within(option, value, low, high, unit, cure)
    return tuple(rising)
