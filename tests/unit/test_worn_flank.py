"""Wear of a flank as splines: its slopes and bends, and what gear files refuse."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.correction import WORN_GRID, FlankCorrection
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

HEIGHT, WIDTH = 7.6e-3, 30e-3


def test_slopes_and_bends_of_wear_are_its_derivatives():
    rng = np.random.default_rng(1)
    worn = FlankCorrection(worn=tuple(1e-6 * rng.random(WORN_GRID[0] * WORN_GRID[1])))
    s, t = rng.uniform(0.1, 0.9, (2, 30))
    step = 1e-4

    def value(up, along):
        return worn.bends(s + up * step, t + along * step, HEIGHT, WIDTH).value

    found, h, w = worn.bends(s, t, HEIGHT, WIDTH), HEIGHT * step, WIDTH * step
    expected = {
        "by_h": (value(1, 0) - value(-1, 0)) / (2.0 * h),
        "by_l": (value(0, 1) - value(0, -1)) / (2.0 * w),
        "by_hh": (value(1, 0) - 2.0 * value(0, 0) + value(-1, 0)) / h**2,
        "by_hl": (value(1, 1) - value(1, -1) - value(-1, 1) + value(-1, -1)) / (4.0 * h * w),
        "by_ll": (value(0, 1) - 2.0 * value(0, 0) + value(0, -1)) / w**2,
    }
    for name, one in expected.items():
        got = getattr(found, name)
        # third derivatives jump at knots: differences err there by a step over a spline's width
        np.testing.assert_allclose(got, one, atol=3e-3 * np.abs(got).max())


def test_bad_wear_is_refused():
    with pytest.raises(ParameterError, match="worn_um must hold none or 512 numbers, got 3"):
        HypoidGearFile.named("mohammadpour_2015").varied(
            {"gear.drive_flank.worn_um": [1.0, 2.0, 3.0]}
        )
    with pytest.raises(ParameterError, match="number of worn"):
        FlankCorrection(worn=(1e-6,))
    with pytest.raises(ParameterError, match="worn"):
        FlankCorrection(worn=(-1e-6,) * 512)
