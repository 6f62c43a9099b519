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
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from docs.film_error.contacts import (
    RandomContact,
    random_contacts,
)
from docs.page import Page, begin
from gearlube_core.ehl.gears.helical_film import march_helical_cycle
from gearlube_core.ehl.grid_error import LARGE_ERROR, FilmNumbers, estimated_error, peak_error
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from tests.helpers.jamali_2015 import jamali_2015_film

_PLAIN = PointSolverSettings(estimate_error=False)
# number of the contact and nodes along a side: what stands in a row
Films = dict[tuple[int, int], FilmNumbers]
Estimates = dict[tuple[int, int], tuple[list[FilmNumbers], float]]


def solve_films(path: Path, contacts: list[RandomContact], nodes: int) -> None:
    """Solve contacts on a grid, without an estimate, and add them to a file."""
    for contact in _lacking(path, contacts, nodes):
        began = time.process_time()
        film = solve_point_contact(contact.problem(nodes), _PLAIN, throw=False)
        _append(path, [*_head(contact, nodes, film), *film.numbers, _spent(began)])


def solve_estimates(path: Path, contacts: list[RandomContact], nodes: int) -> None:
    """Solve contacts on a grid, with what their estimates come from, and add them to a file."""
    for contact in _lacking(path, contacts, nodes):
        began = time.process_time()
        film = solve_point_contact(contact.problem(nodes), throw=False)
        numbers = [value for one in (film, *film.coarser) for value in one.numbers]
        peak = peak_error(film, film.coarser[0]) if film.coarser else math.nan
        _append(path, [*_head(contact, nodes, film), peak, *numbers, _spent(began)])


def read_films(path: Path) -> Films:
    """Return converged films by contact and nodes."""
    return {key: FilmNumbers(*numbers[1:5]) for key, numbers in _rows(path)}


def read_estimates(path: Path) -> Estimates:
    """Return converged films with the coarser ones, finest first, and the errors of the peak."""
    found: Estimates = {}
    for key, numbers in _rows(path):
        values = numbers[2:-1]
        films = [FilmNumbers(*values[k : k + 4]) for k in range(0, len(values), 4)]
        found[key] = films, numbers[1]
    return found


def seconds(path: Path) -> float:
    """Return the time of the processor that a file took [s]."""
    return sum(numbers[-1] for _, numbers in _rows(path))


def _rows(path: Path) -> Iterator[tuple[tuple[int, int], list[float]]]:
    if not path.exists():
        return
    with path.open(encoding="utf-8", newline="") as file:
        for number, nodes, converged, wedge, *rest in csv.reader(file):
            if converged == "1" and wedge == _PLAIN.wedge:
                yield (int(number), int(nodes)), [float(one) for one in rest]


def _lacking(path: Path, contacts: list[RandomContact], nodes: int) -> Iterator[RandomContact]:
    path.parent.mkdir(parents=True, exist_ok=True)
    done = set()
    if path.exists():
        with path.open(encoding="utf-8", newline="") as file:
            done = {(int(row[0]), int(row[1])) for row in csv.reader(file)}
    for contact in contacts:
        if (contact.number, nodes) not in done:
            logger.info("contact %d on %d nodes", contact.number, nodes)
            yield contact


def _head(contact: RandomContact, nodes: int, film: PointSolution) -> list[object]:
    outcome = film.outcome
    return [contact.number, nodes, int(outcome.converged), outcome.wedge, outcome.limited]


def _append(path: Path, row: list[object]) -> None:
    with path.open("a", encoding="utf-8", newline="") as file:
        csv.writer(file).writerow(row)


def _spent(began: float) -> float:
    return round(time.process_time() - began, 2)


FIRST, LAST = 470, 490  # steps of design A of Jamali 2015
NODES = (97, 81)
SUBSTEPS = (1, 2, 4, 8)


def solve_marches(path: Path) -> None:
    """March with ever shorter steps and write the smallest film with its estimated errors."""
    if path.exists():
        return
    film = jamali_2015_film("a", nodes=NODES, solids=None)
    rows = []
    for substeps in SUBSTEPS:
        cycle = march_helical_cycle(
            film, first=FIRST, last=LAST, substeps=substeps, settings=MARCH_SETTINGS
        )
        rows.append([substeps, cycle["minimum_film"][-1], cycle["time_error"][-1]])
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)


