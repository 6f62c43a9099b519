"""Count in docs/validation_summary.md how many published statements hold, page by page.

Run `python -m docs.validation_summary` after a page of claims has changed.
"""

from __future__ import annotations

import re
from collections import Counter

from docs.page import Page

# pages of statements, in the order of the table
PAGES = ("validation", "tooth_contact", "resonance", "helical", "ehl", "rough_line_contact")
# as a verdict may begin in a cell, and what it counts as
_KINDS = (
    ("does not hold", "no"),
    ("not held", "no"),
    ("sign held", "part"),
    ("order held", "part"),
    ("holds in part", "part"),
    ("near", "part"),
    ("calibrated", "calibrated"),
    ("holds", "yes"),
    ("held", "yes"),
)
_VERDICT = re.compile(r"\*\*([a-z ]+)\*\*")


def verdicts(text: str) -> Counter[str]:
    """Return how often each kind of verdict comes first in a row of the tables of a page."""
    found: Counter[str] = Counter()
    for line in text.splitlines():
        if not line.startswith("|"):
            continue
        words = next(iter(_VERDICT.findall(line)), "")
        for start, kind in _KINDS:
            if words.startswith(start):
                found[kind] += 1
                break
    return found


def refreshed() -> Page:
    """Return the page with the counts of now."""
    found = [verdicts(Page(name).text) for name in PAGES]
    kinds = ("yes", "part", "no", "calibrated")
    page = Page("validation_summary")
    page.cells("Page | Source | About", [[str(one[k]) for k in kinds] for one in found], first=3)
    return page


if __name__ == "__main__":
    refreshed().write()
