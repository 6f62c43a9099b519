"""Stiffness and damping of the axle from differences, on made-up forces with known derivatives."""

import importlib
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_ODE,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)  # fmt: skip
from gearlube_core.dynamics.train.march import RATES, RENEW

# the package has a function of this name
module = importlib.import_module("gearlube_core.dynamics.hypoid_axle.linearise")
PLACES = [W_P, W_G, *range(V_P, V_P + 3), *range(V_G, V_G + 3)]
MOVED = [*range(U_P, U_P + 3), *range(U_G, U_G + 3)]
MASSES = np.array([0.006, 0.09, 5.0, 5.0, 5.0, 28.0, 28.0, 28.0])
RADIUS, RATIO, NORMAL = 0.041, 2.77, np.array([0.6, 0.48, 0.64])
# d(transmission error)/d(coordinate)
CLOSING = np.array([RADIUS, -RATIO * RADIUS, *NORMAL, *-NORMAL])
MESH_STIFFNESS = 3e8  # N/m
RANDOM = np.random.default_rng(12)
SUPPORT = 1e8 * RANDOM.normal(size=(8, 6))  # N/m, not symmetric as of hysteresis
CIRCULATORY = 1e7 * RANDOM.normal(size=(8, 6))  # N/m, where hysteresis is on
DAMPING = 1e3 * RANDOM.normal(size=(8, 8))  # N s/m
ROLLERS, APPROACH, EXPONENT = 1e9, 2e-8, 10.0 / 9.0  # N/m^n; lightly pressed: 20 nm


@pytest.fixture
def linear(monkeypatch):
    """A linearised axle whose forces are those above."""
    at = 1e-6 * RANDOM.normal(size=SIDE + 1)
    at[PLACES] = RANDOM.normal(size=8)
    renewed = []

    def operate(operation, s, oil_temperature, numbers, memory, plan, size, rate, work):
        assert (oil_temperature, memory, plan) == (350.0, "means", "plan")
        assert (s[LOAD_TORQUE], s[SIDE]) == (60.0, -1.0)
        if operation == RENEW:
            renewed.append(s.copy())
            return
        assert operation == RATES
        np.testing.assert_array_equal(renewed[-1], s)
        changed = s - at
        places = [*PLACES, *MOVED, X, LOAD_TORQUE, SIDE]
        assert not np.delete(changed, places).any()  # the pinion angle above all
        moved = changed[MOVED]
        force = -MESH_STIFFNESS * CLOSING * changed[X] - SUPPORT @ moved
        force[2:] -= ROLLERS * (APPROACH + moved) ** EXPONENT
        if numbers:  # with hysteresis
            force -= DAMPING @ changed[PLACES] + CIRCULATORY @ moved
        work[PLACES], work[X] = force / MASSES, CLOSING @ s[PLACES]

    monkeypatch.setattr(module, "memory_of_means", lambda made: "means")
    monkeypatch.setattr(module, "numbers_at_rest", lambda *_, hysteresis, cages: hysteresis)
    monkeypatch.setattr(module, "work_size", lambda sizes: N_ODE)
    given = SimpleNamespace(
        oil="oil", pinion_inertia=0.006, gear_inertia=0.09, pinion_mass=5.0, gear_mass=28.0
    )
    made = SimpleNamespace(sizes=SimpleNamespace(integrated=N_ODE), plan="plan")
    axle = SimpleNamespace(
        assembly=made, parameters=given, elements=[], operate=operate, state_view=at
    )
    return module.linearise(axle, 350.0, -60.0)


def test_stiffness_is_that_of_mesh_and_supports(linear):
    expected = MESH_STIFFNESS * np.outer(CLOSING, CLOSING)
    expected[:, 2:] += SUPPORT
    rollers = ROLLERS * EXPONENT * APPROACH ** (EXPONENT - 1.0)
    expected[2:, 2:] += rollers * np.eye(6)
    # (n - 1)(2 - n)/6 = 1/60 of the square of 1 nm over 20 nm is left out of rollers' stiffness;
    # states of 1e-6 round displacements of 1e-9 by 1e-13
    limit = np.full((8, 8), 1e-8 * MESH_STIFFNESS) + 1e-8 * np.abs(expected)
    limit[2:, 2:] += 5e-5 * rollers * np.eye(6)
    assert np.all(np.abs(linear.stiffness - expected) < limit)
    np.testing.assert_array_equal(linear.mass, np.diag(MASSES))


def test_damping_is_that_of_the_speeds_and_hysteresis_circulates(linear):
    # states of size 1 round speeds of 1e-5 by 1e-11, rollers' force of 2 N by 1e-16 / 1e-5
    np.testing.assert_allclose(linear.damping, DAMPING, rtol=0.0, atol=1e-9 * np.abs(DAMPING).max())
    assert not linear.circulatory[:, :2].any()
    np.testing.assert_allclose(linear.circulatory[:, 2:], CIRCULATORY, rtol=0.0, atol=10.0)
