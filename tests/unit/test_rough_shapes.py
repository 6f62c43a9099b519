"""Single features of rough surfaces: ridges, dents and waves against their formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.gap import Dent, Ridge, RoughGap, Waviness
from gearlube_core.errors import ParameterError


def test_ridge_is_half_as_high_half_a_width_from_its_crest():
    lies = Ridge(height=2e-6, width=4e-5)
    y = np.linspace(-1.0, 1.0, 3)
    assert lies(np.zeros(3), y) == pytest.approx(2e-6)  # across x through the middle
    assert lies(np.full(3, 2e-5), y) == pytest.approx(1e-6)
    assert lies(np.full(3, -4e-5), y) == pytest.approx(2e-6 / 16.0)
    assert Ridge(height=2e-6, width=4e-5, direction=0.0)(0.7, 0.0) == pytest.approx(2e-6)
    angle = 0.3
    along = np.array([math.cos(angle), math.sin(angle)])
    normal = np.array([math.sin(angle), -math.cos(angle)])
    crest = np.array([1e-4, -3e-4])
    ridge = Ridge(height=-2e-6, width=4e-5, x=crest[0], y=crest[1], direction=angle)
    for distance, share in ((0.0, 1.0), (2e-5, 0.5), (-2e-5, 0.5), (6e-5, 2.0**-9)):
        place = crest + 7e-4 * along + distance * normal
        assert ridge(*place) == pytest.approx(-2e-6 * share)


def test_dent_is_half_as_deep_half_a_width_from_its_middle():
    dent = Dent(depth=2e-6, width=4e-5)
    assert dent(0.0, 0.0) == pytest.approx(-2e-6)
    aside = Dent(depth=2e-6, width=4e-5, x=1e-4, y=-3e-4)
    for angle in (0.0, 0.7, 4.0):
        place = 1e-4 + 2e-5 * math.cos(angle), -3e-4 + 2e-5 * math.sin(angle)
        assert aside(*place) == pytest.approx(-1e-6)


def test_waves_repeat_after_a_wavelength_across_their_crests():
    wave = Waviness(amplitude=1e-6, wavelength=2e-4)
    assert wave(0.0, 5.0) == pytest.approx(1e-6)
    assert wave(1e-4, 5.0) == pytest.approx(-1e-6)
    assert wave(0.5e-4, 0.0) == pytest.approx(0.0, abs=1e-18)
    turned = Waviness(amplitude=1e-6, wavelength=2e-4, direction=0.4, phase=0.9)
    for part in (0.0, 0.2, 1.0, -0.7):
        place = part * 2e-4 * math.cos(0.4), part * 2e-4 * math.sin(0.4)
        expected = 1e-6 * math.cos(2.0 * math.pi * part + 0.9)
        assert turned(*place) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("shape", "nodes", "angle"),
    [
        (lambda size, d: Ridge(height=1e-6, width=size, direction=d + 0.5 * math.pi), 4.0, 0.6),
        (lambda size, d: Waviness(amplitude=1e-6, wavelength=size, direction=d), 8.0, 0.6),
        (lambda size, d: Dent(depth=1e-6, width=size), 4.0, 0.0),
    ],
    ids=["ridge", "waviness", "dent"],
)
def test_shapes_need_nodes_across_them(shape, nodes: float, angle: float):
    fine, coarse = np.linspace(0.0, 1.0, 1001) * 1e-3, np.linspace(0.0, 1.0, 101) * 1e-3
    along_y = math.sin(angle) if angle else 1.0
    for grid, share, axis in (
        ((coarse, fine), math.cos(angle), "x"),
        ((fine, coarse), along_y, "y"),
    ):
        needed = nodes * 1e-5 * share  # the widest interval counts
        shape(1.001 * needed, angle).check_serves(*grid)
        with pytest.raises(ParameterError, match=f"{nodes:g} nodes along {axis}"):
            shape(0.999 * needed, angle).check_serves(*grid)
    uneven = np.sort(np.append(coarse, 3e-6))
    with pytest.raises(ParameterError, match="nodes along x"):
        shape(0.999 * nodes * 1e-5 * math.cos(angle), angle).check_serves(uneven, fine)


def test_heights_narrow_the_gap():
    heights = (Ridge(height=1e-6, width=1e-4), Dent(depth=3e-6, width=1e-4))
    gap = RoughGap(lambda x, y: 5e-6 + 0.0 * x * y, heights)
    assert gap(np.zeros(1), np.zeros(1)) == pytest.approx(5e-6 - 1e-6 + 3e-6)
