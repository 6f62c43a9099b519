"""Interface of a viscosity law: ln(eta/eta0) and its pressure derivative.

A law is a NamedTuple of floats with the kernel `log_viscosity`. For thermal solutions it also
needs `cooling_factor`, `cooling_at` and `viscosity_decline`; without these it is isothermal.

The cooling factor is a number of the law's own choice that stands for the temperature: 1 at the
temperature of the oil. Houpert's is t^(-S0).
"""

from __future__ import annotations

from typing import Any, NamedTuple

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel


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
        Viscosity law.
    p
        Gauge pressure [Pa]; below zero too, where an iteration may look.
    cooling
        Cooling factor of the law [-]; 1: temperature of the oil.

    Returns
    -------
    tuple of float
        ln(eta/eta0) [-], zero at p = 0 and cooling 1, and d ln eta/dp [1/Pa].
    """
    raise NotImplementedError


@by_class(_one)
def cooling_factor(law: Any, temperature: float, oil_temperature: float) -> float:
    """Return the cooling factor [-] at a temperature, of an oil at `oil_temperature` [K]."""
    raise NotImplementedError


@by_class(_one_at)
def cooling_at(law: Any, p: float, log_ratio: float) -> float:
    """Return the cooling factor [-] at which ln(eta/eta0) is `log_ratio` at a pressure [Pa]."""
    raise NotImplementedError


@by_class(_zero)
def viscosity_decline(law: Any, p: float, temperature: float, oil_temperature: float) -> float:
    """Return -d ln eta/dT [1/K] at a pressure [Pa] and a temperature [K]."""
    raise NotImplementedError


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
