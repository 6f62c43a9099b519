"""A ninth root without branches or library calls, which compilers can vectorise.

The load of a line contact goes with the approach to the power 10/9, so each roller needs the
ninth root of its approach once per evaluation; `pow` would take most of the time of the axle.
"""

from __future__ import annotations

from gearlube_core.kernels.inlining import inlined

ROOT_MIN = 2.0**-13.5  # 1, smallest argument of ninth_root
ROOT_MAX = 2.0**17.5  # 1, largest

# Rational start for x^(1/9) on [2^-4.5, 2^8.5], relative error 6.9e-4 (minimax fit).
_P0, _P1, _P2, _P3, _P4 = 0.596642, 12.5071, 13.8193, 1.05515, 0.0045585
_Q1, _Q2, _Q3, _Q4 = 14.4686, 11.8468, 0.670285, 0.0019987
_LOW = 2.0**-4.5
_HIGH = 2.0**8.5

# Series of (1 - r)^(-1/9) and of (1 + u)^(1/9).
_A1, _A2, _A3, _A4, _A5 = 1 / 9, 5 / 81, 95 / 2187, 665 / 19683, 4921 / 177147
_B1, _B2, _B3, _B4, _B5 = 1 / 9, -4 / 81, 68 / 2187, -442 / 19683, 3094 / 177147
_B6 = -68068 / 4782969


@inlined
def ninth_root_start(x: float) -> float:
    """Return x^(1/9) to 6.9e-4 relative for ROOT_MIN <= x <= ROOT_MAX.

    x is first moved into the range of the rational start by 2^9 or 2^-9, whose ninth root is
    exact.
    """
    a = 512.0 if x < _LOW else 1.0
    b = 0.5 if x < _LOW else 1.0
    a = 1.0 / 512.0 if x > _HIGH else a
    b = 2.0 if x > _HIGH else b
    s = a * x
    s2 = s * s
    s4 = s2 * s2
    top = (_P0 + _P1 * s) + (_P2 + _P3 * s) * s2 + _P4 * s4
    bottom = (1.0 + _Q1 * s) + (_Q2 + _Q3 * s) * s2 + _Q4 * s4
    return b * (top / bottom)


@inlined
def ninth_root_residual(y: float, inverse: float) -> float:
    """Return 1 - y^9/x for the start y, given inverse = 1/x."""
    y2 = y * y
    y4 = y2 * y2
    return 1.0 - (y4 * y4) * (y * inverse)


@inlined
def ninth_root_refined(y: float, r: float) -> float:
    """Return y (1 - r)^(-1/9) for the residual r of the start y; error 0.024 r^6."""
    r2 = r * r
    return y + y * r * ((_A1 + _A2 * r) + ((_A3 + _A4 * r) + _A5 * r2) * r2)


@inlined
def ninth_root(x: float) -> float:
    """Return x^(1/9) to a few roundings, for ROOT_MIN <= x <= ROOT_MAX.

    Examples
    --------
    >>> abs(ninth_root(512.0) - 2.0) < 1e-15
    True
    """
    y = ninth_root_start(x)
    return ninth_root_refined(y, ninth_root_residual(y, 1.0 / x))


@inlined
def ninth_root_change(u: float) -> float:
    """Return (1 + u)^(1/9) - 1 for small u; error below 0.012 u^7."""
    u2 = u * u
    return u * ((_B1 + _B2 * u) + ((_B3 + _B4 * u) + (_B5 + _B6 * u) * u2) * u2)
