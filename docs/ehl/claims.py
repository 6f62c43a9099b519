"""A statement of Jamali 2015 on films and how it is judged."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from docs.ehl.lines import GivenUpError
from docs.ehl.store import MissingFilmError, Store
from docs.validation.claims import FAILS, HOLDS, PARTLY, Verdict

GPA, UM, MM = 1e-9, 1e6, 1e3
MISSING = "not computed"

__all__ = [
    "FAILS", "GPA", "HOLDS", "MISSING", "MM", "PARTLY", "UM", "Claim", "Verdict", "judge", "listed",
    "span", "verdicts",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Claim:
    """A named statement with the place it is printed at and what would confirm it."""

    name: str
    statement: str
    source: str
    tolerance: str
    evaluate: Callable[[Store], Verdict]


def verdicts(claims: Iterable[Claim], store: Store) -> list[Verdict]:
    """Return the verdict on every claim; on none whose films are missing.

    A claim on a march that was given up fails.
    """
    found = []
    for claim in claims:
        try:
            found.append(claim.evaluate(store))
        except MissingFilmError as error:
            found.append(Verdict("-", MISSING, f"`{error}` is not computed yet."))
        except GivenUpError as error:
            found.append(Verdict("-", FAILS, f"A march was {error}."))
    return found


def judge(*parts: bool) -> str:
    """Return the word for a statement of several parts: all hold, none does, or some."""
    return HOLDS if all(parts) else PARTLY if any(parts) else FAILS


def span(low: float, high: float, form: str = "{:.2f}") -> str:
    """Return "low to high"."""
    return f"{form.format(low)} to {form.format(high)}"


def listed(values: Iterable[float], form: str = "{:.2f}") -> str:
    """Return values with strokes between."""
    return " / ".join(form.format(v) for v in values)
