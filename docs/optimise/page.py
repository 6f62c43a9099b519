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
    "hypoid": "## A hypoid pair: settings, crowns, twist and tip relief",
}


def main() -> None:
    """Write the page."""
    page = Page("optimise")
    for name, chapter in CHAPTERS.items():
        values = (
            [f"`{row['field']}`", row["before"] or "-", row["after"],
             f"{row['low']} to {row['high']}", row["unit"]]
            for row in _rows(f"{name}_values")
        )  # fmt: skip
        page.rows("Field | Before", values, chapter)
        measures = ([one or "-" for one in row.values()] for row in _rows(name))
        page.rows("Torque [N.m] | | Unit", measures, chapter)
        front = HERE / f"{name}_front.csv"
        if front.is_file() and len(_rows(front.stem)) > 1:
            rows = ([row["whine"], row["loss"]] for row in _rows(front.stem))
            page.rows("Mesh orders | Loss", rows, chapter)
    page.write()


def _rows(name: str) -> list[dict[str, str]]:
    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    main()
