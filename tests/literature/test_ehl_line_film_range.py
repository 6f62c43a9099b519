"""The film formula of lines against solved films at the corners of the range it is used in."""

from __future__ import annotations

import math

import pytest

from gearlube_core.ehl.case.contact_case import LineCase
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.film.dowson_toyoda_1979 import LOAD_RANGE, MATERIAL_RANGE, central_line_film

VISCOSITY, ALPHA, MODULUS, RADIUS = 0.04, 2e-8, 227.5e9, 0.014
(M_LOW, M_HIGH), (L_LOW, L_HIGH) = LOAD_RANGE, MATERIAL_RANGE


@pytest.mark.parametrize(
    ("M", "L"),
    [
        (M_LOW, 10.0),
        (1.0, L_HIGH),
        (M_HIGH, 20.0),
        pytest.param(5.0, L_LOW, marks=pytest.mark.slow),
        pytest.param(200.0, 10.0, marks=pytest.mark.slow),
    ],
)
def test_line_films_lie_within_a_third_of_solved_ones_to_the_ends_of_the_range(M, L):
    speed = (L / (ALPHA * MODULUS)) ** 4 / 2.0 * MODULUS * RADIUS / VISCOSITY
    load = M * math.sqrt(2.0 * VISCOSITY * speed / (MODULUS * RADIUS)) * MODULUS * RADIUS
    case = LineCase.named("jamali_2015").varied(
        {
            "oil.viscosity_pa_s": VISCOSITY,
            "oil.pressure_viscosity_per_gpa": 1e9 * ALPHA,
            "oil.shear": "newtonian",
            "oil.eyring_stress_mpa": None,
            "speed_1_m_s": speed,
            "speed_2_m_s": speed,
            "load_n_per_mm": 1e-3 * load,
            "solver.nodes": 801,
        }
    )
    solved = solve_line(case.problem(), case.settings())
    formula = central_line_film(
        radius=RADIUS,
        viscosity=VISCOSITY,
        pressure_viscosity=ALPHA,
        entrainment_speed=speed,
        line_load=load,
        contact_modulus=0.5 * MODULUS,
    )
    # 0.82 to 1.34 on 2001 nodes; 801 nodes add up to a tenth at the highest load
    assert 0.75 < formula / solved.central_film < 1.45
