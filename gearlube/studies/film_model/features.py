"""What a film depends on, from the groups of its contact: inputs of the statistical fit."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.film_model.groups import FilmGroups

# E* of steel over the pressure of Roelands' law; other solids are outside the domain
_MODULUS_OVER_ROELANDS = 588.5


def film_features(groups: Array) -> Array:
    """Return inputs (n, 17) in which films vary simply, from groups (n, N_GROUPS).

    In order: thickness, material group as of Moes with u cos(psi), alpha p, tau0/p, ellipticity,
    entrainment angle, slide-roll ratio, sliding angle, heating number of the oil, Z, S0, Peclet
    number of the solids, conductivity and heat capacity ratio, viscosity, ln(eta(p)/eta0),
    ln[eta0 slip/(h tau0)] up to a function of the ellipticity.
    """
    g = FilmGroups(*groups.T)
    alpha = g.exponent + np.log(g.viscosity)  # ln(alpha over that of Roelands' pressure)
    speed = g.rate + g.viscosity + np.log(np.cos(g.psi))  # ln(eta0 u cos(psi)/(E* R_x))
    pressure = np.exp(g.pressure) * _MODULUS_OVER_ROELANDS
    growth = g.viscosity * np.expm1(np.exp(g.exponent) * np.log1p(pressure))
    slip = g.viscosity + g.rate + g.slide_roll - g.stress
    shear = slip - 2.0 * (np.log(g.thickness) + g.pressure)
    return np.stack(
        [
            g.thickness,
            alpha + 0.25 * speed,
            alpha + g.pressure,
            g.stress - g.pressure,
            g.ellipse,
            g.psi,
            g.slide_roll,
            g.delta,
            g.heat,
            g.exponent,
            g.cooling,
            g.peclet,
            g.conductivity,
            g.capacity,
            g.viscosity,
            growth,
            shear,
        ],
        axis=1,
    )
