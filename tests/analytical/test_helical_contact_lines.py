"""Contact lines of helical pairs against closed forms, from spur gears to contact ratio five."""

import math

import numpy as np
import pytest

from gearlube_core.helical_geometry.contact_line import (
    clip_line,
    line_count,
    line_kinematics,
    line_position,
    pitch_crossing,
    segment_length,
)
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.load_sharing import positions_at, shared_load
from gearlube_core.helical_geometry.modification import ModifiedPair
from tests.helpers.each import each

HE = HelicalGearFile.named("he_2007")
PHASES = np.arange(2000) / 2000


def variant(width_mm, tip_cut_mm=0.0, helix=21.5):
    """Other face widths and shorter teeth for the pair of He et al.; the same base circles."""
    return HE.varied(
        {
            "pair.face_width_mm": width_mm,
            "pair.helix_angle_deg": helix,
            "pinion.tip_diameter_mm": 85.852 - tip_cut_mm,
            "gear.tip_diameter_mm": 104.902 - tip_cut_mm,
        }
    ).helical_pair()


def pair_of(ratio):
    """The face width that gives this total contact ratio; teeth cut 2.2 mm shorter below 1.6."""
    cut = 2.2 if ratio < 1.6 else 0.0
    unit = variant(31.75, cut)
    lacking = ratio - unit.transverse_contact_ratio
    return variant(31.75 * lacking / unit.overlap_ratio, cut)


RATIOS = [1.2, 1.6, 2.0, 2.7, 3.5, 5.0]


@each("ratio", RATIOS)
def test_mean_total_length_is_contact_ratio_times_width_over_cosine(ratio):
    """Area of the plane of contact over base pitch, along the lines: for any contact ratio.

    Sampling a piecewise linear function leaves the square of the step, 2.5e-7.
    """
    pair = pair_of(ratio)
    assert pair.total_contact_ratio == pytest.approx(ratio, rel=1e-9)
    plane = pair.plane
    total = shared_load(positions_at(PHASES, pair), ModifiedPair(pair=pair), 1.0).total_length
    area = (plane.D - plane.A) * plane.W
    assert total[:, 0].mean() == pytest.approx(area / plane.pitch / plane.cos_b, rel=2e-6)


@each("ratio", RATIOS)
def test_pairs_in_contact_average_to_the_total_contact_ratio(ratio):
    pair = pair_of(ratio)
    plane, count = pair.plane, 0
    assert line_count(plane) == math.ceil(ratio)
    for phase in PHASES:
        for line in range(line_count(plane) + 1):
            touching = segment_length(clip_line(line_position(phase, line, plane), plane), plane)
            assert line < line_count(plane) or touching < 1e-12 * plane.W
            count += touching > 0.0
    # Each of the ends falls between two of 2000 phases.
    assert count / PHASES.size == pytest.approx(pair.total_contact_ratio, abs=1.1e-3)


@each("error", [-1e-14, 0.0, 1e-14])
def test_rounding_of_a_whole_contact_ratio_adds_no_line(error):
    plane = HE.helical_pair().plane
    travel = plane.D - plane.A + plane.W * plane.sin_b / plane.cos_b
    assert line_count(plane._replace(pitch=travel / (5.0 + error * 5.0))) == 5
    assert line_count(plane._replace(pitch=travel / 5.001)) == 6


def test_length_is_constant_where_the_overlap_ratio_is_whole():
    """The classic rule: with eps_beta = 1 the lines enter and leave at one rate."""
    base = variant(31.75)
    pair = variant(31.75 / base.overlap_ratio)
    assert pair.overlap_ratio == pytest.approx(1.0, rel=1e-12)
    total = shared_load(positions_at(PHASES, pair), ModifiedPair(pair=pair), 1.0).total_length
    assert np.ptp(total) < 1e-12 * pair.mean_contact_length * PHASES.size


def test_spur_gears_carry_over_the_whole_face_or_not_at_all():
    pair = variant(31.75, helix=0.0)
    assert pair.base_helix_angle == 0.0
    shared = shared_load(positions_at(PHASES, pair), ModifiedPair(pair=pair), 1.0)
    assert set(np.unique(shared.length)) == {0.0, 31.75e-3}
    pairs = shared.total_length[:, 0] / 31.75e-3
    assert set(np.unique(pairs)) == {1.0, 2.0}
    assert pairs.mean() == pytest.approx(pair.transverse_contact_ratio, abs=1.1e-3)
    assert pair.overlap_ratio == 0.0


