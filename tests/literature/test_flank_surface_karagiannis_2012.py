"""Do the printed machine settings cut a pair that meshes? Karagiannis et al. 2012, Table 1.

The table names settings without drawing them. Of all readings only one brings the pinion's cutter
to the gear's teeth; these tests keep the reading. Printed numbers have three decimals, 1 um and
0.001 deg.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import place_point
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    gear_cut,
    pinion_cut,
    reference_plane_distance,
)
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each
from tests.helpers.pressure_angle import pressure_angle_mismatch

FILE = HypoidGearFile.named("mohammadpour_2015")
# the settings as printed: nothing completed
PRINTED = FILE.varied(
    {
        "pinion.cutter.convex_flank_angle_correction_deg": 0.0,
        "pinion.cutter.concave_flank_angle_correction_deg": 0.0,
        "pinion.cutter.blade_edge_radius_mm": None,
        "gear.cutter.blade_edge_radius_mm": None,
    }
)
SIGNED = {
    "pinion.machine.machine_root_angle_deg": 0.202,
    "pinion.machine.machine_center_to_back_mm": -0.288,
    "pinion.machine.sliding_base_mm": 20.647,
    "pinion.machine.basic_swivel_angle_deg": -32.865,
}


def plane_distance(signs):
    changes = {k: sign * value for (k, value), sign in zip(SIGNED.items(), signs, strict=True)}
    varied = PRINTED.varied(changes)
    return abs(reference_plane_distance(pinion_cut(varied, "concave"), varied.blank()))


def test_the_pinion_cutters_plane_passes_the_mean_point():
    # two um: what three decimals of five lengths and three angles leave
    assert plane_distance((1, 1, 1, 1)) < 2e-6


def test_no_other_choice_of_signs_brings_the_plane_there():
    others = [s for s in itertools.product((1, -1), repeat=4) if s != (1, 1, 1, 1)]
    assert min(plane_distance(signs) for signs in others) > 0.23e-3


def printed_slot_spiral_angle(groups, role):
    """Spiral angle of the slot [deg] on the pitch cone, at a gear cone distance of 79.60 mm.

    Mean of both flanks; the pinion's point is the one that touches the gear's.
    """
    file = PRINTED.varied(
        {f"{member}.cutter.blade_groups": groups for member in ("pinion", "gear")}
    )
    blank = file.blank()
    shifted = replace(blank.gear, outer_cone_distance=79.60e-3 + 0.5 * blank.gear.face_width)
    point = replace(blank, gear=shifted).mean_point()
    angles = []
    for side in ("drive", "coast"):
        flank = Flank.from_file(file, role, side)
        w = point - flank.axis_point
        axial = w @ flank.axis
        s, t = flank.region.position(math.hypot(*np.cross(flank.axis, w)), axial)
        ahead, behind = (
            flank.sample(np.array(s), np.array(t + step)).r - flank.axis_point
            for step in (1e-3, -1e-3)
        )
        middle = 0.5 * (ahead + behind)
        radial = middle - (middle @ flank.axis) * flank.axis
        around = np.cross(flank.axis, radial / np.linalg.norm(radial))
        trace = ahead - behind
        along = math.sqrt(trace @ trace - (trace @ around) ** 2)
        angles.append(math.degrees(math.atan2(abs(trace @ around), along)))
    return float(np.mean(angles))


def test_eleven_blade_groups_give_the_printed_spiral_angles():
    """Table: 27.601 and 45.989 deg; not said: the blade groups. One group more or less: 1 deg."""
    gear = {n: printed_slot_spiral_angle(n, "gear") - 27.601 for n in (10, 11, 12)}
    pinion = {n: printed_slot_spiral_angle(n, "pinion") - 45.989 for n in (10, 11, 12)}
    # a quarter of a degree is left: 0.3 mm along the face
    assert abs(gear[11]) < 0.3
    assert abs(pinion[11]) < 0.3
    for n in (10, 12):
        assert abs(gear[n]) > 1.0
        assert abs(pinion[n]) > 0.8


@each(("groups", "angle"), [(10, 26.47), (11, 27.85), (12, 29.19)])
def test_gear_slot_has_the_spiral_angle_found_before(groups, angle):
    """From an independent evaluation of the same table; its cone distance is given to 0.01 mm."""
    assert printed_slot_spiral_angle(groups, "gear") == pytest.approx(angle, abs=0.02)


def test_eleven_blade_groups_share_no_factor_with_the_teeth():
    """Continuous indexing wants the groups coprime with both numbers of teeth."""
    groups = [n for n in (10, 11, 12) if math.gcd(n, 13) == math.gcd(n, 36) == 1]
    assert groups == [FILE.gear.cutter.blade_groups] == [11]


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_printed_blade_angles_fit_under_the_flank_they_cut(side):
    """Exchanged, as the words inside and outside would have it, they miss by 11.6 deg."""
    fitting = math.degrees(pressure_angle_mismatch(PRINTED, side))
    exchanged = PRINTED.varied(
        {
            "pinion.cutter.convex_flank_blade_angle_deg": 21.529,
            "pinion.cutter.concave_flank_blade_angle_deg": 16.743,
            "gear.cutter.convex_flank_blade_angle_deg": 22.436,
            "gear.cutter.concave_flank_blade_angle_deg": 15.815,
        }
    )
    # the residual that the blade angle corrections of the gear file complete
    assert abs(fitting) < 0.3
    # sum of both exchanges: 6.621 + 4.786 deg = 11.4 deg, less or more the residual
    assert abs(math.degrees(pressure_angle_mismatch(exchanged, side))) == pytest.approx(
        11.4, abs=0.3
    )


def test_residuals_of_both_sides_are_opposite():
    """A blade hook or a swivel tilts both flanks alike: one angle grows, the other shrinks."""
    drive, coast = (
        math.degrees(pressure_angle_mismatch(PRINTED, side)) for side in ("drive", "coast")
    )
    assert drive * coast < 0.0
    assert drive + coast == pytest.approx(0.0, abs=0.06)


def test_blade_faces_stand_normal_to_the_cutting_velocity():
    """Offset angles found before, in an independent evaluation of the same table."""

    def offset_angle(cut):
        return math.degrees(math.atan2(cut.motion.sin_offset, cut.motion.cos_offset))

    assert offset_angle(gear_cut(PRINTED, "convex")) == pytest.approx(16.7, abs=0.05)
    assert offset_angle(pinion_cut(PRINTED, "concave")) == pytest.approx(-17.5, abs=0.05)


def test_axial_blade_faces_would_double_the_pressure_angle_error():
    axial = PRINTED.varied(
        {f"{member}.cutter.blade_offset_angle_deg": 0.0 for member in ("pinion", "gear")}
    )
    for side in ("drive", "coast"):
        normal_to_velocity = abs(pressure_angle_mismatch(PRINTED, side))
        assert abs(pressure_angle_mismatch(axial, side)) > 1.6 * normal_to_velocity


def clearance_at_phase_zero(file, side):
    """Turn of the pinion [m at its mean pitch radius] until the flanks touch, gear at zero."""
    pair = FlankPair.from_file(file, side)
    points = pair.gear.grid(np.linspace(0.15, 0.95, 17), np.linspace(0.15, 0.85, 29)).r
    placed = pair.gear_placed(0.0)
    turns = []
    for point in points.reshape(-1, 3):
        at = np.array([*pair.pinion.start, pair.pinion_turn(0.0)])
        target = place_point(placed, Vector(*point))
        if intersect_rotation(pair.pinion.motion, pair.pinion_base, target, at) == HIT:
            turns.append(pair.touching_sign * pair.pinion_angle(at[3]))
    return min(turns) * file.blank().pinion.mean_pitch_radius


def test_drive_and_coast_flanks_leave_no_backlash_as_printed():
    """Each side alone is 11 um off: the residual pressure angles, opposite on the two sides."""
    drive, coast = (clearance_at_phase_zero(PRINTED, side) for side in ("drive", "coast"))
    # 1 um of printed decimals, and as much for the grid of points
    assert drive + coast == pytest.approx(0.0, abs=2e-6)
    assert 5e-6 < abs(drive) < 15e-6
