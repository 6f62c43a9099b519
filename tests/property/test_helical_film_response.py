"""Periodic response with film friction: against its own loads, quasi-static ones, Coulomb's law."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube.studies.helical.stability import instability_map
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    LOAD,
    MU,
    N_COLUMNS,
    SLIDING,
    X,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.film_friction import (
    FilmField,
    FilmFriction,
    film_coefficients,
    film_moments,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.errors import ParameterError
from gearlube_core.friction.line_integrals import friction_along_lines
from gearlube_core.friction.line_points import line_friction, line_points, uniform_line_load
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import SPEED
from tests.helpers.helical_mesh_points import line_loads

_ROUGHNESS = 0.5e-6
_FILM = FilmFriction(
    oil=Lubricant.named("mohammadpour_2015"),
    oil_temperature=353.15,
    solid=STEEL_MOHAMMADPOUR_2015,
    roughness_rms=_ROUGHNESS,
)


def _film_pair() -> HelicalPairParameters:
    return replace(he_2007_pair(0.0), friction="film", film=_FILM)


@pytest.mark.parametrize("speed", [SPEED, 6.0 * SPEED])
def test_lost_power_is_that_of_the_film_at_the_response_s_own_loads(speed: float) -> None:
    parameters = _film_pair()
    response = periodic_response(parameters, speed)
    c, mesh, film = parameters.kernel_parameters(), parameters.mesh_arrays(), _FILM.constants()
    plane, power = c.plane, []
    points = np.zeros((point_capacity(mesh), N_COLUMNS))
    for row, phase in zip(response.displacement[::4], response.phase[::4], strict=True):
        q = np.insert(row[:10], (5, 10), 0.0)
        q[5] = row[10] / plane.r_bp
        n = contact_points(float(phase), speed, plane, mesh, points)
        line_loads(*mesh_strain(q, plane), c, points, n)
        lost = 0.0
        for point in points[:n]:
            motion = line_kinematics(point[X], speed, plane)
            mu = line_friction(
                point[LOAD], motion.R, motion.entrainment, motion.sliding, film.lubricant,
                film.surface, film.solid,
            ).friction_coefficient  # fmt: skip
            lost += mu * point[LOAD] * point[LENGTH] * abs(point[SLIDING])
        power.append(lost)
    # means of 64 and 256 phases of a function with kinks
    assert np.mean(power) == pytest.approx(response.friction_power, rel=2e-3)


def test_slow_pair_loses_the_power_of_evenly_shared_loads() -> None:
    """Quasi-static loads by length of line, another quadrature; tilting shares loads otherwise."""
    parameters, speed = _film_pair(), 0.2 * SPEED
    points = line_points(parameters.pair)
    cycle = friction_along_lines(
        points,
        uniform_line_load(points, parameters.pinion_torque),
        pinion_speed=speed,
        pinion_torque=parameters.pinion_torque,
        lubricant=_FILM.oil,
        oil_temperature=_FILM.oil_temperature,
        surface=SurfaceParameters(_ROUGHNESS, 0.055, 0.001),
        solid=solid_parameters(_FILM.solid, _FILM.solid),
    )
    response = periodic_response(parameters, speed)
    assert response.friction_power == pytest.approx(cycle.mean_power_loss, rel=0.03)


def test_film_friction_excites_as_a_constant_coefficient_of_the_same_loss_does() -> None:
    film = periodic_response(_film_pair(), SPEED)
    per_mu = periodic_response(he_2007_pair(0.01), SPEED).friction_torque / 0.01
    mean = film.friction_torque / per_mu
    assert 0.01 < mean < 0.12  # mixed friction of mineral oil on steel
    alike = periodic_response(he_2007_pair(mean), SPEED)
    ratio = harmonics(film.signal("u_yp"), 2) / harmonics(alike.signal("u_yp"), 2)
    # same loss; the film's coefficient passes through zero at the pitch line, Coulomb's jumps
    assert np.all((ratio > 0.5) & (ratio < 2.0))
    assert math.isclose(film.signal("psi").mean(), alike.signal("psi").mean(), rel_tol=2e-3)


def test_friction_between_known_phases_is_that_of_the_strain_between() -> None:
    parameters = _film_pair()
    plane, mesh, film = parameters.pair.plane, parameters.mesh_arrays(), _FILM.constants()
    points, moments = np.zeros((point_capacity(mesh), N_COLUMNS)), np.zeros((3, 5, 3))
    strain = np.array([[4e-6, 1e-5], [1.2e-5, -3e-5], [8e-6, 0.0]])
    field = FilmField(film, SPEED, np.array([0.0, 0.4, 1.0]), strain)
    phases = np.array([0.1, 0.4, 0.7])
    film_moments(phases, field, plane, mesh, points, moments)
    between = ((6e-6, 0.0), (1.2e-5, -3e-5), (1e-5, -1.5e-5))
    for phase, (y0, y1), filled in zip(phases, between, moments, strict=True):
        n = contact_points(float(phase), SPEED, plane, mesh, points)
        film_coefficients(y0, y1, SPEED, plane, film, points, n)
        opposing = -np.sign(points[:n, SLIDING]) * points[:n, MU]
        expected = np.sum(opposing * points[:n, DENSITY] * points[:n, LENGTH])
        assert filled[2, 0] == pytest.approx(expected, rel=1e-10)


def test_film_needs_its_data_and_instability_maps_refuse_it() -> None:
    with pytest.raises(ParameterError, match="Give a FilmFriction"):
        replace(he_2007_pair(0.0), friction="film")
    with pytest.raises(ParameterError, match="friction must be one of off, constant"):
        instability_map(_film_pair(), [1000.0], "mu", [0.1])
    with pytest.raises(ParameterError, match="oil_temperature"):
        replace(_FILM, oil_temperature=80.0)
