"""What the formulas err where the film model does not hold: python -m docs.film_model.outside.

Contacts of the axle outside the model's domain are solved (129 x 33 nodes, about a second each,
resumable: docs/film_model/outside.csv) and compared with what the axle takes there.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.film_model.marked_page import put
from gearlube.studies.film_model.plan import COARSE, FilmPlan, FilmTask
from gearlube.studies.film_model.samples import ANYWHERE, axle_contacts
from gearlube.studies.film_model.solves import SolveRow, SolveTable, row_key
from gearlube.studies.film_model.train import failed_row, solve_task
from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.errors import GearLubeError
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.friction.flank_bound import BoundedFlank, FlankEllipse
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_film import flank_film_model
from gearlube_core.friction.flank_laws import SOLVED, consistent
from gearlube_core.friction.solved_flank import FORMULA_FILM_BOUND, FORMULA_FRICTION_BOUND
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.oil.oil_file import read_oil

TABLE = Path(__file__).with_name("outside.csv")
SOLVES, SEED, DRAWS = 80, 220, 1000
MODEL = FilmModel.named("hypoid_flank")
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
_SMOOTH = 1e-8  # m, of flanks without asperities in touch


class Outside(NamedTuple):
    """Contacts outside the domain that were solved; arrays (n,)."""

    outside: Array  # share of the formulas in what the axle takes, 0 to 1 [-]
    film: Array  # solved over what the axle takes [-]
    friction: Array
    film_bound: Array  # relative [-]
    friction_bound: Array
    load: Array  # [N]
    loss: Array  # load times sliding times solved friction [W]
    pressure: Array  # mean of Hertz [Pa]


def contacts() -> list[FilmContact]:
    """Return contacts of the axle that lie outside, in the order of their draw."""
    plan = FilmPlan()
    oils = [read_oil(name).lubricant for name in plan.oils]
    drawn = axle_contacts(DRAWS, SEED, shipped_mesh_table(plan.mesh_table), oils, ANYWHERE)
    numbers = MODEL.copied_numbers()
    found = [one for one in drawn if solved_film(numbers, one).outside > 0.0]
    return found[:SOLVES]


def solved() -> list[SolveRow]:
    """Return all contacts solved; those in the table are not solved again."""
    table = SolveTable(TABLE)
    for n, one in enumerate(contacts()):
        task = FilmTask("outside", n, COARSE, one)
        if table.read(row_key(task)) is None:
            try:
                table.keep(row_key(task), solve_task(task))
            except GearLubeError as error:
                table.keep(row_key(task), failed_row(task, error))
    return list(table.rows.values())


def compared(rows: list[SolveRow]) -> Outside:
    """Return solved films over those that the axle takes, by its own kernel, without asperities."""
    numbers = flank_film_model(MODEL)
    cells = []
    for row in rows:
        c, found = row.task.contact, _flank(row.task.contact, numbers)
        mu = found.state.viscous_friction / c.load
        cells.append(
            (
                found.outside,
                row.solved.central_film / found.state.film_thickness,
                row.solved.friction / mu if mu > 0.0 else np.inf,
                found.film_bound,
                found.friction_bound,
                c.load,
                c.load * c.sliding_speed * row.solved.friction,
                c.pressure_coefficient * c.load ** (1.0 / 3.0),
            )
        )
    return Outside(*np.array(cells).T)


def _flank(c: FilmContact, numbers: Array) -> BoundedFlank:
    law = consistent(gear_flanks(_SMOOTH), SOLID)._replace(film=float(SOLVED))
    geometry = contact_geometry(c.R_x, c.R_y, c.entrainment_angle, SOLID.contact_modulus)
    ellipse = FlankEllipse(c.R_x, c.R_y, c.ellipticity, c.entrainment_angle, c.sliding_angle)
    oil = state_of(c)
    motion = (c.load, c.entrainment_speed, c.sliding_speed, geometry)
    film = law.model_film(*motion, ellipse, oil, numbers)
    return law.bounded_flank(*motion, film, oil, numbers)


def state_of(c: FilmContact) -> LubricantState:
    """Return the oil of a contact as the axle's flanks take it."""
    limit, boundary = 2e6, 0.17  # of asperities, which are not compared here
    return LubricantState(
        c.eta0,
        c.alpha,
        c.beta,
        c.eta0 * c.heat_capacity,  # nu is not used by a film
        c.tau0,
        limit,
        boundary,
        c.conductivity,
        c.temperature,
        c.heat_capacity,
    )


if __name__ == "__main__":
    solved()
