"""Point contacts of given Moes groups, for the tests of the film solver."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from gearlube_core.contact.hertz import log_curvature_ratio
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.dry_contact import DryContact, dry_contact_of_gap
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import Sides
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.oil.film_oil import FilmOil, density, viscosity
from gearlube_core.oil.film_oil_data import film_oil

RADIUS = 0.01  # m
REDUCED_MODULUS = 2.26e11  # Pa
ALPHA = 2e-8  # 1/Pa
ETA0 = 0.04  # Pa s
EYRING_STRESS = 5e6  # Pa


def radius_ratio(ellipticity: float) -> float:
    """Return R_y/R_x of a dry contact with semi-axes a_y/a_x."""
    exponent = log_curvature_ratio(abs(math.log(ellipticity)))
    return math.exp(exponent if ellipticity >= 1.0 else -exponent)


def moes_contact(
    M: float,
    L: float,
    *,
    nodes: tuple[int, int],
    radius_ratio: float = 1.0,
    angle: float = 0.0,
    lubricant: FilmOil | None = None,
    **given: Any,
) -> PointContactProblem:
    """Return the contact with load M and material L of Moes; L = 0 is isoviscous."""
    material = ALPHA * REDUCED_MODULUS
    U = 0.5 * (L / material) ** 4 if L > 0.0 else 1e-11
    speed = U * REDUCED_MODULUS * RADIUS / ETA0
    load = M * (2.0 * U) ** 0.75 * REDUCED_MODULUS * RADIUS**2
    if lubricant is None:
        lubricant = film_oil(eta0=ETA0, alpha=ALPHA if L > 0.0 else 0.0)
    return elliptical_contact(
        R_x=RADIUS,
        R_y=RADIUS * radius_ratio,
        entrainment=(speed * math.cos(angle), speed * math.sin(angle)),
        load=load,
        contact_modulus=0.5 * REDUCED_MODULUS,
        lubricant=lubricant,
        nodes=nodes,
        **given,
    )


def sliding_along(problem: PointContactProblem, slide_roll: float) -> PointContactProblem:
    """Return the contact with an Eyring oil whose surfaces slide along its entrainment."""
    oil = film_oil(eta0=ETA0, alpha=ALPHA, eyring_stress=EYRING_STRESS)
    u, v = problem.entrainment
    return replace(problem, lubricant=oil, sliding=(slide_roll * u, slide_roll * v))


def moes_film(problem: PointContactProblem, film: float) -> float:
    """Return H = h/R (2 U)^(-1/2)."""
    speed = math.hypot(*problem.entrainment)
    U = problem.lubricant.eta0 * speed / (REDUCED_MODULUS * RADIUS)
    return film / RADIUS / math.sqrt(2.0 * U)


def flow_out(solution: PointSolution, i0: int, i1: int, j0: int, j1: int) -> float:
    """Return what leaves a box of nodes over what enters it upstream, less one [-]."""
    problem = solution.problem
    steps = problem.x[1] - problem.x[0], problem.y[1] - problem.y[0]
    fields = solution.pressure, solution.film
    entering, gain = box_flow(
        *fields, problem.lubricant, problem.entrainment[0], steps, (i0, i1, j0, j1)
    )
    return -gain / entering


def box_flow(
    p: np.ndarray,
    h: np.ndarray,
    oil: FilmOil,
    speed: float,
    steps: tuple[float, float],
    box: tuple[int, int, int, int],
) -> tuple[float, float]:
    """Return what enters a box of nodes upstream and what stays in it [kg/s].

    With central faces the flow is that of the printed equation, evaluated from SI fields.
    """
    (dx, dy), (i0, i1, j0, j1) = steps, box
    rho = np.vectorize(lambda q: density(oil, q))(p)
    eta = np.vectorize(lambda q: viscosity(oil, q))(p)

    def along_x(i: int) -> float:
        a, b = slice(i, i + 1), slice(i + 1, i + 2)
        rows = slice(j0, j1 + 1)
        fluidity = 0.5 * (1.0 / eta[a, rows] + 1.0 / eta[b, rows])
        rising = p[b, rows] > p[a, rows]
        logarithmic = (1.0 / eta[b, rows] - 1.0 / eta[a, rows]) / np.where(
            rising, np.log(eta[a, rows] / eta[b, rows]), 1.0
        )
        fluidity = np.where(rising, logarithmic, fluidity)
        cubic = np.sqrt(rho[a, rows] * h[a, rows] ** 3 * rho[b, rows] * h[b, rows] ** 3)
        couette = 0.5 * speed * (rho * h)[i : i + 2, rows].sum(axis=0)
        poiseuille = cubic * fluidity / 12.0 * (p[b, rows] - p[a, rows]) / dx
        return float((couette - poiseuille[0]).sum() * dy)

    def along_y(j: int) -> float:
        columns = slice(i0, i1 + 1)
        a, b = (columns, j), (columns, j + 1)
        cubic = np.sqrt(rho[a] * h[a] ** 3 * rho[b] * h[b] ** 3)
        fluidity = 0.5 * (1.0 / eta[a] + 1.0 / eta[b])
        return float(-(cubic * fluidity / 12.0 * (p[b] - p[a]) / dy).sum() * dx)

    entering = along_x(i0 - 1)
    return entering, entering - along_x(i1) - along_y(j1) + along_y(j0 - 1)


def dry_contact(problem: PointContactProblem) -> DryContact:
    """Return the dry contact of a film's problem on its own grid."""
    x, y = problem.x, problem.y
    return dry_contact_of_gap(
        np.broadcast_to(problem.gap(x[:, None], y[None, :]), problem.nodes),
        x[1] - x[0],
        y[1] - y[0],
        problem.contact_modulus,
        problem.load,
        repeated=Sides(problem.sides).closed,
    )
