"""What must hold for the shares of the tooth pairs at any angle and for any table."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlube_core.mesh_table.kernels import (
    N_SERIES,
    blend_levels,
    load_bracket,
    mesh_series,
    pair_channels,
)
from gearlube_core.mesh_table.netcdf import shipped_mesh_table

TABLE = shipped_mesh_table("mohammadpour_2015")
Z_P = 13.0
PERIOD = 2 * math.pi / Z_P
# 2000 periods, known to 4e-13, times 192/3 nodes and a slope of the share of at most 1 a node
ROUNDING = 1e-10
angles = st.floats(-1e3, 1e3)


@st.composite
def windows(draw):
    """Shares of three pairs that sum to one, shape (3 n + 1,), first node repeated."""
    n = draw(st.integers(1, 12))
    raw = draw(st.lists(st.floats(0.0, 1.0), min_size=3 * n, max_size=3 * n))
    share = np.array(raw).reshape(3, n)
    share[0, share.sum(axis=0) < 1e-3] = 1.0
    share /= share.sum(axis=0)
    return np.append(share.ravel(), share[0, 0])


SHIPPED = np.append(TABLE.windows["share"][0], TABLE.windows["share"][0, 0])
any_window = st.one_of(st.just(SHIPPED), windows())


def shares(window, phi):
    out = np.zeros(1)
    found = []
    for pair in range(3):
        pair_channels(window, window.size - 1, Z_P, phi, pair, 1, out)
        found.append(out[0])
    return np.array(found)


@given(any_window, angles)
def test_three_pairs_carry_the_whole_load_at_any_angle(window, phi):
    found = shares(window, phi)
    assert found.sum() == pytest.approx(1.0, abs=ROUNDING)
    assert np.all(found >= 0.0)
    assert np.all(found <= 1.0 + ROUNDING)


@given(any_window, angles)
def test_one_mesh_period_on_the_pairs_have_changed_places(window, phi):
    here, next_period = shares(window, phi), shares(window, phi + PERIOD)
    np.testing.assert_allclose(next_period, np.roll(here, -1), rtol=0, atol=ROUNDING)


@given(any_window, angles)
def test_three_mesh_periods_on_every_pair_is_back(window, phi):
    np.testing.assert_allclose(
        shares(window, phi + 3 * PERIOD), shares(window, phi), rtol=0, atol=ROUNDING
    )


@given(st.integers(0, 2**32 - 1), st.integers(0, 8), st.floats(-10.0, 10.0))
def test_series_repeat_after_a_mesh_period(seed, orders, phi):
    coefficients = np.random.default_rng(seed).normal(size=N_SERIES * (2 * orders + 1))
    one = mesh_series(coefficients, orders, Z_P, phi)
    two = mesh_series(coefficients, orders, Z_P, phi + PERIOD)
    # 130 rad known to 3e-14, times the order (8) and, for slopes, another 104/rad, in 16 terms
    np.testing.assert_allclose(one, two, rtol=0, atol=1e-8)


@given(
    st.lists(st.floats(0.1, 1e3), min_size=1, max_size=8, unique=True).map(sorted),
    st.floats(-2e3, 2e3),
    st.integers(0, 2**32 - 1),
)
def test_blended_data_stay_between_the_neighbouring_levels(levels, torque, seed):
    packed = np.random.default_rng(seed).normal(size=(len(levels), 3))
    bracket = load_bracket(torque, 1.0, np.array(levels), len(levels))
    assert 0.0 <= bracket.weight <= 1.0
    assert bracket.upper - bracket.lower in (0, 1)
    out = np.empty(3)
    blend_levels(packed.ravel(), 3, bracket, out)
    both = packed[[bracket.lower, bracket.upper]]
    # rounding of one interpolation
    assert np.all(out >= both.min(axis=0) - 1e-14)
    assert np.all(out <= both.max(axis=0) + 1e-14)
