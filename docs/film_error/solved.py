"""Films of random contacts on several grids, each solved once and kept in a file."""

from __future__ import annotations

import csv
import logging
import math
import time
from collections.abc import Iterator
from pathlib import Path

from docs.film_error.contacts import RandomContact
from gearlube_core.ehl.grid_error import FilmNumbers, peak_error
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact

logger = logging.getLogger("docs.film_error")

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
