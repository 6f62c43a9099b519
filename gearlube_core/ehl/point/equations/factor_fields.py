"""Flow factors of a sheared film on a grid, and their slopes: kernels."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel, row_kernel
from gearlube_core.oil.factor_slopes import SMALL_SIGMA, factor_slopes
from gearlube_core.oil.film_laws import rate_ratio
from gearlube_core.oil.shear_block import BLOCK, ShearBlock, balance_block, block_slopes
from gearlube_core.oil.shear_flow import (
    LARGEST_COUETTE,
    LARGEST_SIGMA,
    REACHES,
    STARTS,
    shear_factors,
)

# below, series to the second order are right to 1e-8
_SMALL_STRESS = 1.0e-2
_NO_FILM, _SMALL, _ALONE = -1, -2, -3  # nodes that are not in a block


class ShearUnits(NamedTuple):
    """Stresses over tau0 per unit of the fields, sliding, and the limiting stress."""

    couette: np.ndarray  # of sliding, times film and fluidity, of every row, shape (ny,) [-]
    # stress drop over half the film, over film and difference of pressure between the nodes on
    # both sides [-]; along x of every column, shape (nx,)
    sigma_x: np.ndarray
    sigma_y: float
    cosine: float  # of the angle from x to sliding
    sine: float
    limit: float  # limiting stress at ambient pressure [-]
    limit_slope: float  # its slope with pressure [-]; both 0: none
    ratio: np.ndarray  # local Eyring stress over tau0, shape (ny, nx) [-]
    ratio_slope: np.ndarray  # slope of its logarithm with pressure [-]


class _Stresses(NamedTuple):
    """Stresses at a node over its Eyring stress [-]."""

    s: float  # drop over half the film along sliding
    r: float  # and across it
    a: float  # of sliding
    most: float  # limiting
    small: bool  # all of them


@kernel
def _stresses(
    pressure: np.ndarray, h: float, fluidity: float, units: ShearUnits, j: int, i: int
) -> _Stresses:
    x = units.sigma_x[i] * h * (pressure[j, i + 1] - pressure[j, i - 1])
    y = units.sigma_y * h * (pressure[j + 1, i] - pressure[j - 1, i])
    s, r = units.cosine * x + units.sine * y, units.cosine * y - units.sine * x
    a, most = units.couette[j] / (h * fluidity), math.inf
    limit = units.limit + units.limit_slope * max(pressure[j, i], 0.0)
    if limit > 0.0:
        most = limit / units.ratio[j, i]
    s, r, a = s / units.ratio[j, i], r / units.ratio[j, i], a / units.ratio[j, i]
    return _Stresses(s, r, a, most, max(abs(s), abs(r), abs(a)) < min(_SMALL_STRESS, most))


class FactorWork(NamedTuple):
    """Scratch memory of one row of nodes; arrays of shape (nx,), and a block of points."""

    s: np.ndarray
    r: np.ndarray
    a: np.ndarray
    most: np.ndarray
    rule: np.ndarray  # of quadrature, int64; below 0: the node is not in a block
    column: np.ndarray  # of the points of the block, int64, (BLOCK,)
    block: ShearBlock

    @classmethod
    def empty(cls, nx: int) -> FactorWork:
        """Return the work of rows with nx nodes."""
        s, r, a, most = np.empty((4, nx))
        rule, column = np.empty(nx, dtype=np.int64), np.empty(BLOCK, dtype=np.int64)
        return cls(s, r, a, most, rule, column, ShearBlock.empty())


@kernel
def _sort_row(
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    units: ShearUnits,
    j: int,
    work: FactorWork,
) -> None:
    # stresses of a row, and the rule of every node that goes into a block
    work.rule[:] = _NO_FILM
    for i in range(1, film.shape[1] - 1):
        if film[j, i] <= 0.0:
            continue
        s, r, a, most, small = _stresses(pressure, film[j, i], fluidity[j, i], units, j, i)
        work.s[i], work.r[i], work.a[i], work.most[i] = s, r, a, most
        size = math.sqrt(s * s + r * r)
        if small:
            work.rule[i] = _SMALL
        elif abs(s) < SMALL_SIGMA or size > LARGEST_SIGMA or not abs(a) < LARGEST_COUETTE:
            work.rule[i] = _ALONE
        else:
            rule = 0
            while size > REACHES[rule]:
                rule += 1
            work.rule[i] = rule


@kernel
def _take_block(work: FactorWork, rule: int, begin: int) -> tuple[int, int]:
    # fill the block with nodes of a rule from a column on; how many, and the column to go on from
    n, i, block = 0, begin, work.block
    while i < work.rule.size and n < BLOCK:
        if work.rule[i] == rule:
            work.column[n] = i
            block.sigma_s[n], block.sigma_r[n], block.a[n] = work.s[i], work.r[i], work.a[i]
            n += 1
        i += 1
    return n, i


@row_kernel
def fill_shear_factors(
    law: Any,
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    units: ShearUnits,
    rows: tuple[int, int],
    work: FactorWork,
    along: np.ndarray,
    across: np.ndarray,
    stress: np.ndarray,
) -> None:
    """Fill the flow factors of a shear-thinning film, by rows of other sliding in one direction.

    Parameters
    ----------
    law
        Shear law of the oil.
    pressure, film, fluidity : ndarray, shape (ny, nx)
        p, h and 1/eta [-].
    units
        Units of stress and sliding.
    rows
        First row that is filled and the one behind the last.
    work
        Scratch memory, its values are lost.
    along, across : ndarray, shape (ny, nx)
        Result: flow along and across sliding over its Newtonian value [-]; 1 on the border.
    stress : ndarray, shape (2, ny, nx)
        Result: mid-film stress along and across sliding over tau0 of the nodes that are neither
        small nor left to `shear_factors`, for `fill_factor_slopes`.

    Notes
    -----
    Pressure slopes are central. Small stresses: flow along grows by Sigma^2/10 + a^2/2, across
    by Sigma^2/10 + a^2/6, both times 6 dG/dq: the first terms of the series of `shear_flow`. A
    film that slips at the limiting stress has the flow of one that is sheared just so far. Values
    of a row depend on no other row's.
    """
    ny = pressure.shape[0]
    # of the series G = 1 + g q/6: Eyring's g is 1
    g = 6.0 * rate_ratio(law, 0.0)[1]
    along[rows[0] : rows[1]] = 1.0
    across[rows[0] : rows[1]] = 1.0
    block = work.block
    for j in range(max(rows[0], 1), min(rows[1], ny - 1)):
        _sort_row(pressure, film, fluidity, units, j, work)
        for rule in range(REACHES.size):
            begin = 1
            while begin < work.rule.size:
                n, begin = _take_block(work, rule, begin)
                if n == 0:
                    break
                balance_block(law, block, n, STARTS[rule], STARTS[rule + 1])
                for k in range(n):
                    i = work.column[k]
                    along[j, i], across[j, i] = block.along[0, k], block.across[0, k]
                    stress[0, j, i], stress[1, j, i] = block.stress_s[k], block.stress_r[k]
                    if not abs(block.stress_s[k]) < work.most[i]:
                        work.rule[i] = _ALONE
                        stress[0, j, i] = math.nan
        for i in range(1, work.rule.size - 1):
            s, r, a = work.s[i], work.r[i], work.a[i]
            if work.rule[i] == _SMALL:
                pumped = 0.1 * g * (s * s + r * r)
                along[j, i] = 1.0 + pumped + 0.5 * g * a * a
                across[j, i] = 1.0 + pumped + g * a * a / 6.0
            elif work.rule[i] == _ALONE:
                along[j, i], across[j, i] = shear_factors(law, s, r, a, work.most[i])


@row_kernel
def fill_factor_slopes(
    law: Any,
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    thickening: np.ndarray,
    units: ShearUnits,
    stress: np.ndarray,
    wanted: np.ndarray,
    rows: tuple[int, int],
    work: FactorWork,
    along: np.ndarray,
    across: np.ndarray,
) -> None:
    """Fill the derivatives of the flow factors of `fill_shear_factors`.

    Parameters
    ----------
    law, pressure, film, fluidity, units, rows, work
        As in `fill_shear_factors`.
    thickening : ndarray, shape (ny, nx)
        d ln(eta)/dp [-].
    stress : ndarray, shape (2, ny, nx)
        Mid-film stresses of `fill_shear_factors` at the same fields.
    wanted : ndarray of bool, shape (ny, nx)
        Nodes whose derivatives are needed; 0 elsewhere.
    along, across : ndarray, shape (4, ny, nx)
        Result: derivatives of either factor by the pressure of the node, by ln(h), by the rise of
        pressure from the west to the east neighbour and by that from the south to the north one
        [-]; 0 on the border.
    """
    ny = pressure.shape[0]
    g = 6.0 * rate_ratio(law, 0.0)[1]
    along[:, rows[0] : rows[1]] = 0.0
    across[:, rows[0] : rows[1]] = 0.0
    block = work.block
    for j in range(max(rows[0], 1), min(rows[1], ny - 1)):
        _sort_row(pressure, film, fluidity, units, j, work)
        for i in range(1, work.rule.size - 1):
            if not wanted[j, i]:
                work.rule[i] = _NO_FILM
            elif work.rule[i] >= 0 and math.isnan(stress[0, j, i]):
                work.rule[i] = _ALONE
        for rule in range(REACHES.size):
            begin = 1
            while begin < work.rule.size:
                n, begin = _take_block(work, rule, begin)
                if n == 0:
                    break
                for k in range(n):
                    i = work.column[k]
                    block.stress_s[k], block.stress_r[k] = stress[0, j, i], stress[1, j, i]
                block_slopes(law, block, n, STARTS[rule], STARTS[rule + 1])
                for k in range(n):
                    i, b = work.column[k], block.along
                    _write(pressure, film, thickening, units, work, j, i, b, k, 0.0, along)
                    b = block.across
                    _write(pressure, film, thickening, units, work, j, i, b, k, 0.0, across)
        for i in range(1, work.rule.size - 1):
            s, r, a, b, c = work.s[i], work.r[i], work.a[i], block.along, block.across
            limit_b = limit_c = 0.0
            if work.rule[i] == _SMALL:
                b[1, 0] = c[1, 0] = 0.2 * g * s
                b[2, 0] = c[2, 0] = 0.2 * g * r
                b[3, 0], c[3, 0] = g * a, g * a / 3.0
            elif work.rule[i] == _ALONE:
                f = factor_slopes(law, s, r, a, work.most[i])
                b[1, 0], b[2, 0], b[3, 0], limit_b = f.along_s, f.along_r, f.along_a, f.along_limit
                c[1, 0], c[2, 0], c[3, 0] = f.across_s, f.across_r, f.across_a
                limit_c = f.across_limit
            else:
                continue
            _write(pressure, film, thickening, units, work, j, i, b, 0, limit_b, along)
            _write(pressure, film, thickening, units, work, j, i, c, 0, limit_c, across)


@kernel
def _write(
    pressure: np.ndarray,
    film: np.ndarray,
    thickening: np.ndarray,
    units: ShearUnits,
    work: FactorWork,
    j: int,
    i: int,
    slopes: np.ndarray,
    k: int,
    by_limit: float,
    result: np.ndarray,
) -> None:
    # derivatives by the fields from those over Sigma_s, Sigma_r, a and the limit
    by_s, by_r, by_a = slopes[1, k], slopes[2, k], slopes[3, k]
    s, r, a, h = work.s[i], work.r[i], work.a[i], film[j, i]
    hardening = units.limit_slope / units.ratio[j, i] if pressure[j, i] > 0.0 else 0.0
    result[0, j, i] = by_a * a * thickening[j, i] + by_limit * hardening
    if units.ratio_slope[j, i] != 0.0:
        shrinking = by_s * s + by_r * r + by_a * a
        if by_limit != 0.0:
            shrinking += by_limit * work.most[i]
        result[0, j, i] -= units.ratio_slope[j, i] * shrinking
    result[1, j, i] = by_s * s + by_r * r - by_a * a
    result[2, j, i] = (units.cosine * by_s - units.sine * by_r) * units.sigma_x[i] * h
    result[2, j, i] /= units.ratio[j, i]
    result[3, j, i] = (units.sine * by_s + units.cosine * by_r) * units.sigma_y * h
    result[3, j, i] /= units.ratio[j, i]
