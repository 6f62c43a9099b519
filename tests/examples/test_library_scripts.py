"""The short scripts of examples/ give numbers that physics expects."""

from __future__ import annotations

import math
import runpy
from pathlib import Path

import numpy as np
import pytest

from examples.axle_torque_ramp import ramp
from examples.e_axle_case_response import panel_velocities
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


@pytest.mark.slow
def test_friction_of_the_ball_comes_with_sliding_and_its_film_hardly_changes():
    (still, zero), (film, some) = friction([0.0, 0.5])
    assert zero == 0.0
    assert 0.0 < some < 0.1
    # an Eyring oil thins with sliding, by less than 2 % at this slide-roll ratio
    assert film == pytest.approx(still, rel=0.02)


@pytest.mark.slow  # 30 steps of a film, some seconds
def test_the_measured_profile_presses_its_peaks_through_the_film(monkeypatch):
    monkeypatch.chdir(Path(__file__).parents[2])
    films = runpy.run_path("examples/rough_own_profile.py")["films"]
    assert films.attrs["converged"]
    # 200 N/mm over 1 mm, to the tolerance of the load
    assert films["film_load"].values == pytest.approx(np.full(films.sizes["time"], 200.0), rel=2e-4)
    # Hertz: p = sqrt(w E*/(pi R)), steel of 210 GPa and 0.3 on both sides; roughness stands upon it
    hertz = math.sqrt(2e5 * 210e9 / (2.0 * (1.0 - 0.3**2)) / (math.pi * 0.014))
    assert films["pressure_max"].values[0] == pytest.approx(hertz, rel=0.05)
    assert films["pressure_max"].values[-1] > 1.2 * hertz
    assert films["film_min"].values[-1] < 0.8 * films["film_min"].values[0]


@pytest.mark.slow
def test_panels_of_the_case_move_as_those_of_its_finite_elements():
    """All finite elements, computed once, give 311.2 1/s of the top and 377.6 of the cover.

    Waves of the meshes' stiffness and modes left out change that by 3 %.
    """
    top, _, cover = panel_velocities(np.array([300.0]))["stage_1"][0]
    assert [top, cover] == pytest.approx([311.2, 377.6], rel=0.04)
