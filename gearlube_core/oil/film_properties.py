"""Viscosity and density of a film on a grid, at the oil's temperature or at its own."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.density_law import density_ratio
from gearlube_core.oil.film_oil import FilmOil, bounded_exponential
from gearlube_core.oil.viscosity_law import log_viscosity


@kernel
def fill_properties(
    oil: FilmOil,
    p: np.ndarray,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    """Fill viscosity [Pa s], density [kg/m3] and their slopes with pressure.

    Parameters
    ----------
    oil
        Of the film.
    p
        Pressure [Pa], one-dimensional.
    eta, eta_slope, rho, rho_slope
        Filled; of the shape of `p`.
    """
    for i in range(p.size):
        _fill_node(oil, p[i], 1.0, 1.0, i, eta, eta_slope, rho, rho_slope)


@kernel
def fill_heated_properties(
    oil: FilmOil,
    p: np.ndarray,
    cooling: np.ndarray,
    dilation: np.ndarray,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    """Fill viscosity, density and their slopes in a film of uneven temperature.

    Parameters
    ----------
    oil, p, eta, eta_slope, rho, rho_slope
        As in `fill_properties`.
    cooling, dilation
        `cooling_factor` and the density's factor by heat, of the shape of `p` [-].
    """
    for i in range(p.size):
        _fill_node(oil, p[i], cooling[i], dilation[i], i, eta, eta_slope, rho, rho_slope)


@kernel
def _fill_node(
    oil: FilmOil,
    p: float,
    cooling: float,
    dilation: float,
    i: int,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    y, steepness = log_viscosity(oil.viscosity, p, cooling)
    value, slope = bounded_exponential(y)
    eta[i] = oil.eta0 * value
    eta_slope[i] = oil.eta0 * slope * steepness
    ratio, ratio_slope, _ = density_ratio(oil.density, p)
    rho[i] = dilation * oil.rho0 * ratio
    rho_slope[i] = dilation * oil.rho0 * ratio_slope


def film_properties(
    oil: FilmOil, pressure: Array, warm: tuple[Array, Array] | None
) -> tuple[Array, Array, Array, Array]:
    """Return viscosity, density and their pressure derivatives, of the pressure's shape.

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
        fill_heated_properties(oil, pressure.ravel(), warm[0].ravel(), warm[1].ravel(), *flat)
    return filled[0], filled[1], filled[2], filled[3]
