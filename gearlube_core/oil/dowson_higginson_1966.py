"""Density against pressure: the law of Dowson and Higginson."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.kernels.jit import kernel

_GAMMA = 2.266e-9  # 1/Pa, [jamali_2015 (3.5)]
_LAMBDA = 1.683e-9  # 1/Pa, the same


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