def test_spur_pair_is_the_limit_of_small_helix_angles():
    """Lines of a thousandth of a degree enter within 1 um of travel; away from it alike."""
    spur, nearly = variant(31.75, helix=0.0), variant(31.75, helix=1e-3)
    assert nearly.plane == pytest.approx(spur.plane, rel=1e-6, abs=2e-5)
    edge = 2e-6
    for x in np.linspace(spur.plane.A - 1e-3, spur.plane.D + 1e-3, 997):
        if min(abs(x - spur.plane.A), abs(x - spur.plane.D)) < edge:
            continue
        got = segment_length(clip_line(x, nearly.plane), nearly.plane)
        expected = segment_length(clip_line(x, spur.plane), spur.plane)
        assert got == pytest.approx(expected, abs=1e-9)
    segment = clip_line(spur.plane.P, spur.plane)
    assert pitch_crossing(spur.plane.P - 1e-4, segment, spur.plane) == segment.z_high
    assert pitch_crossing(spur.plane.P + 1e-4, segment, spur.plane) == segment.z_low


def velocity(centre, spin, point):
    """Of a rigid body's point, by the cross product."""
    return np.cross([0.0, 0.0, spin], np.asarray(point) - np.asarray(centre))


def test_surface_speeds_are_those_of_the_rigid_gears_across_the_line():
    """The line moves along x, the line of action; across it lies y, where the flanks slide."""
    pair = HE.helical_pair()
    plane, speed = pair.plane, 104.7
    gear_centre = (plane.x_g, plane.r_bp + plane.r_bg, 0.0)
    for x in np.linspace(plane.A, plane.D, 7):
        point = (x, plane.r_bp, 0.0)
        pinion = velocity((0.0, 0.0, 0.0), -speed, point)
        gear = velocity(gear_centre, speed * 25 / 31, point)
        assert pinion[0] == pytest.approx(gear[0], rel=1e-12)  # conjugate: no gap opens
        got = line_kinematics(x, speed, plane)
        assert (got.u_p, got.u_g) == pytest.approx((-pinion[1], -gear[1]), rel=1e-12)
        assert got.entrainment == pytest.approx(-0.5 * (pinion[1] + gear[1]), rel=1e-12)
        assert got.sliding == pytest.approx(gear[1] - pinion[1], rel=1e-9, abs=1e-12)
        assert got.slide_roll == pytest.approx(got.sliding / got.entrainment, rel=1e-12)


def helicoid(turn, along, base, tan_b):
    """Involute helicoid: tangents of the helix on the base cylinder."""
    foot = np.array([base * math.cos(turn), base * math.sin(turn), base * turn / tan_b])
    slope = np.array([-base * math.sin(turn), base * math.cos(turn), base / tan_b])
    return foot + along * slope / np.linalg.norm(slope)


@pytest.mark.parametrize("member", ["pinion", "gear"])
def test_normal_curvature_is_that_of_the_involute_helicoid(member):
    """Largest curvature of the ruled surface from its fundamental forms, by differences.

    The contact line is a ruling, so one principal curvature is zero and twice the mean curvature
    is the other; steps of 2e-4 leave 1e-6.
    """
    pair = HE.helical_pair()
    plane = pair.plane
    base, tan_b = getattr(pair, f"{member}_base_radius"), plane.sin_b / plane.cos_b
    x = 0.5 * (plane.A + plane.P)
    rho = x if member == "pinion" else plane.x_g - x
    along, h, k = rho / plane.sin_b, 2e-4, 2e-4 * rho

    def at(i, j):
        return helicoid(i * h, along + j * k, base, tan_b)

    u, v = (at(1, 0) - at(-1, 0)) / (2 * h), (at(0, 1) - at(0, -1)) / (2 * k)
    uu = (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / h**2
    uv = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * k)
    normal = np.cross(u, v)
    normal /= np.linalg.norm(normal)
    E, F, G, L, M = u @ u, u @ v, v @ v, uu @ normal, uv @ normal
    curvature = abs((L * G - 2.0 * M * F) / (E * G - F * F))
    got = line_kinematics(x, 1.0, plane)
    radius = {"pinion": got.R_p, "gear": got.R_g}[member]
    assert curvature == pytest.approx(plane.cos_b / radius, rel=1e-5)
    both = plane.cos_b * (1.0 / got.R_p + 1.0 / got.R_g)
    assert pytest.approx(both, rel=1e-12) == 1.0 / got.R
