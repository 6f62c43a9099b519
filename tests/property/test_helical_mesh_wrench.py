"""Forces of the helical mesh: symmetry, action and reaction, energy, friction, separation."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    LOAD,
    OFFSET,
    SLIDING,
    X,
    Z,
)
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_accelerations import points_damping
from tests.helpers.helical_dynamics_cases import (
    SPEED,
    loaded_points,
    random_state,
    spur_pair,
    summed_wrench,
)
from tests.helpers.helical_mesh_points import friction_power, mesh_stiffness_matrix
from tests.helpers.named_pairs import named_pair

phases = st.floats(min_value=0.0, max_value=1.0, exclude_max=True)
seeds = st.integers(min_value=0, max_value=10_000)


@settings(max_examples=40, deadline=None)
@given(phase=phases)
def test_mesh_stiffness_without_friction_is_symmetric_and_takes_no_energy(phase: float) -> None:
    for parameters in (he_2007_pair(0.0), spur_pair(0.0)):
        K = mesh_stiffness_matrix(phase, parameters.pair.plane, parameters.mesh_arrays())
        size = np.abs(K).max()
        assert np.abs(K - K.T).max() <= 1e-15 * size
        values = np.linalg.eigvalsh(0.5 * (K + K.T))
        assert values[0] > -1e-12 * size
        assert values[-1] > 0.1 * size  # at least one pair carries
        assert (np.abs(values) > 1e-9 * size).sum() <= 2  # delta varies along the lines only
        assert not K[[1, 7]].any()  # nothing acts off the line of action


@settings(max_examples=60, deadline=None)
@given(phase=phases, seed=seeds, mu=st.floats(min_value=0.0, max_value=0.3))
def test_action_equals_reaction_about_any_point(phase: float, seed: int, mu: float) -> None:
    rng = np.random.default_rng(seed)
    for parameters in (he_2007_pair(mu), spur_pair(mu)):
        plane = parameters.pair.plane
        _, wrench, _ = loaded_points(parameters, phase, random_state(rng))
        size = np.abs(wrench[:9:2]).max()
        assert np.abs(wrench[:3] + wrench[6:9]).max() <= 1e-12 * size
        about = rng.normal(size=3)
        centre_p, centre_g = -about, np.array([plane.x_g, plane.r_bp + plane.r_bg, 0.0]) - about
        moment = wrench[3:6] + np.cross(centre_p, wrench[:3])
        moment += wrench[9:] + np.cross(centre_g, wrench[6:9])
        assert np.abs(moment).max() <= 1e-12 * size


@settings(max_examples=40, deadline=None)
@given(phase=phases, seed=seeds)
def test_wrench_is_force_times_arm_summed_over_points(phase: float, seed: int) -> None:
    parameters = he_2007_pair(0.1)
    q = random_state(np.random.default_rng(seed))
    points, wrench, _ = loaded_points(parameters, phase, q)
    expected = summed_wrench(parameters, points)
    assert np.allclose(wrench, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())
    plane, mesh = parameters.pair.plane, parameters.mesh_arrays()
    matrix = mesh_stiffness_matrix(phase, plane, mesh, mu=0.1)
    assert np.allclose(-matrix @ q, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())


@settings(max_examples=40, deadline=None)
@given(phase=phases, seed=seeds, mu=st.floats(min_value=0.0, max_value=0.3))
def test_axial_force_is_the_helix_share_of_the_force_along_the_line_of_action(
    phase: float, seed: int, mu: float
) -> None:
    """H19: F_z = -F_x tan(b), whatever the friction."""
    parameters = he_2007_pair(mu)
    _, wrench, _ = loaded_points(parameters, phase, random_state(np.random.default_rng(seed)))
    tan_b = parameters.pair.plane.sin_b / parameters.pair.plane.cos_b
    assert abs(wrench[2] + wrench[0] * tan_b) <= 1e-12 * abs(wrench[0])


def test_sliding_reverses_at_the_pitch_line_and_friction_opposes_it() -> None:
    """H8."""
    parameters = he_2007_pair(0.1)
    pressed = np.zeros(12)
    pressed[0] = 1e-5
    for phase in np.linspace(0.0, 0.99, 34):
        points, _, _ = loaded_points(parameters, float(phase), pressed)
        assert (
            np.sign(points[:, SLIDING]) == np.sign(parameters.pair.pitch_point - points[:, X])
        ).all()
        # speed of the pinion's tooth over the gear's by rigid rotation about the two centres
        plane = parameters.pair.plane
        gear_speed = SPEED * 25.0 / 31.0
        expected = -SPEED * points[:, X] + gear_speed * (plane.x_g - points[:, X])
        assert np.allclose(points[:, SLIDING], expected, rtol=1e-12, atol=1e-14)


@settings(max_examples=30, deadline=None)
@given(phase=phases, seed=seeds)
def test_friction_takes_the_power_of_its_force_on_sliding(phase: float, seed: int) -> None:
    """The torques' power in rigid rotation equals mu w abs(v_s), and is never negative."""
    parameters = replace(he_2007_pair(0.1), contact="one_sided", line_divisions=4)
    q = random_state(np.random.default_rng(seed))
    q[0] += 5e-6
    points, wrench, _ = loaded_points(parameters, phase, q)
    power = friction_power(points, len(points))
    # nominal rotation: pinion about -z, gear about +z; flank forces do no work in it
    taken = wrench[5] * SPEED - wrench[11] * SPEED * 25.0 / 31.0
    scale = np.abs(wrench[5]) * SPEED
    assert power >= 0.0
    assert abs(taken - power) <= 1e-12 * scale


