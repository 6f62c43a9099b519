"""Pitch cones and tooth traces of ISO 23509 against constructions in space that do not use it.

The cones are placed on their axes as vectors, the limit normal and curvature follow from the
velocities, the trace from a cutter rolling on a circle.
"""

import cmath
import math

import numpy as np
import pytest

from gearlube_core.hypoid_geometry.blank.iso_23509 import HypoidDesign, apex_misfit, method_2
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones, ToothTrace
from tests.helpers.each import each

FIELDS = ("shaft", "gear_angle", "teeth", "radius", "offset", "spiral")
CASES = [
    dict(zip(FIELDS, row, strict=True))
    for row in (
        (90.0, 63.2, (9, 34), 73.35, 31.75, 21.0),
        (90.0, 71.4, (12, 49), 171.6, 40.0, 30.0),
        (75.0, 52.0, (13, 36), 68.7, 24.0, 27.6),
        (105.0, 74.0, (13, 36), 68.7, 12.0, 35.0),
    )
]


def touching(case):
    return PitchCones.touching(
        pinion_teeth=case["teeth"][0],
        gear_teeth=case["teeth"][1],
        offset=case["offset"] * 1e-3,
        shaft_angle=math.radians(case["shaft"]),
        gear_pitch_angle=math.radians(case["gear_angle"]),
        gear_pitch_radius=case["radius"] * 1e-3,
        gear_spiral_angle=math.radians(case["spiral"]),
    )


def unit(vector):
    return vector / np.linalg.norm(vector)


class InSpace:
    """Gear axis z, crossing points (0, 0, 0) and (0, a, 0), pinion body along `pinion_axis`."""

    def __init__(self, cones):
        sigma, delta2 = cones.shaft_angle, cones.gear_pitch_angle
        self.gear_axis = np.array([0.0, 0.0, 1.0])
        self.pinion_axis = np.array([math.sin(sigma), 0.0, math.cos(sigma)])
        foot = np.array([0.0, cones.offset, 0.0])
        self.gear_apex = -cones.gear_apex * self.gear_axis
        self.pinion_apex = foot - cones.pinion_apex * self.pinion_axis
        height = self.gear_apex[2] + cones.gear_mean_cone_distance * math.cos(delta2)
        # the pinion's mean point stands this far along its axis
        along = cones.pinion_mean_cone_distance * math.cos(cones.pinion_pitch_angle)
        along -= cones.pinion_apex
        radius = cones.gear_mean_cone_distance * math.sin(delta2)
        cosine = (along - height * self.pinion_axis[2]) / (radius * self.pinion_axis[0])
        self.point = np.array(
            [radius * cosine, radius * math.sqrt(1.0 - cosine**2), height],
        )
        self.pinion_line = self.point - self.pinion_apex
        self.gear_line = self.point - self.gear_apex

    def normal(self, axis, line):
        """Normal of the cone about `axis` through `line`, away from the axis."""
        outward = line - (line @ axis) * axis
        return unit(outward - (outward @ line) / (line @ line) * line)

    def speeds(self, cones):
        """Angular velocities in the ratio of teeth, in the sense in which the cones roll."""
        gear = self.gear_axis / cones.gear_teeth
        pinion = -self.pinion_axis / cones.pinion_teeth
        return pinion, gear

    def velocities(self, cones):
        pinion, gear = self.speeds(cones)
        return np.cross(pinion, self.pinion_line), np.cross(gear, self.gear_line)


