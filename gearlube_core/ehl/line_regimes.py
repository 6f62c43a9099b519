"""Film of a line contact at the ends of its regimes, to size a domain and start a solution."""

from __future__ import annotations

import math
from typing import NamedTuple


class LineGroups(NamedTuple):
    """Groups of a line contact; all dimensionless [-]."""

    U: float  # speed, eta0 u/(E' R), u the mean speed
    G: float  # material, alpha E'
    W: float  # load, w/(E' R)
    M: float  # Moes load, W (2 U)^(-1/2)
    L: float  # Moes material, G (2 U)^(1/4)


def line_groups(
    *,
    viscosity: float,
    pressure_viscosity: float,
    entrainment_speed: float,
    line_load: float,
    radius: float,
    reduced_modulus: float,
) -> LineGroups:
    """Return the groups of a line contact.

    U = eta0 u/(E' R), G = alpha E', W = w/(E' R), M = W (2U)^(-1/2), L = G (2U)^(1/4)

    Parameters
    ----------
    viscosity, pressure_viscosity : float
        eta0 [Pa s] and alpha [1/Pa].
    entrainment_speed : float
        Mean surface speed u, above zero [m/s].
    line_load : float
        w [N/m].
    radius : float
        R [m].
    reduced_modulus : float
        E' = 2 E* [Pa].

    References
    ----------
    Moes 1992; Venner and Lubrecht 2000.

    Examples
    --------
    >>> g = line_groups(viscosity=0.04, pressure_viscosity=2e-8, entrainment_speed=1.0,
    ...                 line_load=1e5, radius=0.01, reduced_modulus=2.3e11)
    >>> round(g.M, 2), round(g.L, 2)
    (7.37, 11.17)
    """
    stiffness = reduced_modulus * radius
    U = viscosity * entrainment_speed / stiffness
    G, W = pressure_viscosity * reduced_modulus, line_load / stiffness
    return LineGroups(U, G, W, W * (2.0 * U) ** -0.5, G * (2.0 * U) ** 0.25)


def central_film_group(M: float, L: float) -> float:
    """Return the central film H = (h/R) (2U)^(-1/2) between the four regimes.

    H = [(RI^(7/3) + EI^(7/3))^(3s/7) + (RP^(-7/2) + EP^(-7/2))^(-2s/7)]^(1/s),
    s = (7 + 8 exp(-2 EI/RI))/5, RI = 3/M, EI = 2.621 M^(-1/5), RP = 1.287 L^(2/3),
    EP = 1.311 M^(-1/8) L^(3/4)

    Parameters
    ----------
    M, L : float
        Moes load, above zero, and material, not negative [1].

    Returns
    -------
    float
        H [1].

    Notes
    -----
    A fit, within about 10 %; here it sizes domains and starts iterations, it is no result.
    Source: Moes 1992, coefficients for the central film as quoted by Venner and Lubrecht 2000.
    """
    RI, EI = 3.0 / M, 2.621 * M**-0.2
    s = (7.0 + 8.0 * math.exp(-2.0 * EI / RI)) / 5.0
    isoviscous = (RI ** (7.0 / 3.0) + EI ** (7.0 / 3.0)) ** (3.0 * s / 7.0)
    if L <= 0.0:
        return isoviscous ** (1.0 / s)
    RP, EP = 1.287 * L ** (2.0 / 3.0), 1.311 * M**-0.125 * L**0.75
    piezoviscous = (RP**-3.5 + EP**-3.5) ** (-2.0 * s / 7.0)
    return (isoviscous + piezoviscous) ** (1.0 / s)
