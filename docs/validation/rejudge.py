"""Rewrite what would make claims hold on the pages: python -m docs.validation.rejudge.

About three minutes on one core. The scripts that write whole pages take these sections from here.
"""

from __future__ import annotations

from pathlib import Path

from docs.validation import decide_axle, decide_helical, decide_motion, efficiency
from docs.validation.decide_flanks import flank_section
from docs.validation.decision import decision_table, replace_section

DOCS = Path(__file__).resolve().parents[1]
_TEXT = Path(__file__).parent / "text"


def axle_section() -> str:
    """Return the section of docs/validation.md."""
    rows = [*decide_axle.decisions(), *efficiency.decisions()]
    text = (_TEXT / "axle.md").read_text(encoding="utf-8")
    return text.format(
        sensitivities=efficiency.sensitivity_table(),
        circle=100.0 * efficiency.circle_share(),
        speed=efficiency.JUDGED_AT,
        decisions=decision_table(rows),
    )


def pair_section() -> str:
    """Return the section of docs/resonance.md."""
    return decide_motion.section() + flank_section()


def helical_section() -> str:
    """Return the section of docs/helical.md."""
    return decide_helical.section()


def main() -> None:
    """Rewrite the sections of all pages."""
    replace_section(DOCS / "validation.md", axle_section())
    replace_section(DOCS / "resonance.md", pair_section())
    replace_section(DOCS / "helical.md", helical_section())


if __name__ == "__main__":
    main()
