"""Where a part of a step ends, on motions whose change of the contact mode is known."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.hypoid_torsional import mode_march, rates
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import N_ROW, R_G, R_P, TWO_DOF, K
from gearlube_core.dynamics.hypoid_torsional.rates import FULL, GAP, LAYER, OPEN
from tests.helpers.source_of import interpret, source_of

PHI, STEP = 0.3, 0.01  # rad
BACKLASH = 150e-6
P = SimpleNamespace(form=TWO_DOF, backlash=BACKLASH, gated=1.0, c=0.0)
DAMPED = SimpleNamespace(form=TWO_DOF, backlash=BACKLASH, gated=1.0, c=2000.0)
END = 0.37  # share of the step at which the mode ends


def part(monkeypatch, x_of, start=0.0, whole=0, p=P):
    """The part of a step along x(share) [m], its state, and how often the step was tried.

    Stiffness rises along the step, and speeds do; the teeth part at 0.4 m/s.
    """
    interpret(monkeypatch, mode_march, rates)
    tries = []

    def angle_step(y, phi, h, load_torque, speed, rows, i, mode, p):
        at, size = (phi - PHI) / STEP, h / STEP
        assert at == pytest.approx(start, abs=1e-12)
        assert (load_torque, speed) == (100.0, 400.0)
        places = at + size * np.array([0.0, 0.5, 1.0])
        found = rows[(i + np.arange(3)) % rows.shape[0], K]
        np.testing.assert_allclose(found, 4e8 * (1.0 + places), rtol=1e-12)
        np.testing.assert_allclose(y, state(at), rtol=1e-12, atol=1e-12)
        y[:] = state(at + size)
        tries.append(size)
        return 11.0 if size == 1.0 - start else 13.0

    def state(share):
        return np.array([x_of(share) * 1e6, 10.0 + 5.0 * share, 12.0 + 2.0 * share, 3.0 + share])

    monkeypatch.setattr(mode_march, "angle_step", angle_step)
    rows = np.zeros((4, N_ROW))
    rows[:, R_P], rows[:, R_G] = 0.02, 0.05
    rows[1] = 1e3  # not of this step
    rows[[2, 3, 0], K] = 4e8, 6e8, 8e8
    y, trial = state(start), np.zeros(4)
    found = source_of(mode_march.part_of_step)(
        y, PHI, STEP, start, whole, 100.0, 400.0, rows, 2, p, trial, np.zeros((3, N_ROW))
    )
    assert found.force == 11.0
    np.testing.assert_allclose(trial, state(found.end), rtol=1e-12, atol=1e-12)
    return found, trial[0] * 1e-6, len(tries)


MOTIONS = {
    "straight": lambda t: 20e-6 * (t - END),
    "bent": lambda t: 20e-6 * (t**3 - END**3),
    "slowing": lambda t: 20e-6 * (np.sqrt(t) - np.sqrt(END)),
    "stopping": lambda t: 20e-6 * ((1.0 - END) ** 3 - (1.0 - t) ** 3),
    "from the edge of the mode": lambda t: 20e-6 * t * (t - END),
    "late": lambda t: 1e-6 * (np.expm1(12.0 * t) - np.expm1(12.0 * END)),
}


@pytest.mark.parametrize("x_of", MOTIONS.values(), ids=MOTIONS)
def test_part_ends_where_the_flanks_touch(monkeypatch, x_of):
    found, x, tries = part(monkeypatch, x_of)
    assert found.mode == GAP
    # beyond the mode by less than 1e-9 of the step
    assert 0.0 <= found.end - END < 1e-9
    assert x == pytest.approx(x_of(found.end), rel=1e-12)
    assert tries < 25  # bisection needs 30, false position hundreds where the motion bends


def test_part_goes_on_from_within_the_step(monkeypatch):
    found, x, _ = part(monkeypatch, MOTIONS["bent"], start=0.2)
    assert 0.0 <= found.end - END < 1e-9
    assert x == pytest.approx(MOTIONS["bent"](found.end), abs=1e-18)


def test_damped_flanks_push_until_damping_would_pull(monkeypatch):
    """k f + c x' = 0 with f = 3 um (1 - t), k = 4e8 (1 + t) N/m and c x' = -800 N."""
    end = np.sqrt(1.0 / 3.0)
    found, _, _ = part(monkeypatch, lambda t: 3e-6 * (1.0 - t), p=DAMPED)
    assert found.mode == FULL
    assert -1e-15 <= found.end - end < 1e-9
    found, _, _ = part(monkeypatch, lambda t: 3e-6 * t, p=DAMPED)
    assert found.mode == GAP  # at t = 0, and what follows begins at once
    found, _, _ = part(monkeypatch, lambda t: 3e-6 * t, start=0.2, p=DAMPED)
    assert found.mode == OPEN  # 3t (1 + t) = 2 ends it
    assert -1e-15 <= found.end - (np.sqrt(11.0 / 12.0) - 0.5) < 1e-9


def test_open_flanks_push_again_as_they_stiffen(monkeypatch):
    """k f = 800 N of damping: 1.2 um (1 + t) = 2 um."""
    found, _, _ = part(monkeypatch, lambda t: 1.2e-6, p=DAMPED)
    assert found.mode == OPEN
    assert -1e-15 <= found.end - 2.0 / 3.0 < 1e-9


def test_layer_of_damping_ends_at_its_depth(monkeypatch):
    found, x, _ = part(monkeypatch, lambda t: DAMPING_BUILD_UP * (0.5 + 0.5 * t / END))
    assert found.mode == LAYER
    assert found.end == pytest.approx(END, abs=2e-9)
    assert x == pytest.approx(DAMPING_BUILD_UP, rel=1e-8)


@pytest.mark.parametrize(
    ("x_of", "mode"), [(lambda t: -1e-6 - 1e-6 * t, GAP), (lambda t: 2e-6 + 1e-6 * t, FULL)]
)
def test_mode_that_stays_lasts_the_whole_step(monkeypatch, x_of, mode):
    found, x, tries = part(monkeypatch, x_of)
    assert (found.end, found.mode, tries) == (1.0, mode, 1)
    assert x == pytest.approx(x_of(1.0), rel=1e-14)


def test_last_part_keeps_its_mode_to_the_end(monkeypatch):
    found, x, tries = part(monkeypatch, MOTIONS["bent"], whole=1)
    assert (found.end, found.mode, tries) == (1.0, GAP, 1)
    assert x == pytest.approx(MOTIONS["bent"](1.0), rel=1e-14)
