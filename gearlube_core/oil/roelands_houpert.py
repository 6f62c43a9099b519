"""Barus, Roelands and Houpert in one viscosity law.

    eta = eta0 exp{A [t^(-S0) (1 + chi p)^Z - 1]},  t = (T - 138)/(T0 - 138)

Roelands with A = ln(eta0/kappa), Houpert with S0 above zero, Barus with Z = 1, A = alpha/chi.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.roelands_1966 import (
    GLASS_TEMPERATURE,
    ROELANDS_KAPPA,
    ROELANDS_PRESSURE,
)


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
