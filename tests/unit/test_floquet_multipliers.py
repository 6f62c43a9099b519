"""Floquet multipliers and the tests of stability on sets of multipliers chosen by hand."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.periodic.floquet import (
    doubling_test,
    exchange_test,
    floquet_multipliers,
    loss_of_stability,
    stability_margin,
    stable,
    torus_pair,
    torus_test,
)
from tests.helpers.each import each


def multipliers(*values):
    return np.array(values, dtype=complex)


def matrix_with(*values):
    """A matrix with these eigenvalues in a basis of its own."""
    blocks = np.zeros((len(values), len(values)))
    k = 0
    while k < len(values):
        mu = complex(values[k])
        blocks[k, k] = mu.real
        if mu.imag != 0.0:  # its conjugate stands next
            blocks[k : k + 2, k : k + 2] = [[mu.real, -mu.imag], [mu.imag, mu.real]]
            k += 1
        k += 1
    basis = np.random.default_rng(len(values)).standard_normal(blocks.shape) + 3.0 * np.eye(k)
    return basis @ blocks @ np.linalg.inv(basis)


def test_multipliers_are_sorted_by_modulus_and_pairs_by_their_imaginary_part():
    found = floquet_multipliers(matrix_with(0.2, 0.3 + 0.6j, 0.3 - 0.6j, -0.9))
    np.testing.assert_allclose(found, [-0.9, 0.3 + 0.6j, 0.3 - 0.6j, 0.2], atol=1e-12)


@pytest.mark.parametrize(
    ("trivial", "left"), [(0, [-1.2, 1.12, 1.0, 0.4]), (1, [-1.2, 1.12, 0.4]), (2, [-1.2, 0.4])]
)
def test_trivial_multipliers_are_those_closest_to_one(trivial, left):
    found = floquet_multipliers(matrix_with(1.0, 1.12, -1.2, 0.4), trivial=trivial)
    np.testing.assert_allclose(found, left, atol=1e-12)


def test_motion_that_ran_away_has_no_multipliers():
    found = floquet_multipliers(np.array([[1.0, np.inf], [0.0, 1.0]]), trivial=1)
    assert found.shape == (1,)
    assert np.isnan(found).all()


def test_what_has_no_multipliers_is_refused():
    with pytest.raises(ParameterError, match=r"square, got shape \(2, 3\)"):
        floquet_multipliers(np.zeros((2, 3)))
    with pytest.raises(ParameterError, match="at most the 2 states, got 3"):
        floquet_multipliers(np.eye(2), trivial=3)
    assert floquet_multipliers(np.eye(2), trivial=2).size == 0


@each(
    ("mu", "margin", "loss"),
    [
        (multipliers(0.5, -0.8), 0.2, "none"),
        (multipliers(1.25, -0.8), -0.25, "fold"),
        (multipliers(-1.25, 1.1), -0.25, "period doubling"),
        (multipliers(0.9 + 1.2j, 0.9 - 1.2j, 1.1), -0.5, "Neimark-Sacker"),
        (multipliers(), 1.0, "none"),
        (multipliers(1.0), 0.0, "fold"),
    ],
)
def test_stability_is_lost_with_the_largest_multiplier(mu, margin, loss):
    assert stability_margin(mu) == pytest.approx(margin, abs=1e-15)
    assert stable(mu) == (margin > 0.0)
    assert loss_of_stability(mu) == loss


def test_test_functions_are_their_products():
    mu = multipliers(0.5, -0.25, 0.3 + 0.4j, 0.3 - 0.4j)
    # |1 - mu|^2 = 0.7^2 + 0.4^2 and |1 + mu|^2 = 1.3^2 + 0.4^2 of the pair
    assert exchange_test(mu) == pytest.approx(0.5 * 1.25 * 0.65, rel=1e-14)
    assert doubling_test(mu) == pytest.approx(1.5 * 0.75 * 1.85, rel=1e-14)
    # pairs: -1/8 - 1, 0.25 - 1 and |0.5 mu - 1|^2 and |-0.25 mu - 1|^2
    pairs = -1.125 * -0.75 * (0.85**2 + 0.2**2) * (1.075**2 + 0.1**2)
    assert torus_test(mu) == pytest.approx(pairs, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "before", "after"),
    [
        (exchange_test, (0.9, -0.5), (1.1, -0.5)),
        (doubling_test, (-0.9, 0.5), (-1.1, 0.5)),
        (torus_test, (0.6 + 0.7j, 0.6 - 0.7j), (0.6 + 0.9j, 0.6 - 0.9j)),
    ],
)
def test_each_changes_sign_at_its_bifurcation_alone(name, before, after):
    for test in (exchange_test, doubling_test, torus_test):
        product = test(multipliers(*before)) * test(multipliers(*after))
        assert (product < 0.0) == (test is name)


def test_torus_has_a_complex_pair_closest_to_the_unit_circle():
    assert torus_pair(multipliers(0.2, 0.6 + 0.79j, 0.6 - 0.79j))
    assert not torus_pair(multipliers(2.0, 0.51, 0.3 + 0.4j, 0.3 - 0.4j))
    assert not torus_pair(multipliers(0.9))
