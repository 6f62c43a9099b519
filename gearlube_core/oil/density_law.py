"""Interface of a density law: rho/rho0 and its first two pressure derivatives.

A law is a NamedTuple of floats with the kernel `density_ratio`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel


@by_class()
def density_ratio(law: Any, p: float) -> tuple[float, float, float]:
    """Return rho/rho0 and its first and second pressure derivative.

    Parameters
    ----------
    law
        Density law.
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
