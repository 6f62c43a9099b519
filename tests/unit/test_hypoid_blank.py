"""The hypoid blank: what it accepts, what it refuses, what it derives."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

BLANK = HypoidGearFile.named("mohammadpour_2015").blank()


def test_a_file_of_millimetres_and_degrees_becomes_metres_and_radians():
    # the printed numbers times 1e-3 and pi/180, to rounding
    assert BLANK.pinion.outer_cone_distance == pytest.approx(0.083084, rel=1e-15)
    assert BLANK.gear.pitch_angle == pytest.approx(59.653 * math.pi / 180.0, rel=1e-15)
    assert BLANK.offset == pytest.approx(0.024, rel=1e-15)
    assert (BLANK.pinion.teeth, BLANK.gear.teeth) == (13, 36)


@each("field", ["face_width", "outer_cone_distance", "pitch_apex", "face_apex"])
@each("member", ["pinion", "gear"])
def test_millimetres_given_as_metres_are_refused_by_name(member, field):
    body = getattr(BLANK, member)
    with pytest.raises(ParameterError, match=rf"{field} must be .* m, got .* m\. Give metres"):
        replace(body, **{field: 1e3 * getattr(body, field)})


def test_an_offset_in_millimetres_given_as_metres_is_refused():
    with pytest.raises(ParameterError, match=r"offset must be .* m, got .* m\. Give metres"):
        replace(BLANK, offset=1e3 * BLANK.offset)


@pytest.mark.parametrize("field", ["pitch_angle", "spiral_angle"])
def test_degrees_given_as_radians_are_refused_by_name(field):
    with pytest.raises(ParameterError, match=rf"{field} must be .* rad, got .* Give radians"):
        replace(BLANK.gear, **{field: math.degrees(getattr(BLANK.gear, field))})


@each(
    "field",
    ["face_width", "outer_cone_distance", "pitch_angle", "spiral_angle", "pitch_apex", "face_apex"],
)
def test_a_length_or_angle_that_is_not_a_number_is_refused(field):
    with pytest.raises(ParameterError, match=f"{field} must be finite, got nan"):
        replace(BLANK.pinion, **{field: math.nan})


def test_a_face_wider_than_the_cone_is_refused():
    with pytest.raises(ParameterError, match=r"must exceed face_width 0\.09 m, got"):
        replace(BLANK.pinion, face_width=0.09)


def test_a_gear_of_two_teeth_is_refused():
    with pytest.raises(ParameterError, match="teeth must be within 3 to 400, got 2"):
        replace(BLANK.pinion, teeth=2)


def test_an_offset_beyond_the_reach_of_the_cones_is_refused():
    with pytest.raises(ParameterError, match="Reduce offset"):
        replace(BLANK, offset=0.4).mean_point()


def test_without_offset_the_mean_point_lies_in_the_plane_of_the_axes():
    point = replace(BLANK, offset=0.0).mean_point()
    assert point[1] == 0.0
    # mid-face pitch radius and height over the apex of the gear cone, by hand in mm
    cone = 95.598 - 0.5 * 29.999
    expected = [
        cone * math.sin(math.radians(59.653)),
        -8.987 + cone * math.cos(math.radians(59.653)),
    ]
    np.testing.assert_allclose(1e3 * point[[0, 2]], expected, rtol=1e-14)


def test_directions_at_the_mean_point_are_orthogonal_unit_vectors():
    generator, pitch = BLANK.gear_generator(), BLANK.pitch_normal()
    np.testing.assert_allclose(np.linalg.norm([generator, pitch], axis=1), 1.0, rtol=1e-15)
    assert abs(generator @ pitch) < 1e-15
