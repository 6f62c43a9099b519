"""Smallest film behind the moving relief: how it depends on stencil, grid and time step."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.ehl.helical_cycle import march_helical_cycle
from gearlube_core.ehl.helical_film import jamali_2015_film
from gearlube_core.ehl.settings import PointSolverSettings

FIRST, LAST = 470, 490  # steps of design A; the contact is crossed in 17
# nodes across and along the line, stencil, time steps for one step
VARIANTS = (
    (97, 81, "upwind-1", 1),
    (97, 81, "upwind-2", 1),
    (97, 81, "quick", 1),
    (97, 161, "quick", 1),
    (193, 81, "quick", 1),
    (97, 81, "upwind-1", 4),
    (97, 81, "quick", 2),
    (97, 81, "quick", 4),
    (193, 81, "quick", 2),
)
COLUMNS = ("steady", "step 490", "x", "y", "failures")


def minimum_film_table(folder: Path) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return one row a variant, columns as in `COLUMNS`, SI; computed once for a folder.

    Film of the line at rest at step 470 and in motion at step 490 [m], where the latter lies [m],
    and steps that did not converge.
    """
    path = folder / "minimum_film.npy"
    if path.exists():
        table: np.ndarray[Any, np.dtype[np.float64]] = np.load(path)
        if table.shape == (len(VARIANTS), len(COLUMNS)):
            return table
    rows = []
    for nx, ny, wedge, substeps in VARIANTS:
        cycle = march_helical_cycle(
            jamali_2015_film("a", nodes=(nx, ny)),
            first=FIRST,
            last=LAST,
            substeps=substeps,
            settings=PointSolverSettings(tolerance=1e-5, wedge=wedge),
            throw=False,
        )
        film, x, y = (cycle[name] for name in ("min_film", "min_film_x", "min_film_y"))
        rows.append((film[0], film[-1], x[-1], y[-1], cycle.failures))
    table = np.array(rows)
    folder.mkdir(parents=True, exist_ok=True)
    np.save(path, table)
    return table
