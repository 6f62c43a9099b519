"""A domain that cuts the contact is told, with the side to widen; ends of solids are not."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.gears.helical_cycle import solve_helical_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.far_field import border_pressure
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.jamali_2015 import jamali_2015_film

PLACES = {"small x": (1, 4), "large x": (-2, 4), "small y": (4, 1), "large y": (4, -2)}


@pytest.mark.parametrize("side", PLACES)
def test_side_with_the_most_pressure_is_named(side):
    pressure, film = np.zeros((9, 9)), np.ones((9, 9))
    pressure[4, 4] = 2.0
    assert border_pressure(pressure, film).sentence == ""
    pressure[PLACES[side]] = 0.5
    found = border_pressure(pressure, film)
    assert found.share == 0.25
    assert found.side == side
    assert f"{side} is 25 %" in found.sentence


def test_pressure_beside_the_end_of_a_tooth_is_no_cut():
    pressure, film = np.zeros((9, 9)), np.ones((9, 9))
    pressure[:, 1:-1] = 1.0
    pressure[[0, 1, -2, -1]] = 0.0
    assert border_pressure(pressure, film).share == 1.0
    film[:, [0, -1]] = 50.0
    assert border_pressure(pressure, film).sentence == ""


def test_spoilt_pressure_says_nothing():
    assert border_pressure(np.full((9, 9), np.nan), np.ones((9, 9))).sentence == ""


@pytest.mark.parametrize(
    ("velocity", "kept", "end"),
    [
        (2.5, 0.6, "large x"),
        (-2.5, 0.6, "small x"),
        # cut so near its middle that no film is found: hundreds of steps
        pytest.param(2.5, 0.3, "large x", marks=pytest.mark.slow),
        pytest.param(-2.5, 0.3, "small x", marks=pytest.mark.slow),
    ],
)
def test_point_contact_cut_behind_its_middle_says_so(velocity, kept, end):
    problem = elliptical_contact(
        R_x=0.0177,
        R_y=0.05,
        entrainment=(velocity, 0.0),
        load=400.0,
        contact_modulus=115.4e9,
        lubricant=film_oil(eta0=0.0171, alpha=2.38e-8),
        nodes=(33, 33),
    )
    whole = solve_point_contact(problem)
    assert "cuts" not in whole.outcome.sentence
    low, high = problem.x_limits
    limits = (low, kept * high) if velocity > 0.0 else (kept * low, high)
    cut = solve_point_contact(replace(problem, x_limits=limits), throw=False)
    assert f"at {end} is" in cut.outcome.sentence
    assert "Widen" in cut.outcome.sentence


def test_steep_relief_is_pushed_out_of_the_domain_of_the_thesis():
    # Jamali 2015 sec. 5.4: k = 0.02 at step 500; his domain ends 1.775 semi-widths behind the line
    film = jamali_2015_film("a", k=0.02, nodes=(49, 97))
    cut = solve_helical_line(film, 500, throw=False)
    assert cut.border_pressure > 0.05
    assert "at large x is" in cut.outcome
    wide = solve_helical_line(replace(film, extent=(-2.75, 2.75)), 500, throw=False)
    assert wide.border_pressure < 0.01
    assert "cuts" not in wide.outcome
