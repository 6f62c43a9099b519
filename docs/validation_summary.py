"""Write docs/validation_summary.md: how many published statements hold, page by page.

Run `python -m docs.validation_summary` after a page of claims has changed.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE / "validation_summary.md"
# page, source of its statements, what they are about
PAGES = (
    ("validation", "Mohammadpour et al. 2015", "hypoid axle on roller bearings, speed sweeps"),
    ("tooth_contact", "the same, and Karagiannis et al. 2012", "contact of the hypoid pair"),
    ("resonance", "Karagiannis et al. 2012", "resonance and friction of the hypoid pair"),
    ("helical", "He et al. 2007, Jamali 2015", "helical pair: geometry, vibration"),
    ("ehl", "Jamali 2015, chapters 4 to 6", "films of helical gears"),
    ("rough_line_contact", "Jamali 2015, chapter 7", "rough line contact in motion"),
)
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

_HEAD = """# Validation in short

Written by `python -m docs.validation_summary`; not edited by hand.

gearlube implements four publications. Their statements are written down one by one, each with a
tolerance. Each page below has the full table: what the source says, what gearlube finds, and why a
statement does not hold. *Calibrated* means that a number was chosen to meet the statement, so it
proves nothing.

| Page | Source | About | Hold | In part | Do not hold | Calibrated |
|---|---|---|---|---|---|---|
"""
_TAIL = """
A statement that does not hold stays in the table. Often the source leaves out an input or prints a
formula with a missing factor; the pages say which input would make it hold.

Besides the papers, the equations are held against independent solutions:

| What | Against | Page |
|---|---|---|
| films | finer grids, closed forms, published films | [errors of films](film_error.md), [table of films](film_table.md), [thermal films](ehl_thermal.md) |
| film formulas of the axle | full film solutions of the same flanks | [hypoid films](ehl_hypoid.md) |
| bearing friction | a published measurement | [bearing friction](bearing.md) |
| losses of the axle | published ranges and trends | [loss map](loss_map.md) |
| designed gears | contact analysis of the written file | [designs](designs.md) |
| FMUs | the same FMU in seven host programs | [host programs](fmu_hosts.md) |

[What can I trust this for?](trust.md) says what this means for your results.
"""  # noqa: E501


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


def page() -> str:
    """Return the page as text."""
    rows = []
    for name, source, about in PAGES:
        found = verdicts((HERE / f"{name}.md").read_text(encoding="utf-8"))
        counts = " | ".join(str(found[kind]) for kind in ("yes", "part", "no", "calibrated"))
        rows.append(f"| [{name}]({name}.md) | {source} | {about} | {counts} |\n")
    return _HEAD + "".join(rows) + _TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
