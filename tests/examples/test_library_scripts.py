"""The short scripts of examples/ give numbers that physics expects."""

from __future__ import annotations

import math

import pytest

from examples.axle_torque_ramp import ramp
from examples.film_with_own_oil import films
from examples.helical_transmission_error import transmission_error
from examples.sliding_point_contact import friction


def test_the_axles_mesh_force_follows_the_torque_ramp():
    rows = ramp(first=40.0, last=60.0, steps=200)
    (torque_1, efficiency, force_1), (torque_2, _, force_2) = rows
    # the mesh radius is constant within a few per cent, and the ramp lasts a few mesh periods
    assert force_2 / force_1 == pytest.approx(torque_2 / torque_1, rel=0.1)
    assert 0.95 < efficiency < 1.0


def test_films_of_the_own_oil_thin_as_it_warms():
    (cold, _), (warm, _) = films([40.0, 100.0])
    # h ~ eta0^0.69 alpha^0.56 [dowson_toyoda_1979]; a constant Roelands exponent gives
    # alpha ~ ln eta0 + 9.67; the formula holds within 10 % there
    eta = 870.0 * 1.5e-4, 870.0 * 1.6e-5
    alpha = [math.log(viscosity) + 9.67 for viscosity in eta]
    expected = (eta[0] / eta[1]) ** 0.69 * (alpha[0] / alpha[1]) ** 0.56
    assert cold / warm == pytest.approx(expected, rel=0.1)


def test_transmission_error_peaks_between_slow_and_fast():
    slow, resonant = transmission_error(226.0, [1000.0, 6000.0])
    # 6000 rpm is near the mesh resonance; 5 % damping lets single orders grow up to tenfold
    assert resonant > 1.5 * slow


def test_friction_of_the_ball_rises_with_sliding_and_its_film_hardly_changes():
    (still, zero), (film, some), (_, more) = friction([0.0, 0.1, 0.5])
    assert zero == 0.0
    assert 0.0 < some < more < 0.1
    # an Eyring oil thins with sliding, by less than 2 % at this slide-roll ratio
    assert film == pytest.approx(still, rel=0.02)
