"""Macro geometry of helical pairs: what is refused, and sharing of load by length."""

import dataclasses
import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.load_sharing import (
    relief_on_path,
    shared_load,
    unrelieved_plane,
)
from gearlube_core.helical_geometry.meshing_steps import line_at_position
from gearlube_core.helical_geometry.modification import FlankModification, ModifiedPair, TipRelief
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair

HE = named_pair("he_2007")


@each(
    ("changes", "words"),
    [
        ({"pinion_teeth": 3}, "pinion_teeth must be within 5 to 1000, got 3"),
        ({"normal_module": 2.95}, "normal_module must be within .* m, got 2.95 m. Give metres"),
        ({"normal_pressure_angle": 23.0}, "normal_pressure_angle must be .* rad. Give radians"),
        ({"helix_angle": -0.1}, "helix_angle must be within 0 to 0.785398 rad, got -0.1 rad"),
        ({"face_width": 0.0}, "face_width must be above 0 m, got 0 m"),
        ({"backlash": -1e-6}, "backlash must be within 0 to"),
        ({"centre_distance": 0.07}, "centre_distance must be within .* sum of the base radii"),
        ({"pinion_tip_radius": 0.03}, "pinion_tip_radius must be within"),
        ({"gear_root_radius": 0.06}, "gear_root_radius must be within"),
        (
            {"gear_tip_radius": 0.060},
            "Contact must lie between the tangent points.* the teeth interfere",
        ),
        (
            {"pinion_tip_radius": 0.0405, "gear_tip_radius": 0.0499, "face_width": 1e-3},
            "total contact ratio must exceed 1, got 0.4",
        ),
    ],
)
def test_impossible_pairs_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        dataclasses.replace(HE, **changes)


def test_closed_forms_of_the_pair_agree_with_each_other():
    """Identities of parallel-axis involute gears, each by another route."""
    b = HE.base_helix_angle
    # sin(beta_b) = sin(beta) cos(alpha_n), the normal-plane form of the base helix.
    assert math.sin(b) == pytest.approx(
        math.sin(HE.helix_angle) * math.cos(HE.normal_pressure_angle), rel=1e-12
    )
    # Normal base pitch pi m_n cos(alpha_n) is the transverse one times cos(beta_b).
    normal_pitch = math.pi * HE.normal_module * math.cos(HE.normal_pressure_angle)
    assert HE.base_pitch * math.cos(b) == pytest.approx(normal_pitch, rel=1e-12)
    # Overlap: face width over axial pitch.
    axial_pitch = math.pi * HE.normal_module / math.sin(HE.helix_angle)
    assert HE.overlap_ratio == pytest.approx(HE.face_width / axial_pitch, rel=1e-12)
    assert HE.ratio == pytest.approx(HE.gear_base_radius / HE.pinion_base_radius, rel=1e-12)
    assert HE.mesh_frequency(1000.0 * math.pi / 30.0) == pytest.approx(25 * 1000.0 / 60.0)
    # Exchanged gears have the mirrored line of action.
    swapped = dataclasses.replace(
        HE,
        pinion_teeth=31,
        gear_teeth=25,
        pinion_tip_radius=HE.gear_tip_radius,
        gear_tip_radius=HE.pinion_tip_radius,
        pinion_root_radius=HE.gear_root_radius,
        gear_root_radius=HE.pinion_root_radius,
    )
    assert swapped.contact_start == pytest.approx(HE.tangent_length - HE.contact_end, rel=1e-12)
    assert swapped.pitch_point == pytest.approx(HE.tangent_length - HE.pitch_point, rel=1e-12)
    assert swapped.total_contact_ratio == pytest.approx(HE.total_contact_ratio, rel=1e-12)


def relieved(extent):
    flank = FlankModification(tip_relief=TipRelief(amount=20e-6, extent=extent, k=1.0))
    return ModifiedPair(pair=HE, pinion=flank, gear=flank)


def test_relief_ends_where_equations_2_14_and_2_15_put_it():
    plane = unrelieved_plane(relieved(1e-3))
    z_p = relief_on_path(HE.pinion_tip_radius, HE.pinion_base_radius, 1e-3)
    z_w = relief_on_path(HE.gear_tip_radius, HE.gear_base_radius, 1e-3)
    ends = HE.contact_start + z_w, HE.contact_end - z_p
    got = plane.A, plane.D
    assert got == pytest.approx(ends, rel=1e-12)
    assert relief_on_path(0.05, 0.04, 0.0) == 0.0


def test_position_of_a_line_is_its_s_i_on_the_lower_face():
    x = line_at_position([-2e-3, 0.0, 3e-3], HE)
    low = x - HE.face_width * math.tan(HE.base_helix_angle)
    assert low - HE.pitch_point == pytest.approx([-2e-3, 0.0, 3e-3], abs=1e-15)


def test_line_without_contact_carries_nothing():
    shared = shared_load(np.array([HE.contact_start - 1e-3, HE.pitch_point]), relieved(1e-4), 10.0)
    assert (shared.length[0], shared.share[0], shared.load[0], shared.line_load[0]) == (0, 0, 0, 0)
    assert shared.load[1] > 0.0


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: shared_load(0.02, relieved(1e-3), 0.0), "torque must be above 0 N.m"),
        (
            lambda: shared_load(0.02, relieved(1e-3), 1.0, "printed"),
            "must be one of normal, thesis",
        ),
        (lambda: unrelieved_plane(relieved(5e-3)), "limit 0 mm.* Shorten the relief"),
        (lambda: relief_on_path(0.05, 0.04, 0.011), "depth must be within 0 to 0.01 m"),
    ],
)
def test_what_makes_no_sense_is_refused(call, words):
    with pytest.raises(ParameterError, match=words):
        call()


def test_relief_that_leaves_no_contact_at_some_phase_is_refused():
    """A spur pair whose unrelieved path is shorter than the base pitch."""
    file = HelicalGearFile.named("he_2007").varied({"pair.helix_angle_deg": 0.0})
    spur = file.helical_pair()
    flank = FlankModification(tip_relief=TipRelief(amount=20e-6, extent=2e-3, k=1.0))
    modified = ModifiedPair(pair=spur, pinion=flank, gear=flank)
    plane = unrelieved_plane(modified)
    path = plane.D - plane.A
    assert path < spur.base_pitch
    within = plane.A + 0.5 * path
    assert shared_load(np.array([within]), modified, 10.0).share == pytest.approx([1.0])
    with pytest.raises(ParameterError, match=f"above 0 m .* at X = {plane.D + 1e-6:.6g} m"):
        shared_load(np.array([within, plane.D + 1e-6]), modified, 10.0)
