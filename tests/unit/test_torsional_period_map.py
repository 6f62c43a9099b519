"""Derivatives of the period map, and the problem it states for shooting."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.time_sweep import time_sweep
from gearlube_core.errors import ParameterError
from gearlube_core.periodic.shooting import solve_periodic
from tests.helpers.each import each
from tests.helpers.torsional_cases import reconstructed

# speed over natural frequency; x0 off static deflection [um]; 13 periods cost time, not insight
CASES = {
    "contact": (lambda: PeriodProblem(reconstructed(0.003)), 0.5, -1.0),
    "impacts": (lambda: PeriodProblem(reconstructed(0.003)), 1.0, -3.0),
    "as printed": (
        lambda: PeriodProblem(
            reconstructed(
                0.003, damping_gate="as_printed", equations="as_printed",
                load_torque="instantaneous",
            )
        ),
        0.9,
        -2.5,
    ),
    "one degree of freedom": (lambda: PeriodProblem(reconstructed(form="one_dof")), 1.0, -2.0),
    "ripple over a revolution": (
        lambda: PeriodProblem(
            reconstructed(0.002, torque_ripple=0.1), periods=13, steps_per_mesh_period=64
        ),
        0.5,
        0.0,
    ),
    "friction": (
        lambda: PeriodProblem(
            replace(karagiannis_2012_pair(), friction="thermal_eyring"), steps_per_mesh_period=64
        ),
        0.4,
        0.5,
    ),
}  # fmt: skip


@each("case", CASES)
def test_derivatives_are_those_of_the_map(case):
    made, ratio, off = CASES[case]
    problem = made()
    speed = problem.model.pinion_speed(ratio * problem.model.natural_frequency)
    z = problem.initial_guess(speed)
    z[0] += off
    _, by_z, by_speed, monodromy = problem.residual(z, speed)
    direct = np.empty_like(by_z)
    for i, scale in enumerate(problem.scales):
        h = np.zeros(z.size)
        h[i] = 1e-5 * scale
        above, below = problem.residual(z + h, speed)[0], problem.residual(z - h, speed)[0]
        direct[:, i] = (above - below) / (2.0 * h[i])
    h = 1e-3
    above, below = problem.residual(z, speed + h)[0], problem.residual(z, speed - h)[0]
    # both differences round: the map's at 1e-16 R_p w_p/1e-5 um, the tangent's likewise
    assert np.max(np.abs(by_z - direct) / np.abs(by_z).max(axis=0)) < 1e-6
    assert by_speed == pytest.approx((above - below) / (2.0 * h), abs=1e-6 * abs(by_speed).max())
    m = monodromy.shape[0]
    assert monodromy - np.eye(m) == pytest.approx(by_z[:m, :m], abs=1e-12)


@pytest.mark.parametrize("form", ["two_dof", "one_dof"])
def test_shooting_finds_what_time_integration_settles_to(form):
    parameters = reconstructed(0.002 if form == "two_dof" else 0.0, form=form)
    problem = PeriodProblem(parameters)
    frequency = 0.5 * problem.model.natural_frequency
    speed = problem.model.pinion_speed(frequency)
    motion = solve_periodic(problem.equations(), problem.initial_guess(speed), speed)
    assert motion.stable
    orbit = problem.orbit(motion.unknowns, speed)
    sweep = time_sweep(parameters, [frequency], "up", periods=400)
    # time integration keeps exp(-359 1/s x 0.4 s); its speed settles to the balance of losses
    assert np.ptp(orbit.x) == pytest.approx(sweep.peak_to_peak[0], rel=1e-3)
    assert orbit.separation_share == 0.0
    if form == "two_dof":
        end = problem.flow(motion.unknowns, speed)[0]
        assert 2.0 * np.pi / 13 / end[3] == pytest.approx(speed, rel=1e-10)


def test_load_torque_gives_way_to_losses():
    """At constant mean speed the load takes what damping and friction leave."""
    for friction in ("off", "thermal_eyring"):
        problem = PeriodProblem(
            replace(karagiannis_2012_pair(), friction=friction), steps_per_mesh_period=128
        )
        speed = problem.model.pinion_speed(0.4 * problem.model.natural_frequency)
        motion = solve_periodic(problem.equations(), problem.initial_guess(speed), speed)
        orbit = problem.orbit(motion.unknowns, speed)
        assert orbit.load_torque < problem.model.mean_load_torque
        y, load = problem.state(motion.unknowns, speed)
        r = problem.model.pair_rates(y[0] * 1e-6, y[1], y[2], 0.0, load, speed)
        assert r.load_torque == load


def test_torque_ripple_needs_whole_revolutions():
    with pytest.raises(ParameterError, match="13"):
        PeriodProblem(reconstructed(torque_ripple=0.1), periods=1)


def test_a_map_that_leaves_the_teeth_says_so():
    problem = PeriodProblem(reconstructed())
    z = problem.initial_guess(800.0)
    z[0] = -2e5
    assert np.isnan(problem.residual(z, 800.0)[0]).all()
