"""The pair with tooth separation where its motion is known otherwise."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.helical_pair.linear.linear_system import linear_system, relative_rows
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    ResponseSettings,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh import contact_points as at
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain
from gearlube_core.dynamics.helical_pair.separation.march import (
    N_EXTRA,
    march_separating,
    march_work,
)
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.dynamics.helical_pair.separation.system import N_BY, N_ROWS, relative_masses
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from gearlube_core.periodic.shooting import solve_periodic
from tests.helpers.helical_accelerations import pair_accelerations
from tests.helpers.helical_dynamics_cases import symmetric_support
from tests.helpers.helical_mesh_points import line_loads
from tests.helpers.separation_cases import separated_motion, separating_pair, spur_geometry


@pytest.mark.parametrize("form", ["twelve_dof", "six_dof"])
def test_a_pair_that_stays_in_contact_moves_as_the_linear_pair(form):
    parameters = separating_pair(zeta=0.05, mu=0.1, form=form)
    problem = SeparationProblem(parameters, steps_per_mesh_period=256)
    speed = 0.37 * problem.natural_speed
    motion = solve_periodic(problem.over_speed(), problem.initial_guess(), speed)
    assert motion.iterations == 1  # the map is affine
    orbit = problem.orbit(motion.unknowns, speed)
    assert orbit.lift_off_share == 0.0
    settings = ResponseSettings(samples=256, steps_per_oscillation=80)
    linear = periodic_response(parameters, speed, settings)
    # both of fourth order, h = 1/256 of a period of about two oscillations of the fastest mode
    swing = np.ptp(linear.signal("delta_z"))
    assert orbit.delta_z[0] == pytest.approx(linear.signal("delta_z")[0], abs=1e-6 * swing)
    assert abs(motion.multipliers[0]) == pytest.approx(abs(linear.multipliers[0]), rel=1e-6)
    place = BEARING_FORCES.index("F_xg")
    assert orbit.bearing_force[0, place] == pytest.approx(linear.bearing_force[0, place], rel=1e-6)
    # the swing between samples that do not lie alike
    assert orbit.peak_to_peak == pytest.approx(swing, rel=1e-3)


def test_without_offsets_the_motion_grows_with_the_load():
    """Flanks that open at zero load know no other force: only backlash and build-up are lengths."""
    one = separated_motion(separating_pair())
    factor = 0.3
    pair = separating_pair(pinion_torque=factor * separating_pair().pinion_torque)
    problem = SeparationProblem(pair, damping_build_up=factor * 0.5e-6)
    motion = solve_periodic(problem.over_speed(), factor * one[2].unknowns, one[1])
    assert one[0].orbit(one[2].unknowns, one[1]).separation_share > 0.1
    # exact but for rounding, which Newton's tolerance of 1e-9 scales covers
    error = motion.unknowns - factor * one[2].unknowns
    assert np.abs(error / one[0].scales).max() < 1e-8


@pytest.mark.slow
def test_multipliers_multiply_to_what_damping_leaves():
    """Liouville: det M = exp(-integral of all damping rates), the mesh's only where it touches."""
    problem, speed, motion = separated_motion(separating_pair(), steps_per_mesh_period=512)
    orbit = problem.orbit(motion.unknowns, speed)
    assert orbit.separation_share > 0.1
    psi_rate = orbit.rate[:, -1]
    # the damper where it takes the whole load of the flank away no longer depends on the rate
    load = orbit.flank_force * problem.parameters.pair.plane.cos_b
    free = np.abs(orbit.damping_force) < np.abs(load) * (1.0 - 1e-9)
    mesh = np.where(free, orbit.damping_force / psi_rate, 0.0)
    mesh /= problem.parameters.effective_mass
    period = 1.0 / problem.parameters.pair.mesh_frequency(speed)
    total = problem.system.C.sum() + orbit.weight @ mesh
    assert orbit.weight @ mesh > 0.02 * total
    sign, size = np.linalg.slogdet(motion.monodromy)
    assert sign > 0.0
    # rectangle rule with 512 samples, of which four lie at the edges of contact
    assert size == pytest.approx(-period * total, rel=2e-3)


@pytest.mark.slow
def test_adaptive_integration_of_the_twelve_coordinates_returns_to_the_start():
    """DOP853 with the forces of the twelve coordinates, point by point."""
    problem, speed, motion = separated_motion(separating_pair(mu=0.05), steps_per_mesh_period=512)
    assert problem.orbit(motion.unknowns, speed).separation_share > 0.1
    p, n = problem.parameters, problem.size // 2
    c, supports, mesh = p.kernel_parameters(), p.support_arrays(), p.mesh_arrays()
    period, rows = 1.0 / p.pair.mesh_frequency(speed), relative_rows(p)
    points = np.empty((point_capacity(mesh), at.N_COLUMNS))
    wrench, sums, acceleration = np.zeros(12), np.zeros(5), np.zeros(12)

    def rates(t, s):
        count = contact_points(t / period, speed, c.plane, mesh, points)
        constant_friction(p.mu, points, count)
        line_loads(*mesh_strain(s[:12], c.plane), c, points, count)
        pair_accelerations(
            s[:12], s[12:], c.T_p, c.T_g, c, supports, points, count, wrench, sums,
            acceleration,
        )  # fmt: skip
        return np.concatenate((s[12:], acceleration))

    back = np.linalg.pinv(rows)
    start = np.concatenate((back @ motion.unknowns[:n], back @ motion.unknowns[n:]))
    end = solve_ivp(
        rates, (0.0, period), start, method="DOP853", rtol=1e-7, atol=1e-12,
        max_step=period / 100,
    ).y[:, -1]  # fmt: skip
    returned = np.concatenate((rows @ end[:12], rows @ end[12:]))
    moved = (returned - motion.unknowns) / problem.scales
    # the march's own error with 512 steps is 1e-5 of the scales (see the convergence tests)
    assert np.abs(moved).max() < 5e-5


