"""Geometry that cannot be a tooth is refused with a cure."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.errors import ParameterError
from gearlube_core.tooth_compliance.flank_compliance import (
    CondensationSettings,
    interpolation_weights,
    tooth_compliance,
)
from gearlube_core.tooth_compliance.tooth_mesh import (
    MeshDensity,
    graded_thickness,
    smallest_scaled_jacobian,
    tooth_mesh,
)
from tests.helpers.compliance_cases import COARSE, spiral_tooth
from tests.helpers.each import each

TOOTH = spiral_tooth(neighbour_pitches=1.0, base_depth=12e-3)


def test_flanks_of_different_shape_are_refused():
    with pytest.raises(ParameterError, match="Sample both flanks with one grid"):
        replace(TOOTH, left=TOOTH.left[:-1])


def test_grids_that_are_no_grids_are_refused():
    with pytest.raises(ParameterError, match="Axis 0 runs root to tip"):
        replace(TOOTH, left=TOOTH.left[0])
    with pytest.raises(ParameterError, match="finite coordinates"):
        replace(TOOTH, right=np.where(TOOTH.right > 0.0, np.nan, TOOTH.right))


def test_swapped_flanks_are_refused():
    with pytest.raises(ParameterError, match="swap the"):
        tooth_mesh(replace(TOOTH, left=TOOTH.right, right=TOOTH.left), COARSE)


def test_flanks_from_tip_to_root_are_refused():
    upside_down = replace(TOOTH, left=TOOTH.left[::-1], right=TOOTH.right[::-1])
    with pytest.raises(ParameterError, match="root first"):
        tooth_mesh(upside_down, COARSE)


@pytest.mark.parametrize("name", ["base_depth", "slot_depth"])
def test_negative_depths_are_refused(name):
    with pytest.raises(ParameterError, match=r"above 0 m, got -0\.001 m"):
        replace(TOOTH, **{name: -1e-3})


def test_a_slot_too_deep_for_its_width_is_refused():
    with pytest.raises(ParameterError, match="Reduce slot_depth"):
        tooth_mesh(replace(TOOTH, slot_depth=15e-3), COARSE)


def test_a_block_deeper_than_the_gear_is_refused():
    with pytest.raises(ParameterError, match="reduce base_depth"):
        tooth_mesh(replace(TOOTH, base_depth=0.3), COARSE)


@each(
    ("change", "cure"),
    [
        ({"inward": np.zeros((25, 3))}, "zero vector"),
        ({"inward": np.ones((3, 3))}, "direction for each station"),
        ({"axis_direction": np.zeros(3)}, "axis_direction"),
        ({"axis_point": np.array([0.0, np.nan, 0.0])}, "axis_point"),
        ({"teeth": 2}, "number of teeth"),
        ({"neighbour_pitches": 9.0}, "neighbour_pitches"),
    ],
)
def test_bad_frames_are_refused(change, cure):
    with pytest.raises(ParameterError, match=cure):
        replace(TOOTH, **change)


def test_counts_are_checked():
    with pytest.raises(ParameterError, match="fillet"):
        MeshDensity(fillet=0)
    with pytest.raises(ParameterError, match="profile_hats"):
        CondensationSettings(profile_hats=1)
    with pytest.raises(ParameterError, match="Choose 12 or 18"):
        CondensationSettings(profile_hats=7, density=MeshDensity(profile=16))


def test_points_that_are_not_finite_are_refused():
    settings = CondensationSettings(profile_hats=3, lengthwise_hats=4, density=COARSE)
    left, _ = tooth_compliance(TOOTH, STEEL, settings)
    with pytest.raises(ParameterError, match="finite"):
        interpolation_weights(np.array([np.nan]), np.array([0.5]), left)


@pytest.mark.parametrize("teeth", [36, 13])
def test_default_mesh_has_no_flat_element(teeth):
    size = {} if teeth == 36 else {"outer_radius": 40e-3, "pitch_angle": 0.52, "spiral_angle": 0.8}
    mesh = tooth_mesh(
        spiral_tooth(teeth=teeth, neighbour_pitches=1.0, base_depth=12e-3, **size), MeshDensity()
    )
    # skewed by a spiral angle of 46 deg a brick has 0.7; fillets take the rest
    assert smallest_scaled_jacobian(mesh.solid) > 0.1


def test_thickness_grows_from_both_flanks():
    a = graded_thickness(MeshDensity(thickness=3, growth=2.0))
    assert a == pytest.approx(np.array([0, 1, 3, 7, 11, 13, 14]) / 14.0, abs=1e-15)
