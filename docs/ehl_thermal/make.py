"""Rewrite docs/ehl_thermal.md: python -m docs.ehl_thermal.make.

Thermal point contacts over slide-roll ratios and over inlet heating, some minutes of one core.
"""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.ehl.case.contact_case import PointCase
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.film.grubin_1949 import inlet_heating_factor
from gearlube_core.oil.film_oil import FilmOil, viscosity_cooling

PAGE = Path(__file__).resolve().parents[1] / "ehl_thermal.md"
OIL = PointCase.named("elliptical_thermal").oil.film_oil()
RATIOS = (0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0)
RADIUS, MODULUS = 0.012, 115e9
SPEEDS = (1.0, 4.0)
INLETS = (2.0, 5.0, 8.0, 10.0)
# Murch and Wilson 1975: 3.94/(3.94 + L^0.62)
MURCH_WILSON = (3.94, 0.62)

HEAD = """# Heat in point contacts

Written by `python -m docs.ehl_thermal.make`; not edited by hand.

What the thermal option (`temperature = "thermal"`) makes of films and friction. Steel bodies, in
bulk at the oil's inlet temperature of 40 degC; the oil of the shipped case `elliptical_thermal`
(20 mPa s, 18 1/GPa, Houpert with S0 = 1.1, Eyring stress 5 MPa). Equations and limits stand in
`gearlube_core.ehl.point.thermal.solver`, their tests in
`tests/analytical/test_ehl_point_thermal.py` (line contact, balances, symmetry) and
`test_ehl_moving_heat.py` (Jaeger's sources).
"""


class Row(NamedTuple):
    """One contact, cold and warm."""

    film: float  # warm over cold, central
    smallest: float
    cold: float  # friction
    warm: float
    rise: float  # [K]
    surface: float
    turns: int
    cost: float  # CPU time, warm over cold
    converged: bool


def solved(problem: PointContactProblem) -> Row:
    """Return a contact without and with its heat."""
    began = time.process_time()
    cold = solve_point_contact(problem, throw=False)
    between = time.process_time()
    warm = solve_thermal_point(problem, STEEL, STEEL, throw=False)
    spent = time.process_time() - between
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
        len(warm.balances) - 1,
        spent / (between - began),
        warm.converged and cold.outcome.converged,
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


def sliding_table(speed: float) -> str:
    """Return friction and film over slide-roll ratios."""
    lines = [
        f"\n### {speed:g} m/s\n",
        "| slide-roll | friction, cold | friction, warm | film, K | surface, K | central film | "
        "smallest film | turns | CPU time | converged |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for ratio in RATIOS:
        row = solved(ball(speed, ratio))
        lines.append(
            f"| {ratio:g} | {abs(row.cold):.4f} | {abs(row.warm):.4f} | "
            f"{row.rise:.1f} | {row.surface:.1f} | "
            f"{row.film:.3f} | {row.smallest:.3f} | {row.turns} | {row.cost:.1f} | "
            f"{'yes' if row.converged else 'NO'} |"
        )
    return "\n".join(lines) + "\n"


def inlet_table() -> str:
    """Return films thinned by heat in the inlet beside published factors."""
    lines = [
        "| u, m/s | L | solved, ellipse | solved, ball | Murch and Wilson 1975 | "
        "Gupta et al. 1992 | converged |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
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
        lines.append(
            f"| {speed:g} | {L:.2f} | {rows[0].film:.3f} | {rows[1].film:.3f} | "
            f"{first / (first + L**power):.3f} | {gupta:.3f} | "
            f"{'yes' if all(row.converged for row in rows) else 'NO'} |"
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Solve and write the page."""
    page = HEAD + (
        "\n## Over the slide-roll ratio\n\n"
        "Ball of 12 mm, 54 N, 129 by 129 nodes. *Cold*: isothermal film and friction.\n"
        "Temperatures above the inlet; films and CPU time warm over cold. At a ratio of 2 one\n"
        "surface stands, beyond it the surfaces move against each other: heat goes upstream in\n"
        "the slow one and warms the inlet. Warm friction passes a maximum and falls with more\n"
        "sliding up to a ratio of 2, beyond which the film thins so much that it rises again;\n"
        "cold friction rises all the way.\n"
    )
    page += "".join(sliding_table(speed) for speed in SPEEDS)
    page += (
        "\n## Heat in the inlet\n\n"
        "Central films of pure rolling, Newtonian, 40 mPa s, warm over cold, over\n"
        "L = beta eta0 u^2/k. The published factors are those of line contacts: the slender\n"
        "ellipse (R_y/R_x = 8) has to come near them, a ball loses less.\n\n"
    )
    page += inlet_table()
    PAGE.write_text(page.rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
