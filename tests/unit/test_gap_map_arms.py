"""Gaps of hypoid flanks that turning the pinion does not close."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact.gap_map import GapMap
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.strips import strip_frame


def gaps(gap: list[float], arm: list[float]) -> GapMap:
    points = np.zeros((1, len(gap), 3))
    return GapMap(np.array([gap]), points, points, points, points, np.array([arm]))


def test_gaps_with_an_arm_of_zero_or_less_close_at_no_rotation():
    """Two pitches away, flanks of 9 x 41 teeth move apart: inf over a negative arm was -inf."""
    found = gaps(
        [2e-6, math.inf, 1e-6, 3e-6, -1e-6], [0.02, -0.01, 0.0, math.nan, -0.02]
    ).touching_rotation
    np.testing.assert_array_equal(found, [[2e-6 / 0.02, *4 * [math.inf]]])


def test_a_strip_lies_on_the_contact_where_a_corner_of_the_gear_has_no_flank():
    """Points that the gear lacks are NaN; one of them was taken for the nearest to the contact."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, 5), np.linspace(-4.0, 4.0, 9), indexing="ij")
    point = 1e-3 * np.stack([x, y, 0.0 * x], axis=-1)
    normal = np.broadcast_to([0.0, 0.0, 1.0], point.shape).copy()
    gap = 1e-6 * (x**2 + 0.1 * y**2)
    for field in (point, normal):
        field[:2, 0] = math.nan
    gap[:2, 0] = math.inf
    frame = strip_frame(GapMap(gap, point, normal, point, point, np.full(gap.shape, 0.02)), 1.7e-6)
    np.testing.assert_allclose(np.abs(frame.along), [0.0, 1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(frame.centre, 0.0, atol=1e-9)
    # all columns touch: 8 mm and three halves of the step of 1 mm at both ends
    assert frame.half_length == pytest.approx(5.5e-3, rel=1e-6)


def test_the_first_contact_is_not_where_flanks_part():
    near, far = gaps([1e-6], [0.02]), gaps([math.inf], [-0.01])
    position = MeshPosition(None, 0.0, (0.0, 1.0), (near, far))
    assert position.unloaded_rotation == pytest.approx(5e-5)


def test_teeth_that_meet_nowhere_are_said_to_do_so():
    nowhere = gaps([math.inf], [0.02])
    position = MeshPosition(None, 0.25, (0.25,), (nowhere,))
    with pytest.raises(ConvergenceError, match=r"The teeth must meet at mesh phase 0\.250"):
        position.load(50.0, None, LoadedSettings())
