"""Elastic energy of two opposed roller bearings, the potential of their quasi-steady force."""

from __future__ import annotations

import math

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.cage_frame import approach_terms
from gearlube_core.bearings.parameters import (
    COS_TABLE,
    FILM_FLOOR_APPROACH,
    FILM_RANGE,
    SIN_TABLE,
    BearingParameters,
)
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    approach_with_film,
    film_amplitude,
    roller_approach_line,
)
from gearlube_core.film.mostofi_gohar_1983 import LOAD_EXPONENT
from gearlube_core.kernels.inlining import summing
from gearlube_core.kernels.jit import kernel


@kernel
def roller_energy(g: float, film: float, n: float) -> float:
    """Return the integral of x^n dg up to the geometric approach g, with x = g + H(x).

    x^(n+1)/(n+1) + m A (min(x, R)^(n-m) - 1)/(n-m),  m = 0.045 n, the second term for x > 1.

    Lengths are in units of FILM_FLOOR_APPROACH, R is FILM_RANGE. The second term is the work
    that the rollers do as the film gives way under load, -integral of x^n dH.
    """
    x = approach_with_film(g, film, n)
    if x <= 0.0:
        return 0.0
    energy = x ** (n + 1.0) / (n + 1.0)
    if x > 1.0:
        m = -LOAD_EXPONENT * n
        energy += m * film * (min(x, FILM_RANGE) ** (n - m) - 1.0) / (n - m)
    return energy


@summing
def _sum_line(count: int, g: float, g1: float, g2: float, film: float) -> float:
    """Return the sum of `roller_energy` over the rollers of a line contact bearing.

    With y = x^(1/9) and the film H = x - g: x^(n+1) = x^2 y, A x^(n-m) = x y H for 1 < x < R.
    """
    n = N_LINE
    m = -LOAD_EXPONENT * n
    limit = FILM_RANGE ** (n - m)
    total = 0.0
    for i in range(count):
        gap = g + g1 * COS_TABLE[count, i] + g2 * SIN_TABLE[count, i]
        x, y, _, _ = roller_approach_line(gap, film)
        given = x * y * (x - gap) if x < FILM_RANGE else film * limit
        given = given - film if x > 1.0 else 0.0
        total += x * x * y / (n + 1.0) + m * given / (n - m)
    return total


@kernel
def bearing_energy(
    r1: float,
    r2: float,
    xa: float,
    cage_angle: float,
    shaft_speed: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
    side: float,
) -> float:
    """Return the elastic energy of one bearing [J]; see `shaft_bearing_energy`."""
    film, _ = film_amplitude(shaft_speed, eta0, alpha, p)
    still = ShaftMotion(r1, r2, xa, 0.0, 0.0, 0.0, cage_angle, 0.0)
    g0, g1, g2, ga, _, _, _ = approach_terms(still, math.cos(cage_angle), math.sin(cage_angle), p)
    count = int(p.n_rollers)
    if p.n == N_LINE:
        total = _sum_line(count, g0 + side * ga, g1, g2, film)
    else:
        total = 0.0
        for i in range(count):
            g = g0 + side * ga + g1 * COS_TABLE[count, i] + g2 * SIN_TABLE[count, i]
            total += roller_energy(g, film, p.n)
    return total * p.kn * FILM_FLOOR_APPROACH ** (p.n + 1.0) / p.approach_factor


@kernel
def shaft_bearing_energy(
    r1: float,
    r2: float,
    xa: float,
    cage_angle: float,
    shaft_speed: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
) -> float:
    """Return the elastic energy of all rollers of both opposed bearings.

    V = sum kn d^(n+1)/(n+1) without film; F = -grad V for the quasi-steady forces.

    Parameters
    ----------
    r1, r2, xa : float
        Radial and axial displacement of the shaft [m].
    cage_angle, shaft_speed : float
        Angle of roller 0 [rad]; speed of the shaft [rad/s].
    eta0, alpha, p
        As in `shaft_bearing_forces`.

    Returns
    -------
    float
        V [J].

    Notes
    -----
    With the halved approach of [mohammadpour_2015 (26)] as printed, V is divided by the factor 1/2,
    so that the forces still have a potential. With a film, V holds at constant speed and oil; a
    change of these lifts the rollers and does work on the shaft that no term of the model supplies.

    References
    ----------
    [mohammadpour_2015 (25)] integrated over the approach
    """
    return bearing_energy(
        r1, r2, xa, cage_angle, shaft_speed, eta0, alpha, p, 1.0
    ) + bearing_energy(r1, r2, xa, cage_angle, shaft_speed, eta0, alpha, p, -1.0)
