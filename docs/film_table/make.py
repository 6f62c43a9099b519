"""Numbers of docs/film_table.md, films.csv: python -m docs.film_table.make [DIR] [--present].

A quarter of an hour of one processor the first time. Films are kept in the folder given as
argument, by default build/film_table, and a rerun solves only what is missing. With --present
nothing is solved.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import numpy as np

from docs.film_table.contacts import (
    CHECK_NODES,
    LOADS,
    MATERIALS,
    Table,
    all_solved,
    checked_contacts,
    film_group,
    table_contacts,
)
from docs.film_table.extrapolated import Row, Value, extrapolated, write_table
from docs.kept_films import KeptFilms
from docs.page import IMAGES, Page, begin
from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure
from gearlube_core.film.point_film import central_film_group

_SHAPES = ((1.0, 0.0), (4.0, 0.0))  # those shown


def draw(rows: Sequence[Row]) -> Any:
    """Return central films, filled, and smallest films, open, over load; a fit in grey."""
    with house_style():
        figure = new_figure(10.0, 4.6)
        axes = figure.subplots(1, len(_SHAPES), sharey=True)
        for ax, (ellipticity, angle) in zip(axes, _SHAPES, strict=True):
            _films(ax, rows, ellipticity, angle)
            ax.set_title(f"$a_y/a_x$ = {ellipticity:g}, entrained along the short axis")
            ax.set_xlabel("load M [-]")
        axes[0].set_ylabel("film H [-]")
        handles = [
            axes[0].plot([], [], marker, color=colour, label=f"L = {L:g}")[0]
            for L, marker, colour in zip(MATERIALS, MARKERS, SERIES, strict=False)
        ]
        for label, style in (
            ("central film $H_c$", {"color": "k", "marker": "o", "linestyle": "-"}),
            ("smallest film $H_{min}$",
             {"color": "k", "marker": "o", "linestyle": "--", "markerfacecolor": "w"}),
            ("formula for $H_c$, Nijenbanning et al. 1994", {"color": GREY}),
        ):  # fmt: skip
            handles.append(axes[0].plot([], [], label=label, **style)[0])
        figure.legend(handles=handles, loc="outside lower center", ncols=4)
        return figure


def _films(ax: Any, rows: Sequence[Row], ellipticity: float, angle: float) -> None:
    loads = np.geomspace(LOADS[0], LOADS[-1], 60)
    for L, marker, colour in zip(MATERIALS, MARKERS, SERIES, strict=False):
        own = [
            row
            for row in rows
            if (c := row.solved.contact).L == L and (c.ellipticity, c.angle) == (ellipticity, angle)
        ]
        if not own:
            continue
        M = [row.solved.contact.M for row in own]
        ratio = 1.0 / own[0].solved.contact.radius_ratio
        ax.plot(loads, [central_film_group(m, L, ratio) for m in loads], color=GREY, zorder=1)
        ax.plot(M, [row.central.value for row in own], marker + "-", color=colour)
        ax.plot(
            M, [row.minimum.value for row in own], marker + "--", color=colour, markerfacecolor="w"
        )
    ax.set_xscale("log")
    ax.set_yscale("log")


KEPT = Path(__file__).parent / "films.csv"
WIDE = 0.005  # error that the page names


def rows_of(solved: Table) -> list[Row]:
    """Return the rows of the table; contacts not solved on all three grids have none."""
    found = (solved.get((contact, "table")) for contact in table_contacts())
    return [Row.of(one) for one in found if one is not None and one.sound]


def put(page: Page, rows: Sequence[Row], solved: Table) -> None:
    """Put in the errors of the table, and what the checks found."""
    found = checks(rows, solved)
    page.fill("(film_table/films.csv): {} smooth elliptical point contacts", len(rows))
    page.fill("Left out: {}, at 45 degrees under high load", len(table_contacts()) - len(rows))
    page.rows(
        " | median",
        [
            _sizes("H_c", [row.central for row in rows]),
            _sizes("H_min", [row.minimum for row in rows]),
            _sizes("p_max", [row.pressure for row in rows]),
        ],
    )
    page.fill(
        "; {} on all three grids. The extrapolated central films agree within {} %, the smallest "
        "within {} %; {} of the {} films lie within the sum of both errors.",
        found.solved,
        *(f"{100.0 * one:.2g}" for one in found.stencil),
        found.inside,
        2 * found.solved,
    )
    page.fill(
        "the central film moves by at most {} %, the smallest, whose node moves too, by {} %.",
        *(f"{100.0 * one:.2g}" for one in found.domain),
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


def main() -> None:
    """Solve, write the table, the page and its figure."""
    solved = all_solved(KeptFilms(begin("film_table"), compute="--present" not in sys.argv))
    rows, page = rows_of(solved), Page("film_table")
    write_table(KEPT, rows, version("gearlube"))
    put(page, rows, solved)
    page.write()
    draw(rows).savefig(IMAGES / "film_table.png", dpi=100)


if __name__ == "__main__":
    main()
