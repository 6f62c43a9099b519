"""Published formulas of mean friction, for `docs.film_model.published`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

SIGMA = 0.5e-6  # m, composite, of the shipped axle


class Local(NamedTuple):
    """One contact as closed formulas take it."""

    load: float  # [N]
    p: float  # mean of Hertz [Pa]
    length: float  # of the ellipse [m]
    R_x: float  # [m]
    psi: float  # [rad]
    speed: float  # [m/s]
    slip: float
    viscosity: float  # at the oil's temperature [mPa s]


def xu_kahraman(c: Local) -> float:
    """Return exp(f) p^b2 SR^b3 u^b6 nu^b7 R^b8, GPa, m/s, mPa s, m, um."""
    b = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958)
    slide, p = c.slip / c.speed, 1.5e-9 * c.p
    group = slide * p * math.log10(c.viscosity)
    f = b[0] + b[3] * group + b[4] * math.exp(-group) + 0.620305 * math.exp(1e6 * SIGMA)
    return float(
        math.exp(f)
        * p ** b[1]
        * slide ** b[2]
        * c.speed ** b[5]
        * c.viscosity ** b[6]
        * c.R_x ** b[7]
    )


def schlenk(c: Local) -> float:
    """Return 0.048 (F/b/(v_sum rho))^0.2 eta^-0.05 Ra^0.25, N/mm, m/s, mm, mPa s, um.

    At least 150 N/mm; v_sum is the sum of the speeds across the ellipse.
    """
    line_load = max(1e-3 * c.load / c.length, 150.0)
    rate = 2.0 * c.speed * math.cos(c.psi) * 1e3 * c.R_x
    Ra = 1e6 * SIGMA / math.sqrt(2.0) / 1.25  # of one of two like Gaussian surfaces
    return float(0.048 * (line_load / rate) ** 0.2 * c.viscosity**-0.05 * Ra**0.25)


FORMULAS: dict[str, Callable[[Local], float]] = {
    "Xu and Kahraman": xu_kahraman,
    "Schlenk": schlenk,
}
