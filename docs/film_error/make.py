"""Numbers of docs/film_error.md, films.csv: python -m docs.film_error.make [DIR] [--present].

Half an hour of one processor the first time. Films are kept in the folder given as argument, by
default build/film_error, and a rerun solves only what is missing. With --present nothing is solved.
"""

from __future__ import annotations

import csv
import logging
import math
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import numpy as np

from docs.film_error.contacts import RandomContact, random_contacts
from docs.kept_films import KeptFilms, MissingFilmError
from docs.page import Page, begin
from gearlube_core.ehl.gears.helical_film import march_helical_cycle
from gearlube_core.ehl.grid_error import LARGE_ERROR, FilmNumbers, estimated_error, peak_error
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from tests.helpers.jamali_2015 import jamali_2015_film

_PLAIN = PointSolverSettings(estimate_error=False)
Key = tuple[int, int]  # number of the contact, nodes along a side


class Solved(NamedTuple):
    """A converged film of a contact."""

    films: list[FilmNumbers]  # on coarser grids too if its error is estimated, finest first
    peak: float  # how far above the largest pressure any node may come [-]
    seconds: float  # of the processor


def solved(kept: KeptFilms, contact: RandomContact, nodes: int, estimate: bool) -> Solved | None:
    """Return a contact on a grid, with what its estimated error comes from; None: no film."""

    def solve() -> dict[str, Any]:
        began = time.process_time()
        settings = None if estimate else _PLAIN
        film = solve_point_contact(contact.problem(nodes), settings, throw=False)
        return {
            "films": np.array([one.numbers for one in (film, *film.coarser)]),
            "peak": peak_error(film, film.coarser[0]) if film.coarser else math.nan,
            "seconds": time.process_time() - began,
            "found": film.outcome.converged and film.outcome.wedge == _PLAIN.wedge,
        }

    name = f"{'estimate' if estimate else 'film'}_{contact.number}_on_{nodes}"
    data = kept.kept(name, solve)
    films = [FilmNumbers(*one.tolist()) for one in data["films"]]
    return Solved(films, float(data["peak"]), float(data["seconds"])) if data["found"] else None


FIRST, LAST = 470, 490  # steps of design A of Jamali 2015
NODES = (97, 81)
SUBSTEPS = (1, 2, 4, 8)


def march_rows(kept: KeptFilms) -> list[list[str]]:
    """Return films, both estimates and the error against the film that the steps go to."""

    def march() -> dict[str, Any]:
        film, rows = jamali_2015_film("a", nodes=NODES, solids=None), []
        for substeps in SUBSTEPS:
            cycle = march_helical_cycle(
                film, first=FIRST, last=LAST, substeps=substeps, settings=MARCH_SETTINGS
            )
            rows.append([substeps, cycle["minimum_film"][-1], cycle["time_error"][-1]])
        return {"rows": np.array(rows)}

    rows = kept.kept("marches", march)["rows"].tolist()
    films = [row[1] for row in rows]
    # between the first and the second order of the last halving
    exact = films[-1] + (films[-1] - films[-2]) * 2.0 / 3.0
    lines = []
    for k, (substeps, film, embedded) in enumerate(rows):
        repeat = "" if k == 0 else f"{100.0 * abs(films[k - 1] / film - 1.0):.2g} %"
        true = f"{100.0 * abs(film - exact) / film:.2g} %"
        lines.append(
            [f"{substeps:.0f}", f"{1e6 * film:.4f}", f"{100.0 * embedded:.2g} %", repeat, true]
        )
    return lines


KEPT = Path(__file__).parent / "films.csv"
FIT = 200  # contacts that were seen before the factors of safety were chosen
FEW = 60  # contacts on the finest grid
BASES = (65, 129)  # grids whose estimate is looked at
FINER, FINEST = (129, 257), 513
NAMES = ("central film", "smallest film", "largest pressure", "friction")
logger = logging.getLogger("docs.film_error")


@dataclass(frozen=True, slots=True)
class Judged:
    """Estimated and true relative errors of a contact on a grid."""

    contact: RandomContact
    nodes: int
    references: tuple[int, int]  # grids from which the true value is extrapolated
    estimate: FilmNumbers
    true: FilmNumbers


def extrapolated(coarse: FilmNumbers, fine: FilmNumbers) -> FilmNumbers:
    """Return what two grids of half the spacing each go to at second order."""
    return FilmNumbers(*(f + (f - c) / 3.0 for c, f in zip(coarse, fine, strict=True)))


