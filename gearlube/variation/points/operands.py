"""Operands: what a study is computed at beside its input file."""

from __future__ import annotations

from typing import Any

from gearlube.variation.design import Point
from gearlube.variation.keys import Key, Kind


def operand(
    name: str,
    unit: str,
    meaning: str,
    usual: float | str,
    low: float = float("-inf"),
    high: float = float("inf"),
    kind: Kind = "number",
) -> Key:
    """Return the key of an operand."""
    return Key(name, kind, unit, meaning, "operand", usual, low, high)


def value(point: Point, key: Key) -> Any:
    """Return the value of an operand at a point, the usual one where it is not varied."""
    return point.get(key.name, key.usual)
