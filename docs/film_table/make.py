"""Rewrite docs/film_table.md and films.csv: python -m docs.film_table.make [workdir] [--present].

A quarter of an hour of one processor the first time. Films are kept in the folder given as
argument, by default build/film_table, and a rerun solves only what is missing. With --present
nothing is solved.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from statistics import median
from typing import NamedTuple

from docs.film_table.contacts import (
    CHECK_NODES,
    HIGH_LOAD,
    LOADS,
    MATERIALS,
    NODES,
    NODES_ACROSS,
    NODES_ACROSS_UNDER_HIGH_LOAD,
    NODES_AT_AN_ANGLE,
    NODES_UNDER_HIGH_LOAD,
    SHAPES,
    STEEP,
    Table,
    checked_contacts,
    film_group,
    read,
    solve_missing,
    table_contacts,
)
from docs.film_table.extrapolated import DOMAIN_ERROR, Row, Value, extrapolated, write_table
from docs.film_table.picture import draw
from docs.helical.pages import table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "film_table.md"
IMAGE = ROOT / "docs" / "images" / "film_table.png"
KEPT = Path(__file__).parent / "films.csv"
WIDE = 0.005  # error that the page names


def rows_of(solved: Table) -> list[Row]:
    """Return the rows of the table; contacts not solved on all three grids have none."""
    found = (solved.get((contact, "table")) for contact in table_contacts())
    return [Row.of(one) for one in found if one is not None and one.sound]


def page(rows: Sequence[Row], solved: Table) -> str:
    """Return the page."""
    text = (Path(__file__).parent / "text.md").read_text(encoding="utf-8")
    found = checks(rows, solved)
    wide = [row for row in rows if max(row.central.error, row.minimum.error) > WIDE]
    return text.format(
        count=len(rows),
        failed=len(table_contacts()) - len(rows),
        shapes=_shapes(),
        loads=", ".join(f"{one:g}" for one in LOADS),
        materials=", ".join(f"{one:g}" for one in MATERIALS),
        grids=_grids(NODES),
        grids_high=_grids(NODES_UNDER_HIGH_LOAD),
        grids_across=_grids(NODES_ACROSS),
        grids_across_high=_grids(NODES_ACROSS_UNDER_HIGH_LOAD),
        grids_angle=_grids(NODES_AT_AN_ANGLE),
        steep=STEEP,
        high=HIGH_LOAD,
        errors=table(
            ["", "median", "largest", "rows above 0.5 %"],
            [
                _sizes("H_c", [row.central for row in rows]),
                _sizes("H_min", [row.minimum for row in rows]),
                _sizes("p_max", [row.pressure for row in rows]),
            ],
        ),
        wide=_wide(wide),
        checked=len(checked_contacts()),
        checked_sound=found.solved,
        check_nodes=_grids(CHECK_NODES),
        largest_film=100.0 * found.stencil[0],
        largest_minimum=100.0 * found.stencil[1],
        inside=found.inside,
        compared=2 * found.solved,
        wider_film=100.0 * found.domain[0],
        wider_minimum=100.0 * found.domain[1],
        domain=100.0 * DOMAIN_ERROR,
    )


class Checks(NamedTuple):
    """What another stencil and a larger domain change at most, of H_c and of H_min [-]."""

    stencil: tuple[float, float]
    domain: tuple[float, float]
    solved: int  # with the other stencil on all three grids
    inside: int  # films of those that lie within the sum of both errors


def checks(rows: Sequence[Row], solved: Table) -> Checks:
    """Return what the checks of the table found."""
    by_contact = {row.solved.contact: row for row in rows}
    middle = (CHECK_NODES - 1) * 2 + 1  # finest grid whose middle one has the check's spacing
    stencil: tuple[list[float], list[float]] = ([], [])
    domain: tuple[list[float], list[float]] = ([], [])
    inside = 0
    for contact in checked_contacts():
        if contact not in by_contact or (contact, "wider") not in solved:
            continue
        row, other, wider = (
            by_contact[contact],
            solved[contact, "upwind-2"],
            solved[contact, "wider"],
        )
        for k, own in enumerate((row.central, row.minimum)):
            if other.sound:
                found = extrapolated([film_group(contact, grid[k]) for grid in other.grids])
                stencil[k].append(abs(found.value / own.value - 1.0))
                inside += stencil[k][-1] <= own.error + found.error
            if wider.sound and row.solved.nodes == middle:
                domain[k].append(abs(wider.grids[0][k] / row.solved.grids[1][k] - 1.0))
    return Checks(
        (max(stencil[0]), max(stencil[1])),
        (max(domain[0]), max(domain[1])),
        len(stencil[0]),
        inside,
    )


def _sizes(name: str, values: Sequence[Value]) -> list[str]:
    errors = [one.error for one in values]
    return [
        name,
        f"{100.0 * median(errors):.2g} %",
        f"{100.0 * max(errors):.2g} %",
        str(sum(error > WIDE for error in errors)),
    ]


def _wide(rows: Sequence[Row]) -> str:
    cells = []
    for row in rows:
        c = row.solved.contact
        errors = (row.central.error, row.minimum.error)
        cells.append(
            [f"{c.ellipticity:g}", f"{c.angle:g}", f"{c.M:g}", f"{c.L:g}"]
            + [f"{100.0 * error:.2g} %" for error in errors]
        )
    return table(["a_y/a_x", "degrees", "M", "L", "H_c", "H_min"], cells)


def _grids(finest: int) -> str:
    return ", ".join(str((finest - 1) // 2**k + 1) for k in (2, 1, 0))


def _shapes() -> str:
    return ", ".join(f"{k:g} at {angle:g}" for k, angle in SHAPES)


def main() -> None:
    """Solve, write the table, the page and its figure."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    given = [word for word in sys.argv[1:] if word != "--present"]
    folder = Path(given[0]) if given else ROOT / "build" / "film_table"
    kept = folder / "solved.csv"
    solved = read(kept) if "--present" in sys.argv else solve_missing(kept)
    rows = rows_of(solved)
    write_table(KEPT, rows, version("gearlube"))
    PAGE.write_text(page(rows, solved), encoding="utf-8")
    draw(rows).savefig(IMAGE, dpi=100)


if __name__ == "__main__":
    main()
