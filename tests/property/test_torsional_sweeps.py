"""What every sweep of the torsional pair does."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.time_sweep import time_sweep
from gearlube_core.periodic.shooting import solve_periodic
from tests.helpers.torsional_cases import reconstructed

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
    assert sweep.separation_share == pytest.approx(np.mean(x < 0.0, axis=1))
    # the load is fitted in eight revolutions, while the second motion still settles
    assert sweep.mean_speed == pytest.approx(2 * np.pi * sweep.frequency / 13, rel=5e-3)


def test_the_load_gives_way_to_losses_and_the_speed_stays():
    """Sliding takes 1 to 2 % of the power; a load that ignores it would slow the pair."""
    parameters = replace(karagiannis_2012_pair(), friction="evans_johnson")
    model = HypoidTorsional(parameters)
    frequency = model.natural_frequency * np.array([0.3, 0.65])
    sweep = time_sweep(parameters, frequency, "up", periods=260, steps_per_mesh_period=64)
    assert sweep.mean_speed == pytest.approx(2 * np.pi * frequency / 13, rel=1e-4)  # 6e-3 without
    loss = 1.0 - sweep.load_torque / model.mean_load_torque
    assert np.all((loss > 0.005) & (loss < 0.02))
    # what continuation finds as an unknown
    problem = PeriodProblem(parameters, steps_per_mesh_period=64)
    speed = model.pinion_speed(frequency[0])
    z = solve_periodic(problem.equations(), problem.initial_guess(speed), speed).unknowns
    assert sweep.load_torque[0] == pytest.approx(z[3], rel=1e-4)


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
