"""Contacts of the table of films, solved on three nested grids each and kept in a file."""

from __future__ import annotations

import time
from dataclasses import astuple, dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import interpn

from docs.ehl.film_map import RADIUS, REDUCED_MODULUS, Contact
from docs.kept_films import KeptFilms, MissingFilmError
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.ehl.grid_error import FilmNumbers, peak_error
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil import density

SHAPES = ((1.0, 0.0), (2.0, 0.0), (4.0, 0.0), (2.0, 45.0), (2.0, 90.0))  # a_y/a_x, angle in degrees
LOADS = (10.0, 30.0, 100.0, 300.0, 1000.0)  # M
MATERIALS = (2.5, 5.0, 10.0, 15.0)  # L
NODES, NODES_UNDER_HIGH_LOAD, HIGH_LOAD = 385, 513, 300.0
# entrained along the long axis, and at an angle where a spike is steep and finer grids take minutes
NODES_ACROSS, NODES_ACROSS_UNDER_HIGH_LOAD, NODES_AT_AN_ANGLE = 257, 385, 193
STEEP = 750.0  # M L from which a spike at an angle is
WEDGE = "quick"  # its central films are right to 0.1 % on a quarter of the nodes along a side
CHECK_NODES = 193  # of the checks by another stencil and on a larger domain
CHECKED_EVERY = 9  # contacts, so that all shapes, loads and materials are among them
WIDER = 24  # cells of the check's coarsest grid that the larger domain has on every side


def table_contacts() -> list[Contact]:
    """Return the contacts of the table, in its order."""
    return [Contact(k, M, L, angle) for k, angle in SHAPES for M in LOADS for L in MATERIALS]


def checked_contacts() -> list[Contact]:
    """Return those that are solved again in two other ways."""
    return table_contacts()[::CHECKED_EVERY]


def finest_nodes(contact: Contact) -> int:
    """Return the nodes along a side of the finest grid of a contact of the table."""
    if contact.angle == 45.0 and contact.M * contact.L >= STEEP:
        return NODES_AT_AN_ANGLE
    high = contact.M >= HIGH_LOAD
    if contact.angle == 90.0:
        return NODES_ACROSS_UNDER_HIGH_LOAD if high else NODES_ACROSS
    return NODES_UNDER_HIGH_LOAD if high else NODES


def problem(contact: Contact, nodes: int) -> PointContactProblem:
    """Return a contact on a square number of nodes, with oil that goes on beyond the domain."""
    return replace(contact.problem(nodes), oil_beyond=True)


def wider_problem(contact: Contact, nodes: int) -> PointContactProblem:
    """Return the same on half as large a domain again, with the same spacing."""
    own = problem(contact, nodes)
    cells = WIDER * (nodes - 1) // ((CHECK_NODES - 1) // 2)
    (x0, x1), (y0, y1) = own.x_limits, own.y_limits
    dx, dy = cells * (x1 - x0) / (nodes - 1), cells * (y1 - y0) / (nodes - 1)
    return replace(
        own,
        x_limits=(x0 - dx, x1 + dx),
        y_limits=(y0 - dy, y1 + dy),
        nodes=(nodes + 2 * cells, nodes + 2 * cells),
    )


def film_group(contact: Contact, film: float) -> float:
    """Return H = (h/R_x) (2 U)^(-1/2)."""
    return float(film / RADIUS / np.sqrt(2.0 * contact.speed_group))


def hertz_pressure(contact: Contact) -> float:
    """Return the largest pressure of the dry contact [Pa]."""
    load = contact.load_group * REDUCED_MODULUS * RADIUS**2
    R_y = RADIUS * contact.radius_ratio
    return 1.5 * float(hertz_ellipse(RADIUS, R_y, 0.5 * REDUCED_MODULUS, load)[2])


def pressure_group(contact: Contact, pressure: float) -> float:
    """Return a pressure over the largest of the dry contact [-]."""
    return pressure / hertz_pressure(contact)


@dataclass(frozen=True, slots=True)
class Solved:
    """A contact on three nested grids, finest first; variant `table`, `upwind-2` or `wider`."""

    contact: Contact
    variant: str
    nodes: int  # along a side of the finest grid
    sound: bool  # converged with its stencil, nowhere limited to first order
    density_ratio: float  # of the oil in the centre, over that at ambient pressure
    peak: float  # how far above the largest pressure any node may come [-]
    grids: tuple[FilmNumbers, ...]
    seconds: float  # of the processor


Table = dict[tuple[Contact, str], Solved]


def solve(contact: Contact, variant: str) -> dict[str, Any]:
    """Return the numbers of a contact, solved on three grids."""
    began = time.process_time()
    if variant == "table":
        case = problem(contact, finest_nodes(contact))
    elif variant == "wider":
        case = wider_problem(contact, CHECK_NODES)
    else:
        case = problem(contact, CHECK_NODES)
    settings = PointSolverSettings(wedge="upwind-2" if variant == "upwind-2" else WEDGE)
    film = solve_point_contact(case, settings, throw=False)
    all_grids = (film, *film.coarser)
    return {
        "nodes": case.nodes[0],
        "sound": len(all_grids) == 3 and all(_sound(one, settings) for one in all_grids),
        "density_ratio": _density_ratio(film),
        "peak": peak_error(film, film.coarser[0]) if film.coarser else np.nan,
        "grids": np.array([one.numbers for one in all_grids]),
        "seconds": time.process_time() - began,
    }


def solved(kept: KeptFilms, contact: Contact, variant: str) -> Solved:
    """Return a contact, solved if it is not kept."""
    groups = "_".join(f"{one:g}" for one in astuple(contact))
    data = kept.kept(f"{variant}_{groups}", lambda: solve(contact, variant))
    return Solved(
        contact,
        variant,
        int(data["nodes"]),
        bool(data["sound"]),
        float(data["density_ratio"]),
        float(data["peak"]),
        tuple(FilmNumbers(*one) for one in data["grids"].tolist()),
        float(data["seconds"]),
    )


def all_solved(kept: KeptFilms) -> Table:
    """Return all contacts, those of the slow kind last; those that are missing are left out."""
    wanted = [(contact, "table") for contact in table_contacts()]
    wanted += [(contact, way) for contact in checked_contacts() for way in ("upwind-2", "wider")]
    table: Table = {}
    for key in sorted(wanted, key=lambda key: finest_nodes(key[0]) == NODES_AT_AN_ANGLE):
        try:
            table[key] = solved(kept, *key)
        except MissingFilmError:
            continue
    return table


def _sound(film: PointSolution, settings: PointSolverSettings) -> bool:
    outcome = film.outcome
    return outcome.converged and outcome.wedge == settings.wedge and outcome.limited <= 0.0


def _density_ratio(film: PointSolution) -> float:
    pressure = float(interpn(film.axes, film.pressure, (0.0, 0.0))[0])
    oil = film.problem.lubricant
    return float(density(oil, pressure) / density(oil, 0.0))
