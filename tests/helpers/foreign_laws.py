"""Laws of viscosity and density written outside the package, and one oil that has both.

Kernels of films are compiled for every type of oil: tests of either law share this one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_oil_data import film_oil


class Tait(NamedTuple):
    """V/V0 = 1 - ln[1 + (1 + K') p/K0]/(1 + K').

    Source: Tait's equation as Bair 2007 writes it; K0 and K' of mineral oils.
    """

    K0: float  # [Pa]
    K1: float  # K' [-]

    @kernel
    def density_ratio(self, p: float) -> tuple[float, float, float]:
        q = max(p, 0.0)
        up = 1.0 if p >= 0.0 else 0.0
        inner = 1.0 + (1.0 + self.K1) * q / self.K0
        ratio = 1.0 / (1.0 - math.log(inner) / (1.0 + self.K1))
        slope = up * ratio * ratio / (self.K0 * inner)
        bend = slope * (2.0 * slope / ratio - (1.0 + self.K1) / (self.K0 * inner))
        return ratio, slope, bend


@kernel
def _glass(p: float) -> tuple[float, float, float, float]:
    # temperature of the glass [K] and free volume's expansion [-], with their slopes
    q = max(p, 0.0)
    up = 1.0 if p >= 0.0 else 0.0
    a, b = 1.0 + 0.719e-9 * q, 1.0 + 27.52e-9 * q
    T_g, T_slope = 190.0 + 189.0 * math.log(a), up * 189.0 * 0.719e-9 / a
    F, F_slope = 1.0 - 0.188 * math.log(b), -up * 0.188 * 27.52e-9 / b
    return T_g, T_slope, F, F_slope


class Yasutomi(NamedTuple):
    """log10(eta/eta_g) = -C1 X/(C2 + X), X = (T - Tg(p)) F(p); numbers of a traction oil's size.

    Source: Yasutomi, Bair and Winer 1984.
    """

    C1: float
    C2: float
    temperature: float  # of the oil [K]

    @kernel
    def log_viscosity(self, p: float, cooling: float) -> tuple[float, float]:
        T_g, T_slope, F, F_slope = _glass(p)
        T = cooling * self.temperature
        X = (T - T_g) * F
        T_0, _, F_0, _ = _glass(0.0)
        X_0 = (self.temperature - T_0) * F_0
        ten = math.log(10.0)
        value = ten * self.C1 * (X_0 / (self.C2 + X_0) - X / (self.C2 + X))
        X_slope = (T - T_g) * F_slope - T_slope * F
        return value, -ten * self.C1 * self.C2 / (self.C2 + X) ** 2 * X_slope

    @kernel
    def cooling_factor(self, temperature: float, oil_temperature: float) -> float:
        return temperature / oil_temperature

    @kernel
    def cooling_at(self, p: float, log_ratio: float) -> float:
        T_g, _, F, _ = _glass(p)
        T_0, _, F_0, _ = _glass(0.0)
        X_0 = (self.temperature - T_0) * F_0
        y = X_0 / (self.C2 + X_0) - log_ratio / (math.log(10.0) * self.C1)
        return (T_g + self.C2 * y / (1.0 - y) / F) / self.temperature

    @kernel
    def viscosity_decline(self, p: float, temperature: float, oil_temperature: float) -> float:
        T_g, _, F, _ = _glass(p)
        X = (temperature - T_g) * F
        return math.log(10.0) * self.C1 * self.C2 * F / (self.C2 + X) ** 2


T0 = 313.15  # K
TAIT = Tait(1.2e9, 10.5)
FOREIGN_OIL = film_oil(eta0=0.05, law=Yasutomi(16.04, 18.18, T0), density_law=TAIT, temperature=T0)
