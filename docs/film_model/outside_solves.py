"""Contacts outside a film model's domain: solved once, and how far formulas are off there."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from gearlube.studies.film_model.kinds import Contact, ContactKind
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solves import SolveRow, SolveTable, failed_row, row_key, solve_task
from gearlube_core.arrays import Array
from gearlube_core.errors import GearLubeError

OILS = ("mohammadpour_2015", "karagiannis_2012")  # of the papers, by Roelands' law


class Outside(NamedTuple):
    """Contacts that the formulas take alone, solved; arrays (n,)."""

    pressure: Array  # mean of Hertz [Pa]
    film: Array  # solved over the formula's [-]
    friction: Array  # solved [-]
    formula: Array  # Evans and Johnson's [-]
    isothermal: Array  # of an isothermal Eyring film as thick as the formula's [-]
    loss: Array  # load times sliding times solved friction [W] or [W/m]

    def without_friction(self) -> int:
        """Return for how many the friction formula gives nothing."""
        return int((self.formula == 0.0).sum())

    def loss_below(self, pressure: float) -> float:
        """Return the share of the loss of contacts below a mean pressure [%]."""
        return 100.0 * float(self.loss[self.pressure < pressure].sum() / self.loss.sum())

    def exceeded(self, pressure: float, film: float, top: float) -> list[list[str]]:
        """Return how many exceed each bound above and below a pressure [Pa].

        The bound of the film is how much thinner it may be, relative; `top` that of the friction
        over the isothermal value.
        """
        above = self.pressure >= pressure
        bounds = {
            f"film: at least {100.0 * (1.0 - film):.0f} % of the formula's": self.film < 1.0 - film,
            f"friction: between 0 and {top:g} times the isothermal Eyring value": (
                self.friction / self.isothermal > top
            ),
        }
        return [
            [name, *(f"{one[some].sum()} of {one[some].size}" for some in (above, ~above))]
            for name, one in bounds.items()
        ]


def constant_stress(contact: Contact) -> Contact:
    """Return a contact without a local Eyring stress, as the formulas take its oil."""
    return contact._replace(eyring_slope=0.0)


def outside_solves(table: Path, kind: ContactKind, contacts: Sequence[tuple]) -> list[SolveRow]:
    """Return all contacts solved; those in the table are not solved again."""
    kept = SolveTable(table, kind)
    for n, one in enumerate(contacts):
        task = FilmTask("outside", n, kind.nodes, one)
        if kept.read(row_key(task)) is None:
            try:
                kept.keep(row_key(task), solve_task(task))
            except GearLubeError as error:
                kept.keep(row_key(task), failed_row(task, error))
    return list(kept.rows.values())
