"""Slopes of the flow factors of a sheared film against differences of the factors."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.oil import factor_slopes as slopes_module
from gearlube_core.oil.eyring_1936 import Eyring, eyring_flow_factor
from gearlube_core.oil.factor_slopes import factor_slopes
from gearlube_core.oil.shear_flow import shear_factors
from tests.helpers.each import each
from tests.helpers.source_of import interpret

LAW = Eyring(1.0)
POINTS = [
    (0.3, 0.2, 0.5, math.inf),
    (-1.4, 0.8, 30.0, math.inf),
    (0.02, -3.0, 4e3, math.inf),
    (4.0, 1.5, -60.0, math.inf),
    (0.7, 0.4, 50.0, 2.5),  # slips
    (-2.0, 1.0, -50.0, 1.2),
    (30.0, -20.0, 1e5, math.inf),
    (90.0, 60.0, 1e8, math.inf),  # beyond |Sigma| = 100
]


@each("point", POINTS)
def test_slopes_are_those_of_differences(point):
    found = factor_slopes(LAW, *point)
    assert (found.along, found.across) == shear_factors(LAW, *point)
    slopes = np.array([found[1:5], found[6:10]])
    for k, value in enumerate(point):
        if not math.isfinite(value):
            assert not slopes[:, k].any()
            continue

        def factors(at: float, k: int = k) -> np.ndarray:
            return np.array(shear_factors(LAW, *point[:k], at, *point[k + 1 :]))

        # fourth order: e^30 over a step of 3e-4 of 30 has a truncation of 1e-9
        step = 3e-4 * abs(value)
        near, far = (factors(value + n * step) - factors(value - n * step) for n in (1, 2))
        expected = (8.0 * near - far) / (12.0 * step)
        # the stress is found to 1e-9, and no better are differences over 3e-4 of a value
        scale = np.array([found.along, found.across]) / abs(value)
        assert slopes[:, k] == pytest.approx(expected, rel=1e-6, abs=3e-6 * scale.min())


@pytest.mark.parametrize(("sigma", "a"), [(0.4, 2.0), (-3.0, 100.0), (12.0, 1e4)])
def test_slopes_along_sliding_are_those_of_the_closed_form(sigma, a):
    found = factor_slopes(LAW, sigma, 0.0, a, math.inf)
    S, by_sigma, by_a = eyring_flow_factor(sigma, a)
    assert found.along == pytest.approx(S, rel=1e-9)
    assert found.along_s == pytest.approx(by_sigma, rel=1e-8)
    assert found.along_a == pytest.approx(by_a, rel=1e-8, abs=0.0)
    assert found.along_r == found.across_r == 0.0


def test_slopes_vanish_with_the_stress_they_belong_to():
    # both factors are even in either Sigma: slopes grow in proportion to it
    small, large = (factor_slopes(LAW, s, 0.7, 5.0, math.inf) for s in (3e-6, 2e-3))
    for name in ("along_s", "across_s"):
        expected = getattr(large, name) * 3e-6 / 2e-3
        assert getattr(small, name) == pytest.approx(expected, rel=1e-3, abs=0.0)
    assert factor_slopes(LAW, 0.0, 0.7, 5.0, math.inf).along_s == 0.0


def test_factors_are_held_along_the_direction_of_a_stress_beyond_the_largest():
    found = factor_slopes(LAW, 120.0, 90.0, 1e4, math.inf)
    # what is left are roundings of slopes as large as the factors
    assert abs(120.0 * found.along_s + 90.0 * found.along_r) < 1e-12 * found.along
    assert abs(120.0 * found.across_s + 90.0 * found.across_r) < 1e-12 * found.across


@pytest.mark.parametrize("point", POINTS[:5])
def test_compiled_slopes_are_those_of_the_source(monkeypatch, point):
    compiled = factor_slopes(LAW, *point)
    interpret(monkeypatch, slopes_module)
    assert slopes_module.factor_slopes(LAW, *point) == pytest.approx(compiled, rel=1e-12)
