"""What the formulas of lines err outside the film model: python -m docs.film_model.outside_line.

Contacts of the helical pairs outside the domain of the model are solved (tenths of a second each,
resumable: docs/film_model/outside_line.csv) and compared with what the pair takes there. Then
`python -m docs.film_model.lines` writes the page.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from docs.film_model.outside_solves import OILS, Outside, constant_stress, outside_solves
from docs.page import Page
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.kinds import HELICAL_LINE
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solves import SolveRow, SolveTable
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.film_model.line_contact import LineContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_line
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.friction.solved_line import LINE_FORMULA_FILM_BOUND, LINE_FORMULA_FRICTION_TOP
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.oil_file import read_oil

TABLE = Path(__file__).with_name("outside_line.csv")
SOLVES, SEED, DRAWS = 120, 220, 1500
MODEL = "helical_line"
PRESSURE = 0.1e9  # Pa, mean pressure down to which the bounds are set


def formula_friction(contact: LineContact, film: float) -> float:
    """Return the friction coefficient of the film by Evans and Johnson [-]."""
    c = contact
    p = line_mean_pressure(c.line_load, c.R, c.contact_modulus)
    effusivity_squared = c.solid_conductivity * c.solid_heat_capacity
    modulus = 2.0 * c.contact_modulus
    resistance = solid_resistance(c.R, p, c.entrainment_speed, modulus, effusivity_squared)
    return viscous_friction_coefficient(
        film,
        p,
        c.sliding_speed,
        c.eta0,
        c.alpha,
        c.beta,
        c.tau0,
        c.conductivity,
        surface_heating_number(film, c.conductivity, resistance),
    )


def formula_film(contact: LineContact) -> float:
    """Return the film by Dowson and Toyoda [m]."""
    c = contact
    modulus = 2.0 * c.contact_modulus
    return line_film_thickness(c.R, c.eta0, c.alpha, c.entrainment_speed, c.line_load, modulus)


def contacts() -> list[LineContact]:
    """Return contacts of the pairs well outside, in the order of their draw."""
    plan = FilmPlan(contact=HELICAL_LINE.name)
    oils = [read_oil(name).lubricant for name in OILS]
    visited = HELICAL_LINE.visits(DRAWS, SEED, plan.pairs, oils, ANYWHERE)
    drawn = [constant_stress(one) for one in visited]
    numbers = FilmModel.named(MODEL).copied_numbers()
    return [one for one in drawn if solved_line(numbers, one).outside >= 1.0][:SOLVES]


def compared(rows: list[SolveRow]) -> Outside:
    """Return solved films beside the formulas, as the pair takes them."""
    cells = []
    for row in rows:
        if row.failure:
            continue
        c, mu = row.task.contact, row.solved.friction
        p, film = line_mean_pressure(c.line_load, c.R, c.contact_modulus), formula_film(c)
        rate = c.eta0 * c.sliding_speed / (film * c.tau0)
        isothermal = c.tau0 / p * eyring_stress_ratio(rate, c.alpha * p)
        ratio = row.solved.central_film / film
        loss = c.line_load * c.sliding_speed * mu
        cells.append((p, ratio, mu, formula_friction(c, film), isothermal, loss))
    return Outside(*np.array(cells).T)


def put_outside(page: Page) -> None:
    """Put in what the table says, with how many contacts exceed the bounds."""
    rows = list(SolveTable(TABLE, HELICAL_LINE).rows.values())
    found = compared(rows)
    gpa, ratio = 1e-9 * found.pressure, found.film
    page.fill(
        "{} contacts of the pairs where the formulas stand in alone were solved, {} of them not "
        "found ({} to {} GPa mean pressure). Solved films are {} to {} times as thick as the "
        "formula's. The formula's friction is zero at {} of them, so that no bound relative",
        len(rows),
        len(rows) - gpa.size,
        *(f"{one:.2f}" for one in (gpa.min(), gpa.max(), ratio.min(), ratio.max())),
        found.without_friction(),
    )
    page.fill(
        "The bounds hold 95 % of the contacts above 0.1 GPa; those below hold {} % of the loss of "
        "all solved ones.",
        f"{found.loss_below(PRESSURE):.0f}",
    )
    bounds = (LINE_FORMULA_FILM_BOUND, LINE_FORMULA_FRICTION_TOP)
    page.rows("bound | exceeded", found.exceeded(PRESSURE, *bounds))


if __name__ == "__main__":
    outside_solves(TABLE, HELICAL_LINE, contacts())
