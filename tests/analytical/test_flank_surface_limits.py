"""Cut surfaces whose form is known: cutter cones, involutes, epicycloids, envelopes."""

import math

import numpy as np
import pytest

from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion, cut_state
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.surface_point import CONVERGED, locate, surface_point
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

FILE = HypoidGearFile.named("mohammadpour_2015")
SINGLE_INDEXED = {
    "gear.cutter.blade_groups": 0,
    "pinion.cutter.blade_groups": 0,
    "gear.cutter.blade_offset_angle_deg": 0.0,
    "gear.cutter.blade_edge_radius_mm": None,
}
X, Y, Z = Vector(1.0, 0.0, 0.0), Vector(0.0, 1.0, 0.0), Vector(0.0, 0.0, 1.0)
ORIGIN = Vector(0.0, 0.0, 0.0)
PLACES = np.meshgrid(np.linspace(0.1, 1.0, 5), np.linspace(0.0, 1.0, 6), indexing="ij")


def of_cutter(flank, points):
    """Height over the reference plane and distance from the cutter axis."""
    offset = points - np.array(flank.motion.cutter_centre)
    height = offset @ np.array(flank.motion.cutter_axis)
    return height, np.linalg.norm(
        offset - height[..., None] * np.array(flank.motion.cutter_axis), axis=-1
    )


@pytest.mark.parametrize(("side", "angle", "sign"), [("drive", 15.815, 1), ("coast", 22.436, -1)])
def test_face_milled_form_cut_flank_is_the_cone_of_the_blades(side, angle, sign):
    """Convex flank: inside the cone; curvature cos(alpha) / R around it, none along the blade."""
    flank = Flank.from_file(FILE.varied(SINGLE_INDEXED), "gear", side)
    sample = flank.sample(*PLACES)
    height, radius = of_cutter(flank, sample.r)
    alpha = math.radians(angle)
    cone = 64.185e-3 + sign * height * math.tan(alpha)
    # the located points satisfy their conditions to 1e-11 of 2 mm
    np.testing.assert_allclose(radius, cone, atol=1e-12)
    expected = np.zeros((*radius.shape, 2, 2))
    # the centre of curvature lies on the cutter axis: behind the convex flank's outward normal
    expected[..., 1, 1] = -sign * math.cos(alpha) / radius
    np.testing.assert_allclose(sample.curvature, expected, atol=1e-9)


def test_curved_blade_edge_curves_the_face_milled_flank_by_its_own_radius():
    edge = {"gear.cutter.blade_edge_radius_mm": 762.0}
    flank = Flank.from_file(FILE.varied(SINGLE_INDEXED | edge), "gear", "drive")
    sample = flank.sample(*PLACES)
    height, _ = of_cutter(flank, sample.r)
    # parabola u tan(alpha) - u^2 / (2 rho): curvature 1 / rho / (1 + slope^2)^(3/2), convex tooth
    slope = math.tan(math.radians(15.815)) - height / 0.762
    np.testing.assert_allclose(
        sample.curvature[..., 0, 0], -1.0 / 0.762 / (1.0 + slope**2) ** 1.5, rtol=1e-9
    )


def test_the_blades_of_either_flank_may_have_their_own_edge_radius():
    """The flank that has none of its own keeps that of the cutter, bit by bit."""
    own = {
        "gear.cutter.blade_edge_radius_mm": 762.0,
        "gear.cutter.convex_flank_edge_radius_mm": 400.0,
    }
    usual = {"gear.cutter.blade_edge_radius_mm": 762.0}
    both = [FILE.varied(SINGLE_INDEXED | changes) for changes in (own, usual)]
    coast = [Flank.from_file(file, "gear", "coast").sample(*PLACES).r for file in both]
    np.testing.assert_array_equal(*coast)
    drive = Flank.from_file(both[0], "gear", "drive")
    sample = drive.sample(*PLACES)
    height, _ = of_cutter(drive, sample.r)
    slope = math.tan(math.radians(15.815)) - height / 0.4
    np.testing.assert_allclose(
        sample.curvature[..., 0, 0], -1.0 / 0.4 / (1.0 + slope**2) ** 1.5, rtol=1e-9
    )


