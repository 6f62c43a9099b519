"""Rollers of a catalogue's bearing against ISO 281 and bearings whose rollers are printed."""

import math

import pytest

from gearlube_core.bearings.bearing_fields import (
    rating_factor,
    roller_length_of_rating,
    usual_roller_count,
    usual_roller_diameter,
)
from tests.helpers.each import each

# f_c of radial roller bearings, ISO 281:2007, as remembered from its table
TABLE = [
    (0.01, 52.1),
    (0.02, 60.8),
    (0.05, 74.1),
    (0.1, 84.2),
    (0.16, 88.5),
    (0.2, 88.7),
    (0.3, 83.8),
]


@each(("gamma", "factor"), TABLE)
def test_the_factor_is_that_of_the_standards_table(gamma, factor):
    assert rating_factor(gamma) == pytest.approx(factor, abs=0.06)  # printed to 0.1


def test_the_rating_of_printed_rollers_is_that_of_catalogues():
    # 32216: rollers of Wingertszahn et al. 2023; C of catalogues 187 kN, 10 % between makers,
    # which are 13 % of the length, as it goes with C^(9/7)
    rollers = {
        "rollers": 16,
        "diameter": 17e-3,
        "contact_angle": math.radians(15.64),
        "pitch": 108.5e-3,
    }
    assert roller_length_of_rating(187e3, **rollers) == pytest.approx(22.7e-3, rel=0.13)


@pytest.mark.parametrize(
    ("bore", "outside", "pitch", "diameter", "count"),
    [
        (80e-3, 140e-3, 108.5e-3, 17e-3, 16),  # 32216, Wingertszahn et al. 2023
        (40e-3, 83.7e-3, 62.7e-3, 12.7e-3, 12),  # Mohammadpour et al. 2015
    ],
)
def test_usual_rollers_are_near_those_that_are_printed(bore, outside, pitch, diameter, count):
    assert usual_roller_diameter(bore, outside) == pytest.approx(diameter, rel=0.03)
    assert abs(usual_roller_count(pitch, diameter) - count) <= 1
