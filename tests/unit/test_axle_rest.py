"""Search for the shafts' places at rest, with a made-up solver and made-up forces."""

import math

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import shafts_at_rest as module
from tests.helpers.source_of import interpret, source_of

FORCE = 1500.0  # N, of the mesh
NEEDED = 10.0 ** np.arange(9, -1, -1)  # N/m: from stiff as a bearing to nothing that counts
STEP = 1e-6 * np.array([1.0, -2.0, 3.0, -4.0, 5.0, -6.0])  # m, of the made-up solver
OPEN = np.array([0.1, -0.2, 0.3, -0.4, 0.5, -1.0])


def searched(monkeypatch, left, force=FORCE, balance=OPEN):
    """Search where the balance of an attempt without springs is open by `left(attempt)` [N]."""
    interpret(monkeypatch, module)
    springs, starts = [], []
    forces = force * np.array([0.6, 0.48, 0.64, -0.6, -0.48, -0.64])

    def displacements(u, scale, problem, work):
        assert np.all(scale == 1e-6)
        springs.append(problem.soft[0])
        starts.append(u.copy())
        u += STEP

    def missing(u, problem, out):
        assert (problem.oil, problem.p) == ("oil", "axle")
        assert problem.forces is forces
        out[:] = left(len(springs)) * balance

    monkeypatch.setattr(module, "_displacements", displacements)
    monkeypatch.setattr(module, "_missing", missing)
    u = np.full(6, np.nan)
    work = np.full(module.REST_WORK, np.nan)
    status, worst = source_of(module.shafts_at_rest)(u, forces, abs(force), "oil", "axle", work)
    return u, status, worst, springs, starts


def test_a_balance_that_closes_at_once_takes_no_springs(monkeypatch):
    u, status, worst, springs, starts = searched(monkeypatch, lambda attempt: 0.99e-4 * FORCE)
    assert (status, springs) == (module.OK, [0.0])
    assert worst == pytest.approx(0.99e-4 * FORCE, rel=1e-14)
    assert not starts[0].any()
    np.testing.assert_array_equal(u, STEP)


def test_springs_soften_tenfold_from_those_of_a_bearing_and_are_taken_away(monkeypatch):
    u, status, worst, springs, starts = searched(
        monkeypatch, lambda attempt: 0.0 if attempt > 1 else 1.01e-4 * FORCE
    )
    assert status == module.OK
    np.testing.assert_allclose(springs, [0.0, *NEEDED, 0.0], rtol=1e-12)
    # the first springs start again, each search after them where the last one ended
    np.testing.assert_allclose(
        [found[0] for found in starts], 1e-6 * np.array([0.0, 0.0, *range(1, 11)]), rtol=1e-12
    )
    assert worst == 0.0
    np.testing.assert_allclose(u, 11.0 * STEP, rtol=1e-12)


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


def test_without_load_the_balance_closes_to_a_share_of_a_newton(monkeypatch):
    assert searched(monkeypatch, lambda attempt: 0.99e-4, force=0.0)[1] == module.OK
    assert searched(monkeypatch, lambda attempt: 1.01e-4, force=0.0)[1] == module.NO_EQUILIBRIUM
