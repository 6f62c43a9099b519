"""What the formulas of rollers err where their film model does not hold.

Contacts of the shipped bearings outside the model's domain are solved (a tenth of a second each,
resumable: docs/film_model/outside_rollers.csv) and compared with what stands in there:
python -m docs.film_model.outside_rollers prints the table of docs/film_model_axle.md.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.film_model.marked_page import put
from docs.film_model.outside_solves import outside_solves
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.kinds import BEARING_ROLLER
from gearlube.studies.film_model.roller_samples import AXLE_BEARING, roller_contacts
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


def sentences(rows: list[SolveRow]) -> str:
    """Return what was found, as Markdown."""
    found = compared(rows)
    failed = len(rows) - found.film.size
    lines = []
    for words, ratio, bound in (
        ("central film", found.film, FORMULA_RACE_FILM_BOUND),
        ("rolling force", found.force, FORMULA_FORCE_BOUND),
    ):
        least, low, middle, high, most = np.quantile(ratio, (0.0, 0.05, 0.5, 0.95, 1.0))
        above = np.abs(ratio - 1.0) > bound
        lines.append(
            f"| {words} | {least:.2f} | {low:.2f} | {middle:.2f} | {high:.2f} | {most:.2f} | "
            f"{100.0 * bound:.0f} | {above[:SET].sum()} of {above[:SET].size} | "
            f"{above[SET:].sum()} of {above[SET:].size} |"
        )
    gpa = 1e-9 * found.pressure
    return (
        f"{found.film.size} contacts of the axle's rollers outside were solved "
        f"({gpa.min():.2f} to {gpa.max():.2f} GPa mean pressure); {failed} were not found.\n\n"
        "| solved over formula | least | 5 % | median | 95 % | most | bound, % | above it | "
        "of contacts that did not set it |\n|---|---|---|---|---|---|---|---|---|\n"
        + "\n".join(lines)
        + "\n"
    )


def main() -> None:
    """Solve what is missing and write the page."""
    put(
        "outside_rollers",
        "outside_rollers",
        sentences(outside_solves(TABLE, BEARING_ROLLER, contacts())),
    )


if __name__ == "__main__":
    main()
