"""Density under pressure by the equation of state of Tait."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.named_laws import DensityLaw

_FIT = "own fit of a PAO of ISO VG 320: 20 to 100 degC, to 0.4 GPa, 0.17 kg/m3 rms"


class Tait(NamedTuple):
    """V/V0 = 1 - ln[1 + (1 + K0') p/K0]/(1 + K0'); all floats, SI."""

    K0: float  # bulk modulus at ambient pressure [Pa]
    K1: float  # K0', its slope with pressure [-]

    @kernel
    def density_ratio(self, p: float) -> tuple[float, float, float]:
        """Return rho/rho0 and its first and second pressure derivative.

        Notes
        -----
        Below ambient pressure rho0, with derivatives zero; at zero those from above. Measured to
        about 1 GPa; no pole below 1e3 K0. Source: [bair_2007].
        """
        steep = (1.0 + self.K1) / self.K0
        below = 1.0 + steep * max(p, 0.0)
        ratio = 1.0 / (1.0 - math.log(below) / (1.0 + self.K1))
        slope = ratio * ratio / (self.K0 * below) if p >= 0.0 else 0.0
        return ratio, slope, slope * (2.0 * slope / ratio - steep / below)


@dataclass(frozen=True, kw_only=True)
class TaitDensity(DensityLaw, name="tait"):
    """V/V0 = 1 - ln[1 + (1 + K0') p/K0]/(1 + K0'), K0 = K00 exp(-bK T)."""

    K00: Annotated[float, Number("Pa", 1e9, 1e11, text="Bulk modulus at 0 K", source=_FIT)] = (
        6.939e9
    )
    bK: Annotated[float, Number("1/K", 0.0, 2e-2, text="Its decline", source=_FIT)] = 5.018e-3
    K1: Annotated[float, Number("1", 5.0, 20.0, text="Slope K0'", source=_FIT)] = 9.175
    density_temperature: float = 353.15  # of the oil [K]

    def at(self, temperature: float) -> TaitDensity:
        """Return the law at a temperature [K]."""
        return replace(self, density_temperature=temperature)

    def __call__(self) -> Tait:
        """Return the law for kernels."""
        return Tait(float(self.K00 * math.exp(-self.bK * self.density_temperature)), float(self.K1))
