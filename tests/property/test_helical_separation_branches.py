"""What backlash and separation do to the pair's resonance, whatever the numbers."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.linear.linear_system import linear_system
from gearlube_core.dynamics.helical_pair.mesh import contact_points as at
from gearlube_core.dynamics.helical_pair.mesh.contact_points import contact_points, point_capacity
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.dynamics.helical_pair.separation.system import relative_masses
from gearlube_core.periodic.branch import switch_branch
from gearlube_core.periodic.continuation import ContinuationSettings, follow
from gearlube_core.periodic.shooting import solve_periodic
from tests.helpers.separation_cases import (
    crowned_mesh,
    separated_motion,
    separating_pair,
    spur_geometry,
)


def _resonance(problem, low, high, at=(), **settings):
    """The branch followed from above the resonance to below it, ratios of mesh to natural."""
    equations, unit = problem.over_speed(), problem.natural_speed
    start = solve_periodic(equations, problem.initial_guess(), high * unit)
    return follow(
        equations,
        start.unknowns,
        high * unit,
        limits=(low * unit, high * unit),
        heading=-1.0,
        at=[ratio * unit for ratio in at],
        settings=ContinuationSettings(largest_step=0.5, **settings),
    )


def _sweep(problem, ratios, periods=200):
    """States at speeds run through in turn, by marching alone."""
    z, states = problem.initial_guess(), []
    for ratio in ratios:
        z = problem.march(z, ratio * problem.natural_speed, periods=periods)
        states.append(z)
    return states


@pytest.mark.slow
def test_separation_bends_the_resonance_down_and_sweeps_jump_at_its_folds():
    problem = SeparationProblem(separating_pair())
    unit = problem.natural_speed
    branch = _resonance(problem, 0.85, 1.2, at=[0.95])
    lower, upper = sorted(fold.parameter / unit for fold in branch.of_kind("fold"))
    assert lower < upper < 1.0
    rows = branch.at(0.95 * unit)
    orbits = [problem.orbit(branch.unknowns[row], 0.95 * unit) for row in rows]
    swings = [orbit.peak_to_peak for orbit in orbits]
    # coming from above: the arm with separation, the unstable one between, the one in contact
    assert branch.stable[rows].tolist() == [True, False, True]
    assert swings[0] > swings[1] > swings[2]
    assert orbits[0].separation_share > 0.2
    assert orbits[2].lift_off_share == 0.0

    ratios = [0.9, 0.95, upper - 0.005, upper + 0.005]
    up = [problem.orbit(z, r * unit) for z, r in zip(_sweep(problem, ratios), ratios, strict=True)]
    assert [orbit.separation_share > 0.0 for orbit in up] == [False, False, False, True]
    down_ratios = [1.01, 1.0, 0.98, 0.95, lower + 0.005, lower - 0.005]
    states = _sweep(problem, down_ratios)
    down = [
        problem.orbit(z, r * unit).separation_share > 0.0
        for z, r in zip(states, down_ratios, strict=True)
    ]
    assert down == [True, True, True, True, True, False]
    # 200 periods leave 0.9**200 of a start; the branch is exact to Newton's tolerance
    assert up[1].peak_to_peak == pytest.approx(swings[2], rel=1e-5)
    found = (states[3] - branch.unknowns[rows[0]]) / problem.scales
    assert np.abs(found).max() < 1e-5


def test_overlap_keeps_the_helical_pair_in_contact_where_the_spur_pair_parts():
    """Same transverse section, damping and load; the spur pair's stiffness jumps two to one."""
    swings = {}
    for name, pair in (("helical", None), ("spur", spur_geometry())):
        problem = SeparationProblem(separating_pair(zeta=0.05, pair=pair))
        assert (problem.parameters.pair.overlap_ratio > 1.0) == (name == "helical")
        branch = _resonance(problem, 0.85, 1.15)
        assert branch.stable.all()
        orbits = [
            problem.orbit(z, w) for z, w in zip(branch.unknowns, branch.parameter, strict=True)
        ]
        swings[name] = max(orbit.peak_to_peak for orbit in orbits)
        share = max(orbit.separation_share for orbit in orbits)
        assert share == 0.0 if name == "helical" else share > 0.4
    assert swings["spur"] > 3.0 * swings["helical"]


