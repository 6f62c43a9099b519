"""Viscosity and density of a film on a grid, at the oil's temperature or at its own."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.oil.film_oil import EhlLubricant, fill_properties, fill_warm_properties


def film_properties(
    oil: EhlLubricant, pressure: Array, warm: tuple[Array, Array] | None
) -> tuple[Array, Array, Array, Array]:
    """Return viscosity, density and how they answer to pressure, of the pressure's shape.

    Parameters
    ----------
    oil, pressure
        In the same units.
    warm
        `cooling_factor` of the temperature and the density's factor by heat, of the pressure's
        shape [-]; None: at the oil's temperature.

    Returns
    -------
    tuple of ndarray
        eta, d eta/dp, rho, d rho/dp.
    """
    filled = np.empty((4, *pressure.shape))
    flat = (filled[0].ravel(), filled[1].ravel(), filled[2].ravel(), filled[3].ravel())
    if warm is None:
        fill_properties(oil, pressure.ravel(), *flat)
    else:
        fill_warm_properties(oil, pressure.ravel(), warm[0].ravel(), warm[1].ravel(), *flat)
    return filled[0], filled[1], filled[2], filled[3]
