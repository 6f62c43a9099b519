"""Stress over cycles of gear materials: life factors, cycles to failure, Miner's sum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from gearlube_core.arrays import Array

Knots = tuple[tuple[float, float], ...]  # cycles and life factor, straight between in logarithms

_CASE: Knots = ((1e5, 1.6), (5e7, 1.0), (1e10, 0.85))
_NITRIDED: Knots = ((1e5, 1.3), (2e6, 1.0), (1e10, 0.85))
PITTING = MappingProxyType(
    {
        "case_hardened": _CASE,
        "through_hardened": _CASE,
        "nitrided": _NITRIDED,
        "nitrocarburised": ((1e5, 1.1), (2e6, 1.0), (1e10, 0.85)),
    }
)
# with some pitting allowed
LIMITED_PITTING: Knots = ((6e5, 1.6), (1e7, 1.3), (1e9, 1.0), (1e10, 0.85))
BENDING = MappingProxyType(
    {
        "case_hardened": ((1e3, 2.5), (3e6, 1.0), (1e10, 0.85)),
        "through_hardened": ((1e4, 2.5), (3e6, 1.0), (1e10, 0.85)),
        "nitrided": ((1e3, 1.6), (3e6, 1.0), (1e10, 0.85)),
        "nitrocarburised": ((1e3, 1.1), (3e6, 1.0), (1e10, 0.85)),
    }
)
TREATMENTS = tuple(PITTING)


def life_factor(knots: Knots, cycles: float | Array) -> Array:
    """Return Z_NT or Y_NT at a number of load cycles [-]; constant beyond both ends.

    Source: [iso_6336_2] table of Z_NT, [iso_6336_3] table of Y_NT.

    Examples
    --------
    >>> round(float(life_factor(PITTING["case_hardened"], 1.080e9)), 3)
    0.91
    """
    n, factor = np.log(np.array(knots)).T
    return np.exp(np.interp(np.log(cycles), n, factor))


def cycles_to_failure(knots: Knots, ratio: float | Array) -> Array:
    """Return the cycles that a stress lasts.

    Parameters
    ----------
    knots
        Of the life factor.
    ratio
        Stress over the strength at a life factor of 1 [-].

    Returns
    -------
    ndarray
        0 above the first life factor, static failure; infinite below the last.

    Examples
    --------
    >>> ratio = np.array([1650.0, 1450.0, 1300.0, 1200.0]) / 1500.0
    >>> [f"{n:.4g}" for n in cycles_to_failure(PITTING["case_hardened"], ratio)]
    ['1.418e+07', '1.51e+08', '5.31e+09', 'inf']
    """
    ratio = np.asarray(ratio, dtype=float)
    n, factor = np.log(np.array(knots)).T
    log = np.log(np.maximum(ratio, 1e-300))
    found = np.exp(np.interp(log, factor[::-1], n[::-1]))
    return np.where(ratio < knots[-1][1], np.inf, np.where(ratio > knots[0][1], 0.0, found))


def miner_sum(
    knots: Knots, ratios: Sequence[float] | Array, cycles: Sequence[float] | Array
) -> Array:
    """Return the damage of each load bin, cycles over cycles to failure [-].

    Source: [iso_6336_6]; 1 and more is failure, infinite at once.

    Examples
    --------
    >>> ratio = np.array([1650.0, 1450.0, 1300.0, 1200.0]) / 1500.0
    >>> round(float(miner_sum(PITTING["case_hardened"], ratio, [2e5, 5e6, 5e7, 1e9]).sum()), 5)
    0.05663
    """
    left = cycles_to_failure(knots, np.asarray(ratios))
    n = np.asarray(cycles, dtype=float)
    return np.where(
        n > 0.0, np.divide(n, left, out=np.full_like(n, math.inf), where=left > 0.0), 0.0
    )
