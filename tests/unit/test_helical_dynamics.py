"""Dynamics of the helical pair: inputs, and the map with tooth separation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube.studies.helical.settings import HARMONICS
from gearlube.studies.helical.sweep_grid import QUANTITIES, friction_column
from gearlube_core.dynamics.helical_pair.linear.linear_system import relative_rows
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh import contact_points as at
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain
from gearlube_core.dynamics.helical_pair.parameters import pack_lines
from gearlube_core.dynamics.helical_pair.separation.march import separating_rates
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.dynamics.helical_pair.separation.system import (
    N_BY,
    N_ROWS,
    OFFSET,
    OFFSET_RATE,
    STIFFNESS,
    STIFFNESS_RATE,
    StagePoints,
)
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_accelerations import pair_accelerations
from tests.helpers.helical_dynamics_cases import SPEED
from tests.helpers.helical_mesh_points import line_loads
from tests.helpers.named_pairs import named_pair
from tests.helpers.separation_cases import crowned_mesh, separating_pair


@each(
    ("field", "value", "message"),
    [
        ("pinion_mass", 0.0, "pinion_mass must be above 0 kg"),
        ("friction_coefficient", 1.5, "friction_coefficient must be within 0 to 1"),
        ("friction", "dry", "friction must be one of"),
        ("pair", named_pair("jamali_2015_a"), "mesh must belong to the pair of 33 and 34"),
        ("line_divisions", 0, "line_divisions must be within 1 to 64"),
        ("form", "three_dof", "form must be one of"),
    ],
)
def test_bad_parameters_are_refused_with_their_limit(
    field: str, value: object, message: str
) -> None:
    with pytest.raises(ParameterError, match=message):
        replace(he_2007_pair(0.1), **{field: value})


def test_a_bearing_that_gives_energy_away_is_refused() -> None:
    with pytest.raises(ParameterError, match="K_x_theta_y must be within"):
        Bearing(position=0.05, K_xx=1e8, K_yy=1e8, K_zz=1e8, K_x_theta_y=1e5)
    bearing = Bearing(position=0.05, K_xx=1e8, K_yy=1e8, K_zz=1e8)
    with pytest.raises(ParameterError, match="bearing 2 at z = -l2"):
        ShaftSupport(first=bearing, second=bearing)


def test_line_mesh_is_read_between_torques_and_refused_beyond() -> None:
    base = he_2007_pair(0.1).mesh
    shape = (2, 1, base.lines, 2)
    density = np.broadcast_to(np.array([1e10, 2e10])[:, None, None, None], shape)
    offset = np.broadcast_to(np.array([0.0, 4e-6]), shape)
    mesh = replace(
        base, torque=np.array([100.0, 300.0]), station=np.array([0.25, 0.75]), density=density,
        offset=offset,
    )  # fmt: skip
    packed = pack_lines(mesh, 150.0, 2)
    assert np.allclose(packed.station, [0.0, 0.25, 0.5, 0.75, 1.0])
    assert np.allclose(packed.density, 1.25e10)
    assert np.allclose(packed.offset, [0.0, 0.0, 2e-6, 4e-6, 4e-6])
    with pytest.raises(ParameterError, match="pinion_torque must be within 100 to 300"):
        pack_lines(mesh, 301.0, 1)


def test_finer_lines_do_not_change_linear_contact() -> None:
    coarse = periodic_response(he_2007_pair(0.1), SPEED)
    fine = periodic_response(replace(he_2007_pair(0.1), line_divisions=5), SPEED)
    # two points a part are exact already: rounding through some thousand steps
    swing = np.ptp(coarse.displacement, axis=0)
    assert np.all(np.abs(fine.displacement - coarse.displacement).max(axis=0) < 1e-7 * swing)


def test_speed_must_be_positive() -> None:
    with pytest.raises(ParameterError, match="pinion_speed must be above 0 rad/s"):
        periodic_response(he_2007_pair(0.1), 0.0)


def test_grid_holds_the_single_responses() -> None:
    column = friction_column(he_2007_pair(0.0), np.array([0.0, 0.1]), SPEED)
    response = periodic_response(he_2007_pair(0.1), SPEED)
    for i, name in enumerate(QUANTITIES):
        expected = harmonics(response.signal(name), HARMONICS)
        assert np.allclose(column["displacement"][1, i], expected, rtol=1e-12, atol=0.0)
    force = harmonics(response.bearing_force, HARMONICS).T
    assert np.allclose(column["bearing_force"][1], force)
    assert np.allclose(column["mean_bearing_force"][1], response.bearing_force.mean(axis=0))
    assert column["friction_torque"][1] == response.friction_torque
    assert column["stability_margin"].shape == (2,)
    assert (column["stability_margin"] > 0.0).all()


COARSE = {"steps_per_mesh_period": 16}


def _loaded_on_both_flanks():
    """A pair with every complication, and states about half of which are out of contact."""
    pair = separating_pair().pair
    parameters = separating_pair(
        mu=0.08,
        zeta=0.05,
        pair=replace(pair, backlash=8e-6),
        mesh=crowned_mesh(pair, crown=4e-6, torque=(20.0, 300.0)),
        line_divisions=3,
    )
    problem = SeparationProblem(parameters, **COARSE)
    random = np.random.default_rng(3).standard_normal((6, problem.size))
    return problem, problem.initial_guess() + 0.6 * problem.scales * random


def test_derivatives_are_those_of_the_map():
    problem, states = _loaded_on_both_flanks()
    speed, torque = 0.7 * problem.natural_speed, 90.0
    step, zero = 1e-8, np.zeros(problem.size)
    starts = [(way, 0.0, 0.0) for way in np.diag(problem.scales)]
    for z in states:
        _, by_start, by_torque, by_speed = problem.flow(z, speed, torque)
        assert problem.orbit(z, speed, torque).lift_off_share > 0.0
        slopes = np.column_stack((by_start * problem.scales, by_speed * speed, by_torque * torque))
        ways = [*starts, (zero, speed, 0.0), (zero, 0.0, torque)]
        for slope, (dz, dw, dt) in zip(slopes.T / problem.scales, ways, strict=True):
            up, down = (
                problem.flow(z + s * dz, speed + s * dw, torque + s * dt)[0] for s in (step, -step)
            )
            numeric = (up - down) / (2.0 * step) / problem.scales
            # rounding gives 1e-7; a kink within the step would show as 1e-3
            assert np.abs(numeric - slope).max() < 1e-6 * max(1.0, np.abs(slope).max())


@each("torque", [20.0, 95.0, 105.0, 290.0, 300.0])
def test_points_near_a_level_of_the_mesh_follow_the_torque_on_their_side_of_it(torque):
    """Slopes of stiffness and offset with the torque are those between the levels around it."""
    pair = separating_pair().pair
    mesh = crowned_mesh(pair, crown=4e-6, torque=(20.0, 100.0, 300.0))
    parameters = separating_pair(mesh=mesh, pinion_torque=torque, line_divisions=3)
    table = SeparationProblem(parameters, **COARSE).table
    low, high = (20.0, 100.0) if torque < 100.0 else (100.0, 300.0)
    here, there = (
        SeparationProblem(replace(parameters, pinion_torque=end), **COARSE).table
        for end in (low, high)
    )
    slope = (there.points - here.points) / (high - low)
    # data that are linear in the torque: rounding over 1e-4 of it
    for column, rate in ((STIFFNESS, STIFFNESS_RATE), (OFFSET, OFFSET_RATE)):
        wanted = slope[..., column]
        limit = 1e-10 * np.abs(here.points[..., column]).max() + 1e-9 * np.abs(wanted).max()
        assert np.abs(wanted).max() > 100.0 * limit
        np.testing.assert_allclose(table.points[..., rate], wanted, rtol=0.0, atol=limit)
    total = (there.total[..., 0] - here.total[..., 0]) / (high - low)
    np.testing.assert_allclose(table.total[..., 1], total, rtol=1e-7)
    at_torque = here.total[..., 0] + (torque - low) * total
    np.testing.assert_allclose(table.total[..., 0], at_torque, rtol=1e-12)


def test_accelerations_are_those_of_the_twelve_coordinates():
    """Against the kernels of the marching equations, whose forces are summed point by point."""
    problem, states = _loaded_on_both_flanks()
    p, n = problem.parameters, problem.size // 2
    c, supports, mesh = p.kernel_parameters(), p.support_arrays(), p.mesh_arrays()
    table = problem.table
    points = np.empty((point_capacity(mesh), at.N_COLUMNS))
    wrench, acceleration = np.zeros(12), np.zeros(12)
    for step, z in enumerate(states):
        phase = table.phase[step] + 0.5 * table.width[step]
        q, v = z[:n, None].copy(), z[n:, None].copy()
        a, rate = np.zeros((n, 1)), np.zeros((n, 1))
        _, touching = separating_rates(
            q, v, p.pinion_torque, 1.0,
            StagePoints(table.points[step, 1], table.used[step, 1], table.total[step, 1]),
            problem.system, np.zeros((2, 1)), np.zeros((N_ROWS, 1)), np.zeros((N_ROWS, N_BY)),
            a, rate,
        )  # fmt: skip
        rows = relative_rows(p)
        # psi all in the pinion: only the sum counts
        back = np.linalg.pinv(rows)
        q12, v12 = back @ z[:n], back @ z[n:]
        count = contact_points(phase, 1.0, c.plane, mesh, points)
        constant_friction(p.mu, points, count)
        k_m = line_loads(*mesh_strain(q12, c.plane), c, points, count)
        pair_accelerations(
            q12, v12, c.T_p, c.T_g, c, supports, points, count, wrench, np.zeros(5),
            acceleration,
        )  # fmt: skip
        expected = rows @ acceleration
        assert a[:, 0] == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max())
        assert touching * c.plane.cos_b**2 == pytest.approx(k_m, rel=1e-12)


def test_no_step_spans_a_kink_and_all_steps_make_a_period():
    problem = SeparationProblem(separating_pair(), **COARSE)
    table = problem.table
    assert table.width.sum() == pytest.approx(1.0, abs=1e-14)
    assert table.phase[1:] == pytest.approx(np.cumsum(table.width)[:-1], abs=1e-14)
    plane = problem.parameters.pair.plane
    first_line_leaves = ((plane.D - plane.A) / plane.pitch) % 1.0
    assert np.abs(table.phase - first_line_leaves).min() < 1e-9


def test_linear_contact_is_refused_with_a_cure():
    with pytest.raises(ParameterError, match="periodic_response"):
        SeparationProblem(replace(separating_pair(), contact="linear"))


def test_a_motion_that_runs_away_shows_as_not_finite():
    problem = SeparationProblem(separating_pair(), **COARSE)
    residual = problem.residual(1e6 * problem.scales, problem.natural_speed)[0]
    assert np.isnan(residual).all()


def test_torques_outside_the_mesh_levels_show_as_not_finite():
    problem, states = _loaded_on_both_flanks()
    equations = problem.over_torque(problem.natural_speed)
    assert np.isnan(equations.residual(states[0], 301.0)[0]).all()
    assert np.isfinite(equations.residual(states[0], 299.0)[0]).all()
