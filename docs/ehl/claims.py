"""A statement of Jamali 2015 on films and how it is judged."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from docs.ehl.store import Store
from docs.validation.claims import FAILS, HOLDS, PARTLY, Verdict

GPA, UM, MM = 1e-9, 1e6, 1e3

__all__ = [
    "FAILS", "GPA", "HOLDS", "MM", "PARTLY", "UM", "Claim", "Verdict", "judge", "listed", "span",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Claim:
    """A named statement with the place it is printed at and what would confirm it."""

    name: str
    statement: str
    source: str
    tolerance: str
    evaluate: Callable[[Store], Verdict]


def judge(*parts: bool) -> str:
    """Return the word for a statement of several parts: all hold, none does, or some."""
    return HOLDS if all(parts) else PARTLY if any(parts) else FAILS


def span(low: float, high: float, form: str = "{:.2f}") -> str:
    """Return "low to high"."""
    return f"{form.format(low)} to {form.format(high)}"


def listed(values: Iterable[float], form: str = "{:.2f}") -> str:
    """Return values with strokes between."""
    return " / ".join(form.format(v) for v in values)