def test_blade_offset_angle_makes_a_face_milled_flank_a_hyperboloid():
    """A line skew to the axis sweeps x^2 + y^2 = a^2 + (h - h0)^2 tan^2(b); Gauss K < 0."""
    offset = {"gear.cutter.blade_offset_angle_deg": 16.7}
    flank = Flank.from_file(FILE.varied(SINGLE_INDEXED | offset), "gear", "drive")
    sample = flank.sample(*PLACES)
    height, radius = of_cutter(flank, sample.r)
    e = height * math.tan(math.radians(15.815))
    turned = math.radians(16.7)
    squared = (64.185e-3 + e * math.cos(turned)) ** 2 + (e * math.sin(turned)) ** 2
    np.testing.assert_allclose(radius**2, squared, rtol=1e-12)
    # ruled by its blade edge: no curvature along it, and negative Gaussian curvature -k12^2
    np.testing.assert_allclose(sample.curvature[..., 0, 0], 0.0, atol=1e-9)
    assert np.all(np.linalg.det(sample.curvature) < -1e-3)


# a rack as cutter and cradle of 20 m radius: form errors (10 mm)^2 / 40 m = 2.5 um
FAR = 20.0
PITCH_RADIUS, RACK_ANGLE = 40e-3, math.radians(20.0)
BASE_RADIUS = PITCH_RADIUS * math.cos(RACK_ANGLE)


def rack_motion(far=FAR):
    """A rack at y = pitch radius, moving along x past a work piece that turns about z."""
    return CuttingMotion(
        radius=far,
        slope=math.tan(RACK_ANGLE),
        bend=0.0,
        cos_offset=1.0,
        sin_offset=0.0,
        cutter_centre=Vector(-far, PITCH_RADIUS, 0.0),
        cutter_axis=Vector(0.0, -1.0, 0.0),
        cutter_zero=X,
        cradle_point=Vector(0.0, PITCH_RADIUS + far, 0.0),
        cradle_axis=Z,
        work_point=ORIGIN,
        work_axis=Z,
        index_ratio=0.0,
        roll_ratio=far / PITCH_RADIUS,
        generated=1.0,
    )


def involute(angle):
    return math.tan(angle) - angle


def error_of_involute(radius, far):
    """Polar angle of the flank at `radius` less that of the involute through the pitch point."""
    motion, at = rack_motion(far), np.zeros(3)
    assert locate(motion, radius, 0.0, at) == CONVERGED
    r = np.array(cut_state(motion, *at).r)
    swept = math.atan2(r[1], r[0]) - 0.5 * math.pi
    return abs(swept) - abs(involute(math.acos(BASE_RADIUS / radius)) - involute(RACK_ANGLE))


@each("radius", [38.2e-3, 39e-3, 41e-3, 43e-3])
def test_rack_generates_the_involute(radius):
    error, double = error_of_involute(radius, FAR), error_of_involute(radius, 0.5 * FAR)
    # 2.5 um of rack form at 40 mm, which is inverse to its radius
    assert abs(error) < 2.5e-6 / 40e-3
    assert double / error == pytest.approx(2.0, rel=0.01)


def principal_curvatures(radius):
    motion, at = rack_motion(), np.zeros(3)
    assert locate(motion, radius, 0.0, at) == CONVERGED
    point = surface_point(motion, *at, 1.0)
    operator = [[point.k_11, point.k_12], [point.k_12, point.k_22]]
    return np.sort(np.abs(np.linalg.eigvalsh(operator)))


@each("radius", [39e-3, 40e-3, 42e-3])
def test_generated_involute_has_the_length_of_its_tangent_as_radius_of_curvature(radius):
    along, across = principal_curvatures(radius)
    # straight along the axis but for the round cutter
    assert along == pytest.approx(math.cos(RACK_ANGLE) / FAR, rel=1e-2)
    # 40 mm of pitch radius to 20 m of rack, twice where the tangent is short
    assert 1.0 / across == pytest.approx(math.sqrt(radius**2 - BASE_RADIUS**2), rel=4e-3)


