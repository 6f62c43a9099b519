"""Design A at step 300 by finite differences and by finite elements."""

from __future__ import annotations

import numpy as np

from docs.ehl.cases import CYCLE, FACETED, FilmCase
from docs.ehl.store import SETTINGS, MissingFilmError, Store
from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from gearlube_core.storage.atomic_file import write_arrays

METHODS = ("differences", "elements")
GRIDS = (CYCLE, FACETED)
_STEP = 300


def _problem(nodes: tuple[int, int]) -> PointContactProblem:
    """Return the contact line as a point contact: speeds of its middle all along it."""
    film = FilmCase(nodes=nodes).film()
    moving = film.moving_film()
    X = film.line(_STEP * film.time_step)
    gap = UndeformedGap(modified=film.modified)
    u_1, u_2 = film.surface_speeds(np.zeros(1), X)
    return PointContactProblem(
        gap=lambda x, y: np.minimum(gap.heights(x, y, X), film.largest_gap),
        entrainment=(0.5 * float(u_1[0] + u_2[0]), 0.0),
        load=film.load(X),
        contact_modulus=film.contact_modulus,
        lubricant=film.lubricant,
        x_limits=moving.x_limits,
        y_limits=moving.y_limits,
        nodes=nodes,
        hertz=moving.hertz,
        sliding=(float(u_1[0] - u_2[0]), 0.0),
    )


def discretised(store: Store, nodes: tuple[int, int]) -> dict[str, tuple[Array, Array]]:
    """Return pressure [Pa] and film [m] by either method, shape (x, y)."""
    path = store.folder / f"methods_{nodes[0]}x{nodes[1]}.npz"
    if not path.exists():
        if not store.compute:
            raise MissingFilmError(path.stem)
        arrays: dict[str, Array] = {}
        for method in METHODS:
            settings = PointSolverSettings(
                wedge=SETTINGS.wedge, tolerance=SETTINGS.tolerance, discretisation=method
            )
            found = solve_point_contact(_problem(nodes), settings)
            arrays |= {f"{method}_pressure": found.pressure, f"{method}_film": found.film}
        write_arrays(path, arrays, compress=True)
    with np.load(path) as data:
        return {m: (data[f"{m}_pressure"], data[f"{m}_film"]) for m in METHODS}
