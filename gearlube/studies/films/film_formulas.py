"""References for a computed film: published formulas where they apply, and roughness."""

from __future__ import annotations

import math
from typing import NamedTuple

import xarray as xr

from gearlube.report.films import FULL_FILM, film_ratio_level, film_ratio_words
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import NOTE, Finding
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
from gearlube_core.oil.formula_laws import alpha_at

ROUGHNESS = "roughness_rms"  # attribute of a film: composite rms roughness [m], where it was given
RATIO_FILMS = ("central film", "smallest film")
_ALONG_AXIS = math.radians(1.0)
_SMALLEST_RATIO = 0.01  # R_x/R_y of Nijenbanning's fit


def least_films(dataset: xr.Dataset) -> dict[str, float]:
    """Return the least central and the smallest film [m], those that the dataset has."""
    prefix = "steady_" if dataset.attrs["contact"] == "hypoid" else ""
    found = {}
    for name, variable in zip(RATIO_FILMS, ("central_film", "minimum_film"), strict=True):
        if variable in dataset.attrs:
            found[name] = float(dataset.attrs[variable])
        elif prefix + variable in dataset:
            found[name] = float(dataset[prefix + variable].min())
    return found


def film_ratios(dataset: xr.Dataset) -> dict[str, float]:
    """Return the least films over the composite roughness [-]; empty without a roughness."""
    if ROUGHNESS not in dataset.attrs:
        return {}
    roughness = float(dataset.attrs[ROUGHNESS])
    return {name: film / roughness for name, film in least_films(dataset).items()}


def film_ratio_finding(dataset: xr.Dataset) -> Finding:
    """Return the film ratio as a sentence, or the roughness that would matter if none is given."""
    ratios = film_ratios(dataset)
    if not ratios:
        film = next(iter(least_films(dataset).values()))
        limit = quantity_text(1e6 * film / FULL_FILM, "µm", 2)
        return Finding(
            NOTE,
            "No roughness was given, so the film ratio λ is not known.",
            f"The film is mixed below λ = {FULL_FILM:g}: with a composite rms roughness above "
            f"{limit}. Give it with --roughness-um, or as roughness_um in the case.",
        )
    name, ratio = next(iter(ratios.items()))
    others = "".join(
        f" The {other} has {value:.2g}." for other, value in ratios.items() if other != name
    )
    roughness = quantity_text(1e6 * float(dataset.attrs[ROUGHNESS]), "µm", 2)
    return Finding(
        film_ratio_level(ratio),
        f"The film ratio λ of the {name} is {ratio:.2g}.",
        f"{film_ratio_words(ratio)} Film of smooth surfaces over a composite rms roughness of "
        f"{roughness}.{others}",
    )


class FilmFormula(NamedTuple):
    """Film of a formula."""

    quantity: str  # "central film" or "minimum film"
    source: str
    film: float  # [m]
    radius: float  # relative radius along entrainment or across, the smaller [m]


def line_film_formulas(problem: LineProblem) -> list[FilmFormula]:
    """Return films of formulas for a line contact; none for a constant viscosity.

    alpha is that of films, of an oil whose law has one; else the slope at ambient pressure.
    """
    oil, u = problem.lubricant, abs(problem.entrainment_speed)
    alpha = alpha_at(oil.viscosity, pressure_viscosity(oil))
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
    alpha, speed = alpha_at(oil.viscosity, pressure_viscosity(oil)), math.hypot(u, v)
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
