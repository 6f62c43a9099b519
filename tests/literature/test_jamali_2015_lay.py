"""Extrusion of roughness and stand-ins for the profiles of Jamali 2015, sections 7.6 and 7.9."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.surface.extrusion import (
    ExtrudedProfile,
    Lay,
    check_divides,
    periodic_section,
)
from gearlube_core.surface.heights import Profile
from gearlube_core.surface.stand_ins import SEEDS, stand_in
from gearlube_core.surface.statistics import profile_statistics
from tests.helpers.each import each

MICRO, DEGREE = 1e-6, math.pi / 180.0
WIDTH = 1e-3  # m


def waves(period: float, count: int = 200) -> Profile:
    turn = 2.0 * np.pi * np.arange(count) / count
    height = MICRO * (0.3 * np.sin(3.0 * turn) + 0.1 * np.cos(7.0 * turn + 0.4))
    return Profile(height=height, spacing=period / count, periodic=True)


@each(("period_um", "angle_deg"), [(149, 8.475), (100, 5.711), (114, 6.504), (131, 7.463)])
def test_periods_of_the_thesis_have_its_angles(period_um, angle_deg):
    lay = Lay(period=period_um * MICRO, width=WIDTH, turns=1)
    assert lay.angle / DEGREE == pytest.approx(angle_deg, abs=5.1e-4)  # digits


@each("measured", ["along_x", "across_lay"])
@each("turns", [-3, 0, 1, 2])
def test_an_extruded_profile_repeats_over_the_width_and_its_period(measured, turns):
    profile = waves(149 * MICRO)
    lay = Lay(period=profile.length, width=WIDTH, turns=turns, measured=measured)
    drawn = ExtrudedProfile(profile=profile, lay=lay)
    x, y = np.linspace(-0.7e-3, 0.9e-3, 41)[:, None], np.linspace(0.0, WIDTH, 23)
    height = drawn(x, y)
    limit = 1e-12 * np.abs(profile.height).max()
    assert np.abs(drawn(x, y + WIDTH) - height).max() < limit
    assert np.abs(drawn(x, y - 5 * WIDTH) - height).max() < limit
    assert np.abs(drawn(x + drawn.period_x, y) - height).max() < limit
    # along a crest, which leans from y towards x, nothing changes
    along = drawn(x + y * math.tan(lay.angle), y)
    assert np.abs(along - along[:, :1]).max() < limit


def test_a_section_along_x_or_across_the_lay_is_the_profile():
    profile = waves(149 * MICRO)
    for measured, slope in (("along_x", 0.0), ("across_lay", 1.0)):
        lay = Lay(period=profile.length, width=WIDTH, turns=1, measured=measured)
        drawn = ExtrudedProfile(profile=profile, lay=lay)
        x = profile.x * (math.cos(lay.angle) if slope else 1.0)
        y = -slope * profile.x * math.sin(lay.angle)
        # at the nodes of the spline
        assert drawn(x, y) == pytest.approx(profile.height, abs=1e-16)


def test_the_map_of_an_extruded_profile_closes():
    profile = waves(100 * MICRO)
    lay = Lay(period=profile.length, width=WIDTH, turns=1)
    surface = ExtrudedProfile(profile=profile, lay=lay).over(3e-4, (600, 128))
    assert surface.lengths == pytest.approx((3e-4, WIDTH))
    assert surface.height[:200] == pytest.approx(surface.height[200:400], abs=1e-18)
    # a row farther the crests have moved by 200/128 nodes; after all rows by one period
    assert surface.height[25 * 8, 16 * 8 - 1] != surface.height[25 * 8, 0]
    shifted = np.roll(surface.height[:200, 0], 25)
    assert surface.height[:200, 16] == pytest.approx(shifted, abs=1e-18)


def test_a_lay_that_does_not_close_is_refused_with_the_nearest():
    with pytest.raises(ParameterError) as refused:
        Lay.closing(149 * MICRO, WIDTH, 8.5 * DEGREE)
    text = str(refused.value)
    assert "8.4747 deg (1 turns)" in text
    assert "149.45 um" in text  # 1 mm tan 8.5 deg
    assert Lay.closing(149 * MICRO, WIDTH, math.atan(0.298)).turns == 2
    assert Lay.nearest(149 * MICRO, WIDTH, -16.0 * DEGREE).turns == -2
    assert Lay.nearest(149 * MICRO, WIDTH, 1.2, "across_lay").turns == 6


@each(
    ("make", "words"),
    [
        (lambda: check_divides("L_y", WIDTH, 149 * MICRO), "1043 um, or a period of 142.857 um"),
        (lambda: Lay(period=1e-4, width=WIDTH, turns=1.5), "whole number"),
        (lambda: Lay(period=1e-3, width=1e-3, turns=1, measured="across_lay"), "below"),
        (
            lambda: ExtrudedProfile(
                profile=Profile(
                    height=1e-7 * np.sin(np.arange(50) / 10.0), spacing=2e-6, periodic=True
                ),
                lay=Lay(period=1e-4, width=WIDTH, turns=1),
            ),
            "got a jump of",
        ),
        (
            lambda: ExtrudedProfile(
                profile=waves(1e-4), lay=Lay(period=2e-4, width=WIDTH, turns=1)
            ),
            "lay.period must be that of",
        ),
        (
            lambda: ExtrudedProfile(
                profile=Profile(height=waves(1e-4).height, spacing=5e-7),
                lay=Lay(period=1e-4, width=WIDTH, turns=1),
            ),
            "must be periodic",
        ),
        (
            lambda: ExtrudedProfile(
                profile=waves(1e-4), lay=Lay(period=1e-4, width=WIDTH, turns=1)
            ).over(1e-4, (200, 32)),
            "8 nodes a wave along y",
        ),
        (
            lambda: ExtrudedProfile(
                profile=waves(1e-4), lay=Lay(period=1e-4, width=WIDTH, turns=1)
            ).over(1e-4, (32, 256)),
            "8 nodes a wave along x, a step of at most 1.786 um",  # 100 um/7/8
        ),
        (lambda: periodic_section(waves(1e-4), 5e-5, 1e-4), "must have at least 8 points"),
    ],
)
def test_what_does_not_close_or_is_too_coarse_is_refused(make, words):
    with pytest.raises(ParameterError) as refused:
        make()
    assert words in str(refused.value)


def test_a_cut_part_closes_where_the_profile_nearly_does():
    x = MICRO * np.arange(1200)
    height = 0.3 * MICRO * np.sin(2.0 * np.pi * x / 70e-6) + 0.002 * (x - x.mean())
    part = periodic_section(Profile(height=height, spacing=MICRO), 4e-4, 140e-6)
    assert part.periodic
    assert part.length == pytest.approx(140e-6, rel=1e-12)
    # two whole waves, and of the slope nothing
    assert np.abs(np.fft.rfft(part.height)[2]) / 70 == pytest.approx(0.3 * MICRO, rel=1e-6)
    assert np.delete(np.abs(np.fft.rfft(part.height)), 2).max() < 1e-6 * 0.3 * MICRO * 70


@each(("case", "angles_deg"), [("A", (8.475, 5.711)), ("B", (8.475, 5.711)), ("C", (6.504, 7.463))])
def test_stand_ins_have_the_published_numbers(case, angles_deg):
    made = stand_in(case)
    of = profile_statistics(made.full.surface)
    assert of.length == pytest.approx(4e-3)
    assert of.Ra == pytest.approx(0.31 * MICRO, rel=1e-9)
    assert [lay.angle / DEGREE for lay in made.lays] == pytest.approx(angles_deg, abs=5.1e-4)
    for part in (made.fast, made.slow):
        assert part.periodic
        # a/200, to whole points of a period
        assert part.spacing == pytest.approx(1.19 * MICRO, rel=0.005)


@pytest.mark.slow
def test_five_stand_ins_differ_and_can_be_scaled():
    made = [stand_in("A", seed, same_mean=True) for seed in SEEDS]
    assert [profile_statistics(one.fast).Ra for one in made] == pytest.approx([0.31 * MICRO] * 5)
    heights = np.array([one.fast.height for one in made])
    assert np.abs(np.corrcoef(heights) - np.eye(5)).max() < 0.9
    with pytest.raises(ParameterError, match="A, B, C"):
        stand_in("D")
