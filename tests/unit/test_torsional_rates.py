"""Rates of the torsional pair: energy, printed form, loads, and the reduction to one freedom."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional import rates as module
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import DE, DK, N_ROW, R_G, R_P, K
from gearlube_core.dynamics.hypoid_torsional.rates import FlankTorques
from tests.helpers.source_of import interpret

ROWS = np.full((3, N_ROW), np.nan)
ROWS[1, [K, DK, R_P, R_G, DE]] = 4e8, -3e7, 0.021, 0.058, 1.3e-6
X, W_P, W_G, PHI, LOAD, SPEED = 2e-6, 310.0, 112.0, 0.8, 140.0, 314.0
DAMPING = 900.0  # N s/m


def parameters(**given) -> SimpleNamespace:
    return SimpleNamespace(
        **{
            "consistent": 1.0, "friction_form": 0.0, "pinion_torque": 50.0, "hold_gain": 0.7,
            "instantaneous_load": 0.0, "ratio": 2.77, "I_p": 1.7e-3, "I_g": 5.8e-2, "ripple": 0.2,
            "R_p0": 0.022, "m_eq": 2.9,
        }
        | given
    )  # fmt: skip


@pytest.fixture(autouse=True)
def laws(monkeypatch):
    """A linear spring and damper in mode 7, and friction that takes 30 W."""
    interpret(monkeypatch, module)

    class Force(tuple):
        """Deviation and force."""

        force = property(lambda self: self[1])

    def force_in_mode(mode, x, x_rate, k, p):
        assert mode == 7
        return Force((x, k * x + DAMPING * x_rate))

    def friction(rows, i, w_p, w_g, force, p):
        assert (i, w_p, w_g) == (1, W_P, W_G)
        return FlankTorques(-0.02 * force / W_P, -0.01 * force / W_G, 0.03 * force)

    monkeypatch.setattr(module, "force_in_mode", force_in_mode)
    monkeypatch.setattr(module, "flank_torques", friction)


def pair(**given):
    return module.pair_rates(X, W_P, W_G, PHI, LOAD, SPEED, ROWS, 1, 7, parameters(**given))


def test_power_put_in_is_stored_dissipated_or_taken_by_the_load():
    found, p = pair(), parameters()
    closing = (0.021 - 1.3e-6) * W_P - 0.058 * W_G
    assert found.x == pytest.approx(closing)
    stored = p.I_p * W_P * found.w_p + p.I_g * W_G * found.w_g
    # k x^2/2, whose stiffness changes as the pinion turns
    stored += 4e8 * X * closing + 0.5 * -3e7 * W_P * X**2
    given = found.pinion_torque * W_P - found.load_torque * W_G
    taken = DAMPING * closing**2 + 0.03 * found.force
    assert stored == pytest.approx(given - taken, rel=1e-10)
    assert found.force == pytest.approx(4e8 * X + DAMPING * closing)
    assert found.damping_power == pytest.approx(DAMPING * closing**2)
    assert found.friction_power == pytest.approx(0.03 * found.force)
    assert found.friction_p == pytest.approx(-0.02 * found.force / W_P)
    assert found.friction_g == pytest.approx(-0.01 * found.force / W_G)
    assert found.pinion_torque == pytest.approx(50.0 * (1.0 + 0.2 * math.cos(PHI)) + 0.7 * 4.0)
    assert found.load_torque == LOAD


def test_printed_form_turns_the_pinion_with_its_radius_alone():
    found, p = pair(consistent=0.0, friction_form=-1.0), parameters()
    assert found.torque_p == pytest.approx(-0.021 * found.force)
    assert (found.friction_p, found.friction_g, found.friction_power) == (0.0, 0.0, 0.0)
    assert p.I_p * found.w_p == pytest.approx(found.pinion_torque - 0.021 * found.force)
    assert p.I_g * found.w_g == pytest.approx(0.058 * found.force - LOAD)
    friction = pair(consistent=0.0)
    assert p.I_p * (friction.w_p - found.w_p) == pytest.approx(-0.02 * found.force / W_P)
    assert p.I_g * (friction.w_g - found.w_g) == pytest.approx(-0.01 * found.force / W_G)


def test_instantaneous_load_follows_the_ratio_of_the_radii():
    p, found = parameters(), pair(instantaneous_load=1.0)
    assert found.load_torque == pytest.approx(LOAD * 0.058 / 0.021 / 2.77)
    assert p.I_g * (pair().w_g - found.w_g) == pytest.approx(found.load_torque - LOAD)


def test_torque_without_ripple_is_its_mean():
    assert module.ripple(PHI, parameters(ripple=0.0)) == 1.0
    assert module.ripple(0.0, parameters()) == pytest.approx(1.2)
    assert module.ripple(math.pi, parameters()) == pytest.approx(0.8)


def test_reduction_is_an_oscillator_driven_by_error_and_ripple():
    p, v = parameters(), 0.004
    found = module.reduced_rates(X, v, PHI, SPEED, ROWS, 1, 7, p)
    assert found.x == pytest.approx(v - 1.3e-6 * SPEED)
    assert found.force == pytest.approx(4e8 * X + DAMPING * found.x)
    # m_eq v' = F_mean - F; of the ripple the share of the pinion's inertia seen at the mesh
    swing = 0.2 * math.cos(PHI) * 2.9 * 0.022**2 / 1.7e-3
    assert 2.9 * found.v == pytest.approx(50.0 / 0.022 * (1.0 + swing) - found.force)
