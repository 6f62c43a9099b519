"""Periodic motions over the pinion torque: derivatives, and agreement with those over the speed."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import LoadProblem
from gearlube_core.errors import ParameterError
from gearlube_core.periodic import follow, solve_periodic


def load_problem(form, relative=0.8):
    parameters = replace(karagiannis_2012_pair(), form=form)
    model = HypoidTorsional(parameters)
    speed = model.pinion_speed(relative * model.natural_frequency)
    return LoadProblem(parameters, speed, steps_per_mesh_period=128)


@pytest.mark.parametrize("form", ["one_dof", "two_dof"])
def test_derivative_by_the_torque_is_that_of_the_residual(form):
    problem = load_problem(form)
    torque = 61.0  # between two levels of the table
    z = problem.initial_guess(torque)
    _, _, by_torque, _ = problem.residual(z, torque)
    step = 1e-2
    ahead, behind = (problem.residual(z, torque + d)[0] for d in (step, -step))
    # second order in the step, rounding 1e-12 um over 1e-2 N.m
    scale = np.abs(by_torque).max()
    np.testing.assert_allclose((ahead - behind) / (2 * step), by_torque, atol=1e-6 * scale)


@pytest.mark.parametrize("form", ["one_dof", "two_dof"])
def test_a_branch_over_the_torque_meets_the_motions_at_each_torque(form):
    problem = load_problem(form)
    asked = [45.0, 60.0, 80.0]
    branch = follow(
        problem.equations(),
        problem.initial_guess(100.0),
        100.0,
        limits=(40.0, 100.0),
        heading=-1.0,
        at=asked,
    )
    assert branch.ending == "parameter limit"
    for torque in asked:
        (row,) = branch.at(torque)
        alone = solve_periodic(
            problem.at(torque).equations(), problem.initial_guess(torque), problem.speed
        )
        # both solved to 1e-9 of their scales; below resonance there is one motion
        np.testing.assert_allclose(
            branch.unknowns[row], alone.unknowns, rtol=1e-6, atol=1e-6 * np.abs(alone.unknowns[0])
        )
        assert branch.stable[row] == alone.stable


def test_deflection_grows_with_the_torque_as_the_mesh_stiffens():
    problem = load_problem("one_dof", relative=0.2)
    means = []
    for torque in (50.0, 100.0):
        motion = solve_periodic(
            problem.at(torque).equations(), problem.initial_guess(torque), problem.speed
        )
        means.append(problem.orbit(motion.unknowns, torque).x.mean())
    stiffness = [problem.at(t).model.stiffness for t in (50.0, 100.0)]
    # far below resonance x = F/k; its mean differs from 1/mean(k) by the square of the 6 % ripple
    assert means[1] / means[0] == pytest.approx(2.0 * stiffness[0] / stiffness[1], rel=0.02)


@pytest.mark.parametrize("speed", [0.0, -100.0, float("nan")])
def test_a_speed_that_is_none_is_refused(speed):
    with pytest.raises(ParameterError, match="speed must be"):
        LoadProblem(karagiannis_2012_pair(), speed)
