"""Motions with tooth separation against the number of time steps and of points on a line."""

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.periodic.shooting import solve_periodic
from tests.helpers.separation_cases import crowned_mesh, separated_motion, separating_pair


def test_separated_motions_converge_with_the_time_step():
    """Second order on the whole, because steps run across the kinks where teeth meet and part."""
    _, speed, start = separated_motion(separating_pair())
    finest = SeparationProblem(separating_pair(), steps_per_mesh_period=2048)
    motion = solve_periodic(finest.over_speed(), start.unknowns, speed)
    assert finest.orbit(motion.unknowns, speed).separation_share > 0.3
    errors = []
    for steps in (32, 128, 512):
        problem = SeparationProblem(separating_pair(), steps_per_mesh_period=steps)
        found = solve_periodic(problem.over_speed(), motion.unknowns, speed)
        errors.append(np.abs((found.unknowns - motion.unknowns) / problem.scales).max())
    # a kink lies anywhere in its step: the order 2 holds on average, 256 over both refinements
    assert errors[2] < errors[0] / 100.0
    assert errors[1] < 1e-3  # of the static deflection, at the default number of steps
    assert errors[2] < 1e-4


@pytest.mark.slow
def test_light_loads_converge_with_the_points_on_a_line():
    """A crowned line ends anywhere between two points; more of them find the end."""
    pair = separating_pair().pair
    mesh = crowned_mesh(pair, crown=4e-6, torque=(1.0, 300.0))
    swings = []
    for divisions in (4, 32, 64):
        parameters = separating_pair(
            zeta=0.05, mesh=mesh, pinion_torque=15.0, line_divisions=divisions
        )
        problem = SeparationProblem(parameters, steps_per_mesh_period=256)
        speed = 0.5 * problem.natural_speed
        start = problem.march(problem.initial_guess(), speed, periods=60)
        motion = solve_periodic(problem.over_speed(), start, speed)
        orbit = problem.orbit(motion.unknowns, speed)
        assert 0.0 < orbit.contact_share.max() < 1.0
        swings.append(motion.unknowns / problem.scales)
    errors = [np.abs(swing - swings[-1]).max() for swing in swings[:-1]]
    # the kink lies anywhere in its part: order 2 on average, 64 from 4 to 32 parts
    assert errors[1] < errors[0] / 16.0
    assert errors[0] < 0.01  # of the static deflection at full load, with four parts
