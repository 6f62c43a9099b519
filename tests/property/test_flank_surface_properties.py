"""What must hold for every pair: size scales, the cradle angle is a phase, teeth are alike."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.machine_check import reference_misfit
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes

FILE = HypoidGearFile.named("mohammadpour_2015")
LENGTHS = [name for name, note in field_notes(HypoidGearFile).items() if note.unit == "mm"]
S, T = np.linspace(0.4, 1.0, 4), np.linspace(0.1, 0.9, 4)


def value(field):
    here = FILE
    for part in field.split("."):
        if here is None:  # an optional section that this file leaves out
            return None
        here = getattr(here, part)
    return here


def larger(factor):
    given_lengths = {name: value(name) for name in LENGTHS if value(name) is not None}
    return FILE.varied({name: factor * length for name, length in given_lengths.items()})


# few examples: a gear file is evaluated in 0.1 s
@settings(max_examples=5, deadline=None)
@given(factor=st.floats(0.5, 1.8), role=st.sampled_from(["pinion", "gear"]))
def test_a_larger_gear_is_the_same_gear_enlarged(factor, role):
    for side in ("drive", "coast"):
        small = Flank.from_file(FILE, role, side).grid(S, T)
        large = Flank.from_file(larger(factor), role, side).grid(S, T)
        # located to 1e-11 of 2 mm; curvatures amplify that by their change along the flank
        np.testing.assert_allclose(large.r, factor * small.r, rtol=0.0, atol=1e-11)
        np.testing.assert_allclose(large.normal, small.normal, rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(factor * large.curvature, small.curvature, rtol=1e-7, atol=1e-6)


@pytest.mark.slow
@settings(max_examples=5, deadline=None)
@given(phase=st.floats(-40.0, 40.0))
def test_the_basic_cradle_angle_is_a_phase_only(phase):
    """Cutter centre and tilt turn with it: the same pinion leaves the machine, turned."""
    q = FILE.pinion.machine.basic_cradle_angle_deg
    turned = FILE.varied({"pinion.machine.basic_cradle_angle_deg": q + phase})
    assert reference_misfit(turned, "pinion") == pytest.approx(
        reference_misfit(FILE, "pinion"), abs=1e-12
    )
    before, after = Tooth.from_file(FILE, "pinion"), Tooth.from_file(turned, "pinion")
    # located to 1e-11 of 0.1 rad
    np.testing.assert_allclose(
        after.thickness_angle(S, T), before.thickness_angle(S, T), rtol=0.0, atol=1e-9
    )
    np.testing.assert_allclose(
        after.drive.grid(S, T).curvature, before.drive.grid(S, T).curvature, rtol=1e-7, atol=1e-6
    )


@settings(max_examples=5, deadline=None)
@given(correction=st.floats(-1.0, 1.0), side=st.sampled_from(["drive", "coast"]))
def test_points_stay_on_the_flank_whatever_the_blade_angle(correction, side):
    """Places are asked for in the axial section; the cut point must stand in it."""
    file = FILE.varied(
        {
            "pinion.cutter.convex_flank_angle_correction_deg": correction,
            "pinion.cutter.concave_flank_angle_correction_deg": correction,
        }
    )
    flank = Flank.from_file(file, "pinion", side)
    sample = flank.grid(S, T)
    w = sample.r - flank.axis_point
    axial = w @ flank.axis
    s, t = flank.region.position(np.linalg.norm(np.cross(flank.axis, w), axis=-1), axial)
    np.testing.assert_allclose(s, np.broadcast_to(S[:, None], s.shape), rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(t, np.broadcast_to(T[None, :], t.shape), rtol=0.0, atol=1e-9)
    assert (sample.regularity > 0.0).all()
