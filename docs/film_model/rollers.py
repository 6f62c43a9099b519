"""Rollers of the axle with solved films: python -m docs.film_model.rollers.

Writes drag by all laws into docs/film_model_axle.md, and what the formulas of rollers err where
their film model does not hold: contacts of the shipped bearings outside its domain are solved (a
tenth of a second each, resumable: docs/film_model/outside_rollers.csv) and compared with what
stands in there.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.film_model.outside_solves import OILS, constant_stress, outside_solves
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
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, AxleLosses, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film_model.line_contact import line_parts, line_reference_film
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.rolling import RollerContact, rolling_line, solved_rolling
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

SPEEDS, TORQUES, TEMPERATURES = (500.0, 1500.0, 3000.0), (20.0, 100.0, 300.0), (40.0, 80.0, 120.0)
SHOWN = 100.0  # N.m, of the rows of the page; its ratios are of all torques
LAWS: dict[str, str] = {
    "palmgren": "Palmgren",
    "zhou_hoeprich_1991": "Zhou and Hoeprich",
    "biboulet_houpert_2010": "Biboulet and Houpert",
    "solved_films": "solved",
}
_DRAG = LOSS_SOURCES.index("bearing_torque")
TABLE = Path(__file__).with_name("outside_rollers.csv")
SOLVES, SEED, DRAWS = 160, 221, 3000
SET = 80  # the first contacts, which set the bounds; the others test them
MODEL = FilmModel.named(ROLLER_MODEL)


def losses(law: str) -> AxleLosses:
    """Return the losses of the shipped axle with a law of bearing drag."""
    return axle_losses(
        replace(mohammadpour_2015_axle(), bearing_torque_loss=law),
        torques=np.array(TORQUES),
        speeds=np.array([rpm_to_rads(one) for one in SPEEDS]),
        temperatures=np.array([celsius_to_kelvin(one) for one in TEMPERATURES]),
    )


def put_losses(page: Page) -> None:
    """Put in drag by all laws, and bound and share outside of solved films."""
    found = {law: losses(law) for law in LAWS}
    solved, rows = found["solved_films"], []
    k = TORQUES.index(SHOWN)
    for j, speed in enumerate(SPEEDS):
        for i, temperature in enumerate(TEMPERATURES):
            drags = [f"{one.power[i, j, k, _DRAG]:.0f}" for one in found.values()]
            rows.append(
                [
                    *(f"{speed:g}", f"{SHOWN:g}", f"{temperature:g}", *drags),
                    f"{solved.drag_bound[i, j, k]:.1f}",
                    f"{100.0 * solved.rollers_outside[i, j, k]:.1f}",
                ]
            )
    page.rows("rpm | N·m | oil, °C", rows)
    drag = {law: one.power[..., _DRAG] for law, one in found.items()}

    def over(law: str) -> tuple[str, ...]:
        ratio: Array = drag["solved_films"] / drag[law]
        return tuple(f"{one:.2f}" for one in (ratio.min(), ratio.max(), np.median(ratio)))

    bound = 100.0 * solved.drag_bound / drag["solved_films"]
    page.fill(
        "Solved over Biboulet and Houpert: {} to {}, median {}; over Zhou and Hoeprich: {} to {}, "
        "median {}; over Palmgren: {} to {}, median {}. Bound over loss: median {} %, at most {} "
        "%.",
        *over("biboulet_houpert_2010"),
        *over("zhou_hoeprich_1991"),
        *over("palmgren"),
        *(f"{one:.1f}" for one in (np.median(bound), bound.max())),
    )


class Outside(NamedTuple):
    """Contacts that the formulas take alone, solved; arrays (n,)."""

    pressure: Array  # mean of Hertz [Pa]
    film: Array  # solved over the formula's [-]
    force: Array  # likewise
    loss: Array  # power by the solved force, per length [W/m]


def contacts() -> list[RollerContact]:
    """Return contacts of the axle's bearings where the formulas stand in alone."""
    oils = [read_oil(name).lubricant for name in OILS]
    visited = roller_contacts(DRAWS, SEED, [AXLE_BEARING], oils, ANYWHERE)
    drawn = [constant_stress(one) for one in visited]
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


def put_outside(page: Page, rows: list[SolveRow]) -> None:
    """Put in what the formulas err outside the domain."""
    found, cells = compared(rows), []
    for ratio, bound in ((found.film, FORMULA_RACE_FILM_BOUND), (found.force, FORMULA_FORCE_BOUND)):
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
    put_losses(page)
    put_outside(page, outside_solves(TABLE, BEARING_ROLLER, contacts()))
    page.write()


if __name__ == "__main__":
    main()
