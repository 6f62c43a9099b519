"""Dimensionless groups of a point contact against the papers' own groups and the film kernel."""

import math

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.film.groups import point_contact_groups
from tests.helpers.each import each

CASE = {
    "viscosity": 0.0171,
    "pressure_viscosity": 2.383e-8,
    "entrainment_speed": 4.0,
    "load": 1500.0,
    "radius": 0.02,
    "reduced_modulus": 230.8e9,
}


def test_groups_printed_with_er_and_the_sum_of_speeds_are_the_same_numbers():
    # Mohammadpour et al. 2015, below eq. (22): W = pi F/(2 Er R^2), U = pi eta0 U'/(4 Er R),
    # G = 2 Er alpha/pi with Er = pi E'/2 and U' = u1 + u2
    groups = point_contact_groups(**CASE)
    E_r = math.pi * CASE["reduced_modulus"] / 2.0
    R = CASE["radius"]
    total = 2.0 * CASE["entrainment_speed"]
    W = math.pi * CASE["load"] / (2.0 * E_r * R**2)
    U = math.pi * CASE["viscosity"] * total / (4.0 * E_r * R)
    G = 2.0 / math.pi * E_r * CASE["pressure_viscosity"]
    # the same numbers up to roundings
    assert pytest.approx((U, G, W), rel=1e-14) == (groups.U, groups.G, groups.W)


def test_moes_groups_leave_two_of_three_numbers():
    """Scaling load and speed so that M and L stay leaves H (2U)^(-1/2) of any film law alone."""
    groups = point_contact_groups(**CASE)
    assert pytest.approx(groups.W, rel=1e-14) == groups.M * (2.0 * groups.U) ** 0.75
    assert pytest.approx(groups.G, rel=1e-14) == groups.L / (2.0 * groups.U) ** 0.25


@each("name", list(CASE))
def test_a_quantity_that_is_not_positive_is_named(name):
    with pytest.raises(ParameterError, match=name):
        point_contact_groups(**{**CASE, name: 0.0})
