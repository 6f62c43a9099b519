"""Outline of a straight tooth on a cylinder, drawn by hand in the complex plane."""

import cmath
import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry, _fillet_curve, half_section

TEETH = 20
PITCH = 2.0 * math.pi / TEETH
ROOT_HEIGHT, HALF_ROOT, HEIGHT = 50e-3, 4e-3, 8e-3  # m, the tooth stands along +i
TILT = math.radians(15.0)  # of the flank at its root against the middle of the tooth
BULGE = 0.6e-3  # m, by which the tip stands out beyond a straight flank
BASE, RIM = 10e-3, 0.6  # m, pitches
SIDES = {"left": 1.0, "right": -1.0}  # sense about the axis, in which left turns to its neighbour
STATIONS = np.linspace(0.0, 1.0, 4)
# shallow slot: the fillet is an arc; deep one: it takes 0.85 of the half slot
DEPTHS = (1.0e-3, 2.6e-3)


def tooth(slot_depth, tilt):
    """Crowned flanks in the planes z = 0 to 12 mm, the axis along z."""
    s, z = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 12e-3, 4)
    points = {}
    for side, sense in SIDES.items():
        x = -sense * (HALF_ROOT - s * HEIGHT * math.tan(tilt) + s**2 * BULGE)
        grid = np.zeros((5, 4, 3))
        grid[..., 0], grid[..., 1], grid[..., 2] = (
            x[:, None],
            (ROOT_HEIGHT + s * HEIGHT)[:, None],
            z,
        )
        points[side] = grid
    return ToothGeometry(
        **points, inward=np.tile([0.0, -1.0, 0.0], (4, 1)), axis_point=np.zeros(3),
        axis_direction=np.array([0.0, 0.0, 1.0]), teeth=TEETH, slot_depth=slot_depth,
        base_depth=BASE, neighbour_pitches=RIM,
    )  # fmt: skip


def section(side, slot_depth, tilt=TILT):
    return half_section(
        tooth(slot_depth, tilt), side, np.array([1.0, 0.5, 0.0]), STATIONS,
        np.linspace(0.02, 1.0, 50), np.array([0.5, 1.0]), np.array([0.25, 1.0]),
    )  # fmt: skip


def drawn(side, slot_depth):
    """Root, corner, end of the fillet and middle of the slot, on the left half of the plane."""
    root = -HALF_ROOT + 1j * ROOT_HEIGHT
    centre = 1j * cmath.exp(0.5j * PITCH)  # outward along the middle of the slot
    # root and neighbour's root lie alike to both sides of it
    middle = ((root / centre).real - slot_depth) * centre
    down = -math.sin(TILT) - 1j * math.cos(TILT)
    across = centre * 1j
    # root + length down = middle - room across
    length, room = np.linalg.solve(
        [[down.real, across.real], [down.imag, across.imag]],
        [(middle - root).real, (middle - root).imag],
    )
    corner = root + length * down
    end = corner + min(0.85 * room, length) * across
    points = root, corner, end, middle, centre
    # the right half is its mirror image
    return [p if side == "left" else -p.conjugate() for p in points], length, room


def in_plane(points):
    """Points as complex numbers; all stations must be alike but for z."""
    np.testing.assert_allclose(points[..., 0] - points[..., :1, 0], 0.0, atol=1e-15)
    return points[..., 0, 0] + 1j * points[..., 0, 1]


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("slot_depth", DEPTHS)
def test_outline_runs_from_the_tip_over_fillet_and_slot_to_the_end_of_the_rim(side, slot_depth):
    found = section(side, slot_depth)
    (root, _, end, middle, centre), length, room = drawn(side, slot_depth)
    assert (length < 0.85 * room) == (slot_depth == DEPTHS[0])
    s = np.array([1.0, 0.5, 0.0])
    across = s * HEIGHT * math.tan(TILT) - s**2 * BULGE
    flank = root + SIDES[side] * across + 1j * s * HEIGHT
    np.testing.assert_allclose(in_plane(found.flank), flank, atol=1e-15)
    assert in_plane(found.fillet)[-1] == pytest.approx(end, abs=1e-15)
    turn = cmath.exp(SIDES[side] * 1j * PITCH)
    rim = [0.5 * (end + middle), middle, middle * turn ** (0.25 * RIM), middle * turn**RIM]
    np.testing.assert_allclose(in_plane(found.rim), rim, atol=1e-15)
    below = (middle - BASE * centre) * turn**RIM
    assert in_plane(found.base) == pytest.approx(below, abs=1e-15)
    z = np.linspace(0.0, 12e-3, 4)
    np.testing.assert_allclose(found.outline[..., 2], np.tile(z, (57, 1)), atol=1e-15)
    np.testing.assert_array_equal(found.outline[3:53], found.fillet)


@pytest.mark.parametrize("side", SIDES)
def test_fillet_between_equal_tangents_is_an_arc(side):
    (root, corner, end, _, _), length, _ = drawn(side, DEPTHS[0])
    turning = abs(cmath.phase((end - corner) / (corner - root)))
    radius = length / math.tan(0.5 * turning)
    centre = corner + (root + end - 2.0 * corner) / abs(root + end - 2.0 * corner) * (
        math.hypot(length, radius)
    )
    arc = in_plane(section(side, DEPTHS[0]).fillet)
    assert abs(root - centre) == pytest.approx(radius, rel=1e-12)
    # as the docstring of the curve says
    np.testing.assert_allclose(abs(arc - centre), radius, rtol=1e-3)


@pytest.mark.parametrize("turning_deg", [20.0, 60.0, 90.0, 110.0])
def test_curve_in_a_corner_follows_the_circle_of_its_turning_angle(turning_deg):
    theta = math.radians(turning_deg)
    tangent = math.tan(0.5 * theta)  # of a circle of radius 1 about (0, 1)
    corner = np.array([[tangent, 0.0, 0.0]])
    end = corner + tangent * np.array([[math.cos(theta), math.sin(theta), 0.0]])
    x = np.linspace(0.0, 1.0, 21)
    curve = _fillet_curve(np.zeros((1, 3)), corner, end, x)[:, 0]
    np.testing.assert_allclose(curve[0], 0.0, atol=1e-15)
    np.testing.assert_allclose(curve[-1], end[0], rtol=1e-14)
    np.testing.assert_allclose(np.hypot(curve[:, 0], curve[:, 1] - 1.0), 1.0, atol=1e-3)
    angle = np.arctan2(curve[:, 0], 1.0 - curve[:, 1])
    assert angle[10] == pytest.approx(0.5 * theta, rel=1e-12)  # it is symmetric
    assert np.all(np.diff(angle) > 0.0)


def test_slot_without_room_for_a_fillet_is_refused():
    with pytest.raises(ParameterError, match="slot_depth must leave a flat slot"):
        section("left", 20e-3)


def test_flank_must_fall_towards_the_body():
    # descent cos(tilt + half a pitch), 0.19 and 0.21; at least 0.2 is asked for
    with pytest.raises(ParameterError, match="left flank must fall towards the body"):
        section("left", 0.5e-3, math.radians(70.0))
    assert np.isfinite(section("left", 0.5e-3, math.radians(69.0)).fillet).all()
