"""Solids and the moduli of a pair."""

import dataclasses
import math

import pytest

from gearlube_core.contact.solid import (
    STEEL_MOHAMMADPOUR_2015,
    contact_modulus,
    pi_contact_modulus,
    reduced_modulus,
    solid_parameters,
)
from gearlube_core.errors import ParameterError

STEEL = STEEL_MOHAMMADPOUR_2015


def test_equal_solids_have_half_the_plane_strain_modulus() -> None:
    assert contact_modulus(STEEL, STEEL) == pytest.approx(210e9 / (2 * (1 - 0.3**2)), rel=1e-14)


def test_a_rigid_partner_doubles_the_contact_modulus() -> None:
    rigid = dataclasses.replace(STEEL, youngs_modulus=1.9e12, poisson_ratio=0.5)
    expected = 1.0 / (0.91 / 210e9 + 0.75 / 1.9e12)
    assert contact_modulus(STEEL, rigid) == pytest.approx(expected, rel=1e-14)


def test_the_three_moduli_stand_as_one_to_two_to_pi() -> None:
    e_star = contact_modulus(STEEL, STEEL)
    assert reduced_modulus(STEEL, STEEL) / e_star == 2.0
    assert pi_contact_modulus(STEEL, STEEL) / e_star == pytest.approx(math.pi, rel=1e-15)


def test_a_pair_of_like_solids_keeps_its_thermal_data() -> None:
    pair = solid_parameters(STEEL, STEEL)
    assert (pair.conductivity, pair.density, pair.heat_capacity) == (46.0, 7850.0, 470.0)


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("youngs_modulus", 210.0, "210 GPa is 2.1e11 Pa"),
        ("poisson_ratio", 0.7, "poisson_ratio must be within 0 to 0.5"),
        ("density", 7.85, "7.85 g/cm3 is 7850 kg/m3"),
        ("conductivity", float("nan"), "conductivity must be finite"),
    ],
)
def test_wrong_solid_data_are_refused_with_a_cure(field: str, value: float, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        dataclasses.replace(STEEL, **{field: value})
