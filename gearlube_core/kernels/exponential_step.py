"""Numbers with which one mode is stepped exactly in its linear part, as a kernel."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

_SMALL = 0.5  # norm below which the series is summed
_TERMS = 14  # of it: the rest is below 0.5^14/14! of the sum
Square = tuple[float, float, float, float]


@kernel
def _product(one: Square, other: Square) -> Square:
    a, b, c, d = one
    e, f, g, h = other
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h


@kernel
def phi_functions(square: float, damping: float, h: float) -> tuple[Square, Square, Square, Square]:
    """Return exp(h L) and phi_1, phi_2, phi_3 of h L, row by row, of q'' + damping q' + square q.

    phi_k(z) = sum z^j / (j + k)! and L = [[0, 1], [-square, -damping]].

    Parameters
    ----------
    square : float
        Of the frequency, of either sign [1/s2].
    damping : float
        [1/s]
    h : float
        [s]

    References
    ----------
    S. M. Cox, P. C. Matthews, J. Comput. Phys. 176 (2002), doi:10.1006/jcph.2002.6995. By scaling
    and squaring, as M. Hochbruck, A. Ostermann, Acta Numerica 19 (2010),
    doi:10.1017/S0962492910000048, section 4.1.

    Examples
    --------
    >>> whole = phi_functions(4.0, 0.0, 0.5)[0]
    >>> [round(one, 6) for one in whole]  # cos 1, sin(1)/2, -2 sin 1, cos 1
    [0.540302, 0.420735, -1.682942, 0.540302]
    """
    # in units of the frequency, in which both rows compare
    w = math.sqrt(abs(square))
    w = w if w > 0.0 else 1.0
    upper, lower, turned = h * w, -h * square / w, -h * damping
    norm, doublings = max(abs(upper), abs(lower)) + abs(turned), 0
    while norm > _SMALL and doublings < 64:
        norm *= 0.5
        doublings += 1
    scale = 0.5**doublings
    z = 0.0, scale * upper, scale * lower, scale * turned
    # phi_3 by Horner, then phi_k = z phi_(k+1) + 1/k!
    last = 1.0
    for j in range(2, _TERMS + 4):
        last /= j
    three = last, 0.0, 0.0, last
    for j in range(_TERMS + 3, 3, -1):
        last *= j
        a, b, c, d = _product(z, three)
        three = a + last, b, c, d + last
    a, b, c, d = _product(z, three)
    two = a + 0.5, b, c, d + 0.5
    a, b, c, d = _product(z, two)
    one = a + 1.0, b, c, d + 1.0
    a, b, c, d = _product(z, one)
    whole = a + 1.0, b, c, d + 1.0
    for _ in range(doublings):
        p, q, r = _product(whole, three), _product(whole, two), _product(whole, one)
        three = (
            0.125 * (p[0] + three[0] + two[0] + 0.5 * one[0]),
            0.125 * (p[1] + three[1] + two[1] + 0.5 * one[1]),
            0.125 * (p[2] + three[2] + two[2] + 0.5 * one[2]),
            0.125 * (p[3] + three[3] + two[3] + 0.5 * one[3]),
        )
        two = (
            0.25 * (q[0] + two[0] + one[0]),
            0.25 * (q[1] + two[1] + one[1]),
            0.25 * (q[2] + two[2] + one[2]),
            0.25 * (q[3] + two[3] + one[3]),
        )
        one = (
            0.5 * (r[0] + one[0]),
            0.5 * (r[1] + one[1]),
            0.5 * (r[2] + one[2]),
            0.5 * (r[3] + one[3]),
        )
        whole = _product(whole, whole)
    return (
        (whole[0], whole[1] / w, whole[2] * w, whole[3]),
        (one[0], one[1] / w, one[2] * w, one[3]),
        (two[0], two[1] / w, two[2] * w, two[3]),
        (three[0], three[1] / w, three[2] * w, three[3]),
    )
