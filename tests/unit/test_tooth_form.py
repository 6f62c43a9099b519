"""Thickness, topland, root and undercut of the teeth of the shipped pair."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form, tooth_grids
from gearlube_core.hypoid_geometry.flank.tooth_solid import tooth_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = HypoidGearFile.named("mohammadpour_2015")
ROLES = ("pinion", "gear")


@pytest.fixture(scope="module", params=ROLES)
def tooth(request):
    return Tooth.from_file(FILE, request.param)


def filled_at_the_reference_point(role):
    """Share of the pitch that the tooth fills where both blades' paths meet."""
    tooth = Tooth.from_file(FILE, role)
    point = tooth.drive.sample_parameters(tooth.drive.start).r - tooth.drive.axis_point
    axial = point @ tooth.drive.axis
    s, t = tooth.drive.region.position(math.hypot(*np.cross(tooth.drive.axis, point)), axial)
    return tooth.thickness_angle(np.array([s]), np.array([t]))[0, 0] / tooth.pitch


def test_form_cut_tooth_fills_half_the_pitch_where_both_blades_trace_one_curve():
    # located to 1e-11 of 0.1 rad
    assert filled_at_the_reference_point("gear") == pytest.approx(0.5, abs=1e-9)


def test_generated_tooth_is_a_little_thinner_there():
    """Blades of other cradle angles cut below the path of the two that pass the point.

    It is no pitch point: 1.7 mm off the pitch cone. Nearly 0.1 mm to each side of 15 mm of pitch.
    """
    assert 0.48 < filled_at_the_reference_point("pinion") < 0.495


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_a_step_into_the_tooth_goes_against_the_outward_normal(tooth, side):
    s, t = np.array([0.6]), np.array([0.5])
    angle = tooth.angles(side, s, t)[0]
    inward = tooth.towards if side == "drive" else -tooth.towards
    step = tooth.points(angle + 1e-4 * inward, s, t) - tooth.points(angle, s, t)
    flank = tooth.drive if side == "drive" else tooth.coast
    turn = 0.0 if side == "drive" else tooth.coast_turn
    normal = flank.turned(turn).apply(flank.sample(s, t).normal)
    assert float(step[0, 0] @ normal[0]) < 0.0


def test_teeth_of_both_members_share_the_normal_pitch_at_the_pitch_cones():
    thickness = sum(float(tooth_form(FILE, role, 3).thickness[1]) for role in ROLES)
    # mid-face, while the printed spiral angle holds 0.97 mm towards the toe: 1.2 %
    assert thickness == pytest.approx(math.pi * FILE.blank().mean_normal_module, rel=0.02)


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_polar_angles_give_back_the_points_of_the_flank(tooth, side):
    s, t = np.linspace(0.4, 1.0, 4), np.linspace(0.0, 1.0, 5)
    angle, extended = tooth.angles(side, s, t)
    assert not extended.any()
    flank = tooth.drive if side == "drive" else tooth.coast
    turn = 0.0 if side == "drive" else tooth.coast_turn
    cut = flank.grid(s, t).r
    turned = flank.turned(turn).apply((cut - flank.axis_point).reshape(-1, 3)).reshape(cut.shape)
    np.testing.assert_allclose(
        tooth.points(angle, s, t), turned + flank.axis_point, rtol=0.0, atol=1e-12
    )


@pytest.mark.parametrize("role", ROLES)
def test_grids_are_complete_and_smooth_down_to_the_root(role):
    for grid in tooth_grids(FILE, role, 41, 33):
        assert grid.shape == (41, 33, 3)
        assert np.isfinite(grid).all()
        rows = np.linalg.norm(np.diff(grid, axis=0), axis=-1)
        # 190 um of depth a row; a jump at the seam of the extension would stand out
        assert rows.max() < 1.6 * np.median(rows)
        bends = np.linalg.norm(np.diff(grid, 2, axis=0), axis=-1)
        assert bends.max() < 0.15 * np.median(rows)


def test_undercut_of_the_pinion_is_extended_only_at_its_toe():
    tooth = Tooth.from_file(FILE, "pinion")
    s, t = np.linspace(0.0, 1.0, 21), np.linspace(0.0, 1.0, 17)
    _, extended = tooth.angles("coast", s, t)
    assert extended[0, 0]
    assert not extended[:, -1].any()
    assert not extended[8:].any()


def test_form_cut_flanks_end_on_the_line_of_the_blade_tips():
    """The gear's cutter reaches a clearance below the working depth: the root line, s = 0."""
    form = tooth_form(FILE, "gear", 9)
    for limit in (form.drive, form.coast):
        assert not limit.undercut.any()
        # the tip travels in a plane, the root line lies on a cone: 0.14 mm of 7.6 mm
        np.testing.assert_allclose(limit.s, 0.0, atol=0.02)


def test_shipped_pinion_is_undercut_and_thin_at_the_toe_and_says_so():
    form = tooth_form(FILE, "pinion")
    report = form.report()
    assert len(report) == 3
    assert report[0].startswith("pinion topland is thin: 0.73 mm at the toe")
    assert report[1].startswith("pinion drive flank is undercut below s = 0.15 at the toe")
    assert report[2].startswith("pinion coast flank is undercut below s = 0.22 at the toe")
    # the mate's tip reaches the clearance over the root: one ninth of the whole depth
    assert form.active == pytest.approx(1.0 / 9.0, rel=1e-12)
    assert form.topland[0] == form.topland.min()
    assert tooth_form(FILE, "gear").report() == []


def test_tooth_that_runs_to_a_point_is_reported_and_has_no_solid():
    high = FILE.varied({"pinion.face_apex_mm": 5.0})
    assert "pinion tooth is pointed" in tooth_form(high, "pinion").report()[0]
    with pytest.raises(ParameterError, match="pinion tooth is pointed"):
        tooth_solid(Tooth.from_file(high, "pinion"))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"m": 1, "n": 5}, "m must be within 2 to"),
        ({"m": 5, "n": 1}, "n must be within 2 to"),
        ({"m": 5, "n": 5, "s_low": -0.5}, "s_low must be within -0.1 to 0.9"),
    ],
)
def test_grids_of_impossible_size_are_refused(arguments, words):
    with pytest.raises(ParameterError, match=words):
        tooth_grids(FILE, "gear", **arguments)
