"""What the grid of a hypoid flank's film decides, in the middle of the engagement."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from docs.page import Page
from gearlube.studies.films.hypoid.flank import HypoidFlank, hypoid_flank
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.transient.curves import central_film
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.storage.atomic_file import write_text


class Film(NamedTuple):
    """Central and smallest film [m]."""

    central: float
    minimum: float


def _solved(flank: HypoidFlank, nodes: tuple[int, int]) -> Film:
    film = replace(flank.film, nodes=nodes)
    first, last = film.cycle.time[[0, -1]]
    middle = 0.5 * float(first + last)
    solution = solve_steady_film(film.moving_film(), middle, flank.case.settings())
    return Film(central_film(solution), solution.minimum_film)


def _grids(nodes: tuple[int, int]) -> tuple[list[int], list[int]]:
    """Return half, three quarters and all of the nodes across; all and more of those along."""
    across, along = (count - 1 for count in nodes)
    return [across * k // 4 + 1 for k in (2, 3, 4)], [along * k // 2 + 1 for k in (2, 3, 6)]


def _below(values: list[float], across: list[int]) -> str:
    """Return how far the films on three grids lie below what they go to, to second order."""
    finer = (across[-1] - 1) / (across[0] - 1)
    limit = values[-1] + (values[-1] - values[0]) / (finer**2 - 1.0)
    return listed([f"{100.0 * (1.0 - value / limit):.1f}" for value in values]) + " %"


def listed(words: list[str]) -> str:
    """Return words as "a, b and c"."""
    return f"{', '.join(words[:-1])} and {words[-1]}"


def put_grids(page: Page, work: Path, case: HypoidCase) -> None:
    """Put in what the grid decides; films are kept in `work`."""
    across, along = _grids((case.solver.nodes_minor, case.solver.nodes_major))
    path = work / "grids.json"
    if not path.exists():
        flank = hypoid_flank(case)
        grids = [*((n, along[0]) for n in across), *((across[-1], n) for n in along[1:])]
        work.mkdir(parents=True, exist_ok=True)
        write_text(json.dumps([_solved(flank, nodes) for nodes in grids]), path)
    films = [Film(*row) for row in json.loads(path.read_text(encoding="utf-8"))]
    coarse_to_fine, longer = films[: len(across)], films[len(across) :]
    moved = max(
        abs(there / here - 1.0)
        for film in longer
        for there, here in zip(film, coarse_to_fine[-1], strict=True)
    )
    page.fill(
        "In the middle of the engagement {} nodes across leave the central film {} and the "
        "smallest one {} below what they go to, to second order; {} nodes along it change neither "
        "by more than {} %.",
        listed([str(n) for n in across]),
        _below([film.central for film in coarse_to_fine], across),
        _below([film.minimum for film in coarse_to_fine], across),
        " or ".join(str(n) for n in along[1:]),
        f"{100.0 * moved:.1g}",
    )