@pytest.mark.slow
def test_the_spur_pair_doubles_its_period_on_the_way_down():
    """Found on the branch, followed over two periods, and met by marching."""
    parameters = separating_pair(zeta=0.05, pair=spur_geometry())
    problem, doubled = (SeparationProblem(parameters, periods=n) for n in (1, 2))
    unit = problem.natural_speed
    branch = _resonance(problem, 0.82, 1.1)
    (doubling,) = branch.of_kind("period doubling")
    start = switch_branch(doubled.over_speed(), doubling)
    motion = solve_periodic(doubled.over_speed(), start.unknowns, start.parameter)
    orbit = doubled.orbit(motion.unknowns, start.parameter)
    first, second = np.split(orbit.delta_z, 2)
    assert np.abs(first - second).max() > 1e-3 * orbit.peak_to_peak
    above, below = doubling.parameter / unit + 0.01, doubling.parameter / unit - 0.01
    for ratio, repeats in ((above, True), (below, False)):
        z = _sweep(problem, [1.0, 0.9, ratio], periods=300)[-1]
        once = problem.march(z, ratio * unit, periods=1)
        moved = np.abs((once - z) / problem.scales).max()
        assert (moved < 1e-4) == repeats


@pytest.mark.slow
def test_what_damping_takes_the_moving_mesh_gives():
    """Over a period constant torques do no work on psi; only the stiffness's change does."""
    problem, speed, motion = separated_motion(separating_pair(), steps_per_mesh_period=512)
    p, orbit = problem.parameters, problem.orbit(motion.unknowns, speed)
    assert orbit.separation_share > 0.1
    linear, mass = linear_system(p), relative_masses(p, problem.names)
    period = 1.0 / p.pair.mesh_frequency(speed)
    power = orbit.rate**2 @ (linear.C * mass) + orbit.damping_force * orbit.rate[:, -1]
    assert (orbit.damping_force * orbit.rate[:, -1] >= 0.0).all()
    mesh, plane = p.mesh_arrays(), p.pair.plane
    points = np.empty((point_capacity(mesh), at.N_COLUMNS))

    def potential(phase, q):
        n = contact_points(phase, 1.0, plane, mesh, points)
        x, z, length, density = points[:n, [at.X, at.Z, at.LENGTH, at.DENSITY]].T
        y = linear.E @ q
        delta = y[0] + y[1] * (x * plane.sin_b + z * plane.cos_b)
        pressed = np.maximum(delta, 0.0) + np.maximum(-delta - p.pair.backlash, 0.0)
        return 0.5 * (density * length) @ pressed**2

    step = 1e-5
    gain = [
        (potential(phase + step, q) - potential(phase - step, q)) / (2.0 * step)
        for phase, q in zip(orbit.phase, orbit.displacement, strict=True)
    ]
    # rectangle rule over 512 samples of integrands with kinks
    assert period * orbit.weight @ power == pytest.approx(orbit.weight @ gain, rel=2e-3)


def test_more_torque_closes_crowned_lines():
    pair = separating_pair().pair
    mesh = crowned_mesh(pair, crown=4e-6, torque=(5.0, 50.0, 300.0))
    parameters = separating_pair(zeta=0.05, mesh=mesh, line_divisions=4)
    problem = SeparationProblem(parameters)
    speed, torque = 0.5 * problem.natural_speed, parameters.pinion_torque
    equations = problem.over_torque(speed)
    start = solve_periodic(equations, problem.initial_guess(), torque).unknowns
    branch = follow(equations, start, torque, limits=(10.0, torque), heading=-1.0, at=[30.0])
    assert branch.ending == "parameter limit"
    assert branch.stable.all()
    orbits = [
        problem.orbit(z, speed, t) for z, t in zip(branch.unknowns, branch.parameter, strict=True)
    ]
    touching = [orbit.weight @ orbit.contact_share for orbit in orbits]
    assert touching[0] == pytest.approx(1.0, abs=1e-12)
    assert touching[-1] < 0.8
    assert (np.diff(touching) <= 1e-12).all()
    # points part one by one, never all
    assert np.unique(orbits[-1].contact_share.round(9)).size > 2
    assert orbits[-1].separation_share == 0.0
    # the same motion as of a pair that has this torque to begin with
    (row,) = branch.at(30.0)
    light = SeparationProblem(replace(parameters, pinion_torque=30.0))
    motion = solve_periodic(light.over_speed(), branch.unknowns[row], speed)
    assert np.abs((motion.unknowns - branch.unknowns[row]) / problem.scales).max() < 1e-7
