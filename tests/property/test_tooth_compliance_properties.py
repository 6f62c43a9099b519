"""Symmetries, bounds and scaling of the condensed tooth compliance."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.tooth_compliance.flank_compliance import (
    CondensationSettings,
    FlankCompliance,
    interpolation_weights,
    projected,
    tooth_compliance,
)
from tests.helpers.compliance_cases import COARSE, spiral_tooth

SETTINGS = CondensationSettings(profile_hats=3, lengthwise_hats=4, density=COARSE)
TOOTH = spiral_tooth(neighbour_pitches=0.5, base_depth=8e-3)


@pytest.fixture(scope="module")
def flanks():
    return tooth_compliance(TOOTH, STEEL, SETTINGS)


def test_displacement_is_reciprocal_and_energy_positive(flanks):
    for flank in flanks:
        for matrix in (flank.image, flank.elastic):
            # round-off of an elimination with some thousand unknowns
            assert np.abs(matrix - matrix.T).max() < 1e-10 * np.abs(matrix).max()
        assert np.linalg.eigvalsh(flank.elastic)[0] > 0.0


def test_compliance_scales_with_one_over_size_and_modulus(flanks):
    scale = 2.5
    large = replace(
        TOOTH,
        left=scale * TOOTH.left,
        right=scale * TOOTH.right,
        slot_depth=scale * TOOTH.slot_depth,
        base_depth=scale * TOOTH.base_depth,
    )
    soft = replace(STEEL, youngs_modulus=STEEL.youngs_modulus / 3.0)
    for got, flank in zip(tooth_compliance(large, soft, SETTINGS), flanks, strict=True):
        # exact by dimensional analysis, up to round-off
        assert got.image * scale / 3.0 == pytest.approx(flank.image, rel=1e-8, abs=1e-17)
        assert got.elastic * scale / 3.0 == pytest.approx(flank.elastic, rel=1e-8, abs=1e-17)


def test_turning_the_gear_changes_nothing(flanks):
    turned = replace(
        TOOTH,
        left=TOOTH.rotated_points(TOOTH.left, 1.1),
        right=TOOTH.rotated_points(TOOTH.right, 1.1),
        inward=TOOTH.rotated_vectors(TOOTH.inward, 1.1),
    )
    for got, flank in zip(tooth_compliance(turned, STEEL, SETTINGS), flanks, strict=True):
        assert got.image == pytest.approx(flank.image, rel=1e-8, abs=1e-17)  # round-off


def test_the_mirrored_tooth_swaps_its_flanks(flanks):
    mirror = np.array([1.0, -1.0, 1.0])
    other_hand = replace(
        TOOTH, left=TOOTH.right * mirror, right=TOOTH.left * mirror, inward=TOOTH.inward * mirror
    )
    left, right = tooth_compliance(other_hand, STEEL, SETTINGS)
    assert left.image == pytest.approx(flanks[1].image, rel=1e-8, abs=1e-17)  # round-off
    assert right.image == pytest.approx(flanks[0].image, rel=1e-8, abs=1e-17)
    # the teeth are spiral: toe and heel make the two flanks differ
    assert np.abs(left.image / right.image - 1.0).max() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("more", [{"base_depth": 14e-3}, {"neighbour_pitches": 1.0}])
def test_a_larger_held_block_is_more_compliant(flanks, more):
    """The smaller block is the larger one with more of it held, so its energy is lower."""
    larger = tooth_compliance(replace(TOOTH, **more), STEEL, SETTINGS)
    for got, flank in zip(larger, flanks, strict=True):
        assert np.trace(got.elastic) > np.trace(flank.elastic)


def test_the_tip_is_more_compliant_than_the_root(flanks):
    for flank in flanks:
        own = np.diag(flank.image).reshape(3, 4)
        assert np.all(np.diff(own[:, 1:3], axis=0) > 0.0)


def test_weights_share_out_each_force_once_and_reproduce_bilinear_fields(flanks):
    rng = np.random.default_rng(2)
    s, t = rng.uniform(0.0, 1.0, (2, 50))
    W = interpolation_weights(s, t, flanks[0])
    assert W.sum(axis=1) == pytest.approx(np.ones(50), abs=1e-14)  # round-off
    field = 2.0 - 3.0 * flanks[0].s[:, None] + 5.0 * flanks[0].t[None, :]
    assert W @ field.ravel() == pytest.approx(2.0 - 3.0 * s + 5.0 * t, abs=1e-13)
    outside = interpolation_weights(np.array([-0.2, 1.3]), np.array([1.4, -0.1]), flanks[0])
    corners = interpolation_weights(np.array([0.0, 1.0]), np.array([1.0, 0.0]), flanks[0])
    assert np.array_equal(outside.toarray(), corners.toarray())


def test_projection_recovers_an_influence_function_from_its_averages():
    rng = np.random.default_rng(4)
    mass = np.array([[2.0, 1.0, 0.0], [1.0, 4.0, 1.0], [0.0, 1.0, 2.0]]) / 6.0
    nodal = rng.standard_normal((3, 3))
    nodal = nodal + nodal.T
    area = mass.sum(axis=1)
    averages = (mass / area[:, None]) @ nodal @ (mass / area[:, None]).T
    assert projected(averages, mass) == pytest.approx(nodal, abs=1e-13)  # round-off


def test_fields_are_those_of_the_grid(flanks):
    for flank in flanks:
        assert isinstance(flank, FlankCompliance)
        assert flank.image.shape == flank.elastic.shape == (flank.s.size * flank.t.size,) * 2
        assert (flank.s[0], flank.s[-1], flank.t[0], flank.t[-1]) == (0.0, 1.0, 0.0, 1.0)
