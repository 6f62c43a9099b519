"""Mild wear by Archard's law."""

from __future__ import annotations

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.errors import ParameterError


def test_wear_is_zero_at_the_pitch_point_and_in_the_inverse_ratio_of_speeds():
    u1 = np.array([1.0538, 3.0, 4.0])
    u2 = np.array([4.7835, 3.0, 2.0])
    pinion, gear = gl.rating.wear_per_cycle(5e-18, 236.3e3, (u1, u2))
    assert pinion[1] == gear[1] == 0.0
    assert pinion[[0, 2]] / gear[[0, 2]] == pytest.approx((u2 / u1)[[0, 2]])
    # k w |1 - u_j/u_i|
    assert pinion[0] == pytest.approx(4.182e-12, rel=1e-3)
    assert gear[0] == pytest.approx(9.213e-13, rel=1e-3)


def test_wear_is_pressure_times_the_way_of_sliding_over_the_contact():
    a, w, u1, u2 = 2e-4, 1e5, 3.0, 2.0
    x = np.linspace(-a, a, 2001)
    pressure = 2.0 * w / (np.pi * a) * np.sqrt(1.0 - (x / a) ** 2)
    # a point of the pinion stays in the contact 2 a/u1
    integral = 1e-17 * np.trapezoid(pressure, x) * (u1 - u2) / u1
    assert float(gl.rating.wear_per_cycle(1e-17, w, (u1, u2))[0]) == pytest.approx(
        integral, rel=1e-4
    )


def test_sliding_along_the_line_wears_and_a_film_spares():
    plain = gl.rating.wear_per_cycle(1e-17, 1e5, (3.0, 3.0))[0]
    hypoid = gl.rating.wear_per_cycle(1e-17, 1e5, (3.0, 3.0), sliding=2.0)[0]
    assert float(plain) == 0.0 < float(hypoid)
    half = gl.rating.wear_per_cycle(1e-17, 1e5, (3.0, 3.0), sliding=2.0, asperity_share=0.5)[0]
    assert float(half) == pytest.approx(0.5 * float(hypoid))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"coefficient": 1e-8}, "coefficient must be within 0 to 1e-11 1/Pa, got 1e-08"),
        ({"speeds": (1.0, -1.0)}, "speeds must be above 0"),
        ({"asperity_share": 2.0}, "asperity_share must be within 0 to 1"),
    ],
)
def test_wear_that_is_none_is_refused(changes, words):
    given = {"coefficient": 1e-17, "line_load": 1e5, "speeds": (1.0, 2.0), **changes}
    with pytest.raises(ParameterError, match=words):
        gl.rating.wear_per_cycle(**given)
