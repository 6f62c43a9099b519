"""Flow factors of many points at once against those of one point, and by rows."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from gearlube_core.ehl.point.equations.factor_fields import (
    FactorWork,
    ShearUnits,
    fill_factor_slopes,
    fill_shear_factors,
)
from gearlube_core.oil import shear_block
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.factor_slopes import factor_slopes
from gearlube_core.oil.shear_block import ShearBlock, balance_block, block_slopes, rate_ratios
from gearlube_core.oil.shear_flow import REACHES, STARTS
from tests.helpers.each import each
from tests.helpers.source_of import interpret

LAW = Eyring(1.0)
COUNT = 40


def block_of(rule: int) -> ShearBlock:
    rng = np.random.default_rng(rule)
    low, high = (1e-3, *REACHES)[rule], min(REACHES[rule], 100.0)
    size, angle = rng.uniform(low, high, COUNT), rng.uniform(0.0, 2.0 * math.pi, COUNT)
    b = ShearBlock.empty()
    b.sigma_s[:COUNT], b.sigma_r[:COUNT] = size * np.cos(angle), size * np.sin(angle)
    b.a[:COUNT] = rng.choice([-1.0, 1.0], COUNT) * 10.0 ** rng.uniform(-2.0, 4.0, COUNT)
    return b


@pytest.mark.parametrize("rule", range(4))
def test_points_of_a_block_flow_as_each_alone(rule):
    b, nodes = block_of(rule), (STARTS[rule], STARTS[rule + 1])
    balance_block(LAW, b, COUNT, *nodes)
    assert not np.isnan(b.stress_s[:COUNT]).any()
    alone = np.array(
        [
            factor_slopes(LAW, *point, math.inf)
            for point in zip(b.sigma_s[:COUNT], b.sigma_r[:COUNT], b.a[:COUNT], strict=True)
        ]
    ).T
    # stress is found to 1e-9 by either, sums of factors are as exact
    assert b.along[0, :COUNT] == pytest.approx(alone[0], rel=1e-8)
    assert b.across[0, :COUNT] == pytest.approx(alone[5], rel=1e-8)
    block_slopes(LAW, b, COUNT, *nodes)
    s, a = np.abs(b.sigma_s[:COUNT]), np.abs(b.a[:COUNT])
    for slopes, first in ((b.along, 0), (b.across, 5)):
        for k, unit in enumerate((s, s, a), start=1):
            error = np.abs(slopes[k, :COUNT] - alone[first + k])
            # slopes cross zero, and over Sigma_s they are differences over it
            assert (error <= 1e-8 * (np.abs(alone[first + k]) + alone[0] / unit)).all()


def test_interpreted_block_is_the_compiled_one(monkeypatch):
    compiled = block_of(2)
    nodes = STARTS[2], STARTS[3]
    balance_block(LAW, compiled, 6, *nodes)
    block_slopes(LAW, compiled, 6, *nodes)
    interpret(monkeypatch, shear_block)
    b = block_of(2)
    shear_block.balance_block(LAW, b, 6, *nodes)
    shear_block.block_slopes(LAW, b, 6, *nodes)
    assert b.along[:, :6] == pytest.approx(compiled.along[:, :6], rel=1e-9)
    assert b.across[:, :6] == pytest.approx(compiled.across[:, :6], rel=1e-9)


@each("largest", [1e-8, 0.4, 3.0, 60.0, 4e4])
def test_series_of_many_stresses_are_sinh_and_its_slope(largest):
    q = np.linspace(0.0, largest, 33)[1:]
    G, slope = np.empty((2, q.size))
    rate_ratios(LAW, q, G, slope)
    t = np.sqrt(q)
    # roundings double with every doubling of the argument, eight of them at t = 200
    assert pytest.approx(np.sinh(t) / t, rel=1e-12) == G
    # the difference on the right loses digits where t is small: its limit 1/6 + q/60 instead
    expected = np.where(q > 1e-3, 0.5 * (np.cosh(t) - np.sinh(t) / t) / q, 1.0 / 6.0 + q / 60.0)
    assert slope == pytest.approx(expected, rel=1e-8)


def test_rows_of_factors_do_not_depend_on_the_rows_filled_with_them():
    ny, nx = 11, 300
    rng = np.random.default_rng(3)
    pressure, film = rng.uniform(0.0, 2.0, (ny, nx)), rng.uniform(0.2, 1.0, (ny, nx))
    fluidity, thickening = np.exp(-6.0 * pressure), np.full((ny, nx), 6.0)
    local = 1.0 + 0.2 * pressure, 0.2 / (1.0 + 0.2 * pressure)
    units = ShearUnits(
        np.linspace(-0.5, 0.5, ny), np.full(nx, 1.5), 0.7, 0.8, 0.6, 2.0, 1.0, *local
    )
    whole, parts = (np.full((12, ny, nx), np.nan) for _ in range(2))
    wanted = np.ones((ny, nx), dtype=bool)
    for fields, cuts in ((whole, (0, ny)), (parts, (0, 2, 7, ny))):
        stress, work = fields[10:], FactorWork.empty(nx)
        for rows in pairwise(cuts):
            given = LAW, pressure, film, fluidity
            fill_shear_factors(*given, units, rows, work, fields[0], fields[1], stress)
            given = *given, thickening, units, stress, wanted
            fill_factor_slopes(*given, rows, work, fields[2:6], fields[6:10])
    assert (whole[:10] == parts[:10]).all()
    few, wanted = np.full((8, ny, nx), np.nan), rng.random((ny, nx)) < 0.5
    given = LAW, pressure, film, fluidity, thickening, units, whole[10:], wanted
    fill_factor_slopes(*given, (0, ny), FactorWork.empty(nx), few[:4], few[4:])
    # with other points in its block a point has other roundings, which the stress magnifies
    assert few == pytest.approx(np.where(wanted, whole[2:10], 0.0), rel=1e-8)
