"""Strips are enlarged until they hold the contact: which way, and when it is given up."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError
from gearlube_core.tooth_contact.strip_growth import StripGrowth, solve_on_growing_strips

GROWTH = StripGrowth(factor=1.5, margin=1.1, attempts=6)
LENGTH, HALF_WIDTH = 8e-3, 0.3e-3  # m, of a contact that the strips must hold


def solution(_, width):
    """A contact of fixed half-width on four cells across a strip of `width`."""
    forces = np.zeros((4, 3))
    forces[1:3] = 1.0
    forces[[0, -1]] = float(width < HALF_WIDTH)
    return width, SimpleNamespace(forces=(forces,))


def grown(closing, width, growth=GROWTH):
    tried = []

    def solve(closing, width):
        tried.append((closing, width))
        return solution(closing, width)

    solve_on_growing_strips(
        solve, lambda _: LENGTH, closing=closing, width=width, growth=growth,
        where="mesh phase 0.250 and 50 N.m", cure=", or crown the flanks",
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
