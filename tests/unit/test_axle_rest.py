"""Search for the axle's static equilibrium, with a made-up solver and made-up forces."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import start as module
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_STATE,
    SIDE,
    U_G,
    U_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshLevels
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, R_P
from tests.helpers.source_of import interpret, source_of

RADIUS, STIFFNESS, BACKLASH, RATIO = 0.04, 3e8, 1.5e-4, 2.77
FORCE = 60.0 / RADIUS  # N, of the mesh
NEEDED = 10.0 ** np.arange(3, -7, -1)  # N/um: from stiff as a bearing to nothing that counts


STEP = np.array([1.0, -2.0, 3.0, -4.0, 5.0, -6.0])  # um, of the made-up solver
OPEN = np.array([0.1, -0.2, 0.3, -0.4, 0.5, -1.0])


def searched(monkeypatch, left, torque=60.0, balance=OPEN):
    """Search where the balance of an attempt without springs is open by `left(attempt)` [N]."""
    interpret(monkeypatch, module)
    springs, starts = [], []

    def displacements(u, scale, problem, work):
        assert np.all(scale == 1.0)
        springs.append(problem.soft[0])
        starts.append(u.copy())
        u += STEP

    def rest_forces(u, problem, out):
        assert tuple(problem.inputs) == (torque, *[0.0] * 6)
        found = {place: value for place, value in enumerate(problem.s) if value != 0.0}
        side = -1.0 if torque < 0.0 else 1.0
        expected = {LOAD_TORQUE: abs(torque), SIDE: side, X: s[X]}
        assert found == {place: value for place, value in expected.items() if value != 0.0}
        out[:] = left(len(springs)) * balance

    means = np.full(N_SERIES, np.nan)
    means[[R_P, K_M]] = RADIUS, STIFFNESS
    monkeypatch.setattr(module, "_displacements", displacements)
    monkeypatch.setattr(module, "rest_forces", rest_forces)
    monkeypatch.setattr(module, "lubricant_state", lambda oil, temperature, laws: oil)
    p = SimpleNamespace(oil="oil", ratio=RATIO, mesh=SimpleNamespace(backlash=BACKLASH))
    mesh = MeshLevels(np.array([50.0]), means, 0, np.zeros(0), 3)
    s = np.full(N_STATE, np.nan)
    work = np.full(module.REST_WORK, np.nan)
    status, worst = source_of(module.rest)(s, 200.0, torque, 350.0, mesh, p, work)
    return s, status, worst, springs, starts


def test_a_balance_that_closes_at_once_takes_no_springs(monkeypatch):
    s, status, worst, springs, starts = searched(monkeypatch, lambda attempt: 0.99e-4 * FORCE)
    assert (status, springs) == (module.OK, [0.0])
    assert worst == pytest.approx(0.99e-4 * FORCE, rel=1e-14)
    assert not starts[0].any()
    places = [*range(U_P, U_P + 3), *range(U_G, U_G + 3)]
    np.testing.assert_array_equal(s[places], STEP)
    assert (s[W_P], s[W_G]) == (200.0, pytest.approx(200.0 / RATIO, rel=1e-14))
    assert (s[LOAD_TORQUE], s[SIDE]) == (60.0, 1.0)
    assert s[X] == pytest.approx(1e6 * FORCE / STIFFNESS, rel=1e-14)
    assert not np.delete(s, [*places, W_P, W_G, LOAD_TORQUE, SIDE, X]).any()


def test_springs_soften_tenfold_from_those_of_a_bearing_and_are_taken_away(monkeypatch):
    s, status, worst, springs, starts = searched(
        monkeypatch, lambda attempt: 0.0 if attempt > 1 else 1.01e-4 * FORCE
    )
    assert status == module.OK
    np.testing.assert_allclose(springs, [0.0, *NEEDED, 0.0], rtol=1e-12)
    # the first springs start anew, each search after them where the last one ended
    assert [found[0] for found in starts] == [0.0, 0.0, *range(1, 11)]
    assert worst == 0.0
    np.testing.assert_array_equal(s[U_P : U_P + 3], 11.0 * STEP[:3])


@pytest.mark.parametrize("left", [1.0, math.nan, math.inf])
def test_what_stays_open_is_no_equilibrium(monkeypatch, left):
    _, status, worst, springs, _ = searched(monkeypatch, lambda attempt: left)
    assert status == module.NO_EQUILIBRIUM
    assert worst == (left if left == 1.0 else math.inf)
    assert len(springs) == 12


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_every_balance_counts(monkeypatch, place, sense):
    balance = sense * (np.arange(6) == place)
    _, status, worst, *_ = searched(monkeypatch, lambda attempt: 1.01e-4 * FORCE, balance=balance)
    assert (status, worst) == (module.NO_EQUILIBRIUM, 1.01e-4 * FORCE)


def test_coast_flanks_lie_behind_the_backlash_and_no_torque_between(monkeypatch):
    # without load the balance closes to 1e-4 N
    s, status, *_ = searched(monkeypatch, lambda attempt: 0.99e-4, torque=0.0)
    assert (status, s[X], s[SIDE]) == (module.OK, 0.0, 1.0)
    s, status, *_ = searched(monkeypatch, lambda attempt: 1.01e-4, torque=0.0)
    assert status == module.NO_EQUILIBRIUM
    s, *_ = searched(monkeypatch, lambda attempt: 0.0, torque=-60.0)
    assert s[X] == pytest.approx(-1e6 * (FORCE / STIFFNESS + BACKLASH), rel=1e-14)
    assert (s[SIDE], s[LOAD_TORQUE]) == (-1.0, 60.0)
