"""A statement, what was found, and the judgement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from docs.validation.claims import FAILS, HOLDS, PARTLY

if TYPE_CHECKING:
    from docs.resonance.evidence import Evidence

OPEN = "not reproducible"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was found with the shipped and with the reconstructed mesh; "-" where it is not asked.

    Mismatches in the second are 0 / 0.2 / 0.3 / 0.4 % in this order.
    """

    shipped: str
    shipped_verdict: str
    reconstructed: str
    reconstructed_verdict: str
    reason: str


@dataclass(frozen=True, slots=True)
class Claim:
    """A numbered statement with the place it is printed at and what would confirm it."""

    number: int
    statement: str
    source: str
    tolerance: str
    evaluate: Callable[[Evidence], Verdict]


def judge(ok: bool, partly: bool = False) -> str:
    """Return the word for a verdict."""
    return HOLDS if ok else PARTLY if partly else FAILS
