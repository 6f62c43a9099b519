"""Generated surfaces are what was asked, whatever the seed, and say what cannot be."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.surface.generator import generated_map, generated_profile
from gearlube_core.surface.generator_request import (
    RoughnessRequest,
    johnson_transform,
    lognormal_kurtosis,
    normal_scores,
)
from gearlube_core.surface.spectrum import map_autocorrelation, profile_spectrum
from gearlube_core.surface.statistics import map_statistics, profile_statistics
from tests.helpers.each import each

MICRO = 1e-6
ASKED = RoughnessRequest(
    arithmetic_mean=0.31 * MICRO,
    correlation_length=8.0 * MICRO,
    shortest_wave=12.0 * MICRO,
    longest_wave=100.0 * MICRO,
)
# stop of the search for moments, in units of skewness and as a share of the kurtosis
MOMENT = 1.001e-3


@pytest.mark.slow
@each("seed", range(3))
@each(("skewness", "kurtosis"), [(0.0, 3.0), (-0.7, 4.0), (0.8, 3.5)])
def test_a_profile_has_the_statistics_asked_of_every_seed(seed, skewness, kurtosis):
    asked = replace(ASKED, skewness=skewness, kurtosis=kurtosis)
    made = generated_profile(asked, 2e-3, 2000, np.random.default_rng(seed))
    of = profile_statistics(made.surface)
    assert of.Ra == pytest.approx(0.31 * MICRO, rel=1e-12)
    assert of.Rsk == pytest.approx(skewness, abs=MOMENT)
    assert of.Rku == pytest.approx(kurtosis, rel=MOMENT)
    # the search stops at a ten-thousandth
    assert of.Ral == pytest.approx(8.0 * MICRO, rel=1.001e-4)
    told = {one.name: one.reached for one in made.statistics}
    assert told["skewness"] == pytest.approx(of.Rsk, abs=1e-12)
    assert told["correlation length across"] == pytest.approx(of.Ral, rel=1e-9)


def test_there_are_no_waves_outside_the_band():
    made = generated_profile(ASKED, 2e-3, 2000, np.random.default_rng(1))
    found = profile_spectrum(made.surface)
    outside = (found.frequency < 1.0 / (100.1 * MICRO)) | (found.frequency > 1.0 / (11.99 * MICRO))
    # squares of rounding
    assert found.density[outside].max() < 1e-25 * found.density.max()
    assert found.density[~outside].min() > 1e-3 * found.density.max()


def test_seeds_give_other_surfaces_with_the_same_heights():
    made = [
        generated_profile(ASKED, 2e-3, 1336, np.random.default_rng(seed)).surface
        for seed in range(4)
    ]
    # 2 mm hold about 125 independent lengths of 16 um: correlations by chance are of 0.09
    alike = np.corrcoef([one.height for one in made]) - np.eye(4)
    assert np.abs(alike).max() < 0.4
    of = [profile_statistics(one) for one in made]
    # normal heights: Rq = Ra sqrt(pi/2); beside it only skewness and kurtosis are held
    assert [one.Rq / one.Ra for one in of] == pytest.approx(
        [math.sqrt(math.pi / 2.0)] * 4, rel=0.01
    )
    assert np.ptp([one.Rdq / one.Rq for one in of]) < 1e-9 * of[0].Rdq / of[0].Rq


def test_the_same_seed_makes_the_same_bits():
    one, two = (generated_profile(ASKED, 1e-3, 1000, np.random.default_rng(7)) for _ in range(2))
    assert (one.surface.height == two.surface.height).all()


@pytest.mark.slow
@pytest.mark.parametrize("lay", [0.0, 0.3, -0.5])
def test_a_map_correlates_as_asked_across_and_along_its_lay(lay):
    asked = replace(
        ASKED,
        longest_wave=None,
        correlation_length_along=24.0 * MICRO,
        lay=lay,
        skewness=-0.5,
        kurtosis=3.6,
    )
    made = generated_map(asked, (384e-6, 512e-6), (256, 256), np.random.default_rng(2))
    of = map_statistics(made.surface)
    assert of.Ssk == pytest.approx(-0.5, abs=MOMENT)
    assert of.Sku == pytest.approx(3.6, rel=MOMENT)
    # off the axes the correlation is bilinear between points of 1.5 and 2 um
    assert of.Sal == pytest.approx(8.0 * MICRO, rel=5e-3)
    assert of.Str == pytest.approx(8.0 / 24.0, rel=1e-2)
    # crests lie from y towards x, so the fastest fall is across them
    turn = math.remainder(of.fastest_direction - (-lay), math.pi)
    assert abs(turn) < math.radians(4.0)


def test_a_map_repeats_at_both_seams():
    made = generated_map(
        replace(ASKED, longest_wave=None), (256e-6, 192e-6), (170, 128), np.random.default_rng(5)
    )
    height = made.surface.height
    # seam and inside have the same mean square steps, within 20 % of 128 and 170 points
    for axis in range(2):
        steps = np.diff(height, axis=axis)
        seam = np.take(height, 0, axis) - np.take(height, -1, axis)
        assert (seam**2).mean() == pytest.approx((steps**2).mean(), rel=0.2)
    assert map_autocorrelation(made.surface)[0, 0] == pytest.approx(1.0)


@each(
    ("skewness", "kurtosis"),
    [(0.0, 3.0), (0.0, 1.8), (0.0, 6.0), (1.0, 5.0), (-2.0, 9.0), (0.5, 1.6), (-1.0, 3.0)],
)
def test_johnson_distributions_have_the_moments_asked(skewness, kurtosis):
    grid = np.linspace(-9.0, 9.0, 20_001)
    weight = np.exp(-0.5 * grid**2)
    weight /= weight.sum()
    values = johnson_transform(skewness, kurtosis)(grid)
    assert (np.diff(values) >= 0.0).all()
    values = values - weight @ values
    values = values / math.sqrt(weight @ values**2)
    # the fit stops at 1e-4 of each
    assert weight @ values**3 == pytest.approx(skewness, abs=2e-4)
    assert weight @ values**4 == pytest.approx(kurtosis, rel=2e-4)


def test_the_lognormal_line_is_that_of_exp():
    # exp of half a standard normal height: w = exp(1/4), Johnson's equations in closed form
    w = math.exp(0.25)
    skewness = (w + 2.0) * math.sqrt(w - 1.0)
    exact = w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0
    assert lognormal_kurtosis(skewness) == pytest.approx(exact, rel=1e-9)
    assert lognormal_kurtosis(0.0) == 3.0
    assert normal_scores(3) == pytest.approx([-0.967422, 0.0, 0.967422], abs=1e-6)


@each(
    ("change", "words"),
    [
        ({"kurtosis": 1.2, "skewness": 0.5}, "above skewness^2 + 1 = 1.25"),
        ({"kurtosis": math.nan}, "kurtosis must be finite"),
        ({"skewness": 1e308}, "skewness must be within -10 to 10"),
        ({"root_mean_square": 1e-7}, "Give one of"),
        ({"arithmetic_mean": None}, "Give one of"),
        ({"arithmetic_mean": 0.31}, "0.3 um is 3e-7 m"),
        ({"correlation_length": 1e-6}, "at least 2.615 um"),
        ({"shortest_wave": 2e-4}, "longest_wave must exceed"),
        ({"autocorrelation": "fractal"}, "exponential, gaussian"),
    ],
)
def test_what_cannot_be_asked_is_refused(change, words):
    with pytest.raises(ParameterError) as refused:
        replace(ASKED, **change)
    assert words in str(refused.value)


@each(
    ("change", "count", "words"),
    [
        ({"shortest_wave": 1.5e-6}, 1000, "at least 2 spacings, 2 um"),
        ({"correlation_length": 300e-6, "longest_wave": None}, 1000, "a quarter of the period"),
        ({"correlation_length": 200e-6}, 1000, "must be one that waves of 12 to 100 um"),
        ({"skewness": -3.0, "kurtosis": 14.0}, 1000, "the nearest found is"),
        ({"arithmetic_mean": 3e-6}, 1000, "rms slope along x must be at most 0.2"),
        ({}, 1, "at least 16 points"),
        ({"shortest_wave": 98e-6, "correlation_length": 21.5e-6}, 1000, "at least 3 waves"),
    ],
)
def test_what_a_grid_cannot_have_is_refused(change, count, words):
    with pytest.raises(ParameterError) as refused:
        generated_profile(replace(ASKED, **change), 1e-3, count, np.random.default_rng(1))
    assert words in str(refused.value)


def test_few_nodes_a_wave_are_told():
    made = generated_profile(ASKED, 1e-3, 500, np.random.default_rng(1))
    assert any("6 nodes" in note and "1.5 um" in note for note in made.notes)
    assert not generated_profile(ASKED, 1e-3, 1000, np.random.default_rng(1)).notes
