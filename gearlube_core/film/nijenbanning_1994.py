"""Central film of a point contact across all regimes, Nijenbanning, Venner and Moes 1994."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_positive, check_within


class RegimeFilms(NamedTuple):
    """H = (h/R_x) (2 U)^(-1/2) of the regimes, each alone; all dimensionless [-]."""

    rigid_isoviscous: float
    elastic_isoviscous: float
    rigid_piezoviscous: float
    elastic_piezoviscous: float
    light_load: float  # upper bound of the elastic isoviscous film


def regime_films(M: float, L: float, radius_ratio: float = 1.0) -> RegimeFilms:
    """Return the central films of the regimes.

    RI = 145 (1 + 0.796 lam^(14/15))^(-15/7) lam^-1 M^-2,
    EI = 3.18 c^(-14/25) lam^(-1/15) M^(-2/15),  RP = 1.29 (1 + 0.691 lam)^(-2/3) L^(2/3),
    EP = 1.48 c^(-7/20) lam^(-1/24) M^(-1/12) L^(3/4),  c = 1 + 0.006 ln(lam) + 0.63 lam^(4/7)

    Parameters
    ----------
    M, L
        Load and material of Moes with R_x as the radius [-]; L is 0 for an isoviscous oil.
    radius_ratio
        lam = R_x/R_y [-], R_x along the entrainment; 0.01 to 1, wide contacts.

    Raises
    ------
    ParameterError
        An argument is out of range.
    """
    check_positive("M", M)
    check_within("L", L, 0.0, 1e3)
    check_within("radius_ratio", radius_ratio, 0.01, 1.0, "", "Entrain along the short axis.")
    lam = radius_ratio
    c = 1.0 + 0.006 * math.log(lam) + 0.63 * lam ** (4.0 / 7.0)
    return RegimeFilms(
        145.0 * (1.0 + 0.796 * lam ** (14.0 / 15.0)) ** (-15.0 / 7.0) / (lam * M * M),
        3.18 * c ** (-14.0 / 25.0) * lam ** (-1.0 / 15.0) * M ** (-2.0 / 15.0),
        1.29 * (1.0 + 0.691 * lam) ** (-2.0 / 3.0) * L ** (2.0 / 3.0),
        1.48 * c ** (-7.0 / 20.0) * lam ** (-1.0 / 24.0) * M ** (-1.0 / 12.0) * L**0.75,
        1.8 / lam,
    )


def central_film_group(M: float, L: float, radius_ratio: float = 1.0) -> float:
    """Return the central film H = (h/R_x) (2 U)^(-1/2) between the regimes.

    H = {[RI^(3/2) + (EI^-4 + H_0^-4)^(-3/8)]^(2s/3) + [RP^-8 + EP^-8]^(-s/8)}^(1/s),
    s = 1.5 (1 + exp(-1.2 EI/EP)),  H_0 = 1.8/lam

    Parameters
    ----------
    M, L, radius_ratio
        As in `regime_films`.

    Returns
    -------
    float
        H [-].

    Notes
    -----
    A fit to numerical films, within about 10 % of them; the smooth start and the yardstick of
    films over a map of loads, no result. Source: [nijenbanning_1994].

    Examples
    --------
    >>> round(central_film_group(20.0, 10.0), 3)
    4.265
    """
    RI, EI, RP, EP, H_0 = regime_films(M, L, radius_ratio)
    s = 1.5 if EP == 0.0 else 1.5 * (1.0 + math.exp(-1.2 * EI / EP))
    isoviscous = RI**1.5 + (EI**-4 + H_0**-4) ** (-3.0 / 8.0)
    piezoviscous = (RP**-8 + EP**-8) ** (-s / 8.0) if L > 0.0 else 0.0
    return float((isoviscous ** (2.0 * s / 3.0) + piezoviscous) ** (1.0 / s))
