"""Viscosity by the distance from the glass transition, Yasutomi's law as improved by Bair."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.pressure_coefficients import MEAN_PRESSURE
from gearlube_core.oil.shape_law import ShapedViscosity, ShapeLaw

_LN10 = math.log(10.0)
_FIT = "own fit of a PAO of ISO VG 320: 20 to 100 degC, to 0.4 GPa, 1.7 % rms"


class Yasutomi(NamedTuple):
    """log10(eta/eta_g) = -C1 X/(C2 + X), X = (T - Tg) F; all floats, SI.

    Tg = Tg0 + A1 ln(1 + A2 p),  F = (1 + b1 p)^b2

    Notes
    -----
    The form has a pole at X = -C2. In the glass, X below 0, its tangent at Tg is taken instead.
    """

    Tg0: float  # [K]
    A1: float  # [K]
    A2: float  # [1/Pa]
    b1: float  # [1/Pa]
    b2: float  # [-]
    C1: float  # [-]
    C2: float  # [K]

    @kernel
    def growth(self, x: float, temperature: float, cold: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and its slope by x, the pressure [Pa]."""
        above = temperature - self.Tg0 - self.A1 * math.log1p(self.A2 * x)
        F = (1.0 + self.b1 * x) ** self.b2
        X, X0 = above * F, temperature - self.Tg0
        X_slope = above * F * self.b2 * self.b1 / (1.0 + self.b1 * x)
        X_slope -= F * self.A1 * self.A2 / (1.0 + self.A2 * x)
        below, below0 = self.C2 + max(X, 0.0), self.C2 + max(X0, 0.0)
        value = _LN10 * self.C1 * (X0 / below0 - X / below)
        return value, -_LN10 * self.C1 * self.C2 / (below * below) * X_slope


@dataclass(frozen=True, kw_only=True)
class YasutomiLaw(ShapeLaw, name="yasutomi"):
    """The improved law of Yasutomi: less than exponential in thin oil, more towards the glass.

    Source: [bair_2013].
    """

    Tg0: Annotated[
        float, Number("K", 100.0, 300.0, text="Glass temperature without pressure", source=_FIT)
    ] = 206.09
    A1: Annotated[
        float, Number("K", 10.0, 500.0, text="Rise of the glass temperature", source=_FIT)
    ] = 81.565
    A2: Annotated[
        float, Number("1/Pa", 1e-10, 1e-8, text="Pressure of that rise", source=_FIT, factor=1.35)
    ] = 1.1041e-9
    b1: Annotated[
        float, Number("1/Pa", 1e-10, 1e-7, text="Pressure of the expansion", source=_FIT)
    ] = 8.7961e-9
    b2: Annotated[
        float, Number("1", -1.0, 0.0, text="Exponent of the expansion", source=_FIT)
    ] = -0.19905
    C1: Annotated[float, Number("1", 5.0, 30.0, text="Number C1", source=_FIT)] = 15.5505
    C2: Annotated[float, Number("K", 5.0, 100.0, text="Number C2", source=_FIT)] = 25.363

    def shape(self) -> Yasutomi:
        """Return the shape for kernels."""
        return Yasutomi(*(self.numbers[name] for name in Yasutomi._fields))

    def __call__(self, eta0: float, alpha: float) -> ShapedViscosity:
        """Return the law for kernels.

        Raises
        ------
        ParameterError
            The oil is a glass below 0.2 GPa.
        """
        made, T = super().__call__(eta0, alpha), float(self.factor_temperature)
        glass = self.Tg0 + self.A1 * math.log1p(self.A2 * made.scale * MEAN_PRESSURE)
        if glass < T:
            return made
        raise ParameterError(
            f"Oil with the viscosity law {self.name} must be liquid to "
            f"{1e-9 * MEAN_PRESSURE:g} GPa, got a glass temperature of {glass:.4g} K at {T:.4g} K. "
            "Raise the lowest temperature of the oil, correct Tg0 and A1, or take another law."
        )
