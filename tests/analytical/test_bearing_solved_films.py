"""Friction of a bearing by the film model of rollers, against films solved here."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube.studies.film_model.kinds import BEARING_ROLLER
from gearlube.studies.film_model.line_samples import roller_contact_of
from gearlube_core.bearings.losses.race_rolling import ROLLER_MODEL
from gearlube_core.film_model.model import FilmModel
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.bearing_32216 import BEARING, F_A, RPM, loss_at

OIL = Lubricant.named("fva_3")


@pytest.mark.slow
@pytest.mark.parametrize("rpm", [500, 2000])
def test_torque_of_the_raceways_is_that_of_films_solved_for_them(rpm):
    p, model = BEARING.parameters(), FilmModel.named(ROLLER_MODEL)
    u = BEARING.mean_ratio * rpm * RPM
    outer = F_A / (16 * math.sin(BEARING.outer_angle))  # load of each roller, all alike
    power, films = 0.0, []
    for R, load in ((p.R_outer, outer), (p.R_inner, p.inner_share * outer)):
        one = roller_contact_of(load / p.length, R, u, OIL, 323.15)
        coarse, fine = (
            np.array([found.central_film, found.friction])
            for found in (BEARING_ROLLER.solve(one, (nodes, 1)) for nodes in (257, 513))
        )
        film, friction = (4.0 * fine - coarse) / 3.0  # of second order
        power += 16 * friction * load * u
        films.append(film / p.roughness)
    found = loss_at(rpm, law="solved_films")
    assert found.out_of_range == 0.0
    # bounds of the model hold for 95 % of contacts; the grid's limit is known to some tenths
    tolerance = 1.5 * model.friction_bound + 0.003
    assert found.parts["rolling"] * rpm * RPM == pytest.approx(power, rel=tolerance)
    assert found.film_ratio == pytest.approx(min(films), rel=1.5 * model.film_bound + 0.003)


def test_films_heat_themselves_and_lose_less_for_it():
    """As Aihara's factor for bearings has it, 1/(1 + 0.29 Lt^0.78), within a sixth."""
    found = loss_at(2000, law="solved_films").parts["rolling"]
    cold = loss_at(2000, law="biboulet_houpert", heating="none").parts["rolling"]
    hot = loss_at(2000, law="biboulet_houpert").parts["rolling"]
    assert found < cold
    assert found == pytest.approx(hot, rel=1.0 / 6.0)


def test_formulas_stand_in_outside_the_domain_of_the_model():
    # 30 N on the whole bearing: mean pressures below the domain's
    light = loss_at(1000, law="solved_films", axial_load=30.0)
    formula = loss_at(1000, law="biboulet_houpert", axial_load=30.0)
    assert light.out_of_range == 1.0
    assert light.parts["rolling"] == pytest.approx(formula.parts["rolling"], rel=1e-9)
    assert np.isfinite(light.film_ratio)


def test_starved_contacts_lose_less_by_solved_films_too():
    flooded = loss_at(1000, law="solved_films")
    starved = loss_at(1000, law="solved_films", inlet_layer=5e-6)
    assert starved.parts["rolling"] < 0.75 * flooded.parts["rolling"]
    assert starved.parts["rib"] == flooded.parts["rib"]
