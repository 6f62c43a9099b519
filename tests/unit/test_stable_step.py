"""Search for the largest stable communication step, with a made-up map."""

from __future__ import annotations

import numpy as np
import pytest

from drivetrain.driveline import stability
from drivetrain.driveline.stability import largest_stable_step
from gearlube_core.errors import ConvergenceError


def search(monkeypatch, radius, **limits) -> tuple[float, int]:
    tried = []

    def communication_map(driveline, h, axle):
        assert driveline == "driveline"
        tried.append(h)
        # the largest of the moduli counts
        return np.diag([0.1, -radius(h)])

    monkeypatch.setattr(stability, "communication_map", communication_map)
    return largest_stable_step("driveline", axle="axle", **limits), len(tried)


@pytest.mark.parametrize("limit", [3.21e-4, 1.03e-5, 9.9e-3])
def test_step_is_found_within_a_thousandth(monkeypatch, limit: float):
    found, tried = search(monkeypatch, lambda h: h / limit)
    assert limit * (1.0 - 1e-3) <= found < limit
    # upwards in ratios of 1.05, then by bisection: 50 times finer
    assert tried <= np.log(limit / 1e-5) / np.log(1.05) + 2 + 6 + 1


def test_unstable_band_is_not_jumped_over(monkeypatch):
    found, _ = search(monkeypatch, lambda h: 1.1 if 2e-4 <= h <= 2.12e-4 else 0.9)
    assert 2e-4 * (1.0 - 1e-3) <= found < 2e-4


def test_longest_step_is_returned_where_all_are_stable(monkeypatch):
    assert search(monkeypatch, lambda h: 0.9, longest=3e-3)[0] == 3e-3
    assert search(monkeypatch, lambda h: 0.9)[0] == 1e-2


def test_shortest_step_must_be_stable(monkeypatch):
    with pytest.raises(ConvergenceError, match="not at 2e-05 s"):
        search(monkeypatch, lambda h: 1.0, shortest=2e-5)
