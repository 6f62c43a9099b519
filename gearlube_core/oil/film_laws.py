"""Laws of the oil in a film: viscosity, density and shear, by class for kernels.

Interface of a density law: rho/rho0 and its first two pressure derivatives.

A law is a NamedTuple of floats with the kernel `density_ratio`.

Interface of a viscosity law: ln(eta/eta0) and its pressure derivative.

A law is a NamedTuple of floats with the kernel `log_viscosity`. For thermal solutions it also
needs `cooling_factor`, `cooling_at` and `viscosity_decline`; without these it is isothermal.

The cooling factor is a number of the law's own choice that stands for the temperature: 1 at the
temperature of the oil. Houpert's is t^(-S0).

Interface of a shear law: the shear rate over that of a Newtonian oil.

    du/dz = (tau0/eta) t G(|t|^2),  t = tau/tau0

A law is a NamedTuple of floats with the field `tau0`, its unit of stress [Pa], and the kernel
`rate_ratio`. A law with closed forms for a film may bring `flow_factor`, `mid_stress` and
`layered_stress` as well (`shear_factors`); without them a quadrature serves.

Barus, Roelands and Houpert in one viscosity law.

    eta = eta0 exp{A [t^(-S0) (1 + chi p)^Z - 1]},  t = (T - 138)/(T0 - 138)

Roelands with A = ln(eta0/kappa), Houpert with S0 above zero, Barus with Z = 1, A = alpha/chi.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA, ROELANDS_PRESSURE

_GAMMA = 2.266e-9  # 1/Pa, [jamali_2015 (3.5)]
_LAMBDA = 1.683e-9  # 1/Pa, the same


@by_class()
def density_ratio(law: Any, p: float) -> tuple[float, float, float]:
    """Return rho/rho0 and its first and second pressure derivative.

    Parameters
    ----------
    law
        Density law of the oil.
    p
        Gauge pressure [Pa]; below zero too, where an iteration may look.

    Returns
    -------
    tuple of float
        rho/rho0 [-], one at p = 0, above zero everywhere; [1/Pa]; [1/Pa2].
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


class ScaledDensity(NamedTuple):
    """A density law whose pressure is given in another unit."""

    law: Any
    unit: float  # [Pa]

    @kernel
    def density_ratio(self, p: float) -> tuple[float, float, float]:
        """Return rho/rho0 and its derivatives by p, p in units."""
        ratio, slope, bend = density_ratio(self.law, p * self.unit)
        return ratio, slope * self.unit, bend * self.unit * self.unit


def density_in_units(law: Any, unit: float) -> Any:
    """Return a law that takes pressure in a unit [Pa].

    A law may bring a method `in_units(unit)` that puts the unit into its own numbers.
    """
    return law.in_units(unit) if hasattr(law, "in_units") else ScaledDensity(law, float(unit))


@kernel
def _one(law: Any, temperature: float, oil_temperature: float) -> float:
    return 1.0


@kernel
def _one_at(law: Any, p: float, log_ratio: float) -> float:
    return 1.0


@kernel
def _zero(law: Any, p: float, temperature: float, oil_temperature: float) -> float:
    return 0.0


@by_class()
def log_viscosity(law: Any, p: float, cooling: float) -> tuple[float, float]:
    """Return ln(eta/eta0) and its pressure derivative.

    Parameters
    ----------
    law
        Viscosity law of the oil.
    p
        Gauge pressure [Pa]; below zero too, where an iteration may look.
    cooling
        Cooling factor of the law [-]; 1: temperature of the oil.

    Returns
    -------
    tuple of float
        ln(eta/eta0) [-], zero at p = 0 and cooling 1, and d ln eta/dp [1/Pa].
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_one)
def cooling_factor(law: Any, temperature: float, oil_temperature: float) -> float:
    """Return the cooling factor [-] at a temperature, of an oil at `oil_temperature` [K]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_one_at)
def cooling_at(law: Any, p: float, log_ratio: float) -> float:
    """Return the cooling factor [-] at which ln(eta/eta0) is `log_ratio` at a pressure [Pa]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_zero)
def viscosity_decline(law: Any, p: float, temperature: float, oil_temperature: float) -> float:
    """Return -d ln eta/dT [1/K] at a pressure [Pa] and a temperature [K]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


