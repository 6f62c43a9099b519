"""From what people type to what the sweep takes."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError

_MOST_SPEEDS = 500
_LOWEST_SPEED, _HIGHEST_SPEED = 1.0, 300.0  # km/h
_FORM = "Write first:last:step, for instance 20:100:5, or single values."


def speeds_from(texts: Sequence[str]) -> list[float]:
    """Return the speeds [km/h] that ranges "20:100:5" and single values ask for, in order.

    >>> speeds_from(["20:40:10", "55"])
    [20.0, 30.0, 40.0, 55.0]
    """
    speeds = [speed for text in texts for part in text.split(",") for speed in _range(part)]
    for speed in speeds:
        check_within("--speeds", speed, _LOWEST_SPEED, _HIGHEST_SPEED, "km/h", _FORM)
    return sorted(set(speeds))


def _range(text: str) -> list[float]:
    pieces = [_number(piece) for piece in text.split(":")]
    if len(pieces) == 1:
        return pieces
    if len(pieces) != 3:
        raise ParameterError(f"--speeds must be a range of three numbers, got {text!r}. {_FORM}")
    first, last, step = pieces
    check_positive("the step of --speeds", step, "km/h", _FORM)
    if last < first:
        raise ParameterError(
            f"The last speed of --speeds must be at least the first, {first:g} km/h, "
            f"got {last:g} km/h. {_FORM}"
        )
    count = math.floor((last - first) / step * (1.0 + 1e-12)) + 1
    if count > _MOST_SPEEDS:
        raise ParameterError(
            f"--speeds must give at most {_MOST_SPEEDS} values, got {count}. Use a larger step."
        )
    return [first + i * step for i in range(count)]


def _number(text: str) -> float:
    return check_finite("--speeds", text, "km/h", _FORM)  # type: ignore[arg-type]
