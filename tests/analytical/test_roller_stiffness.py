"""Stiffness of rollers by their length against the theory of two cylinders."""

import math

import pytest

from gearlube_core.bearings.roller_stiffness import palmgren_roller_stiffness
from tests.helpers.each import each


@each("load", [300.0, 1000.0, 3000.0])  # N
@each("length", [0.012, 0.022])  # m
def test_palmgrens_approach_is_near_that_of_elastic_cylinders(load, length):
    # A cylinder of radius R between two flats, each contact of half-width b, is squeezed by
    # 4 q (1 - nu^2)/(pi E) (ln(4 R/b) - 1/2) (Johnson, Contact Mechanics, 5.6); by how much the
    # races give way depends on their thickness and is about as much again.
    E, nu, R = 210e9, 0.3, 6.35e-3
    q = load / length
    b = math.sqrt(4.0 * q * R * (1.0 - nu**2) / (math.pi * E / 2.0))
    squeeze = 4.0 * q * (1.0 - nu**2) / (math.pi * E) * (math.log(4.0 * R / b) - 0.5)
    approach = (load / palmgren_roller_stiffness(length)) ** 0.9
    assert squeeze < approach < 3.0 * squeeze


def test_stiffness_grows_with_length_to_the_power_of_eight_ninths():
    ratio = palmgren_roller_stiffness(0.04) / palmgren_roller_stiffness(0.02)
    assert ratio == pytest.approx(2.0 ** (8 / 9), rel=1e-12)  # rounding
