"""The oil of a film: laws of viscosity, density and shear together, and their values: kernels."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import NEWTONIAN
from gearlube_core.oil.film_laws import (
    cooling_factor,
    density_in_units,
    density_ratio,
    log_viscosity,
    viscosity_decline,
    viscosity_in_units,
)
from gearlube_core.oil.oil_heat import HEAT_RISES, HeatRise

# eta/eta0 = e^200 lies far above glass; beyond, the law goes on along its tangent in ln eta
_LARGEST_EXPONENT = 200.0
_LARGEST_RATIO = math.exp(_LARGEST_EXPONENT)
# Pa; below, the local Eyring stress is that at this pressure
LEAST_PRESSURE = 1.0e6


class FilmOil(NamedTuple):
    """Oil of a film at its inlet temperature, in SI units; `film_oil` and `film_oil_of` make one.

    Its three laws are NamedTuples as described in `film_laws`.

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> oil = film_oil(eta0=0.04, alpha=2e-8)
    >>> round(viscosity(oil, 1e8), 2)  # Pa s at 0.1 GPa
    0.25
    """

    eta0: float  # viscosity at ambient pressure and `temperature` [Pa s]
    rho0: float  # density at ambient pressure and `temperature` [kg/m3]
    viscosity: Any  # law of ln(eta/eta0)
    density: Any  # law of rho/rho0
    shear: Any  # law of the shear rate, Newtonian where its tau0 is 0
    tau_limit: float  # limiting shear stress at ambient pressure [Pa]
    limit_slope: float  # its slope with pressure [-]; both 0: no limit
    temperature: float  # T0 [K]
    expansion: float  # thermal expansion of volume [1/K]
    conductivity: float  # [W/(m K)]
    heat_capacity: float  # [J/(kg K)]
    eyring_slope: float = 0.0  # Lambda of the local Eyring stress [-]; 0: tau0 everywhere
    heat_rise: HeatRise = HEAT_RISES["none"]

    def newtonian(self) -> FilmOil:
        """Return the oil without shear thinning."""
        return self._replace(shear=NEWTONIAN, eyring_slope=0.0)

    def in_units(self, pressure: float) -> FilmOil:
        """Return the oil with viscosity over eta0, density over rho0, pressure in a unit [Pa].

        The shear law and the limiting stress stay in SI.
        """
        return self._replace(
            eta0=1.0,
            rho0=1.0,
            viscosity=viscosity_in_units(self.viscosity, pressure),
            density=density_in_units(self.density, pressure),
        )


@kernel
def bounded_exponential(y: float) -> tuple[float, float]:
    """Return exp(y), with a linear tail above y = 200, and its derivative.

    The value goes on growing there, so that a Newton step still sees a slope.
    """
    if y > _LARGEST_EXPONENT:
        return _LARGEST_RATIO * (1.0 + y - _LARGEST_EXPONENT), _LARGEST_RATIO
    value = math.exp(y)
    return value, value


@kernel
def viscosity(oil: FilmOil, p: float) -> float:
    """Return the viscosity [Pa s] at a gauge pressure [Pa] and the oil's temperature.

    Notes
    -----
    Above eta/eta0 = e^200 the ratio grows linearly in the exponent, so that no step of an
    iteration can overflow.
    """
    return oil.eta0 * bounded_exponential(log_viscosity(oil.viscosity, p, 1.0)[0])[0]


@kernel
def thermal_viscosity(oil: FilmOil, p: float, temperature: float) -> float:
    """Return the viscosity [Pa s] at a pressure [Pa] and a temperature [K]."""
    cooling = cooling_factor(oil.viscosity, temperature, oil.temperature)
    return oil.eta0 * bounded_exponential(log_viscosity(oil.viscosity, p, cooling)[0])[0]


@kernel
def viscosity_cooling(oil: FilmOil, p: float, temperature: float) -> float:
    """Return -d ln eta/dT at a pressure [Pa] and a temperature [K] [1/K]; 0: isothermal law."""
    return viscosity_decline(oil.viscosity, p, temperature, oil.temperature)


@kernel
def pressure_viscosity(oil: FilmOil) -> float:
    """Return alpha, the slope of ln eta with pressure at ambient pressure [1/Pa].

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> round(pressure_viscosity(film_oil(eta0=0.05, alpha=15e-9, eyring_stress=5e6)), 12)
    1.5e-08
    """
    return log_viscosity(oil.viscosity, 0.0, 1.0)[1]


@kernel
def density(oil: FilmOil, p: float) -> float:
    """Return the density [kg/m3] at a gauge pressure [Pa] and the oil's temperature."""
    return oil.rho0 * density_ratio(oil.density, p)[0]