class ScaledViscosity(NamedTuple):
    """A viscosity law whose pressure is given in another unit."""

    law: Any
    unit: float  # [Pa]

    @kernel
    def log_viscosity(self, p: float, cooling: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and its derivative by p, p in units."""
        value, slope = log_viscosity(self.law, p * self.unit, cooling)
        return value, slope * self.unit


def viscosity_in_units(law: Any, unit: float) -> Any:
    """Return an isothermal law that takes pressure in a unit [Pa].

    A law may bring a method `in_units(unit)` that puts the unit into its own numbers.
    """
    return law.in_units(unit) if hasattr(law, "in_units") else ScaledViscosity(law, float(unit))


@by_class()
def rate_ratio(law: Any, q: float) -> tuple[float, float]:
    """Return G and dG/dq.

    Parameters
    ----------
    law
        Shear law of the oil.
    q
        Square of the amount of the stress over tau0 [-].

    Returns
    -------
    tuple of float
        G [-], one at q = 0 and never falling with q; dG/dq [-], finite at q = 0.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


class DowsonHigginson(NamedTuple):
    """rho = rho0 (1 + gamma p)/(1 + lambda p); both coefficients 0: incompressible."""

    gamma: float  # [1/Pa]
    lam: float  # [1/Pa]

    @kernel
    def density_ratio(self, p: float) -> tuple[float, float, float]:
        """Return rho/rho0 and its first and second pressure derivative.

        Notes
        -----
        Below ambient pressure rho0, with derivatives zero; at zero those from above. Measured to
        about 0.4 GPa; bounded by 1.346 rho0 at any pressure. (3.5) prints another letter for
        gamma p in the numerator. Source: [dowson_higginson_1966] [jamali_2015 (3.5)]
        """
        q = max(p, 0.0)
        below = 1.0 + self.lam * q
        ratio = (1.0 + self.gamma * q) / below
        slope = (self.gamma - self.lam) / (below * below) if p >= 0.0 else 0.0
        return ratio, slope, -2.0 * self.lam * slope / below

    def in_units(self, unit: float) -> DowsonHigginson:
        """Return the law with pressure in a unit [Pa]."""
        return DowsonHigginson(self.gamma * unit, self.lam * unit)


DOWSON_HIGGINSON_1966 = DowsonHigginson(_GAMMA, _LAMBDA)
INCOMPRESSIBLE = DowsonHigginson(0.0, 0.0)


@kernel
def _pressure_exponent(chi: float, Z: float, p: float) -> tuple[float, float]:
    # (1 + chi p)^Z - 1 and its slope; below ambient pressure its tangent at zero
    if p <= 0.0:
        return Z * chi * p, Z * chi
    log_pressure = math.log1p(chi * p)
    return math.expm1(Z * log_pressure), Z * chi * math.exp((Z - 1.0) * log_pressure)


class RoelandsHoupert(NamedTuple):
    """Viscosity law of Barus, Roelands or Houpert; all floats, SI."""

    log_ratio: float  # A [-]
    chi: float  # [1/Pa]
    Z: float  # [-]
    S0: float  # temperature exponent [-]; 0: isothermal

    @kernel
    def log_viscosity(self, p: float, cooling: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and d ln eta/dp.

        Notes
        -----
        Meant for 0 to about 1 GPa; below zero the tangent at ambient pressure is taken.
        Source: [roelands_1966] [jamali_2015 (3.4)] [houpert_1985]
        """
        growth, slope = _pressure_exponent(self.chi, self.Z, p)
        exponent = growth + (cooling - 1.0) * (1.0 + growth)
        return self.log_ratio * exponent, self.log_ratio * cooling * slope

    @kernel
    def cooling_factor(self, temperature: float, oil_temperature: float) -> float:
        """Return t^(-S0); temperatures above 138 K."""
        t = (temperature - GLASS_TEMPERATURE) / (oil_temperature - GLASS_TEMPERATURE)
        return math.exp(-self.S0 * math.log(t))

    @kernel
    def cooling_at(self, p: float, log_ratio: float) -> float:
        """Return t^(-S0) at which ln(eta/eta0) is `log_ratio`; 1 of an isothermal oil."""
        if self.S0 == 0.0:
            return 1.0
        growth, _ = _pressure_exponent(self.chi, self.Z, max(p, 0.0))
        return (log_ratio / self.log_ratio + 1.0) / (1.0 + growth)

    @kernel
    def viscosity_decline(self, p: float, temperature: float, oil_temperature: float) -> float:
        """Return -d ln eta/dT [1/K]."""
        t = (temperature - GLASS_TEMPERATURE) / (oil_temperature - GLASS_TEMPERATURE)
        cooling = math.exp(-self.S0 * math.log(t))
        growth, _ = _pressure_exponent(self.chi, self.Z, p)
        exponent = cooling * (1.0 + growth)
        return self.log_ratio * self.S0 * exponent / (temperature - GLASS_TEMPERATURE)

    def in_units(self, unit: float) -> RoelandsHoupert:
        """Return the law with pressure in a unit [Pa]."""
        return self._replace(chi=self.chi * unit)


def barus(alpha: float) -> RoelandsHoupert:
    """Return eta = eta0 exp(alpha p), alpha in [1/Pa]."""
    return RoelandsHoupert(float(alpha / ROELANDS_PRESSURE), ROELANDS_PRESSURE, 1.0, 0.0)


def roelands(eta0: float, alpha: float, S0: float = 0.0) -> RoelandsHoupert:
    """Return the law of Roelands, of Houpert with S0, through eta0 [Pa s] and alpha [1/Pa]."""
    log_ratio = math.log(eta0 / ROELANDS_KAPPA)
    Z = alpha / (ROELANDS_PRESSURE * log_ratio)
    return RoelandsHoupert(float(log_ratio), ROELANDS_PRESSURE, float(Z), float(S0))
