"""Ease-off grids approach the exact unloaded contact."""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from tests.helpers.contact_cases import SIDES, shipped_pair


# both sides are in the default run of the two tests below
@pytest.mark.slow
@pytest.mark.parametrize("side", ["drive", pytest.param("coast", marks=pytest.mark.slow)])
def test_least_ease_off_approaches_the_error_extreme(side):
    """Never below it, and within the rise of the bowl over half a grid step."""
    pair = shipped_pair(side)
    exact = pair.touching_sign * unloaded_error(pair, 3).extreme_error
    excess = []
    for s_count, t_count in ((11, 21), (41, 81), (81, 161)):
        angles = np.arange(-9, 10) / 12.0 * pair.gear_pitch
        ease = ease_off(pair, s_count=s_count, t_count=t_count, gear_angles=angles)
        excess.append(np.nanmin(pair.touching_sign * ease.conjugate_error()) - exact)
    # the cubic over gear angle errs by less than this near the middle of the flank
    assert min(excess) > -0.02e-6
    # second order in the step, 1/16 a level, were the grid centred alike; its bound is
    assert excess[1] < excess[0] / 4.0 or excess[1] < 1e-6
    assert excess[2] < 0.3e-6


@pytest.mark.parametrize("side", SIDES)
def test_conjugate_error_hardly_depends_on_the_angle_step(side):
    pair = shipped_pair(side)
    found = [
        ease_off(
            pair,
            s_count=9,
            t_count=13,
            gear_angles=np.arange(-2 * k, 2 * k + 1) / k * pair.gear_pitch,
        ).conjugate_error()
        for k in (6, 12, 24)
    ]
    known = np.isfinite(found[0]) & np.isfinite(found[1]) & np.isfinite(found[2])
    assert known.sum() > 50
    coarse, fine = (np.abs(found[k] - found[2])[known].max() for k in (0, 1))
    # fourth order of a cubic: 1/16 a level, in part met where the extreme is steep
    assert fine < coarse / 8.0
    assert fine < 0.1e-6


@pytest.mark.parametrize("side", SIDES)
def test_mean_error_converges_with_the_square_of_the_step(side):
    """Trapezoids on a smooth parabola-like error between exact contacts."""
    pair = shipped_pair(side)
    mean = [unloaded_error(pair, n).mean for n in (9, 17, 33)]
    assert (mean[0] - mean[1]) / (mean[1] - mean[2]) == pytest.approx(4.0, rel=0.02)
