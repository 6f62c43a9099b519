"""Put numbers into docs/ehl_thermal.md: python -m docs.ehl_thermal.make.

Thermal point contacts over slide-roll ratios and over inlet heating, some minutes of one core.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from docs.page import Page
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.ehl.case.contact_case import PointCase
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.film.grubin_1949 import inlet_heating_factor
from gearlube_core.oil.film_oil import FilmOil, viscosity_cooling

OIL = PointCase.named("elliptical_thermal").oil.film_oil()
RATIOS = (0.0, 0.1, 0.5, 1.0, 2.0, 3.0)
RADIUS, MODULUS = 0.012, 115e9
SPEEDS = (1.0, 4.0)
INLETS = (2.0, 5.0, 8.0, 10.0)
# Murch and Wilson 1975: 3.94/(3.94 + L^0.62)
MURCH_WILSON = (3.94, 0.62)


class Row(NamedTuple):
    """One contact, cold and warm."""

    film: float  # warm over cold, central
    smallest: float
    cold: float  # friction
    warm: float
    rise: float  # [K]
    surface: float


def solved(problem: PointContactProblem) -> Row:
    """Return a contact without and with its heat."""
    cold = solve_point_contact(problem)
    warm = solve_thermal_point(problem, STEEL, STEEL)
    sliding, oil = problem.sliding or (0.0, 0.0), problem.lubricant
    shear = point_traction(problem.x, problem.y, cold.pressure, cold.film, sliding, oil)
    walls = max(float(one.max()) for one in warm.surface_temperature)
    return Row(
        warm.film.central_film / cold.central_film,
        warm.film.minimum_film / cold.minimum_film,
        shear.force / problem.load,
        warm.friction_coefficient,
        warm.max_temperature - oil.temperature,
        walls - oil.temperature,
    )


def ball(speed: float, ratio: float, oil: FilmOil = OIL) -> PointContactProblem:
    """Return a ball of 12 mm under 1 GPa with a slide-roll ratio along the entrainment."""
    return elliptical_contact(
        R_x=RADIUS,
        R_y=RADIUS,
        entrainment=(speed, 0.0),
        load=54.0,
        contact_modulus=MODULUS,
        lubricant=oil,
        sliding=(ratio * speed, 0.0),
        nodes=(129, 129),
    )


def sliding_rows(speed: float) -> list[list[str]]:
    """Return friction and film over slide-roll ratios."""
    lines = []
    for ratio in RATIOS:
        row = solved(ball(speed, ratio))
        lines.append(
            [
                f"{ratio:g}",
                *(f"{abs(one):.4f}" for one in (row.cold, row.warm)),
                *(f"{one:.1f}" for one in (row.rise, row.surface)),
                *(f"{one:.3f}" for one in (row.film, row.smallest)),
            ]
        )
    return lines


def inlet_rows() -> list[list[str]]:
    """Return films thinned by heat in the inlet beside published factors."""
    lines = []
    oil = OIL.newtonian()._replace(eta0=0.04, expansion=0.0)
    slope = viscosity_cooling(oil, 0.0, oil.temperature)
    for speed in INLETS:
        round_one = replace(ball(speed, 0.0, oil), nodes=(97, 65))
        slender = elliptical_contact(
            R_x=RADIUS,
            R_y=8.0 * RADIUS,
            entrainment=(speed, 0.0),
            load=300.0,
            contact_modulus=MODULUS,
            lubricant=oil,
            sliding=(0.0, 0.0),
            nodes=(129, 33),
        )
        rows = solved(slender), solved(round_one)
        L = slope * oil.eta0 * speed * speed / oil.conductivity
        first, power = MURCH_WILSON
        gupta = inlet_heating_factor(
            oil.eta0, slope, oil.conductivity, speed, 0.0, slender.hertz_contact[2], 2.0 * MODULUS
        )
        factors = (rows[0].film, rows[1].film, first / (first + L**power), gupta)
        lines.append([f"{speed:g}", f"{L:.2f}", *(f"{one:.3f}" for one in factors)])
    return lines


def main() -> None:
    """Solve, and put the numbers into the page."""
    page = Page("ehl_thermal")
    for speed in SPEEDS:
        page.rows("slide-roll | friction, cold", sliding_rows(speed), f"### {speed:g} m/s")
    page.rows("u, m/s | L", inlet_rows())
    page.write()


if __name__ == "__main__":
    main()
