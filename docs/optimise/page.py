"""Put the tables of this folder into docs/optimise.md: python -m docs.optimise.page."""

from __future__ import annotations

import csv
from pathlib import Path

from docs.page import Page

HERE = Path(__file__).resolve().parent
# problems and the headings of their chapters
CHAPTERS = {
    "helical": "## A helical pair: relief and crown",
    "helical_plain": "## A helical pair without modifications",
    "hypoid": "## A hypoid pair: settings, crowns, relief",
}
SHOWN = (
    "all orders", "all orders, root mean square over errors", "sensitivity to errors",
    "highest pressure", "sliding loss over friction coefficient",
    "mesh orders of the force over its mean", "highest pressure, coast flanks",
)  # fmt: skip


def main() -> None:
    """Write the page."""
    page = Page("optimise")
    for name, chapter in CHAPTERS.items():
        shown = (row for row in _rows(name) if row["what"] in SHOWN)
        names = ("torque", "what", "unit", "before", "after", "change")
        page.rows("Torque [N.m] | | Unit", ([row[n] for n in names] for row in shown), chapter)
    values = (
        [f"`{row['field']}`", row["before"] or "-", row["after"],
         f"{row['low']} to {row['high']}", row["unit"]]
        for row in _rows("helical_values")
    )  # fmt: skip
    page.rows("Field | Before", values)
    page.rows("Mesh orders | Loss", (list(row.values()) for row in _rows("hypoid_front")))
    page.write()


def _rows(name: str) -> list[dict[str, str]]:
    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    main()
