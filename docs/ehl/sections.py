"""Sections across the contact line: transient, at rest, and as a line contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.ehl.cases import CYCLE, FilmCase
from docs.ehl.claims_cycle import cycle
from docs.ehl.store import Store
from gearlube_core.arrays import Array
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.solver import solve_line


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Film of one section in motion and at rest."""

    y: float  # [m]
    x: Array  # [m]
    pressure: Array  # transient [Pa]
    film: Array  # [m]
    rest_pressure: Array
    rest_film: Array

    @property
    def film_ratio(self) -> float:
        """Return the smallest film in motion over that at rest."""
        return float(self.film.min() / self.rest_film.min())

    @property
    def pressure_off(self) -> float:
        """Return the difference of the largest pressures over that at rest."""
        return abs(float(self.pressure.max() / self.rest_pressure.max()) - 1.0)


def section(store: Store, design: str, step: int, y: float) -> Section:
    """Return the section at y [m], between rows, of a design at one of the detailed steps."""
    pressure, film = cycle(store, design).fields(step)
    rest = store.steady(FilmCase(design=design, nodes=CYCLE), step)
    j = int(np.clip(np.searchsorted(rest.y, y), 1, rest.y.size - 1))
    share = float((y - rest.y[j - 1]) / (rest.y[j] - rest.y[j - 1]))

    def at(values: Array) -> Array:
        return np.asarray((1.0 - share) * values[:, j - 1] + share * values[:, j])

    return Section(
        y=y,
        x=rest.x,
        pressure=at(pressure),
        film=at(film),
        rest_pressure=at(rest.pressure),
        rest_film=at(rest.film),
    )


def line_contact(
    store: Store, case: FilmCase, step: float, y: float, **how: object
) -> LineSolution:
    """Return the line contact with gap, speeds and load per length of a section at rest."""
    rest = store.steady(case, step)
    j = rest.column(y)
    place = rest.y[j : j + 1]
    film = case.film()
    X = film.line(case.number(step) * film.time_step)
    u_1, u_2 = film.surface_speeds(place, X)
    plane = film.modified.pair.plane
    s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + float(place[0]) * plane.sin_b
    problem = LineProblem(
        lubricant=film.lubricant,
        radius=s * (plane.x_g - s) / (plane.x_g * plane.cos_b),
        line_load=float(rest.pressure[:, j].sum()) * (rest.x[1] - rest.x[0]),
        reduced_modulus=2.0 * film.contact_modulus,
        speed_1=float(u_1[0]),
        speed_2=float(u_2[0]),
        gap=lambda x: film.gap(x, place, X)[:, 0],
        domain=(float(rest.x[0]), float(rest.x[-1])),
    )
    return solve_line(problem, LineSettings(**how))  # type: ignore[arg-type]
