"""Undercut of a spur gear cut by a rack, against the textbook.

The involute ends on its base circle, where the rack is r sin^2(alpha) below the pitch line; a rack
that reaches deeper undercuts the tooth.
"""

import math

import numpy as np
import pytest

from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.flank import Flank, ToothRegion
from gearlube_core.hypoid_geometry.flank.tooth import flank_root_limit
from gearlube_core.hypoid_geometry.flank.vectors import Vector

FAR = 20.0  # radius of cutter and cradle that stand for a rack [m]
PITCH_RADIUS, ANGLE = 40e-3, math.radians(20.0)
BASE_RADIUS = PITCH_RADIUS * math.cos(ANGLE)
LIMIT = PITCH_RADIUS * math.sin(ANGLE) ** 2
# a cone so slender that it is a cylinder: 10 mm of face change its radius by 1e-8 m
SLENDER = 1e-6
ROOT_DEPTH, ADDENDUM = 5e-3, 3e-3


@pytest.fixture(scope="module")
def spur_flank():
    z = Vector(0.0, 0.0, 1.0)
    motion = CuttingMotion(
        radius=FAR,
        slope=math.tan(ANGLE),
        bend=0.0,
        cos_offset=1.0,
        sin_offset=0.0,
        cutter_centre=Vector(-FAR, PITCH_RADIUS, 0.0),
        cutter_axis=Vector(0.0, -1.0, 0.0),
        cutter_zero=Vector(1.0, 0.0, 0.0),
        cradle_point=Vector(0.0, PITCH_RADIUS + FAR, 0.0),
        cradle_axis=z,
        work_point=Vector(0.0, 0.0, 0.0),
        work_axis=z,
        index_ratio=0.0,
        roll_ratio=FAR / PITCH_RADIUS,
        generated=1.0,
    )
    middle = PITCH_RADIUS / math.sin(SLENDER)
    region = ToothRegion(
        inner_cone_distance=middle - 5e-3,
        outer_cone_distance=middle + 5e-3,
        pitch_angle=SLENDER,
        apex_axial=-middle * math.cos(SLENDER),
        root_depth=ROOT_DEPTH,
        addendum=ADDENDUM,
    )
    return Flank(motion, 1.0, np.zeros(3), region, "pinion", "drive", 40)


def s_of(radius):
    return (radius - PITCH_RADIUS + ROOT_DEPTH) / (ROOT_DEPTH + ADDENDUM)


def test_rack_deeper_than_the_limit_undercuts_down_from_the_base_circle(spur_flank):
    limit = flank_root_limit(spur_flank, np.array([0.3, 0.5, 0.7]), 1.05 * LIMIT)
    assert limit.undercut.all()
    # rack form 2e-3 (r / FAR) of the tangent's 13.7 mm, squared over the radius: 10 um of 8 mm
    np.testing.assert_allclose(limit.s, s_of(BASE_RADIUS), atol=2e-3)
    np.testing.assert_array_equal(limit.s, limit.fold)


def test_shallower_rack_leaves_the_flank_where_its_tip_line_runs(spur_flank):
    tip = 0.8 * LIMIT
    limit = flank_root_limit(spur_flank, np.array([0.3, 0.5, 0.7]), tip)
    assert not limit.undercut.any()
    # line of action: tip below the pitch line, tip / tan(alpha) aside
    radius = math.hypot(PITCH_RADIUS - tip, tip / math.tan(ANGLE))
    np.testing.assert_allclose(limit.s, s_of(radius), atol=2e-3)
