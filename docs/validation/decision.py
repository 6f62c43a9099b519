"""What would make a claim hold: one row of a table, and its place on a page."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

HEADING = "## What would make them hold"
_HEADS = ("#", "What would have to be other", "Here", "Needed", "Plausible?")


@dataclass(frozen=True, slots=True)
class Decision:
    """The change of input or reading that would make a claim hold, and whether it may be."""

    claim: str
    change: str
    here: str
    needed: str
    plausible: str


def table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table of a page."""
    heads = list(heads)
    lines = [heads, ["---"] * len(heads), *(list(row) for row in rows)]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def decision_table(decisions: Iterable[Decision]) -> str:
    """Return the table of decisions."""
    return table(_HEADS, ((d.claim, d.change, d.here, d.needed, d.plausible) for d in decisions))


def replace_section(page: Path, section: str) -> None:
    """Put `section`, which begins with HEADING, in place of the one that the page has."""
    text = page.read_text(encoding="utf-8")
    head, _, tail = text.partition(HEADING + "\n")
    if not tail:
        raise SystemExit(f"{page} has no section '{HEADING}'")
    _, found, rest = tail.partition("\n## ")
    page.write_text(head + section + ("\n## " + rest if found else ""), encoding="utf-8")
