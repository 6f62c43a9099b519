"""What the formulas of rollers err where their film model does not hold.

Contacts of the shipped bearings outside the model's domain are solved (a tenth of a second each,
resumable: docs/film_model/outside_rollers.csv) and compared with what stands in there:
python -m docs.film_model.outside_rollers writes the table of docs/film_model_axle.md.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.film_model.outside_solves import outside_solves
from docs.page import Page
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.kinds import BEARING_ROLLER
from gearlube.studies.film_model.line_samples import AXLE_BEARING, roller_contacts
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.laws import aihara_heating
from gearlube_core.bearings.losses.race_rolling import (
    FORMULA_FORCE_BOUND,
    FORMULA_RACE_FILM_BOUND,
    ROLLER_MODEL,
)
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film_model.line_contact import line_parts, line_reference_film
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.rolling import RollerContact, rolling_line, solved_rolling
from gearlube_core.oil.oil_file import read_oil

TABLE = Path(__file__).with_name("outside_rollers.csv")
SOLVES, SEED, DRAWS = 160, 221, 3000
SET = 80  # the first contacts, which set the bounds; the others test them
OILS = ("mohammadpour_2015", "karagiannis_2012")
MODEL = FilmModel.named(ROLLER_MODEL)


class Outside(NamedTuple):
    """Contacts that the formulas take alone, solved; arrays (n,)."""

    pressure: Array  # mean of Hertz [Pa]
    film: Array  # solved over the formula's [-]
    force: Array  # likewise
    loss: Array  # power by the solved force, per length [W/m]


def contacts() -> list[RollerContact]:
    """Return contacts of the axle's bearings where the formulas stand in alone."""
    oils = [read_oil(name).lubricant for name in OILS]
    drawn = roller_contacts(DRAWS, SEED, [AXLE_BEARING], oils, ANYWHERE)
    numbers = MODEL.copied_numbers()
    return [one for one in drawn if solved_rolling(numbers, one).outside >= 1.0][:SOLVES]


def by_formula(c: RollerContact) -> tuple[float, float]:
    """Return film [m] and rolling force [N/m] of a contact as `solved_race` takes them outside."""
    E = 2.0 * c.contact_modulus
    cold, _ = biboulet_houpert_force(c.R, c.line_load, E, c.eta0, c.alpha, c.speed)
    number = inlet_heating_number(c.eta0, c.beta, c.speed, c.conductivity)
    film = line_reference_film(c.line_load, c.speed, c.R, line_parts(rolling_line(c))[1])
    return film, cold * aihara_heating(number)


def compared(rows: list[SolveRow]) -> Outside:
    """Return solved films beside the formulas."""
    cells = []
    for row in rows:
        c = row.task.contact
        if row.failure:
            continue
        film, force = by_formula(c)
        solved_force = 0.5 * row.solved.friction * c.line_load
        p = line_mean_pressure(c.line_load, c.R, c.contact_modulus)
        loss = 2.0 * solved_force * c.speed
        cells.append((p, row.solved.central_film / film, solved_force / force, loss))
    return Outside(*np.array(cells).T)


def put(page: Page, rows: list[SolveRow]) -> None:
    """Put in what was found."""
    found, cells = compared(rows), []
    for ratio, bound in (
        (found.film, FORMULA_RACE_FILM_BOUND),
        (found.force, FORMULA_FORCE_BOUND),
    ):
        above = np.abs(ratio - 1.0) > bound
        shares = (f"{some.sum()} of {some.size}" for some in (above[:SET], above[SET:]))
        quantiles = np.quantile(ratio, (0.0, 0.05, 0.5, 0.95, 1.0))
        cells.append([*(f"{one:.2f}" for one in quantiles), f"{100.0 * bound:.0f}", *shares])
    page.cells("solved over formula", cells, first=1)
    gpa = 1e-9 * found.pressure
    page.fill(
        "{} contacts of the axle's rollers outside were solved ({} to {} GPa mean pressure); {} "
        "were not found.",
        found.film.size,
        f"{gpa.min():.2f}",
        f"{gpa.max():.2f}",
        len(rows) - found.film.size,
    )


def main() -> None:
    """Solve what is missing and write the page."""
    page = Page("film_model_axle")
    put(page, outside_solves(TABLE, BEARING_ROLLER, contacts()))
    page.write()


if __name__ == "__main__":
    main()
