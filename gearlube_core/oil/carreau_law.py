"""Shear thinning by a power of the shear rate, Carreau 1972, as viscometers show it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.named_laws import ShearLaw

_STEPS = 30
_THERE = 1e-14  # of ln X
_SQUALANE = "squalane, from memory: not checked against the source"


class Carreau(NamedTuple):
    """tau = eta g (1 + X)^((n - 1)/2),  X = (eta g/tau0)^2, g the shear rate; floats, SI."""

    tau0: float  # critical stress [Pa]
    n: float  # exponent [-]

    @kernel
    def rate_ratio(self, q: float) -> tuple[float, float]:
        """Return G = (1 + X)^((1 - n)/2) and dG/dq, where X (1 + X)^(n - 1) = q.

        Notes
        -----
        Newton's method on ln X: the equation is concave, so it rises to the root from below.
        """
        X = 0.0
        if q > 0.0:
            y = max(math.log(q), math.log(q) / self.n)
            for _ in range(_STEPS):
                X = math.exp(y)
                short = math.log(q) - y + (1.0 - self.n) * math.log1p(X)
                step = short * (1.0 + X) / (1.0 + self.n * X)
                y += step
                if abs(step) <= _THERE * max(1.0, abs(y)):
                    break
            X = math.exp(y)
        G = math.exp(0.5 * (1.0 - self.n) * math.log1p(X))
        return G, 0.5 * (1.0 - self.n) * G * G * G / (1.0 + self.n * X)


@dataclass(frozen=True, kw_only=True)
class CarreauShear(ShearLaw, name="carreau"):
    """Carreau's law, whose critical stress hardly depends on pressure and temperature.

    Not the Eyring stress of the oil but the two numbers here say when it thins. With a limiting
    coefficient the stress is limited as well. Source: [carreau_1972]; the numbers of squalane by
    [bair_2002] are not checked against the source.
    """

    needs_stress = False
    critical_stress: Annotated[
        float, Number("Pa", 1e3, 1e9, text="Critical stress", source=_SQUALANE)
    ] = 6.94e6
    shear_exponent: Annotated[
        float, Number("1", 0.05, 1.0, text="Exponent n", source=_SQUALANE)
    ] = 0.463

    def __call__(self, tau0: float) -> Carreau:
        """Return the law for kernels."""
        return Carreau(float(self.critical_stress), float(self.shear_exponent))
