"""Published film formulas for comparison with a computed film, where they apply."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.film.groups import point_contact_groups
from gearlube_core.film.line_film import line_film_thickness, minimum_line_film_thickness
from gearlube_core.film.point_film import (
    brewe_hamrock_ellipticity,
    central_film_group,
    central_film_thickness,
    film_geometry,
    hamrock_dowson_films,
    minimum_film_geometry,
    minimum_film_thickness,
)
from gearlube_core.oil.film_oil import pressure_viscosity

_ALONG_AXIS = math.radians(1.0)
_SMALLEST_RATIO = 0.01  # R_x/R_y of Nijenbanning's fit


class FilmFormula(NamedTuple):
    """Film of a formula."""

    quantity: str  # "central film" or "minimum film"
    source: str
    film: float  # [m]
    radius: float  # relative radius along entrainment or across, the smaller [m]


def line_film_formulas(problem: LineProblem) -> list[FilmFormula]:
    """Return films of formulas for a line contact; none for a constant viscosity."""
    oil, u = problem.lubricant, abs(problem.entrainment_speed)
    alpha = pressure_viscosity(oil)
    if not alpha > 0.0:
        return []
    contact = (problem.radius, oil.eta0, alpha, u, problem.line_load, problem.reduced_modulus)
    return [
        FilmFormula(what, source, law(*contact), problem.radius)
        for what, source, law in (
            ("central film", "Dowson and Toyoda 1979", line_film_thickness),
            ("minimum film", "Dowson 1968", minimum_line_film_thickness),
        )
    ]


def point_film_formulas(problem: PointContactProblem) -> list[FilmFormula]:
    """Return films of formulas for a point contact; none for a constant viscosity.

    Of a part of a line contact between closed sides: those of the line.

    Notes
    -----
    Hamrock and Dowson's and Nijenbanning's are given where entrainment lies within a degree of
    the minor axis of the contact; Chittenden's at any angle.
    """
    oil, (u, v) = problem.lubricant, problem.entrainment
    alpha, speed = pressure_viscosity(oil), math.hypot(u, v)
    if not alpha > 0.0:
        return []
    R_x, R_y, psi = problem.hertz.R_x, problem.hertz.R_y, math.atan2(abs(v), abs(u))
    if R_x > R_y:
        R_x, R_y, psi = R_y, R_x, 0.5 * math.pi - psi
    modulus = 2.0 * problem.contact_modulus
    if problem.sides != "ambient":
        return line_film_formulas(
            LineProblem(
                lubricant=oil,
                radius=problem.hertz.R_x,
                line_load=problem.line_load,
                reduced_modulus=modulus,
                speed_1=u,
                speed_2=u,
            )
        )
    operation = (oil.eta0, alpha, speed, problem.load, modulus)
    central = central_film_thickness(*film_geometry(R_x, R_y, psi), *operation)
    smallest = minimum_film_thickness(*minimum_film_geometry(R_x, R_y, psi), *operation)
    found = [
        FilmFormula("central film", "Chittenden et al. 1985", central, R_x),
        FilmFormula("minimum film", "Chittenden et al. 1985", smallest, R_x),
    ]
    if psi > _ALONG_AXIS and R_y > R_x:
        return found
    g = point_contact_groups(
        viscosity=oil.eta0,
        pressure_viscosity=alpha,
        entrainment_speed=speed,
        load=problem.load,
        radius=R_x,
        reduced_modulus=modulus,
    )
    H_c, H_m = hamrock_dowson_films(g.U, g.G, g.W, brewe_hamrock_ellipticity(R_x, R_y))
    if R_x >= _SMALLEST_RATIO * R_y:
        H = central_film_group(g.M, g.L, R_x / R_y) * math.sqrt(2.0 * g.U)
        found.append(FilmFormula("central film", "Nijenbanning et al. 1994", R_x * H, R_x))
    return [
        FilmFormula("central film", "Hamrock and Dowson 1977", R_x * H_c, R_x),
        FilmFormula("minimum film", "Hamrock and Dowson 1977", R_x * H_m, R_x),
        *found,
    ]