def _frozen_energy(zeta):
    """March through impacts on both flanks with lines that stand still; energy at each step [J]."""
    pair = separating_pair().pair
    parameters = separating_pair(zeta=zeta, pair=replace(pair, backlash=4e-6))
    problem = SeparationProblem(parameters, steps_per_mesh_period=1024)
    table = problem.table
    steps = table.width.size
    still = table._replace(
        points=np.repeat(np.repeat(table.points[:1, 1:2], 3, axis=1), steps, axis=0),
        used=np.full_like(table.used, table.used[0, 1]),
        total=np.repeat(np.repeat(table.total[:1, 1:2], 3, axis=1), steps, axis=0),
    )
    n, periods = problem.size // 2, 4
    z = problem.initial_guess()
    q, v = z[:n, None].copy(), np.zeros((n, 1))
    v[-1] = 0.3  # m/s, thrown against the back flank
    record = np.zeros((periods * steps, 2 * n + N_EXTRA))
    period = 1.0 / pair.mesh_frequency(problem.natural_speed)
    march_separating(
        q, v, periods, 0.0, 1.0, period, still, problem.system, march_work(n, 1),
        np.zeros((N_ROWS, N_BY)), record,
    )  # fmt: skip
    linear, mass = linear_system(parameters), relative_masses(parameters, problem.names)
    points = still.points[0, 0, : still.used[0, 0]]
    y = record[:, :n] @ linear.E.T
    delta = y[:, :1] + y[:, 1:] * points[:, 0]
    pressed = np.maximum(delta, 0.0) + np.maximum(-delta - 4e-6, 0.0)
    energy = 0.5 * (record[:, n : 2 * n] ** 2 @ mass + pressed**2 @ points[:, 1])
    energy += 0.5 * np.einsum("ti,ij,tj->t", record[:, :n], mass[:, None] * linear.K, record[:, :n])
    gap = (pressed == 0.0).all(axis=1)
    return energy, gap, (delta < -4e-6).any()


def test_impacts_without_damping_keep_the_energy():
    energy, gap, on_the_back = _frozen_energy(0.0)
    assert on_the_back
    assert np.count_nonzero(np.diff(gap.astype(int)) > 0) >= 4
    # second order at each kink of the force: 1024 steps a period
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-4


def test_impacts_with_damping_create_no_energy():
    energy, gap, on_the_back = _frozen_energy(0.05)
    assert on_the_back
    assert np.count_nonzero(np.diff(gap.astype(int)) > 0) >= 2
    assert energy[-1] < 0.9 * energy[0]
    # the integrator's error in one step at a kink, see the test above
    assert np.diff(energy).max() < 1e-6 * energy[0]


@pytest.mark.slow
def test_a_spur_pair_in_stiff_bearings_is_the_oscillator_with_a_gap():
    """m x'' + c g x' + k(t) max(x, 0) = F: one line or two, as the contact ratio of 1.49 has it.

    Kahraman and Singh 1990 and 1991 study this oscillator. Integrated here by DOP853.
    """
    stiff = symmetric_support(K_xx=1e13, K_yy=1e13, K_zz=1e13, distance=0.05)
    parameters = separating_pair(
        zeta=0.05, pair=spur_geometry(), form="six_dof", pinion_support=stiff, gear_support=stiff
    )
    problem, speed, motion = separated_motion(parameters, steps_per_mesh_period=1024)
    pair, mass = parameters.pair, parameters.effective_mass
    orbit = problem.orbit(motion.unknowns, speed)
    assert orbit.separation_share > 0.1
    assert motion.stable
    per_line = parameters.mesh.density.max() * pair.face_width
    load = parameters.pinion_torque / pair.pinion_base_radius
    period = 1.0 / pair.mesh_frequency(speed)

    def oscillator(k):
        def rates(_, s):
            elastic = k * max(s[0], 0.0)
            build_up = min(1.0, max(s[0], 0.0) / 0.5e-6)
            damping = 2.0 * 0.05 * np.sqrt(mass * k) * build_up * s[1]
            return s[1], (load - max(elastic + damping, 0.0)) / mass

        return rates

    two = (pair.transverse_contact_ratio - 1.0) * period
    state = -np.array([motion.unknowns[problem.size // 2 - 1], motion.unknowns[-1]])
    errors = []
    for k, span in ((2.0 * per_line, (0.0, two)), (per_line, (two, period))):
        times = np.linspace(*span, 200)
        history = solve_ivp(
            oscillator(k), span, state, method="DOP853", rtol=1e-8, atol=1e-13, t_eval=times,
            max_step=period / 200,
        )  # fmt: skip
        state = history.y[:, -1]
        march = np.interp(times / period, orbit.phase, -orbit.delta_z, period=1.0)
        errors.append(np.abs(march - history.y[0]).max())
    # bearings leave 1e-4 of the mesh's softness; between samples the record is interpolated
    assert max(errors) < 1e-3 * orbit.peak_to_peak
    # at this damping the damper is held back where flanks part
    pull = orbit.damping_force - orbit.flank_force
    assert pull.max() <= 1e-9 * orbit.flank_force.max()
    assert np.count_nonzero((np.abs(pull) < 1e-6) & (orbit.contact_share > 0.0)) > 2
