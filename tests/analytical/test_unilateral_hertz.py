"""Unilateral contact of half-space cells against Hertz: sphere, ellipse, line."""

import math

import numpy as np
import pytest

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import (
    UnilateralProblem,
    UnilateralSolution,
    tangent_stiffness,
)
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.helpers.each import each
from tests.references.hertz_reference import HertzContact

E_STAR, LOAD = 115.4e9, 500.0


def pressed(
    hertz: HertzContact, nx: int, ny: int, observed: str
) -> tuple[UnilateralProblem, UnilateralSolution, float]:
    """Press two paraboloids; x is the minor axis. Return the area of a cell too."""
    dx, dy = 2.6 * hertz.semi_minor / nx, 2.6 * hertz.semi_major / ny
    x, y = (np.arange(nx) - 0.5 * (nx - 1)) * dx, (np.arange(ny) - 0.5 * (ny - 1)) * dy
    gap = x[:, None] ** 2 / (2.0 * hertz.R_x) + y**2 / (2.0 * hertz.R_y)
    if observed == "mean":
        gap += dx**2 / (24.0 * hertz.R_x) + dy**2 / (24.0 * hertz.R_y)
    coefficients = love_coefficients(dx, dy, nx, ny, hertz.contact_modulus, observed)
    problem = UnilateralProblem(
        compliance=StripCompliance([HalfSpaceConvolution(coefficients)]),
        gap=gap.ravel(),
        arm=np.ones(gap.size),
        cell_area=np.full(gap.size, dx * dy),
    )
    return problem, solve_torque(problem, hertz.load, tolerance=1e-8), dx * dy


@each("observed", ["centre", "mean"])
@each(
    ("R_y", "nx", "ny"),
    [(0.02, 48, 48), (0.02, 48, 24), (0.62, 48, 48), (0.62, 40, 20), (12.0, 48, 48)],
)
def test_ellipse_meets_hertz(R_y: float, nx: int, ny: int, observed: str) -> None:
    # R_y = 0.62 m is an ellipse of axes 1 : 9.9 and 12 m one of 1 : 75
    hertz = HertzContact(R_x=0.02, R_y=R_y, contact_modulus=E_STAR, load=LOAD)
    problem, solution, area = pressed(hertz, nx, ny, observed)
    # errors fall with the square of the cell over the semi-axis, (2.6/20)^2/24 at the coarsest
    assert solution.rotation == pytest.approx(hertz.approach, rel=1e-3)
    assert solution.pressure.max() == pytest.approx(hertz.maximum_pressure, rel=3e-3)
    # cells cut by the edge count as a whole or not at all: a quarter of a cell all round
    edge = 0.25 * 2.6 * (1.0 / nx + 1.0 / ny)
    loaded_area = float(solution.touching.sum()) * area
    ellipse = math.pi * hertz.semi_minor * hertz.semi_major
    assert loaded_area == pytest.approx(ellipse, rel=edge)
    # Hertz: delta ~ W^(2/3), so U = 2/5 W delta and dW/ddelta = 3/2 W/delta
    work = 0.4 * hertz.load * hertz.approach
    assert solution.strain_energy == pytest.approx(work, rel=3e-3)
    tangent = 1.5 * hertz.load / hertz.approach
    # held cells: the edge moves in steps of a cell, worth up to a fifth of a cell over semi-axis
    assert tangent_stiffness(problem, solution) == pytest.approx(tangent, rel=2.5e-2)


def test_pressure_of_a_sphere_is_an_ellipsoid() -> None:
    hertz = HertzContact(R_x=0.02, R_y=0.02, contact_modulus=E_STAR, load=LOAD)
    problem, solution, _ = pressed(hertz, 64, 64, "centre")
    # the gap tells the radius: g = r^2/(2 R)
    inside = 1.0 - problem.gap * 2.0 * hertz.R_x / hertz.semi_major**2
    expected = hertz.maximum_pressure * np.sqrt(np.maximum(inside, 0.0))
    interior = inside > 0.1
    # a cell is 0.041 of the radius; the root's slope is the steepest at the edge
    np.testing.assert_allclose(
        solution.pressure[interior], expected[interior], atol=5e-3 * hertz.maximum_pressure
    )
    # Hertz's gap outside: positive, and rising from the edge
    assert (solution.separation[~solution.touching] >= -1e-12).all()


def test_long_strip_meets_the_line_contact() -> None:
    """A cylinder 40 times as long as the contact is wide, away from its ends."""
    R, load_per_length = 0.02, 2.0e5
    half_width = math.sqrt(4.0 * load_per_length * R / (math.pi * E_STAR))  # Johnson eq. (4.43)
    p_0 = math.sqrt(load_per_length * E_STAR / (math.pi * R))  # Johnson eq. (4.45)
    nx, ny = 40, 64
    dx, length = 2.6 * half_width / nx, 80.0 * half_width
    x = (np.arange(nx) - 0.5 * (nx - 1)) * dx
    gap = np.repeat(x[:, None] ** 2 / (2.0 * R), ny, axis=1)
    coefficients = love_coefficients(dx, length / ny, nx, ny, E_STAR)
    problem = UnilateralProblem(
        compliance=StripCompliance([HalfSpaceConvolution(coefficients)]),
        gap=gap.ravel(),
        arm=np.ones(gap.size),
        cell_area=np.full(gap.size, dx * length / ny),
    )
    solution = solve_torque(problem, load_per_length * length)
    middle = solution.pressure.reshape(nx, ny)[:, ny // 2]
    # the square ends press harder and take load from the middle: use the local load there
    local = float(middle.sum()) * dx
    assert 0.85 * load_per_length < local < load_per_length
    # width and pressure go with the root of the load; cells are 0.065 of the half-width
    root = math.sqrt(local / load_per_length)
    inside = np.sqrt(np.maximum(1.0 - (x / (half_width * root)) ** 2, 0.0))
    np.testing.assert_allclose(middle[3:-3], (p_0 * root * inside)[3:-3], atol=0.03 * p_0)
    assert middle.max() == pytest.approx(p_0 * root, rel=5e-3)
