"""Stress over cycles: life factors of gears, strength lines, cycles to failure."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import MappingProxyType

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

# Load cycles and strength; straight between points in logarithms. Of a life factor, or in Pa.
Line = tuple[tuple[float, float], ...]

_CASE: Line = ((1e5, 1.6), (5e7, 1.0), (1e10, 0.85))
_ROOT: Line = ((1e3, 2.5), (3e6, 1.0), (1e10, 0.85))
PITTING = MappingProxyType({
    "case_hardened": _CASE,
    "induction_hardened": _CASE,
    "through_hardened": _CASE,
    "nitrided": ((1e5, 1.3), (2e6, 1.0), (1e10, 0.85)),
    "nitrocarburised": ((1e5, 1.1), (2e6, 1.0), (1e10, 0.85)),
})  # fmt: skip
SOME_PITTING: Line = ((6e5, 1.6), (1e7, 1.3), (1e9, 1.0), (1e10, 0.85))
BENDING = MappingProxyType({
    "case_hardened": _ROOT,
    "induction_hardened": _ROOT,
    "through_hardened": ((1e4, 2.5), (3e6, 1.0), (1e10, 0.85)),
    "nitrided": ((1e3, 1.6), (3e6, 1.0), (1e10, 0.85)),
    "nitrocarburised": ((1e3, 1.1), (3e6, 1.0), (1e10, 0.85)),
})  # fmt: skip
TREATMENTS = tuple(PITTING)
_LEAST, _MOST = 1e-4, 1e4  # of a torque factor
_SMALL = 1e-9  # a damage that counts as none


def strength_line(factors: Line, limit: float, influence: float) -> Line:
    """Return the strength over cycles, in the unit of the limit.

    `factors` are life factors such as `PITTING["case_hardened"]`, `limit` is the endurance limit at
    a factor of 1, `influence` the product of all other factors [-], of lubrication, size and
    roughness. The first point, the static strength, is not influenced; the others are fully.
    """
    (n, static), *others = factors
    return ((n, limit * static), *((m, limit * influence * factor) for m, factor in others))


def strength(line: Line, cycles: float) -> float:
    """Return the strength, or the life factor, at a number of cycles; constant beyond both ends.

    Source: Z_NT [iso_6336_2], Y_NT [iso_6336_3].

    >>> round(strength(PITTING["case_hardened"], 1.080e9), 3)
    0.91
    """
    n, values = np.log(np.array(line)).T
    return math.exp(np.interp(math.log(cycles), n, values))


def cycles_to_failure(line: Line, stress: float | Array) -> Array:
    """Return the cycles that a stress lasts: 0 above the first point, infinite below the last.

    >>> line = strength_line(PITTING["case_hardened"], 1500.0, 1.0)
    >>> [f"{n:.4g}" for n in cycles_to_failure(line, np.array([1650.0, 1450.0, 1300.0, 1200.0]))]
    ['1.418e+07', '1.51e+08', '5.31e+09', 'inf']
    """
    stress = np.asarray(stress, dtype=float)
    n, values = np.log(np.array(line)).T
    found = np.exp(np.interp(np.log(np.maximum(stress, 1e-300)), values[::-1], n[::-1]))
    return np.where(stress < line[-1][1], np.inf, np.where(stress > line[0][1], 0.0, found))


def miner_sum(line: Line, stress: float | Array, cycles: float | Array) -> Array:
    """Return the damage of each load bin: cycles over cycles to failure [-].

    The sum over bins is Miner's; at 1 the member is expected to fail. Infinite: it fails at once.
    Source: [iso_6336_6].

    >>> line = strength_line(PITTING["case_hardened"], 1500.0, 1.0)
    >>> stress, cycles = np.array([1650.0, 1450.0, 1300.0, 1200.0]), [2e5, 5e6, 5e7, 1e9]
    >>> round(float(miner_sum(line, stress, cycles).sum()), 4)
    0.0566
    """
    n, life = np.broadcast_arrays(np.asarray(cycles, dtype=float), cycles_to_failure(line, stress))
    if not (np.isfinite(n).all() and (n >= 0.0).all()):
        raise ParameterError("Load cycles must be finite and not negative. Check times and speeds.")
    damage = np.where(n > 0.0, math.inf, 0.0)
    np.divide(n, life, out=damage, where=life > 0.0)
    return damage


def torque_factor(damage: Callable[[float], float]) -> float:
    """Return the factor on all torques of a spectrum at which the damage is 1 [-].

    The safety that users expect of a spectrum; 1 over the damage is none. `damage` is Miner's sum
    at a factor, and must not fall with it. Infinite: no torque within 10 000 times damages. Where
    damage jumps from below 1 to failure at once, the factor is that of the jump. ParameterError
    where the damage is 1 already at 1e-4 times the torque.

    >>> damage = lambda factor: float(miner_sum(BENDING["case_hardened"], 1.2 * factor, 3e5))
    >>> found = torque_factor(damage)
    >>> round(found, 3), round(damage(found), 6)
    (1.085, 1.0)
    """
    if damage(_LEAST) >= 1.0:
        raise ParameterError(
            f"Damage must be below 1 at {_LEAST:g} times the torque, got {damage(_LEAST):g}. "
            "Check units of torques and limits: 1500 MPa is 1.5e9 Pa."
        )
    if damage(_MOST) < 1.0:
        return math.inf

    def height(x: float) -> float:
        return math.log(min(max(damage(math.exp(x)), _SMALL), 1.0 / _SMALL))

    return math.exp(brentq(height, math.log(_LEAST), math.log(_MOST), xtol=1e-9))
