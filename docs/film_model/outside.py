"""What the formulas err where the film model does not hold: python -m docs.film_model.outside.

Contacts of the axle outside the model's domain are solved (129 x 33 nodes, about a second each,
resumable: docs/film_model/outside.csv) and compared with what the axle takes there.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from docs.film_model.outside_solves import OILS, Outside, constant_stress, outside_solves
from docs.page import Page
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.kinds import HYPOID_FLANK
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.samples import axle_contacts
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.friction.flank_data import FlankState, contact_geometry
from gearlube_core.friction.flank_laws import FORMULA_FILM_BOUND, FORMULA_FRICTION_TOP, Consistent
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.oil.oil_file import read_oil

TABLE = Path(__file__).with_name("outside.csv")
SOLVES, SEED, DRAWS = 60, 220, 1000
MODEL = FilmModel.named("hypoid_flank")
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
FOUND = 0.1e9  # Pa, mean pressure below which most films are not found
_SMOOTH = 1e-8  # m, of flanks without asperities in touch


def contacts() -> list[FilmContact]:
    """Return contacts of the axle that lie outside, in the order of their draw."""
    oils = [read_oil(name).lubricant for name in OILS]
    mesh = shipped_mesh_table(FilmPlan().mesh_table)
    drawn = [constant_stress(one) for one in axle_contacts(DRAWS, SEED, mesh, oils, ANYWHERE)]
    numbers = MODEL.copied_numbers()
    found = [one for one in drawn if solved_film(numbers, one).outside > 0.0]
    return found[:SOLVES]


def compared(rows: list[SolveRow]) -> Outside:
    """Return solved films well outside the domain beside the formulas, by the axle's kernels."""
    numbers, cells = MODEL.copied_numbers(), []
    for row in rows:
        c = row.task.contact
        if row.failure or solved_film(numbers, c).outside < 1.0:
            continue
        oil, flank = state_of(c), formula_of(c)
        p = flank.mean_pressure
        rate = oil.eta0 * c.sliding_speed / (flank.film_thickness * oil.tau0)
        isothermal = oil.tau0 / p * eyring_stress_ratio(rate, oil.alpha * p)
        mu = row.solved.friction
        cells.append(
            (
                p,
                row.solved.central_film / flank.film_thickness,
                mu,
                flank.viscous_friction / c.load,
                isothermal,
                c.load * c.sliding_speed * mu,
            )
        )
    return Outside(*np.array(cells).T)


def formula_of(c: FilmContact) -> FlankState:
    """Return film and friction by the formulas, flanks too smooth for asperities in touch."""
    law = Consistent()(gear_flanks(_SMOOTH), SOLID)
    geometry = contact_geometry(c.R_x, c.R_y, c.entrainment_angle, SOLID.contact_modulus)
    return law.flank_state(c.load, c.entrainment_speed, c.sliding_speed, geometry, state_of(c))


def put(page: Page, rows: list[SolveRow]) -> None:
    """Put in what was found, how many contacts exceed the bounds."""
    found, failed = compared(rows), [row for row in rows if row.failure]
    gpa = 1e-9 * found.pressure
    page.fill(
        "Of {} contacts drawn outside, {} lie where the formulas stand in alone and were solved "
        "({} to {} GPa mean pressure); {} were not found, all below {} GPa. The formula's friction "
        "is zero at {} of them, so that no bound relative to it can hold. Contacts below 0.1 GPa "
        "hold {} % of the loss of those solved.",
        len(rows),
        gpa.size,
        f"{gpa.min():.2f}",
        f"{gpa.max():.2f}",
        len(failed),
        f"{1e-9 * _highest(failed):.2f}",
        found.without_friction(),
        f"{found.loss_below(FOUND):.1g}",
    )
    rows = found.exceeded(FOUND, FORMULA_FILM_BOUND, FORMULA_FRICTION_TOP)
    page.rows("bound | exceeded", rows)


def _highest(rows: list[SolveRow]) -> float:
    """Return the highest mean Hertz pressure of contacts [Pa]."""
    contacts = [row.task.contact for row in rows]
    return max((c.pressure_coefficient * c.load ** (1.0 / 3.0) for c in contacts), default=0.0)


def main() -> None:
    """Solve what is missing and write the page."""
    page = Page("film_model_axle")
    put(page, outside_solves(TABLE, HYPOID_FLANK, contacts()))
    page.write()


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
        c.alpha,
    )


if __name__ == "__main__":
    main()
