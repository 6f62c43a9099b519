"""One interval of the driveline on linear equations, whose steps are powers of a matrix."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest

from drivetrain.driveline.equations import MEMORY, POWERS, STATES, driveline_stepper
from tests.helpers.communication_stability import interval_jacobian

N, COUNT = len(STATES), len(POWERS)
PROPSHAFT, HALF_SHAFT = 700.0, 90.0  # N m/rad
H, INNER = 0.08, 3
RNG = np.random.default_rng(8)
RATES = RNG.uniform(-3.0, 3.0, (N + COUNT + 2, N + 5))  # of states, powers, torques
P = (0.4, -0.7, 1.3)


def linear(x: ca.SX, u: ca.SX, p: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Return what `driveline_equations` does: rates, torques, powers, stored."""
    y = ca.DM(RATES) @ ca.vertcat(x, u, p)
    return y[:N], y[N + COUNT :], y[N : N + COUNT], ca.SX(0.0)


@pytest.fixture(scope="module")
def interval() -> ca.Function:
    return driveline_stepper(linear, INNER, PROPSHAFT, HALF_SHAFT)


def curved(x: ca.SX, u: ca.SX, p: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Return the same with rates that depend on every state in a bent way."""
    return tuple(part + ca.sum1(ca.sin(x)) * ca.sin(part) for part in linear(x, u, p))


def step_matrix() -> np.ndarray:
    """Return the map of an interval on (states, speeds, p, integrals): RK4, order by order."""
    size = N + 5 + COUNT + 2
    rates = np.zeros((size, size))
    rates[:N, : N + 5] = RATES[:N]
    rates[N + 5 :, : N + 5] = RATES[N:]
    z = H / INNER * rates
    one = np.eye(size) + z + z @ z / 2.0 + z @ z @ z / 6.0 + z @ z @ z @ z / 24.0
    return np.asarray(np.linalg.matrix_power(one, INNER))


@pytest.mark.parametrize("started", [0.0, 1.0])
def test_interval_is_runge_kutta_after_twists_follow_the_angles(
    interval: ca.Function, started: float
):
    before = dict(zip(MEMORY, RNG.uniform(-1.0, 1.0, len(MEMORY)), strict=True))
    before |= {"crank_angle": 12.5, "crank_speed": 40.0, "started": started}
    motion = {"pinion_angle": 0.3, "pinion_speed": 5.0, "wheel_angle": -0.2, "wheel_speed": 2.0}
    z_end, torques = interval(list(before.values()), [H, *motion.values()], P)
    after = dict(zip(MEMORY, np.asarray(z_end).ravel(), strict=True))

    lead = started * (motion["pinion_angle"] - before["pinion_angle"])
    lead_wheel = started * (motion["wheel_angle"] - before["wheel_angle"])
    start = before | {
        "propshaft_twist": before["propshaft_twist"] - lead,
        "half_shaft_twist": before["half_shaft_twist"] + lead_wheel,
    }
    whole = [start[name] for name in STATES]
    whole += [motion["pinion_speed"], motion["wheel_speed"], *P, *[0.0] * (COUNT + 2)]
    end = step_matrix() @ whole
    turned = end[0]
    assert turned > 4.0 * math.pi  # within the next cycle of four strokes
    end[0] -= 4.0 * math.pi
    assert [after[name] for name in STATES] == pytest.approx(end[:N])

    works = dict(zip(POWERS, end[N + 5 :], strict=False))
    # the axle turned farther than expected, under the torques of the interval before
    works["pinion"] += before["pinion_torque"] * lead
    works["ring_gear"] += before["wheel_torque"] * lead_wheel
    for name in POWERS:
        assert after[name] - before[name] == pytest.approx(works[name])
    stored = [
        0.5 * PROPSHAFT * one["propshaft_twist"] ** 2
        + 0.5 * HALF_SHAFT * one["half_shaft_twist"] ** 2
        for one in (before, start)
    ]
    left = before["pinion_torque"] * lead - before["wheel_torque"] * lead_wheel
    assert after["interface"] - before["interface"] == pytest.approx(stored[1] - stored[0] + left)

    means = end[-2:] / H
    assert [after["pinion_torque"], after["wheel_torque"]] == pytest.approx(means)
    assert after["pinion_angle"] == pytest.approx(0.3 + H * 5.0)
    assert after["wheel_angle"] == pytest.approx(-0.2 + H * 2.0)
    assert after["started"] == 1.0
    assert np.asarray(torques).ravel() == pytest.approx([*means, sum(after.values())])


def test_derivatives_of_an_interval_are_parts_of_its_matrix(interval: ca.Function):
    # of states but the crank angle, and of pinion and wheel speed, with the angles expected
    states, torques = interval_jacobian(interval)(RNG.uniform(-1.0, 1.0, N + 1), H, P)
    matrix = step_matrix()
    free = slice(1, N + 2)
    assert np.asarray(states) == pytest.approx(matrix[1:N, free])
    assert np.asarray(torques) == pytest.approx(matrix[-2:, free] / H)


def test_derivatives_are_taken_at_crank_angle_zero_with_the_angles_expected():
    interval = driveline_stepper(curved, INNER, PROPSHAFT, HALF_SHAFT)
    y, step = RNG.uniform(-1.0, 1.0, N + 1), 1e-5

    def outcome(y: np.ndarray) -> np.ndarray:
        memory = dict.fromkeys(MEMORY, 0.0) | dict(zip(STATES[1:], y, strict=False))
        z_end, torques = interval(list(memory.values()), [H, 0.0, y[-2], 0.0, y[-1]], P)
        return np.concatenate((np.asarray(z_end)[1:N, 0], np.asarray(torques)[:2, 0]))

    differences = np.array(
        [
            (outcome(y + step * one) - outcome(y - step * one)) / (2.0 * step)
            for one in np.eye(N + 1)
        ]
    ).T
    found = np.vstack([np.asarray(one) for one in interval_jacobian(interval)(y, H, P)])
    # third derivatives times 1e-10
    assert found == pytest.approx(differences, abs=1e-6 * np.abs(differences).max())
