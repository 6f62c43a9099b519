"""Comparisons of small SI numbers can fail."""

from __future__ import annotations

import numpy as np
import pytest

SMALL = 1e-14


@pytest.mark.parametrize("expected", [SMALL, [SMALL], np.array([SMALL])], ids=type)
def test_a_relative_tolerance_holds_for_small_numbers_too(expected: object):
    found = np.multiply(expected, 1.1)
    assert found != pytest.approx(expected, rel=0.01)
    assert found == pytest.approx(expected, rel=0.11)
    assert found == pytest.approx(expected, abs=SMALL)