def march_rows(path: Path) -> list[list[str]]:
    """Return films, both estimates and the error against the film that the steps go to."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = [[float(one) for one in row] for row in csv.reader(file)]
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


def judged(contact: RandomContact, nodes: int, estimates: Estimates, films: Films) -> Judged | None:
    """Return the errors of a contact on a grid; None: not solved there or on two finer grids."""
    key = contact.number, nodes
    grids = [n for n in (*FINER, FINEST) if (contact.number, n) in films]
    if key not in estimates or len(grids) < 2 or grids[-1] <= nodes:
        return None
    found, peak = estimates[key]
    errors = FilmNumbers(*map(estimated_error, zip(*found, strict=True)))
    errors = errors._replace(maximum_pressure=max(errors.maximum_pressure, peak))
    exact = extrapolated(*(films[contact.number, n] for n in grids[-2:]))
    true = FilmNumbers(*(_off(f, e) for f, e in zip(found[0], exact, strict=True)))
    return Judged(contact, nodes, (grids[-2], grids[-1]), errors, true)


def all_judged(folder: Path) -> list[Judged]:
    """Return the errors of all contacts that are solved."""
    estimates = read_estimates(folder / "estimates.csv")
    films = {key: found[0] for key, (found, _) in estimates.items()}
    films |= read_films(folder / "films.csv")
    found = (judged(c, n, estimates, films) for n in BASES for c in random_contacts())
    return [one for one in found if one is not None]


def solve(folder: Path) -> None:
    """Solve what is missing."""
    contacts = random_contacts()
    for nodes in BASES:
        solve_estimates(folder / "estimates.csv", contacts, nodes)
    solve_films(folder / "films.csv", contacts, FINER[1])
    solve_films(folder / "films.csv", contacts[:FEW], FINEST)
    solve_marches(folder / "marches.csv")


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


def put(page: Page, rows: list[Judged], spent: float) -> None:
    """Put in how often true errors are below their estimates, and how large they are."""
    groups: list[Callable[[Judged], bool]] = []
    for nodes in BASES:
        groups += [
            lambda r, n=nodes: r.nodes == n,
            lambda r, n=nodes: r.nodes == n and r.contact.number >= FIT,
            lambda r, n=nodes: r.nodes == n and r.contact.eyring_stress > 0.0,
        ]
    groups.append(lambda r: r.nodes == 129 and r.references == (FINER[1], FINEST))
    chosen = [[row for row in rows if is_in(row)] for is_in in groups]
    page.cells(
        "Grid | Contacts",
        [[str(len(some)), *(_share(some, k) for k in range(4))] for some in chosen],
        first=1,
    )
    page.rows(" | median", (_sizes(rows, k) for k in range(4)))
    page.rows("Contact | Passes", _worst(rows))
    page.fill("All of it took {} minutes of one processor", f"{spent / 60.0:.0f}")


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


def _worst(rows: list[Judged]) -> list[list[str]]:
    """Return the contacts whose film passes its bound, on 129 x 129 nodes."""
    passed = []
    for row in rows:
        for k in range(2):
            if row.nodes == 129 and row.estimate[k] < row.true[k]:
                c = row.contact
                passed.append(
                    [str(c.number), NAMES[k], f"{c.M:.0f}", f"{c.L:.1f}", f"{c.ellipticity:.2f}",
                     f"{100.0 * row.estimate[k]:.2g} %", f"{100.0 * row.true[k]:.2g} %"]
                )  # fmt: skip
    return passed


def _off(value: float, exact: float) -> float:
    return abs(value - exact) / abs(value) if value else 0.0


def main() -> None:
    """Solve, write the page and the table."""
    folder = begin("film_error")
    if "--present" not in sys.argv:
        solve(folder)
    rows, page = all_judged(folder), Page("film_error")
    write_csv(rows)
    put(page, rows, sum(seconds(folder / name) for name in ("films.csv", "estimates.csv")))
    page.rows("Time steps for one", march_rows(folder / "marches.csv"))
    page.write()


if __name__ == "__main__":
    main()