def test_heavily_pressed_flanks_behave_linearly() -> None:
    linear = he_2007_pair(0.1)
    one_sided = replace(linear, contact="one_sided", line_divisions=3)
    q = random_state(np.random.default_rng(3))
    q[5] -= 1e-3  # 36 um of compression against some micrometres of tilting
    _, expected, k_linear = loaded_points(linear, 0.37, q)
    _, wrench, k_m = loaded_points(one_sided, 0.37, q)
    assert np.allclose(wrench, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())
    assert k_m == pytest.approx(k_linear, rel=1e-13)


def test_flanks_neither_pull_nor_touch_within_the_backlash_and_then_touch_at_the_back() -> None:
    parameters = replace(he_2007_pair(0.1), contact="one_sided")
    cos_b, backlash = parameters.pair.plane.cos_b, parameters.pair.backlash
    q = np.zeros(12)
    for delta, expected in ((-0.5 * backlash, 0.0), (-backlash - 2e-6, -2e-6), (3e-6, 3e-6)):
        q[0] = delta / cos_b
        points, wrench, k_m = loaded_points(parameters, 0.2, q)
        length = points[:, LENGTH].sum()
        force = -cos_b * parameters.mesh.density.max() * length * expected
        assert wrench[0] == pytest.approx(force, rel=1e-9, abs=1e-12)
        assert (k_m > 0.0) == (expected != 0.0)
        assert friction_power(points, len(points)) >= 0.0


def test_offsets_widen_the_gap_on_both_sides() -> None:
    base = replace(he_2007_pair(0.0), contact="one_sided")
    offset = 5e-6
    parameters = replace(
        base, mesh=replace(base.mesh, offset=np.full_like(base.mesh.offset, offset))
    )
    plane, q, k = base.pair.plane, np.zeros(12), base.mesh.density.max()
    first, last = offset, -base.pair.backlash - offset
    for delta, pressed in ((first - 1e-6, 0.0), (first + 1e-6, 1e-6), (last + 1e-6, 0.0),
                           (last - 1e-6, -1e-6)):  # fmt: skip
        q[0] = delta / plane.cos_b
        points, _, _ = loaded_points(parameters, 0.6, q)
        assert np.allclose(points[:, LOAD], pressed * k, rtol=1e-9, atol=1e-6)


