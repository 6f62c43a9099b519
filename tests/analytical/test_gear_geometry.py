"""Lines of action of gears of all kinds, and phases of their meshes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.gear_geometry import (
    excited_modes,
    fitting_angle,
    idler_delay,
    planets_fit,
    split_delay,
)
from gearlube_core.dynamics.train.gear_pair import GearPair
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.blank.pitch_cones import PitchCones
from tests.helpers.each import each

TWENTY = math.radians(20.0)
CONES = PitchCones.touching(
    pinion_teeth=9, gear_teeth=34, offset=31.75e-3, shaft_angle=math.pi / 2.0,
    gear_pitch_angle=math.radians(63.2), gear_pitch_radius=73.35e-3,
    gear_spiral_angle=math.radians(21.0),
)  # fmt: skip
FEW = {"name": "pair", "normal_module": 3e-3, "face_width": 0.03}
PAIRS = {
    "spur": GearPair(teeth_1=20, teeth_2=31, azimuth=0.3, **FEW),
    "helical": GearPair(
        teeth_1=20, teeth_2=31, helix_angle=0.4, right_hand=True, azimuth=2.0, arm_1=0.02,
        arm_2=-0.05, **FEW,
    ),
    "shifted": GearPair(teeth_1=20, teeth_2=31, helix_angle=0.2, centre_distance=0.0795, **FEW),
    "ring": GearPair(
        teeth_1=20, teeth_2=61, helix_angle=0.3, ring=True, azimuth=-1.0, drives_forward=False,
        **FEW,
    ),
    "bevel": GearPair(
        teeth_1=15, teeth_2=30, helix_angle=math.radians(35.0), cone_angle_1=math.atan(0.5),
        cone_angle_2=math.atan(2.0), azimuth=0.7, azimuth_2=1.9, right_hand=True, **FEW,
    ),
    "hypoid": GearPair(
        name="hypoid", teeth_1=9, teeth_2=34, normal_module=CONES.normal_module, face_width=0.03,
        helix_angle=CONES.pinion_spiral_angle, helix_angle_2=CONES.gear_spiral_angle,
        cone_angle_1=CONES.pinion_pitch_angle, cone_angle_2=CONES.gear_pitch_angle,
        azimuth=0.2, azimuth_2=-1.1,
    ),
}  # fmt: skip


def placed(pair: GearPair) -> tuple[Array, Array]:
    """Return the axes of gear 2 in those of gear 1, as a matrix, and its centre from that of 1."""
    one, two = pair.pitch_points()
    bases = [
        np.column_stack([p.along_tooth, p.drive, np.cross(p.along_tooth, p.drive)])
        for p in (one, two)
    ]
    turn = bases[0] @ bases[1].T
    return turn, one.place - turn @ two.place


@each("name", PAIRS)
def test_normals_are_unit_vectors_that_both_gears_share(name: str):
    one, two = PAIRS[name].pitch_points()
    turn, _ = placed(PAIRS[name])
    for mine, its in zip(one[1:], two[1:], strict=True):
        np.testing.assert_allclose([mine @ mine, its @ its], 1.0, rtol=1e-14)
        np.testing.assert_allclose(turn @ its, mine, atol=1e-13)


@each("name", PAIRS)
def test_teeth_over_teeth_turn_without_deflection(name: str):
    """Both flanks, with the gears turning as their teeth count, and the pair as one solid."""
    pair = PAIRS[name]
    one, two = pair.pitch_points()
    sense = 1.0 if pair.ring else -1.0
    for n_1, n_2 in ((one.drive, two.drive), (one.coast, two.coast)):
        first, second = np.cross(one.place, n_1)[2], np.cross(two.place, n_2)[2]
        closing = first * 1.0 - second * sense * pair.teeth_1 / pair.teeth_2
        assert abs(closing) < 1e-13 * abs(first), name
    turn, centre = placed(pair)
    spin, drift = np.array([0.3, -0.5, 0.7]), np.array([0.1, 0.2, -0.4])
    for n_1, n_2 in ((one.drive, two.drive), (one.coast, two.coast)):
        of_first = n_1 @ drift + np.cross(one.place, n_1) @ spin
        moved = turn.T @ (drift + np.cross(spin, centre))
        of_second = n_2 @ moved + np.cross(two.place, n_2) @ (turn.T @ spin)
        assert abs(of_first - of_second) < 1e-13


def test_axes_of_bevel_gears_meet_at_the_shaft_angle():
    turn, centre = placed(PAIRS["bevel"])
    np.testing.assert_allclose(turn[2, 2], 0.0, atol=1e-15)  # 90 deg
    axes = np.column_stack([[0.0, 0.0, 1.0], turn[:, 2], centre])
    assert abs(np.linalg.det(axes)) < 1e-16


def test_axes_of_hypoid_gears_cross_at_the_offset_of_their_cones():
    """Against pitch cones that were found from shaft angle and offset, ISO 23509."""
    turn, centre = placed(PAIRS["hypoid"])
    across = np.cross([0.0, 0.0, 1.0], turn[:, 2])
    angle = math.acos(turn[2, 2])
    assert angle == pytest.approx(CONES.shaft_angle, abs=1e-9)
    # the cones are solved to 1e-9
    offset = abs(centre @ across) / np.linalg.norm(across)
    assert offset == pytest.approx(CONES.offset, rel=1e-8)


@each("sense, axial, radial", [(1.0, 0.824993, 0.084275), (-1.0, -0.427576, 0.710559)])
def test_thrust_of_spiral_bevel_pinions(sense: float, axial: float, radial: float):
    """Gleason's formula at 35 deg of spiral and tan(cone angle) = 0.5, over the tangential force.

    Fx = [tan(an) sin g + s sin m cos g]/cos m, away from the apex; Fr likewise.
    """
    pair = GearPair(
        teeth_1=15, teeth_2=30, helix_angle=math.radians(35.0), cone_angle_1=math.atan(0.5),
        cone_angle_2=math.atan(2.0), right_hand=sense > 0.0, **FEW,
    )  # fmt: skip
    on_pinion = -pair.pitch_points()[0].drive
    tangential = abs(on_pinion[1])
    # printed with six digits
    assert on_pinion[2] / tangential == pytest.approx(axial, abs=1e-6)
    assert -on_pinion[0] / tangential == pytest.approx(radial, abs=1e-6)


def test_thrust_of_both_hypoid_gears():
    """The same formula with cone and spiral angle of each member; the drive flank pushes the gear.

    Tangential forces are as the cosines of the spiral angles.
    """
    pair = PAIRS["hypoid"]
    points = pair.pitch_points()
    spiral = CONES.pinion_spiral_angle, CONES.gear_spiral_angle
    cone = CONES.pinion_pitch_angle, CONES.gear_pitch_angle
    # a left hand that drives about +z: -1; a right hand, driven, about -z: +1
    for k, (sign, hand) in enumerate(((-1.0, -1.0), (1.0, 1.0))):
        force, place = sign * points[k].drive, points[k].place
        outwards = place * (1.0, 1.0, 0.0) / np.hypot(*place[:2])
        around = np.cross([0.0, 0.0, 1.0], outwards)
        tangential = abs(force @ around)
        assert tangential == pytest.approx(math.cos(TWENTY) * math.cos(spiral[k]), rel=1e-12)
        lean, slope = math.tan(TWENTY) / math.cos(spiral[k]), hand * math.tan(spiral[k])
        axial = lean * math.sin(cone[k]) + slope * math.cos(cone[k])
        radial = lean * math.cos(cone[k]) - slope * math.sin(cone[k])
        assert force[2] / tangential == pytest.approx(axial, rel=1e-9)
        assert -(force @ outwards) / tangential == pytest.approx(radial, rel=1e-9)


def test_thrust_of_helical_gears_is_tangent_of_the_helix_angle():
    on_first = -PAIRS["helical"].pitch_points()[0].drive
    across = on_first - on_first[2] * np.array([0.0, 0.0, 1.0])
    c = np.array([math.cos(2.0), math.sin(2.0), 0.0])
    tangential = np.linalg.norm(across - (across @ c) * c)
    assert on_first[2] / tangential == pytest.approx(math.tan(0.4))  # right-hand driver about +z
    assert -(across @ c) / tangential == pytest.approx(math.tan(TWENTY) / math.cos(0.4))


def test_line_of_action_is_that_of_the_helical_pair():
    """Base radii, base helix and working pressure angle of the gears of He et al. 2007."""
    given = helical_march_parameters(HelicalGearFile.named("he_2007")).pair
    pair = GearPair(
        name="he_2007", teeth_1=given.pinion_teeth, teeth_2=given.gear_teeth,
        normal_module=given.normal_module, normal_pressure_angle=given.normal_pressure_angle,
        helix_angle=given.helix_angle, centre_distance=given.centre_distance,
        face_width=given.face_width,
    )  # fmt: skip
    n, plane = pair.pitch_points()[0].drive, given.plane
    arm = np.cross(pair.pitch_points()[0].place, n)[2]
    np.testing.assert_allclose(arm, plane.r_bp * plane.cos_b, rtol=1e-13)
    np.testing.assert_allclose(abs(n[2]), plane.sin_b, rtol=1e-13)
    np.testing.assert_allclose(math.atan2(n[0], n[1]), given.working_pressure_angle, rtol=1e-13)


def test_contact_ratio_counts_addenda_of_one_module():
    """Rack formula: two equal gears of very many teeth reach 4/(pi sin(2 a))."""
    pair = GearPair(teeth_1=10_000, teeth_2=10_000, **FEW)
    assert pair.contact_ratio == pytest.approx(4.0 / (math.pi * math.sin(2.0 * TWENTY)), rel=2e-3)


def test_sequence_of_meshes_of_a_planetary_set():
    """Parker and Lin 2004, planets turning about -z: z_s psi/2 pi at the sun, -z_r psi/2 pi."""
    sun, planet, ring = 27, 35, 97
    first = fitting_angle(sun, planet, 0.0, 0.0)
    for azimuth in (2.0 * np.pi * k / 4 for k in range(4)):
        assert split_delay(sun, 0.0, azimuth) == pytest.approx(sun * azimuth / (2.0 * np.pi) % 1.0)
        # the planet that a tooth of the sun lets in at its azimuth, and where the ring meets it
        turned = fitting_angle(sun, planet, 0.0, azimuth) - azimuth - first
        cycles = planet * turned / (2.0 * np.pi) + ring * azimuth / (2.0 * np.pi)
        assert cycles == pytest.approx(round(cycles), abs=1e-9)
    for teeth, delay in ((35, 0.0), (36, 0.5)):  # opposite meshes: half a tooth, and the thickness
        assert idler_delay(teeth, 0.0, np.pi) == pytest.approx(delay, abs=1e-12)


@each("sun, planets, wanted", [(27, 4, "FPF"), (28, 4, "TTT"), (30, 4, "PTP"), (73, 5, "PFF")])
def test_harmonics_select_the_modes_that_sums_of_phasors_leave(sun: int, planets: int, wanted: str):
    """Whether forces of all planets on the sun leave a torque, a force, or neither."""
    azimuth = 2.0 * np.pi * np.arange(planets) / planets
    words = {"T": "rotational", "F": "translational", "P": "planet"}
    for harmonic, letter in enumerate(wanted, 1):
        phasor = np.exp(1j * harmonic * sun * azimuth)
        torque = abs(phasor.sum())
        force = max(abs((phasor * np.exp(s * 1j * azimuth)).sum()) for s in (1, -1))
        assert letter == ("T" if torque > 0.5 else "F" if force > 0.5 else "P")
        assert excited_modes(sun, planets, harmonic) == words[letter]


def test_one_gear_has_its_teeth_at_one_angle_in_all_meshes_whose_phase_counts():
    """A tooth of the sun at 0 deg faces a gap of the planet at 180 deg: 17 teeth then stand at 0.

    With 18 teeth of the planet 180 deg is 9 pitches, and its teeth stand half a pitch, 10 deg, off.
    """
    for planet, right in ((17, 0.0), (18, 10.0)):
        given = {"normal_module": 0.045, "face_width": 0.5, "backlash": 5e-4, "carrier": "arm",
                 "stiffness_waves": (0.1, 0.0)}  # fmt: skip
        sun = GearMesh(name="sun", first="s", second="p", teeth_1=19, teeth_2=planet, **given)
        turned = [
            GearMesh(name="ring", first="p", second="r", teeth_1=planet, teeth_2=19 + 2 * planet,
                     ring=True, keyed_angle=math.radians(angle), **given)
            for angle in (right, right + 360.0 / planet, right + 4.0)
        ]  # fmt: skip
        orbit = Orbit(name="o", body="p", carrier="arm", mass=1.0,
                      radius=0.0225 * (19 + planet))  # fmt: skip
        for ring in turned[:2]:
            sun.fits((), (sun, ring, orbit))
        words = rf"gear of p with {planet} teeth .* 4 deg apart .* a keyed_angle of {right:g} deg, "
        with pytest.raises(ParameterError, match=words):
            sun.fits((), (sun, turned[2], orbit))
        smooth = [replace(one, stiffness_waves=()) for one in (sun, turned[2])]  # no phase
        smooth[0].fits((), (*smooth, orbit))


def test_planets_fit_where_the_teeth_of_sun_and_ring_are_a_multiple_of_them():
    for planets, fits in ((3, True), (5, True), (4, False)):
        azimuths = tuple(2.0 * np.pi * k / planets for k in range(planets))
        assert planets_fit(19, 56, azimuths) is fits
