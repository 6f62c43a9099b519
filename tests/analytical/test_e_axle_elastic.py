"""The two-stage e-axle on elastic shafts, against a model of its own with 74 coordinates.

Expected numbers are of an independent assembly of the same axle (Timoshenko elements between the
nodes, one spring along the line of action of each mesh), which shares no code with this one.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.helpers.elastic_e_axle import case, whole

# Hz, the first is the rotation of the whole
FREQUENCIES = [
    0.0, 13.337, 18.161, 243.936, 386.290, 414.281, 424.434, 584.881, 627.780, 673.104, 688.795,
    706.606, 935.091, 960.007, 1265.502, 1652.565, 2164.082, 2573.121, 2767.650, 2855.994, 3367.901,
    3563.456, 5284.435, 5285.086, 5340.933, 5843.393, 5998.972, 6567.367, 6989.094, 7544.199,
]  # fmt: skip
HIGHEST = 69208.98
# N, on the shafts at their bearings, under 150 N.m with the wheels held
REACTIONS = {
    "input_fixed": (91.12, -65.27, 2761.60),
    "input_middle": (3141.98, 1099.16, 0.0),
    "input_end": (1745.53, 1568.59, 0.0),
    "counter_fixed": (117.47, -4463.31, 507.68),
    "counter_end": (1098.28, -5085.93, 580.36),
    "output_fixed": (1659.14, 6235.80, -1933.47),
    "output_end": (-7853.50, 710.97, -1916.16),
}


def test_all_frequencies_are_those_of_the_other_model():
    found, _ = whole().train.modes()
    assert found.size == 74
    # masses have six digits, frequencies three behind the point
    np.testing.assert_allclose(found[1:30], FREQUENCIES[1:], rtol=1e-6, atol=6e-4)
    assert found[0] == pytest.approx(0.0, abs=0.01)
    assert found[-1] == pytest.approx(HIGHEST, rel=1e-6)


def test_forces_of_meshes_and_bearings_are_those_of_the_other_model():
    outputs = whole().train.outputs()
    assert outputs["stage_1.load"] == pytest.approx(6259.8692, rel=1e-7)
    assert outputs["stage_2.load"] == pytest.approx(10072.1080, rel=1e-7)
    for name, forces in REACTIONS.items():
        found = [outputs[f"{name}.force.{c}"] for c in "xyz"]
        np.testing.assert_allclose(found, forces, atol=6e-3)  # digits given


def test_misalignment_of_the_second_mesh_is_that_of_the_other_model():
    """Tilt of the pinion against the wheel [rad]."""
    outputs = whole().train.outputs()
    tilts = [outputs[f"counter.pinion.tilt.{c}"] - outputs[f"output.gear.tilt.{c}"] for c in "xy"]
    np.testing.assert_allclose(tilts, [185.474e-6, -313.539e-6], atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("limit", "error"), [(1e4, 2e-3), (3e4, 1e-4)])
def test_few_modes_are_enough_below_five_kilohertz(limit: float, error: float):
    """The countershaft is short: all that it bends is flexibility above the first limit.

    Shapes of it count with frequencies of 1.5 times the limit, where they have inertia of their
    own: below 1 kHz, 15 times lower, that is 1e-4.
    """
    fine, few = case(highest_frequency_hz=1e6), case(highest_frequency_hz=limit)
    fine.start()
    few.start()
    below = fine.train.modes()[0]
    n = int((below < 5e3).sum())
    found = few.train.modes()[0]
    np.testing.assert_allclose(found[1:n], below[1:n], rtol=error)
    slow = int((below < 1e3).sum())
    np.testing.assert_allclose(found[1:slow], below[1:slow], rtol=1e-4)
