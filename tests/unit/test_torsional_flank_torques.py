"""Friction of the torsional pair's flanks against sums by hand over three tooth pairs."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional import rates
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    EVANS_JOHNSON,
    N_ROW,
    PAIRS_AT,
    THERMAL_EYRING,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from tests.helpers.source_of import interpret, source_of

W_P, W_G = 400.0, 150.0  # rad/s
# the rows are share, R_e, side flow, pressure, entrainment arm, arms, direction of sliding
PAIRS = np.array(
    [
        [0.3, 0.011, 0.9, 2.1e7, -0.021, 0.012, 0.035, 0.6, -0.48, 0.64],
        [0.0, 0.013, 0.7, 2.3e7, 0.023, 0.017, 0.031, 0.8, 0.36, 0.48],
        [0.7, 0.017, 0.8, 2.7e7, 0.029, 0.022, 0.041, -0.36, 0.8, 0.48],
    ]
)
PLACES = PAIRS_AT + N_CHANNELS * np.arange(3)
ROW = 1  # the row in use; the others hold what must not be read


def rows():
    found = np.full((3, N_ROW), np.nan)
    of_pairs = found[ROW, PAIRS_AT:].reshape(3, N_CHANNELS)
    of_pairs[:, : PAIRS.shape[1]] = PAIRS
    return found


def parameters(form, along_sliding=0.0):
    return SimpleNamespace(
        friction_form=form, along_sliding=along_sliding, oil="oil", thermal_oil="hot oil",
        surface="surface", solid="solid", thermal="thermal",
    )  # fmt: skip


def half_of(load, viscous, boundary):
    return SimpleNamespace(viscous_friction=viscous * load, boundary_friction=boundary * load)


@pytest.mark.parametrize("pair", range(3))
@pytest.mark.parametrize("along_sliding", [0.0, 1.0])
def test_thermal_law_meets_speeds_and_geometry_of_its_flank(monkeypatch, pair, along_sliding):
    interpret(monkeypatch, rates)
    met = []

    def law(*arguments):
        met.append(arguments)
        return half_of(arguments[0], 0.03, 0.02)

    monkeypatch.setattr(rates, "thermal_eyring_flank", law)
    friction = source_of(rates.pair_friction)(
        rows(), ROW, PLACES[pair], 500.0, -9.0, W_P, W_G,
        parameters(THERMAL_EYRING, along_sliding),
    )  # fmt: skip
    assert friction == pytest.approx(25.0, rel=1e-14)
    load, speed, sliding, geometry, *others = met[0]
    row = PAIRS[pair]
    u_p, u_g = W_P * row[5], W_G * row[6]
    assert load == 500.0
    # printed: the mean of the surface speeds along sliding; else that of the vectors
    mean = 0.5 * (u_p + u_g) if along_sliding else row[4] * W_P
    assert speed == pytest.approx(mean, rel=1e-14)
    assert sliding == pytest.approx(u_p - u_g, rel=1e-13)
    assert tuple(geometry) == tuple(row[1:4])
    assert others == ["hot oil", "surface", "solid", "thermal"]


@pytest.mark.parametrize("pair", range(3))
def test_law_of_evans_and_johnson_meets_its_flank(monkeypatch, pair):
    interpret(monkeypatch, rates)
    met = []

    def law(*arguments):
        met.append(arguments)
        return half_of(arguments[0], 0.03, 0.02)

    monkeypatch.setattr(rates, "flank_friction", law)
    friction = source_of(rates.pair_friction)(
        rows(), ROW, PLACES[pair], 500.0, -9.0, W_P, W_G, parameters(EVANS_JOHNSON)
    )
    assert friction == pytest.approx(25.0, rel=1e-14)
    load, speed, sliding, geometry, *others = met[0]
    assert (load, sliding) == (500.0, -9.0)
    assert speed == pytest.approx(PAIRS[pair, 4] * W_P, rel=1e-14)
    assert tuple(geometry) == tuple(PAIRS[pair, 1:4])
    assert others[:3] == ["oil", "surface", "solid"]


@pytest.mark.parametrize("force", [1000.0, -1000.0, 0.1])
def test_torques_are_the_sum_over_the_flanks_that_carry(monkeypatch, force):
    interpret(monkeypatch, rates)
    mu = dict(zip(PLACES, (0.04, 0.05, 0.07), strict=True))

    def pair_friction(rows, i, at, load, sliding, *_):
        row = rows[i, at : at + N_CHANNELS]
        assert sliding == pytest.approx(W_P * row[5] - W_G * row[6], rel=1e-13)
        return mu[at] * load

    monkeypatch.setattr(rates, "pair_friction", pair_friction)
    found = source_of(rates.flank_torques)(rows(), ROW, W_P, W_G, force, parameters(EVANS_JOHNSON))
    # flank 1 slides backward: 4.8 < 5.25 m/s; flank 3 forward: 8.8 > 6.15 m/s
    first, last = 0.04 * 0.3 * abs(force), 0.07 * 0.7 * abs(force)
    assert found.torque_p == pytest.approx(0.012 * first - 0.022 * last, rel=1e-12)
    assert found.torque_g == pytest.approx(-0.035 * first + 0.041 * last, rel=1e-12)
    assert found.power == pytest.approx(0.45 * first + 2.65 * last, rel=1e-12)


def test_no_force_has_no_friction():
    found = source_of(rates.flank_torques)(rows(), ROW, W_P, W_G, 0.0, parameters(EVANS_JOHNSON))
    assert found == (0.0, 0.0, 0.0)