@kernel
def limiting_stress(oil: FilmOil, p: float) -> float:
    """Return the limiting shear stress tau_limit + slope p [Pa]; infinite where there is none."""
    limit = oil.tau_limit + oil.limit_slope * max(p, 0.0)
    return limit if limit > 0.0 else math.inf


@kernel
def stress_ratio(oil: FilmOil, p: float, cooling: float) -> tuple[float, float]:
    """Return the local Eyring stress over tau0 of the shear law, and the slope of its logarithm.

    tau_E = 2 Lambda p/ln[eta(p, T)/eta(0, T)]

    Parameters
    ----------
    oil
        Oil of the film, in SI.
    p
        Gauge pressure [Pa].
    cooling
        `cooling_factor` of the temperature [-].

    Returns
    -------
    tuple of float
        tau_E/tau0 [-] and d ln(tau_E)/dp at one temperature [1/Pa]; 1 and 0 of an oil whose
        Eyring stress is one number.

    Notes
    -----
    2 Lambda over the secant of ln(eta) from ambient pressure, so that the stress tends to
    Lambda p where both are large. Below 1 MPa it is that at 1 MPa. Source: [arana_2019].

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> oil = film_oil(eta0=0.04, alpha=2e-8, eyring_slope=0.047)
    >>> round(1e-6 * oil.shear.tau0 * stress_ratio(oil, 1e9, 1.0)[0], 2)  # MPa at 1 GPa
    7.28
    """
    if oil.eyring_slope == 0.0:
        return 1.0, 0.0
    q = max(p, LEAST_PRESSURE)
    grown, slope = log_viscosity(oil.viscosity, q, cooling)
    grown -= log_viscosity(oil.viscosity, 0.0, cooling)[0]
    ratio = 2.0 * oil.eyring_slope * q / (grown * oil.shear.tau0)
    return ratio, 1.0 / q - slope / grown if p > LEAST_PRESSURE else 0.0


@kernel
def fill_stress_ratios(
    oil: FilmOil, unit: float, p: np.ndarray, cooling: np.ndarray, ratio: np.ndarray,
    slope: np.ndarray,
) -> None:  # fmt: skip
    """Fill `stress_ratio` and its slope at pressures in a unit [Pa]; arrays of one shape."""
    for i in range(p.size):
        ratio.flat[i], by_p = stress_ratio(oil, p.flat[i] * unit, cooling.flat[i])
        slope.flat[i] = by_p * unit


@kernel
def heat_under(oil: FilmOil, p: float, rho: float) -> tuple[float, float]:
    """Return conductivity [W/(m K)] and heat capacity by volume [J/(m3 K)] of oil of a density.

    Notes
    -----
    With a rise, rho0 c [1 + a p/(1 + b p)] stands for rho c. Source: [larsson_andersson_2000].
    """
    rise, q = oil.heat_rise, max(p, 0.0)
    conductivity = 1.0 + rise.conductivity * q / (1.0 + rise.conductivity_bend * q)
    if rise.capacity > 0.0:
        rho = oil.rho0 * (1.0 + rise.capacity * q / (1.0 + rise.capacity_bend * q))
    return oil.conductivity * conductivity, rho * oil.heat_capacity


@kernel
def _fill_properties(
    oil: FilmOil,
    p: np.ndarray,
    cooling: np.ndarray,
    dilation: np.ndarray,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    for i in range(p.size):
        y, steepness = log_viscosity(oil.viscosity, p[i], cooling[i])
        value, slope = bounded_exponential(y)
        eta[i] = oil.eta0 * value
        eta_slope[i] = oil.eta0 * slope * steepness
        ratio, ratio_slope, _ = density_ratio(oil.density, p[i])
        rho[i] = dilation[i] * oil.rho0 * ratio
        rho_slope[i] = dilation[i] * oil.rho0 * ratio_slope


def film_properties(
    oil: FilmOil, pressure: Array, warm: tuple[Array, Array] | None = None
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
    cooling, dilation = warm or (np.ones(pressure.shape), np.ones(pressure.shape))
    _fill_properties(oil, pressure.ravel(), cooling.ravel(), dilation.ravel(), *flat)
    return filled[0], filled[1], filled[2], filled[3]