def test_curvature_at_the_pitch_point_is_that_of_euler_and_savary():
    """Straight flank, circles of radius r and R: 1 / rho = (1/r + 1/R) / sin(alpha)."""
    _, across = principal_curvatures(PITCH_RADIUS)
    expected = (1.0 / PITCH_RADIUS + 1.0 / FAR) / math.sin(RACK_ANGLE)
    assert across == pytest.approx(expected, rel=1e-9)


def test_rack_envelope_folds_on_the_base_circle():
    """The involute ends on the base circle: regularity falls to zero there, not before."""
    motion, at = rack_motion(), np.zeros(3)
    margins = []
    for radius in np.linspace(40e-3, BASE_RADIUS + 1e-5, 40):
        assert locate(motion, radius, 0.0, at) == CONVERGED
        margins.append(surface_point(motion, *at, 1.0).regularity)
    margins = np.abs(margins)
    # tangent length sqrt(r^2 - r_b^2): at 10 um over the base circle 0.87 mm of 13.7 mm
    assert margins[-1] < 0.1 * margins[0]
    assert np.all(np.diff(margins) < 0.0)
    assert locate(motion, BASE_RADIUS - 1e-4, 0.0, at) != CONVERGED


def test_hobbed_tooth_trace_is_an_epicycloid():
    """Tangent normal to the line from the instant centre, where the rolling circles touch.

    Work and cutter axes 100 mm apart and parallel, 11 blade groups to 36 teeth: the circles
    share the distance as 36 to 11.
    """
    motion = rack_motion()._replace(
        radius=64e-3,
        slope=0.0,
        cutter_centre=Vector(0.1, 0.0, 0.0),
        cutter_axis=Z,
        cradle_point=ORIGIN,
        index_ratio=11.0 / 36.0,
        roll_ratio=0.0,
        generated=0.0,
    )
    for th in (1.8, 2.2, 2.6):
        state = cut_state(motion, 0.0, th, 0.0)
        turned = th * 11.0 / 36.0
        centre = 0.1 * 36.0 / 47.0 * np.array([math.cos(turned), math.sin(turned), 0.0])
        tangent, arm = np.array(state.r_th), np.array(state.r) - centre
        assert tangent @ arm == pytest.approx(0.0, abs=1e-15)
        assert np.linalg.norm(tangent) == pytest.approx((1 + 11 / 36) * np.linalg.norm(arm))


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_blades_at_neighbouring_cradle_angles_touch_the_flank_from_outside(side):
    """Envelope: the blades' surface leaves the flank as the square of the cradle's turn."""
    flank = Flank.from_file(FILE, "pinion", side)
    motion = flank.motion
    for s, t in ((0.5, 0.3), (0.7, 0.5), (0.9, 0.8)):
        parameters = flank.parameters(np.array(s), np.array(t))
        here = flank.sample_parameters(parameters)

        def leaves(turn, parameters=parameters, here=here):
            """Distance along the normal to the blades' surface of the turned cradle."""
            u, th = parameters[0], parameters[1]
            for _ in range(30):
                state = cut_state(motion, u, th, parameters[2] + turn)
                gap = np.array(state.r) - here.r
                slide = [
                    [np.array(r) @ k for r in (state.r_u, state.r_th)]
                    for k in (here.tangent_1, here.tangent_2)
                ]
                du, dth = np.linalg.solve(slide, [-gap @ here.tangent_1, -gap @ here.tangent_2])
                u, th = u + du, th + dth
            return float(gap @ here.normal)

        far, near = [leaves(h) for h in (4e-3, -4e-3)], [leaves(h) for h in (2e-3, -2e-3)]
        # nothing is left standing inside the tooth
        assert min(far + near) > 0.0
        # fourfold up to the cubic terms, which the mean of both turns takes out
        assert sum(far) / sum(near) == pytest.approx(4.0, rel=1e-2)
