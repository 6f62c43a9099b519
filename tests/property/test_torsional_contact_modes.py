"""The contact modes of the torsional pair against the mesh force that they split."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gearlube_core.dynamics.flank_force import backlash_deflection, gated_force
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import N_ROW, PAIRS_AT, rows_between
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.rates import contact_mode, force_in_mode, mode_margin
from tests.helpers.torsional_cases import reconstructed

P = HypoidTorsional(reconstructed()).kernel_parameters
AS_PRINTED = HypoidTorsional(reconstructed(damping_gate="as_printed")).kernel_parameters
K = 4.5e8
deflections = st.one_of(
    st.floats(-170e-6, 20e-6), st.floats(-1e-6, 1e-6), st.floats(-151e-6, -149e-6)
)
rates = st.floats(-0.5, 0.5)


@given(deflections, rates)
def test_each_mode_holds_where_it_is_found_and_has_the_force_there(x, rate):
    mode = contact_mode(x, rate, K, P)
    f = backlash_deflection(x, P.backlash)
    deflection, force = force_in_mode(mode, x, rate, K, P)
    expected = gated_force(K * f, P.c, rate, f)
    assert deflection == f
    assert math.isclose(force, expected, rel_tol=1e-12, abs_tol=1e-9)
    assert mode_margin(mode, x, rate, K, P) >= -1e-20


@given(deflections, rates)
def test_damping_acts_everywhere_as_printed(x, rate):
    mode = contact_mode(x, rate, K, AS_PRINTED)
    f = backlash_deflection(x, P.backlash)
    force = force_in_mode(mode, x, rate, K, AS_PRINTED).force
    assert math.isclose(force, K * f + P.c * rate, rel_tol=1e-12)
    assert mode_margin(mode, x, rate, K, AS_PRINTED) >= -1e-20


@given(deflections, rates, st.floats(-2e-6, 2e-6), st.floats(-0.2, 0.2))
def test_another_mode_begins_where_the_margin_ends(x, rate, dx, d_rate):
    mode = contact_mode(x, rate, K, P)
    inside = mode_margin(mode, x + dx, rate + d_rate, K, P)
    other = contact_mode(x + dx, rate + d_rate, K, P)
    if inside > 1e-15:
        assert other == mode
    if inside < -1e-15:
        assert other != mode


def test_rows_within_a_step_are_a_parabola_of_the_series_and_lines_of_the_flank_data():
    at = np.array([0.0, 0.5, 1.0])
    rows = np.zeros((4, N_ROW))
    rows[[2, 3, 0], :PAIRS_AT] = (1.0 + 2.0 * at + 3.0 * at**2)[:, None]  # the step wraps around
    rows[[2, 3, 0], PAIRS_AT:] = np.array([0.0, 1.0, 5.0])[:, None]
    between = np.zeros((3, N_ROW))
    rows_between(rows, 2, 0.2, 0.9, between)
    t = np.array([0.2, 0.55, 0.9])
    np.testing.assert_allclose(between[:, 0], 1.0 + 2.0 * t + 3.0 * t**2, rtol=1e-14)
    np.testing.assert_allclose(between[:, -1], np.interp(t, at, [0.0, 1.0, 5.0]), rtol=1e-14)