def test_damping_turns_against_the_relative_rotation_and_never_makes_flanks_adhere() -> None:
    """2 zeta sqrt(m_e k_m) d(psi)/dt where all points are deep; zeta 5 percent."""
    for contact in ("linear", "one_sided"):
        parameters = replace(he_2007_pair(0.0), contact=contact)
        c, q = parameters.kernel_parameters(), np.zeros(12)
        depth = {"deep": 5e-6, "back": -c.backlash - 5e-6, "apart": -0.5 * c.backlash}
        for name, delta in depth.items():
            q[0] = delta / c.plane.cos_b
            points, wrench, _ = loaded_points(parameters, 0.2, q)
            k_m = float(parameters.mesh.density.max()) * points[:, LENGTH].sum() * c.plane.cos_b**2
            full = 0.1 * math.sqrt(c.m_e * k_m)
            for rate in (0.001, -0.001):
                force = points_damping(rate, c, points, len(points))
                expected = 0.0 if (contact, name) == ("one_sided", "apart") else full * rate
                assert force == pytest.approx(expected, rel=1e-12)
            # psi grows as the drive flanks part and the back flanks close
            fast = points_damping(1e3, c, points, len(points))
            limited = contact == "one_sided" and name == "deep"
            assert fast == pytest.approx(-wrench[0] if limited else expected * -1e6, rel=1e-12)


@pytest.mark.slow
def test_damping_is_continuous_as_points_begin_to_touch() -> None:
    """Over the penetration: no jump at first contact, and the share of stiffness that touches."""
    parameters = replace(he_2007_pair(0.0), contact="one_sided", line_divisions=8)
    c, q = parameters.kernel_parameters(), np.zeros(12)
    q[4] = 5e-5  # tilted: points touch one by one
    depth = np.linspace(-4e-6, 4e-6, 4001)
    force = []
    for delta in depth:
        q[0] = delta / c.plane.cos_b
        points = loaded_points(parameters, 0.2, q)[0]
        force.append(points_damping(-1e-3, c, points, len(points)))
    assert force[0] == 0.0
    assert force[-1] < 0.0  # the drive flanks close
    # a step of 2 nm adds 2 nm/0.5 um of what is building up at most
    assert np.abs(np.diff(force)).max() <= 1.01 * 2e-9 / 0.5e-6 * np.abs(force).max()


def test_lines_keep_their_data_through_the_change_of_period() -> None:
    """Line i at the period's end is line i + 1 at the next one's start, interpolated data too."""
    pair = named_pair("he_2007")
    base = he_2007_pair(0.0)
    stations, n = np.array([0.0, 0.3, 1.0]), 4
    age = np.arange(3)[None, :, None] + np.arange(n)[:, None, None] / n
    density = 1e10 * (1.0 + 0.2 * age + 0.1 * stations)
    mesh = replace(
        base.mesh, phase=np.arange(n) / n, station=stations, density=density[None],
        offset=1e-6 * age[None] + 0.0 * stations,
    )  # fmt: skip
    parameters = replace(base, mesh=mesh)
    plane = pair.plane
    for phase in (0.1, 0.74, 0.9):
        points, _, _ = loaded_points(parameters, phase, np.zeros(12))
        X_line = points[:, X] + (0.5 * plane.W - points[:, Z]) * plane.sin_b / plane.cos_b
        expected_age = (X_line - plane.A) / plane.pitch
        last = points[:, 6] == 2.0  # nothing follows the oldest line: it keeps its last row
        expected = np.where(last, np.minimum(expected_age, 2.75), expected_age)
        assert np.allclose(points[:, OFFSET], 1e-6 * expected, rtol=1e-9)
        share = points[:, DENSITY] / 1e10 - 1.0 - 0.2 * expected
        assert share.min() > -1e-9
        assert share.max() < 0.1 + 1e-9
        assert np.allclose(points[:, LOAD], -points[:, DENSITY] * points[:, OFFSET], rtol=1e-12)