def judged(
    contact: RandomContact, nodes: int, estimated: Solved, films: Mapping[Key, FilmNumbers]
) -> Judged | None:
    """Return the errors of a contact on a grid; None: it has no film on two finer grids."""
    grids = [n for n in (*FINER, FINEST) if (contact.number, n) in films]
    if len(grids) < 2 or grids[-1] <= nodes:
        return None
    errors = FilmNumbers(*map(estimated_error, zip(*estimated.films, strict=True)))
    errors = errors._replace(maximum_pressure=max(errors.maximum_pressure, estimated.peak))
    exact = extrapolated(*(films[contact.number, n] for n in grids[-2:]))
    true = FilmNumbers(*(_off(f, e) for f, e in zip(estimated.films[0], exact, strict=True)))
    return Judged(contact, nodes, (grids[-2], grids[-1]), errors, true)


def all_judged(kept: KeptFilms) -> list[Judged]:
    """Return the errors of all contacts that are solved."""
    contacts = random_contacts()
    wanted = [(c, n, True) for n in BASES for c in contacts]
    wanted += [(c, FINER[1], False) for c in contacts] + [
        (c, FINEST, False) for c in contacts[:FEW]
    ]
    found: dict[Key, Solved] = {}
    for contact, nodes, estimate in wanted:
        try:
            one = solved(kept, contact, nodes, estimate)
        except MissingFilmError:
            continue
        if one is not None:
            found[contact.number, nodes] = one
    films = {key: one.films[0] for key, one in found.items()}
    rows = [
        judged(c, n, found[c.number, n], films)
        for n in BASES
        for c in contacts
        if (c.number, n) in found
    ]
    return [one for one in rows if one is not None]


def write_csv(rows: list[Judged]) -> None:
    """Write contacts with their errors."""
    columns = ("central_film", "minimum_film", "maximum_pressure", "friction")
    with KEPT.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        head = ["contact", "M", "L", "ellipticity", "slide_roll", "eyring_stress_mpa", "nodes"]
        head += ["finer", "finest"]
        head += [f"{kind}_{name}" for kind in ("estimated", "true") for name in columns]
        writer.writerow(head)
        for row in rows:
            c = row.contact
            own = [f"{v:.4g}" for v in (c.M, c.L, c.ellipticity, c.slide_roll)]
            own += [f"{1e-6 * c.eyring_stress:.3g}", str(row.nodes), *map(str, row.references)]
            errors = [f"{v:.3g}" for v in (*row.estimate, *row.true)]
            writer.writerow([c.number, *own, *errors])


def put(page: Page, rows: list[Judged]) -> None:
    """Put in how often true errors are below their estimates, and how large they are."""
    chosen = [[row for row in rows if row.nodes == nodes] for nodes in BASES]
    chosen.append([r for r in rows if r.nodes == 129 and r.references == (FINER[1], FINEST)])
    page.cells(
        "Grid | Contacts",
        [[str(len(some)), *(_share(some, k) for k in range(4))] for some in chosen],
        first=1,
    )
    page.rows(" | median", (_sizes(rows, k) for k in range(4)))
    passed = sum(
        row.estimate[k] < row.true[k] for row in rows if row.nodes == 129 for k in range(2)
    )
    page.fill("On 129 x 129 nodes {} films pass their bound", passed)


def _share(rows: list[Judged], k: int) -> str:
    bounded = [row.estimate[k] >= row.true[k] for row in rows]
    over = median(row.estimate[k] / max(row.true[k], 1e-9) for row in rows)
    return f"{100.0 * sum(bounded) / len(rows):.1f} %, {over:.1f} times"


def _sizes(rows: list[Judged], k: int) -> list[str]:
    chosen = [row for row in rows if row.nodes == 129]
    true = sorted(row.true[k] for row in chosen)
    warned = sum(row.estimate[k] > LARGE_ERROR for row in chosen)
    large = sum(one > LARGE_ERROR for one in true)
    places = (true[len(true) // 2], true[math.ceil(0.95 * len(true)) - 1], true[-1])
    return [NAMES[k], *(f"{100.0 * one:.2g} %" for one in places), str(warned), str(large)]


def _off(value: float, exact: float) -> float:
    return abs(value - exact) / abs(value) if value else 0.0


def main() -> None:
    """Solve, write the page and the table."""
    kept = KeptFilms(begin("film_error"), compute="--present" not in sys.argv)
    rows, page = all_judged(kept), Page("film_error")
    write_csv(rows)
    put(page, rows)
    page.rows("Time steps for one", march_rows(kept))
    page.write()


if __name__ == "__main__":
    main()