@each("case", CASES)
def test_cones_touch_along_generators_whose_angles_follow_the_sliding(case):
    cones = touching(case)
    space = InSpace(cones)
    # the point found on the gear lies at the pinion's cone distance and angle, to rounding
    assert np.linalg.norm(space.pinion_line) == pytest.approx(
        cones.pinion_mean_cone_distance, rel=1e-12
    )
    cosine = unit(space.pinion_line) @ space.pinion_axis
    assert math.acos(cosine) == pytest.approx(cones.pinion_pitch_angle, rel=1e-12)
    normals = (
        space.normal(space.pinion_axis, space.pinion_line),
        space.normal(space.gear_axis, space.gear_line),
    )
    assert normals[0] @ normals[1] == pytest.approx(-1.0, abs=1e-14)
    # the generators include the offset angle
    angle = math.acos(unit(space.pinion_line) @ unit(space.gear_line))
    assert angle == pytest.approx(cones.offset_angle, rel=1e-10)
    assert angle == pytest.approx(cones.pinion_spiral_angle - cones.gear_spiral_angle, rel=1e-10)
    # speeds in the ratio of teeth leave no velocity across the teeth
    v1, v2 = space.velocities(cones)
    sliding = unit(v1 - v2)
    for line, spiral in (
        (space.pinion_line, cones.pinion_spiral_angle),
        (space.gear_line, cones.gear_spiral_angle),
    ):
        assert abs(sliding @ unit(line)) == pytest.approx(math.cos(spiral), rel=1e-11)


def limit_normal(space, cones):
    """Normal to the tooth at which the equation of meshing loses its time derivative.

    n . (w_1 x v_2 - w_2 x v_1) = 0 (Litvin and Fuentes, Gear Geometry and Applied Theory, 6.6).
    """
    v1, v2 = space.velocities(cones)
    w1, w2 = space.speeds(cones)
    tooth = unit(v1 - v2)
    return unit(np.cross(tooth, np.cross(w1, v2) - np.cross(w2, v1))), tooth


@each("case", CASES)
def test_limit_angle_and_curvature_are_those_of_the_limit_normal(case):
    cones = touching(case)
    space = InSpace(cones)
    normal, tooth = limit_normal(space, cones)
    tilt = abs(normal @ space.normal(space.gear_axis, space.gear_line))
    assert math.asin(tilt) == pytest.approx(abs(cones.limit_pressure_angle), rel=1e-9)
    # along the tooth the sliding turns a normal of curvature k as fast as the speeds do
    v1, v2 = space.velocities(cones)
    w1, w2 = space.speeds(cones)
    curvature = np.cross(w1 - w2, normal) @ tooth / np.linalg.norm(v1 - v2)
    # formula (33) has this curvature of the flank's normal section, not that of the trace, which
    # Meusnier's theorem puts at 1 / cos(alpha_lim) times as much (0.005 to 0.3 % more here)
    assert abs(curvature) == pytest.approx(abs(cones.limit_curvature), rel=1e-9)


def test_without_offset_the_cones_are_those_of_a_bevel_pair():
    angle = math.atan2(39, 14)
    cones = PitchCones.touching(
        pinion_teeth=14,
        gear_teeth=39,
        offset=0.0,
        shaft_angle=0.5 * math.pi,
        gear_pitch_angle=angle,
        gear_pitch_radius=0.0765,
        gear_spiral_angle=0.6,
    )
    assert cones.pinion_pitch_angle == pytest.approx(0.5 * math.pi - angle, rel=1e-14)
    assert cones.pinion_spiral_angle == pytest.approx(0.6, rel=1e-14)
    assert cones.pinion_mean_cone_distance == pytest.approx(
        cones.gear_mean_cone_distance, rel=1e-13
    )
    # both apexes in the crossing point, to rounding of 0.08 m
    assert cones.gear_apex == pytest.approx(0.0, abs=1e-15)
    assert cones.pinion_apex == pytest.approx(0.0, abs=1e-15)


@each("case", CASES)
def test_either_spiral_angle_leads_to_the_same_pair(case):
    cones = touching(case)
    other = PitchCones.touching(
        pinion_teeth=cones.pinion_teeth,
        gear_teeth=cones.gear_teeth,
        offset=cones.offset,
        shaft_angle=cones.shaft_angle,
        gear_pitch_angle=cones.gear_pitch_angle,
        gear_pitch_radius=cones.gear_pitch_radius,
        pinion_spiral_angle=cones.pinion_spiral_angle,
    )
    assert other.gear_spiral_angle == pytest.approx(cones.gear_spiral_angle, rel=1e-12)
    assert other.pinion_pitch_angle == pytest.approx(cones.pinion_pitch_angle, rel=1e-12)


