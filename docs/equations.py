"""Rewrite docs/equations.md from docs/equations.csv and the code: python -m docs.equations."""

from __future__ import annotations

from itertools import groupby

from docs.page import Page
from docs.source_tags import Equation, Tag, equations, package_tags

PAPERS = ("he_2007", "karagiannis_2012", "mohammadpour_2015", "jamali_2015")


def places(equation: Equation, tags: list[Tag]) -> list[str]:
    """Return where an equation is tagged, functions and classes before constants of modules."""
    here = [tag for tag in tags if (tag.key, tag.place) == (equation.paper, f"({equation.number})")]
    named = {_path(tag): bool(tag.scope) for tag in here}
    inside = [place for place, scoped in named.items() if scoped]
    return inside or list(named)


def _path(tag: Tag) -> str:
    module = tag.file.removesuffix(".py").removeprefix("gearlube_core/").replace("/", ".")
    return f"{module}:{tag.scope}" if tag.scope else module


def refreshed() -> Page:
    """Return the page with the equations and places of now."""
    tags, page = package_tags(), Page("equations")
    for paper in PAPERS:
        rows = []
        for row in equations():
            if row.paper == paper:
                where = ", ".join(f"`{place}`" for place in places(row, tags)) or "-"
                rows.append((f"({row.number})", row.what, row.form, where, row.note))
        alike = [list(some) for _, some in groupby(rows, lambda row: row[2:])]
        shown = ([", ".join(n for n, *_ in some), "; ".join(one[1] for one in some), *some[0][2:]]
                 for some in alike)  # fmt: skip
        page.rows("Equation | What", shown, f"Tags: `[{paper} (number)]`.")
    return page


if __name__ == "__main__":
    refreshed().write()
