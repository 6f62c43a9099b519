"""Step of the bracketed secant search for the flash temperature."""

import math

import pytest

from gearlube_core.friction.thermal_eyring_flank import bracketed_secant_step
from tests.helpers.source_of import source_of


@pytest.mark.parametrize("slope", [2.0, -0.3])
def test_secant_meets_the_root_of_a_line_inside_the_bracket(slope):
    step = source_of(bracketed_secant_step)
    root = 14.5
    for x, old in ((12.0, 19.0), (17.0, 16.0)):
        found = step(x, slope * (x - root), old, slope * (old - root), 10.0, 20.0)
        assert found == pytest.approx(root, rel=1e-14)
    # a root on the border still lies inside
    assert step(12.0, 2.0 * slope, 13.0, 3.0 * slope, 10.0, 20.0) == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("g", "g_old"),
    [(1.0, 1.0), (1.0, 1.1), (1.0, 0.9), (math.nan, 1.0)],
    ids=["level", "below", "above", "not a number"],
)
def test_bracket_is_halved_where_the_secant_leaves_it(g, g_old):
    assert source_of(bracketed_secant_step)(12.0, g, 13.0, g_old, 10.0, 20.0) == 15.0
    assert source_of(bracketed_secant_step)(2.0, g, 3.0, g_old, 1.5, 3.5) == 2.5
