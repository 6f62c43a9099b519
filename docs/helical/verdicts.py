"""A statement about helical pairs, what was found, and the judgement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from docs.validation.claims import FAILS, HOLDS, PARTLY, Verdict

if TYPE_CHECKING:
    from docs.helical.cases import Evidence

CALIBRATED, OPEN = "calibrated", "not testable"

__all__ = ["CALIBRATED", "FAILS", "HOLDS", "OPEN", "PARTLY", "Claim", "Verdict", "judge"]


@dataclass(frozen=True, slots=True)
class Claim:
    """A named statement with the place it is printed at and what would confirm it."""

    name: str
    statement: str
    source: str
    tolerance: str
    evaluate: Callable[[Evidence], Verdict]


def judge(ok: bool, partly: bool = False) -> str:
    """Return the word for a verdict."""
    return HOLDS if ok else PARTLY if partly else FAILS
