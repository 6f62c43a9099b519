"""Comparisons of small SI numbers can fail."""

from __future__ import annotations

import numpy as np
import pytest


def test_a_relative_tolerance_holds_for_small_numbers_too():
    assert 1.1e-14 != pytest.approx(1e-14, rel=0.01)
    assert [1.1e-14] != pytest.approx([1e-14], rel=0.01)
    assert np.array([1.1e-14]) != pytest.approx(np.array([1e-14]), rel=0.01)


def test_a_tolerance_that_a_test_names_holds():
    assert 1.1e-14 == pytest.approx(1e-14, abs=1e-14)
