"""Estimated and true errors of time steps, behind the relief that moves along a contact line."""

from __future__ import annotations

import csv
from pathlib import Path

from gearlube_core.ehl.gears.helical_film import march_helical_cycle
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from tests.helpers.jamali_2015 import jamali_2015_film

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
