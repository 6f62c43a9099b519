"""Stability of the exchange of torques, against runs of the real loop."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from drivetrain.driveline.equations import STATES
from drivetrain.driveline.model import COMMUNICATION_STEP, Driveline
from drivetrain.driveline.modes import driveline_modes
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.engine import Engine
from drivetrain.road_load import mohammadpour_2015_road_load
from tests.helpers.communication_stability import (
    TorsionalAxle,
    communication_map,
    communication_stability,
    largest_stable_step,
)
from tests.helpers.each import each

RATIO = 36 / 13
SMOOTH = DrivelineParameters(road_load=mohammadpour_2015_road_load(), engine=Engine(orders=()))
RIGID, ELASTIC = TorsionalAxle(), TorsionalAxle.karagiannis_2012()


class LinearAxle:
    """A torsional axle that moves exactly under held torques; its own little code."""

    def __init__(self, axle: TorsionalAxle, line: Driveline, h: float) -> None:
        self.rigid = math.isinf(axle.mesh_stiffness)
        ip, ig, c = axle.pinion_inertia, axle.gear_inertia, axle.mesh_damping
        k = 0.0 if self.rigid else axle.mesh_stiffness
        # State: pinion angle and speed, gear angle and speed.
        a = np.zeros((6, 6))
        a[0, 1] = a[2, 3] = 1.0
        if self.rigid:
            inertia = ip + ig / RATIO**2
            a[1, 4], a[1, 5] = 1 / inertia, -1 / RATIO / inertia
            a[3] = a[1] / RATIO
        else:
            a[1, :4] = np.array([-k, -c, k * RATIO, c * RATIO]) / ip
            a[3, :4] = np.array([k, c, -k * RATIO, -c * RATIO]) * RATIO / ig
            a[1, 4], a[3, 5] = 1 / ip, -1 / ig
        self.map = expm(a * h)
        steady = line.steady
        wound = 0.0 if self.rigid else steady.pinion_torque / k
        self.state = np.array([wound, steady.pinion_speed, 0.0, steady.wheel_speed])

    def step(self, pinion: float, wheel: float) -> None:
        self.state = (self.map @ np.append(self.state, [pinion, wheel]))[:4]


def cosimulate(axle: TorsionalAxle, speed: float, h: float, steps: int, kick: float) -> np.ndarray:
    """Deviations of (states but crank angle, pinion speed) from the steady state, per step."""
    line = Driveline(SMOOTH, speed)
    partner = LinearAxle(axle, line, h)
    partner.state[1] += kick
    if partner.rigid:
        partner.state[3] += kick / RATIO
    rows = np.empty((steps, len(STATES)))
    for n in range(steps):
        torques = line.step(h, *partner.state)
        partner.step(*torques)
        deviation = line.get_state()[1 : len(STATES)] - line.steady.state[1:]
        rows[n] = np.append(deviation, partner.state[1] - line.steady.pinion_speed)
    return rows


@each("axle", [RIGID, ELASTIC])
def test_a_stable_exchange_follows_the_linear_map(axle: TorsionalAxle) -> None:
    h, speed, kick, steps = 1e-4, 60 / 3.6, 1e-3, 300
    line = Driveline(SMOOTH, speed)
    step_map = communication_map(line, h, axle)
    deviation = np.zeros(len(step_map))
    # Axle state: (w_p) or (wind-up, w_p, w_g).
    deviation[len(STATES) - 1 + (len(deviation) > len(STATES))] = kick
    expected = np.empty(steps)
    for n in range(steps):
        deviation = step_map @ deviation
        expected[n] = deviation[len(STATES) - 1 + (len(deviation) > len(STATES))]
    found = cosimulate(axle, speed, h, steps, kick)[:, -1]
    # Linearisation of drag and tyre, 1e-3 of the kick, and rounding of angles.
    assert np.max(np.abs(found - expected)) < 2e-6 * kick + 1e-9


@pytest.mark.slow
def test_the_default_step_leaves_a_margin() -> None:
    line = Driveline(SMOOTH, 60.0 / 3.6)
    # Documented beside COMMUNICATION_STEP: 1.06 ms and 0.23 ms.
    assert largest_stable_step(line, RIGID) > 10 * COMMUNICATION_STEP
    assert largest_stable_step(line, ELASTIC) > 2 * COMMUNICATION_STEP
    rigid = communication_stability(line, COMMUNICATION_STEP, RIGID)
    assert rigid.stable
    # Numerical damping of the propshaft mode against its ratio of 0.031.
    assert max(abs(mode.added_damping_ratio) for mode in rigid.modes) < 1e-4
    elastic = communication_stability(line, COMMUNICATION_STEP, ELASTIC)
    mesh, propshaft = elastic.modes[:2]
    assert elastic.stable
    assert mesh.frequency > 1800
    assert abs(propshaft.added_damping_ratio) < 1e-3
    assert -6e-3 < mesh.added_damping_ratio < 0.0


def test_linear_continuation_costs_damping_with_the_third_power_of_the_step() -> None:
    undamped = replace(SMOOTH, propshaft_damping=0.0, half_shaft_damping=0.0)
    line = Driveline(undamped, 60 / 3.6)
    added = [
        communication_stability(line, h, ELASTIC).modes[0].added_damping_ratio for h in (8e-5, 4e-5)
    ]
    assert max(added) < 0.0
    # Quadratic error of the angle, in quadrature to the angle in the next order: h^3.
    assert math.log2(added[0] / added[1]) == pytest.approx(3.0, abs=0.2)


def test_short_steps_reproduce_the_modes_of_the_coupled_system() -> None:
    line = Driveline(SMOOTH, 60 / 3.6)
    found = communication_stability(line, 1e-5, RIGID)
    exact = driveline_modes(line)
    assert len(found.modes) == len(exact)
    for mode, reference in zip(found.modes, exact, strict=True):
        # Same Jacobian by two routes; the exchange adds 1e-5.
        assert mode.frequency == pytest.approx(reference.frequency, rel=1e-9)
        assert mode.cosimulated_damping_ratio == pytest.approx(reference.damping_ratio, abs=3e-5)