def test_the_cutter_condition_of_method_2_puts_three_centres_on_a_line():
    design = HypoidDesign(
        pinion_teeth=9,
        gear_teeth=34,
        offset=0.03175,
        shaft_angle=0.5 * math.pi,
        gear_face_width=0.026,
        cutter=CutterHead(radius=0.076, blade_groups=13),
    )
    cones = method_2(design, mean_pitch_diameter=0.1467, gear_spiral_angle=math.radians(21.009))
    # pitch plane: mean point 0, gear apex on the negative real axis, tooth at -beta_m2
    gear_apex = -cones.gear_mean_cone_distance
    pinion_apex = -cones.pinion_mean_cone_distance * cmath.exp(-1j * cones.offset_angle)
    trace = design.gear_trace(cones)
    centre = gear_apex + trace.centre_distance * cmath.exp(
        1j * cmath.phase(pinion_apex - gear_apex)
    )
    assert abs(centre) == pytest.approx(design.cutter.radius, rel=1e-12)
    assert apex_misfit(design, cones) == pytest.approx(0.0, abs=1e-12)


HEADS = [
    (13, 76.0, 38.09, 82.17, 21.0),
    (5, 135.0, 51.7, 181.1, 30.0),
    (11, 64.0, 41.7, 79.6, 27.6),
]


def rolled(groups, radius, crown, cone, spiral):
    """Position and first two derivatives of a blade that rolls outside the crown gear."""
    trace = ToothTrace(
        cutter=CutterHead(radius=radius * 1e-3, blade_groups=groups),
        crown_teeth=crown,
        mean_cone_distance=cone * 1e-3,
        mean_spiral_angle=math.radians(spiral),
    )
    centre, r, turns = trace.centre_distance, radius * 1e-3, 1.0 + crown / groups

    def state(phi, start):
        arm, blade = cmath.exp(1j * phi), cmath.exp(1j * (start + turns * phi))
        return [(1j) ** n * (centre * arm + r * turns**n * blade) for n in range(3)]

    # blade angle at which its distance from the apex is the mean cone distance
    start = math.acos(((cone * 1e-3) ** 2 - centre**2 - r**2) / (2.0 * centre * r))
    return trace, state, start


@each("head", HEADS)
def test_curvature_at_the_mean_point_is_that_of_the_rolled_epicycloid(head):
    trace, state, start = rolled(*head)
    _, first, second = state(0.0, start)
    curvature = (first.conjugate() * second).imag / abs(first) ** 3
    assert trace.curvature_radius == pytest.approx(1.0 / abs(curvature), rel=1e-10)


@each("head", HEADS)
@each("roll", [-0.04, -0.02, 0.0, 0.02, 0.04])
def test_spiral_angle_is_that_of_the_rolled_epicycloid(head, roll):
    trace, state, start = rolled(*head)
    place, velocity, _ = state(roll, start)
    across = (velocity / place).imag
    along = (velocity / place).real
    assert abs(trace.spiral_angle(abs(place))) == pytest.approx(
        math.atan(abs(across / along)), rel=1e-10
    )


def test_the_trace_has_the_spiral_angle_asked_for_at_the_mean_point():
    for head in HEADS:
        trace, _, _ = rolled(*head)
        assert trace.spiral_angle(trace.mean_cone_distance) == pytest.approx(
            trace.mean_spiral_angle, rel=1e-12
        )


def test_face_milling_cuts_a_circle_of_the_cutter_radius():
    trace = ToothTrace(
        cutter=CutterHead(radius=0.0635, blade_groups=0),
        crown_teeth=45.2,
        mean_cone_distance=0.0763,
        mean_spiral_angle=0.67,
    )
    assert trace.lead_angle == 0.0
    assert trace.curvature_radius == pytest.approx(0.0635, rel=1e-12)
    # R sin(beta) of a circle: power of the apex, (R^2 - rho^2 + r^2) / (2 r)
    power = (0.08**2 - trace.centre_distance**2 + 0.0635**2) / (2.0 * 0.0635)
    assert 0.08 * math.sin(trace.spiral_angle(0.08)) == pytest.approx(power, rel=1e-12)
