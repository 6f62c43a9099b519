"""What every sweep of the torsional pair does."""

import numpy as np
import pytest
from torsional_cases import reconstructed

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.time_sweep import time_sweep

NATURAL = HypoidTorsional(reconstructed()).natural_frequency
FEW = {"periods": 150, "steps_per_mesh_period": 64}


def test_up_and_down_part_where_two_motions_coexist():
    """Backlash softens: below resonance contact and separation are both stable."""
    ratios = np.arange(0.75, 1.11, 0.05)
    up = time_sweep(reconstructed(), NATURAL * ratios, "up", **FEW)
    down = time_sweep(reconstructed(), NATURAL * ratios, "down", **FEW)
    assert np.all(np.diff(up.frequency) > 0.0)
    assert np.all(np.diff(down.frequency) < 0.0)
    rise = down.peak_to_peak[::-1] / up.peak_to_peak
    i = int(np.argmax(rise))
    assert rise[i] > 3.0
    assert ratios[i] < 1.0
    assert up.separation_share[i] == 0.0
    assert down.separation_share[::-1][i] > 0.0
    assert rise[0] == pytest.approx(1.0, abs=1e-2)
    assert rise[-1] == pytest.approx(1.0, abs=1e-2)


def test_records_are_consistent_with_their_summary():
    sweep = time_sweep(reconstructed(0.003), NATURAL * np.array([0.6, 1.0]), "up", **FEW)
    x, force = sweep.record[:, :, 1], sweep.record[:, :, 4]
    assert sweep.peak_to_peak == pytest.approx(np.ptp(x, axis=1))
    assert np.array_equal(sweep.impact, [0, 1])
    # no pull on the drive flank, no force in the gap
    assert np.all(force >= 0.0)
    assert np.all(force[x < 0.0] == 0.0)
    # mesh orders bound the swing they make up; the second motion has subharmonics beside
    assert 2.0 * sweep.harmonics[0].sum() > 0.99 * sweep.peak_to_peak[0]
    # losses against a hold of 0.05 N.m s/rad
    assert sweep.mean_speed == pytest.approx(2 * np.pi * sweep.frequency / 13, rel=0.01)


def test_a_rotation_of_phase_zero_changes_nothing():
    """Stiffness and error moved along by a quarter of a mesh period, the motion with them."""
    still = time_sweep(
        reconstructed(form="one_dof", mesh={"stiffness_harmonics": ((0.07, 0.0),)}),
        [0.6 * NATURAL], "up", **FEW,
    )  # fmt: skip
    moved = time_sweep(
        reconstructed(
            form="one_dof",
            mesh={
                "stiffness_harmonics": ((0.0, 0.07),),
                "error_harmonics": ((0.0, 0.96e-6),),
            },
        ),
        [0.6 * NATURAL], "up", **FEW,
    )  # fmt: skip
    assert moved.peak_to_peak == pytest.approx(still.peak_to_peak, rel=1e-4)
