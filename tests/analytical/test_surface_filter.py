"""Filters, levelling, statistics and spectra of surfaces against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.surface.gaussian_filter import filtered, levelled
from gearlube_core.surface.heights import HeightMap, Profile
from gearlube_core.surface.spectrum import (
    map_spectrum,
    profile_autocorrelation,
    profile_spectrum,
    wavelength_holding,
)
from gearlube_core.surface.statistics import map_statistics, profile_statistics
from tests.helpers.each import each

STEP, CUTOFF = 1e-6, 1e-4  # m
ROUNDING = 1e-12


def sine(wavelength: float, count: int, amplitude: float = 1e-6) -> np.ndarray:
    return amplitude * np.sin(2.0 * np.pi * STEP * np.arange(count) / wavelength)


def test_half_of_a_wave_of_the_cut_off_is_mean_line():
    wave = Profile(height=sine(CUTOFF, 1000), spacing=STEP, periodic=True)
    kept = filtered(wave, cutoff_long=CUTOFF)
    assert kept.waviness.height == pytest.approx(0.5 * wave.height, abs=1e-18)
    assert kept.roughness.height == pytest.approx(0.5 * wave.height, abs=1e-18)
    assert (kept.cutoff_long, kept.cutoff_short) == (CUTOFF, None)


@each("periodic", [True, False])
@each("ratio", [0.3, 0.5, 0.8, 1.0, 1.25, 2.0, 5.0])
def test_the_whole_transmission_curve_is_that_of_iso_16610_21(ratio, periodic):
    wavelength = ratio * CUTOFF
    count = round(20 * wavelength / STEP)
    wave = Profile(height=sine(wavelength, count), spacing=STEP, periodic=periodic)
    found = filtered(wave, cutoff_long=CUTOFF).waviness.height
    middle = slice(count // 4, 3 * count // 4) if not periodic else slice(None)
    # independent of the code: alpha^2 pi = ln 2
    expected = math.exp(-math.log(2.0) / ratio**2)
    # the kernel of open ends reaches one cut-off, where its weight is 1e-6 of the largest
    tolerance = 2e-6 if not periodic else ROUNDING
    assert found[middle] == pytest.approx(expected * wave.height[middle], abs=1e-6 * tolerance)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_map_has_the_transmission_of_a_profile_along_each_side(axis):
    wave = sine(CUTOFF, 200)
    shape = (200, 40) if axis == 0 else (40, 200)
    height = np.broadcast_to(np.expand_dims(wave, 1 - axis), shape).copy()
    surface = HeightMap(height=height, spacing=(STEP, STEP), periodic=(True, True))
    assert filtered(surface, cutoff_long=CUTOFF).waviness.height == pytest.approx(
        0.5 * height, abs=1e-18
    )


def test_both_cut_offs_act_one_after_the_other():
    wave = Profile(height=sine(2e-5, 1000), spacing=STEP, periodic=True)
    both = filtered(wave, cutoff_long=CUTOFF, cutoff_short=1e-5)
    share = math.exp(-math.log(2.0) * 0.5**2) * (1.0 - math.exp(-math.log(2.0) * 5.0**2))
    assert both.roughness.height == pytest.approx(share * wave.height, abs=1e-18)


def test_open_ends_keep_a_slope_and_are_cut_where_asked():
    line = Profile(height=1e-6 + 0.01 * STEP * np.arange(500), spacing=STEP)
    assert np.abs(filtered(line, cutoff_long=CUTOFF).roughness.height).max() < 1e-17
    cut = filtered(line, cutoff_long=CUTOFF, ends="cut").roughness
    assert cut.height.size == 500 - 2 * 50


def test_levelling_takes_off_polynomials_and_nothing_else():
    x = np.linspace(-1.0, 1.0, 301)
    curve = 1e-6 * (0.3 - 2.0 * x + 0.7 * x**2)
    wave = Profile(height=sine(3e-5, 301), spacing=STEP)
    bent = Profile(height=wave.height + curve, spacing=STEP)
    assert levelled(bent, 2).height == pytest.approx(levelled(wave, 2).height, abs=1e-18)
    assert np.abs(levelled(Profile(height=curve, spacing=STEP)).height).max() > 1e-7
    tilted = HeightMap(height=1e-6 * (x[:, None] - 3.0 * x[None, :60]), spacing=(STEP, STEP))
    assert np.abs(levelled(tilted).height).max() < 1e-18


def test_a_periodic_surface_keeps_its_first_wave():
    wave = Profile(height=sine(3e-4, 300), spacing=STEP, periodic=True)
    assert levelled(wave).height == pytest.approx(wave.height, abs=1e-18)


def test_statistics_of_a_sine_are_those_of_the_integrals():
    amplitude, wavelength = 1e-6, 1e-4
    of = profile_statistics(Profile(height=sine(wavelength, 1000), spacing=STEP, periodic=True))
    # sums of 100 points a wave; |sin| has a corner, so order two: pi^2/12/50^2
    assert of.Ra == pytest.approx(2.0 * amplitude / math.pi, rel=4e-4)
    assert of.Rq == pytest.approx(amplitude / math.sqrt(2.0), rel=ROUNDING)
    assert of.Rt == pytest.approx(2.0 * amplitude, rel=ROUNDING)
    assert of.Rz == pytest.approx(2.0 * amplitude, rel=ROUNDING)
    assert of.Rsk == pytest.approx(0.0, abs=ROUNDING)
    assert of.Rku == pytest.approx(1.5, rel=ROUNDING)
    # the formula of seven points is of order six: (2 pi/100)^6/140 = 4e-10
    assert of.Rdq == pytest.approx(2.0 * math.pi * of.Rq / wavelength, rel=1e-9)
    assert of.mean_wavelength == pytest.approx(wavelength, rel=1e-9)
    # between points the cosine is taken as straight: (2 pi/100)^2/8 of a spacing's fall
    assert of.Ral == pytest.approx(math.acos(0.2) / (2.0 * math.pi) * wavelength, rel=1e-3)


def test_moments_of_exponential_heights_are_two_and_nine():
    # quantiles of the exponential distribution: skewness 2, kurtosis 9
    shares = (np.arange(400_000) + 0.5) / 400_000
    of = profile_statistics(Profile(height=-1e-7 * np.log(1.0 - shares), spacing=STEP))
    # what is beyond the last quantile is missing: n^-1 ln(n)^4
    assert of.Rsk == pytest.approx(2.0, abs=0.01)
    assert of.Rku == pytest.approx(9.0, abs=0.1)


def test_a_map_of_crossed_waves_has_the_statistics_of_their_product():
    along_x = np.cos(2.0 * np.pi * np.arange(80) / 80)
    along_y = np.cos(2.0 * np.pi * np.arange(120) / 60)
    surface = HeightMap(
        height=1e-6 * np.outer(along_x, along_y), spacing=(STEP, STEP), periodic=(True, True)
    )
    of = map_statistics(surface)
    assert of.Sq == pytest.approx(0.5e-6, rel=ROUNDING)
    assert of.Sku == pytest.approx(1.5**2, rel=ROUNDING)
    assert of.mean_wavelengths == pytest.approx((80e-6, 60e-6), rel=1e-8)
    share = math.acos(0.2) / (2.0 * math.pi)
    assert of.correlation_lengths == pytest.approx((80e-6 * share, 60e-6 * share), rel=3e-3)


@pytest.mark.parametrize("count", [256, 255])
def test_the_spectrum_holds_the_mean_square(count):
    """Parseval: the sum of the density times its step is Rq squared."""
    height = 1e-7 * np.random.default_rng(3).standard_normal(count)
    found = profile_spectrum(Profile(height=height, spacing=STEP, periodic=True))
    step = found.frequency[1]
    assert found.density.sum() * step == pytest.approx(height.var(), rel=ROUNDING)
    surface = HeightMap(
        height=np.outer(height[:40], height), spacing=(STEP, STEP), periodic=(True, True)
    )
    for axis in range(2):
        one = map_spectrum(surface, axis)
        total = one.density.sum() * one.frequency[1]
        assert total == pytest.approx(surface.height.var(), rel=ROUNDING)


def test_a_wave_stands_in_its_place_of_the_spectrum():
    height = sine(1e-4, 1000) + sine(2e-5, 1000, 0.2e-6)
    found = profile_spectrum(Profile(height=height, spacing=STEP, periodic=True))
    # the shorter wave holds 0.04/1.04 of the mean square
    assert wavelength_holding(found, 0.9) == pytest.approx(1e-4)
    assert wavelength_holding(found, 0.99) == pytest.approx(2e-5)


def test_open_ends_correlate_over_the_points_that_are_there():
    rising = Profile(height=np.tile([1e-6, -1e-6], 50), spacing=STEP)
    # every pair at an even distance is equal, at an odd one opposite, also at the longest
    assert profile_autocorrelation(rising) == pytest.approx(
        np.tile([1.0, -1.0], 26)[:51], abs=ROUNDING
    )
