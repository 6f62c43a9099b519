"""Stiffness and damping of the axle from differences, on made-up forces with known derivatives."""

from types import SimpleNamespace

import numpy as np

from gearlube_core.dynamics.hypoid_axle import force_derivatives as module
from gearlube_core.dynamics.hypoid_axle.state import N_STATE, U_G, U_P, V_G, V_P, W_G, W_P, X
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshLevels
from gearlube_core.mesh_table.kernels import N_SERIES, N_X, R_P
from tests.helpers.each import each
from tests.helpers.source_of import interpret, source_of

PLACES = (W_P, W_G, *range(V_P, V_P + 3), *range(V_G, V_G + 3))
MASSES = np.array([0.006, 0.09, 5.0, 5.0, 5.0, 28.0, 28.0, 28.0])
RADIUS, RATIO, NORMAL = 0.041, 2.77, np.array([0.6, 0.48, 0.64])
# d(transmission error)/d(coordinate)
CLOSING = np.array([RADIUS, -RATIO * RADIUS, *NORMAL, *-NORMAL])
MESH_STIFFNESS = 3e8  # N/m
RANDOM = np.random.default_rng(12)
SUPPORT = 1e8 * RANDOM.normal(size=(8, 6))  # N/m, not symmetric as of hysteresis
DAMPING = 1e3 * RANDOM.normal(size=(8, 8))  # N s/m
ROLLERS, APPROACH, EXPONENT = 1e9, 2e-8, 10.0 / 9.0  # N/m^n; lightly pressed: 20 nm


def found(monkeypatch, of_speeds):
    interpret(monkeypatch, module)
    at = RANDOM.normal(size=N_STATE)

    def axle_rhs(s, inputs, mesh, oil, p, tractions, bearings, scratch, slope):
        assert (oil, p, tractions, bearings) == ("oil", axle, 1.0, 1.0)
        assert tuple(inputs) == (0.0,) * 7
        changed = s - at
        moved = 1e-6 * changed[[*range(U_P, U_P + 3), *range(U_G, U_G + 3)]]
        force = -MESH_STIFFNESS * CLOSING * 1e-6 * changed[X] - SUPPORT @ moved
        force[2:] -= ROLLERS * (APPROACH + moved) ** EXPONENT
        force -= DAMPING @ changed[list(PLACES)]
        slope[list(PLACES)] = force / MASSES
        moved_places = {X, *range(U_P, U_P + 3), *range(U_G, U_G + 3), *PLACES}
        assert np.all(np.delete(changed, list(moved_places)) == 0.0)  # the pinion angle above all

    monkeypatch.setattr(module, "axle_rhs", axle_rhs)
    monkeypatch.setattr(module, "lubricant_state", lambda oil, temperature, laws: oil)
    axle = SimpleNamespace(I_p=0.006, I_g=0.09, m_p=5.0, m_g=28.0, ratio=RATIO, oil="oil")
    means = np.full(N_SERIES, np.nan)
    means[R_P], means[N_X : N_X + 3] = RADIUS, NORMAL
    # two levels, the means halfway between them
    levels = np.concatenate([0.8 * means, 1.2 * means])
    mesh = MeshLevels(np.array([40.0, 80.0]), levels, 0, np.zeros(0), 3)
    matrix = np.full(64, np.nan)
    source_of(module.force_derivatives)(
        at, of_speeds, 60.0, 350.0, mesh, axle, np.zeros(module.DERIVATIVES_WORK), matrix
    )
    return matrix.reshape(8, 8)


def test_stiffness_is_that_of_mesh_and_supports(monkeypatch):
    expected = MESH_STIFFNESS * np.outer(CLOSING, CLOSING)
    expected[:, 2:] += SUPPORT
    rollers = ROLLERS * EXPONENT * APPROACH ** (EXPONENT - 1.0)
    expected[2:, 2:] += rollers * np.eye(6)
    # (n - 1)(2 - n)/6 = 1/60 of the square of 1 nm over 20 nm is left out of rollers' stiffness;
    # states of size 1 round displacements of 1e-3 um by 1e-13
    limit = np.full((8, 8), 1e-8 * MESH_STIFFNESS) + 1e-8 * np.abs(expected)
    limit[2:, 2:] += 5e-5 * rollers * np.eye(6)
    assert np.all(np.abs(found(monkeypatch, 0.0) - expected) < limit)


def test_damping_is_that_of_the_speeds(monkeypatch):
    # states of size 1 round speeds of 1e-5 by 1e-11, rollers' force of 2 N by 1e-16 / 1e-5
    np.testing.assert_allclose(
        found(monkeypatch, 1.0), DAMPING, rtol=0.0, atol=1e-9 * np.abs(DAMPING).max()
    )


@each(("j", "place"), list(enumerate(PLACES)))
def test_coordinates_have_their_speeds_and_masses(j, place):
    axle = SimpleNamespace(I_p=0.006, I_g=0.09, m_p=5.0, m_g=28.0)
    assert source_of(module._rate_place)(j) == place
    assert source_of(module.mass_of)(j, axle) == MASSES[j]
