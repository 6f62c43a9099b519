"""Strips are enlarged until they hold the contact: which way, and when it is given up."""

import inspect
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube.studies.contact.command import contact
from gearlube.studies.helical.command import helical
from gearlube_core.errors import ConvergenceError
from gearlube_core.tooth_contact.coupled_strips import StripGrowth, solve_on_growing_strips

GROWTH = StripGrowth(factor=1.5, margin=1.1, attempts=6)
LENGTH, HALF_WIDTH = 8e-3, 0.3e-3  # m, of a contact that the strips must hold


def solution(_, width):
    """A contact of fixed half-width on four cells across a strip of `width`."""
    forces = np.zeros((4, 3))
    forces[1:3] = 1.0
    forces[[0, -1]] = float(width < HALF_WIDTH)
    outcome = SimpleNamespace(converged=True)
    return width, SimpleNamespace(forces=(forces,), solution=SimpleNamespace(outcome=outcome))


def grown(closing, width, growth=GROWTH):
    tried = []

    def solve(closing, width):
        tried.append((closing, width))
        return solution(closing, width)

    solve_on_growing_strips(
        solve, lambda _: LENGTH, closing=closing, width=width, growth=growth,
        tolerance=1e-5, where="mesh phase 0.250 and 50 N.m", cure=", or crown the flanks",
    )  # fmt: skip
    return tried


def test_strips_that_hold_the_contact_are_kept():
    assert grown(1.01 * LENGTH, HALF_WIDTH) == [(1.01 * LENGTH, HALF_WIDTH)]


def test_a_strip_that_is_too_narrow_only_widens():
    tried = grown(2.0 * LENGTH, 0.5 * HALF_WIDTH)
    assert [closing for closing, _ in tried] == [2.0 * LENGTH] * 3  # 0.5, 0.75, 1.125
    assert tried[-1][1] == pytest.approx(1.125 * HALF_WIDTH)


def test_a_closing_that_is_too_small_is_what_was_needed_and_a_margin():
    tried = grown(0.1 * LENGTH, HALF_WIDTH)
    assert tried[1] == (pytest.approx(1.1 * LENGTH), HALF_WIDTH)
    assert len(tried) == 2


def test_contact_that_always_leaves_is_an_error_with_place_and_cure():
    words = r"mesh phase 0.250 and 50 N.m still .* 2 enlargements. Reduce .*, or crown the flanks."
    with pytest.raises(ConvergenceError, match=words):
        grown(LENGTH, 1e-3 * HALF_WIDTH, StripGrowth(factor=1.5, margin=1.1, attempts=2))


def test_contact_that_is_not_found_names_place_residual_and_options_that_exist():
    outcome = SimpleNamespace(converged=False, residual=0.0125, iterations=2000)
    lost = SimpleNamespace(forces=(), solution=SimpleNamespace(outcome=outcome))
    words = "phase 0.250 and 50 N.m .* within 1e-05, got 0.0125 after 2000 .*--torques.*--positions"
    with pytest.raises(ConvergenceError, match=words):
        solve_on_growing_strips(
            lambda closing, width: (width, lost), lambda _: LENGTH, closing=LENGTH, width=1.0,
            growth=GROWTH, tolerance=1e-5, where="mesh phase 0.250 and 50 N.m",
        )  # fmt: skip
    for asked in (contact, helical):
        assert {"torques", "positions"} <= set(inspect.signature(asked).parameters)
