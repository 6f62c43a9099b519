"""Viscosity over pressure and temperature with the pressure factor of a class of base oils.

    ln(eta/eta0) = p/(A + B p),  A = (a1 + a2 T)/s,  B = b1 + b2 T

The scale s gives the oil its own alpha; the viscosity at ambient pressure is that of its line of
Walther.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.errors import ParameterError
from gearlube_core.number import Number
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.pressure_factor import PressureFactor, film_coefficient, modulus_at
from gearlube_core.oil.shape_law import ShapedViscosity, ShapeLaw

_MANN = "falling-body viscosities by Mann to 0.5 GPa [arana_2019 Table 3]"

_GPA, _HOT = 1e9, 353.15  # Pa, K
_LARGEST_B, _LEAST_GROWTH = 0.15, 1.0  # of B; of ln(eta/eta0) at 1 GPa
_FVA = "the formula that [wingertszahn_2023] quotes"


@dataclass(frozen=True, kw_only=True)
class ModulusLaw(ShapeLaw, name="modulus"):
    """exp[p/(A + B p)] with numbers of an oil's own, by default of a paraffinic mineral oil.

    `at` scales the factor to the alpha of an oil.
    """

    formulas_know = True
    a1: Annotated[float, Number("Pa", -2e8, 2e8, source=_MANN)] = -2.28e7
    a2: Annotated[float, Number("Pa/K", 1e4, 2e6, source=_MANN)] = 2.26e5
    b1: Annotated[float, Number("1", -0.5, 0.5, source=_MANN)] = -68.20e-3
    b2: Annotated[float, Number("1/K", -1e-3, 2e-3, source=_MANN)] = 27.68e-5
    growth: float = 1.0  # viscosity at 1 GPa over that of these numbers, alpha of films kept [-]

    def factor_of(self, oil: Lubricant) -> PressureFactor:
        """Return the factor that has the alpha of an oil.

        Raises
        ------
        ParameterError
            No scale gives a mean slope of this size.
        """
        T, alpha, to = oil.alpha_temperature, oil.alpha, oil.alpha_pressure
        A, B = modulus_at(self._own, float(T))
        wanted = 1.0 / alpha
        if oil.alpha_is == "film":
            wanted = A * film_coefficient(A, B) / alpha
        elif oil.alpha_is == "mean":
            wanted -= B * to
        if not wanted > 0.0:
            raise ParameterError(
                f"alpha as the mean slope to {1e-9 * to:g} GPa must be below "
                f"{1e9 / (B * to):.3g} 1/GPa with the viscosity law {self.name}, got "
                f"{1e9 * alpha:.4g} 1/GPa. Check alpha and its pressure, or take another law."
            )
        return _grown(self._own.scaled(A / wanted), self.growth)

    @property
    def _own(self) -> PressureFactor:
        return PressureFactor(float(self.a1), float(self.a2), float(self.b1), float(self.b2))

    def shape(self) -> PressureFactor:
        """Return the factor for kernels: that of the oil, else with these numbers."""
        return self._own if self.oil is None else self.factor_of(self.oil)

    def __call__(self, eta0: float, alpha: float) -> ShapedViscosity:
        """Return the law for kernels; an oil's own alpha counts, else `alpha` of films."""
        T, shape, scale = float(self.factor_temperature), self.shape(), 1.0
        if self.oil is None:
            scale = float(alpha / film_coefficient(*modulus_at(shape, T)))
        return ShapedViscosity(shape, scale, 1.0, self.line(), T, 1.0, 1.0)


def _grown(factor: PressureFactor, growth: float) -> PressureFactor:
    """Return the factor with a viscosity at 1 GPa times `growth` and the same alpha of films.

    Both hold at 80 degC, as far as a B from 0, or its own below 0, to 0.15 can: without B the
    viscosity is exponential in pressure, and with the same alpha it cannot grow more. In cold oil
    `growth` has more effect, as laws fitted to one oil differ more there.
    """
    if growth == 1.0:
        return factor
    from scipy.optimize import brentq  # takes a third of a second

    A, B = modulus_at(factor, _HOT)
    film = film_coefficient(A, B)
    wanted = max(_GPA / (A + B * _GPA) + math.log(growth), _LEAST_GROWTH)

    def slope_at(b: float) -> float:
        return float(film_coefficient(1.0, b)) / film  # A that has this alpha

    def excess(b: float) -> float:
        return slope_at(b) + b * _GPA - _GPA / wanted

    low, high = min(B, 0.0), max(B, _LARGEST_B)
    b = low if excess(low) > 0.0 else high if excess(high) < 0.0 else brentq(excess, low, high)
    by = slope_at(b) / A
    return PressureFactor(factor.a1 * by, factor.a2 * by, factor.b1 + b - B, factor.b2)


@dataclass(frozen=True, kw_only=True)
class NaphthenicModulus(ModulusLaw, name="modulus_naphthenic"):
    """That of a naphthenic mineral oil."""

    a1: Annotated[float, Number("Pa", -2e8, 2e8, source=_MANN)] = -7.23e7
    a2: Annotated[float, Number("Pa/K", 1e4, 2e6, source=_MANN)] = 3.48e5
    b1: Annotated[float, Number("1", -0.5, 0.5, source=_MANN)] = 5.00e-3
    b2: Annotated[float, Number("1/K", -1e-3, 2e-3, source=_MANN)] = -1.83e-5


@dataclass(frozen=True, kw_only=True)
class PolyalphaolefinModulus(ModulusLaw, name="modulus_pao"):
    """That of a polyalphaolefin."""

    a1: Annotated[float, Number("Pa", -2e8, 2e8, source=_MANN)] = -5.73e7
    a2: Annotated[float, Number("Pa/K", 1e4, 2e6, source=_MANN)] = 3.90e5
    b1: Annotated[float, Number("1", -0.5, 0.5, source=_MANN)] = -39.50e-3
    b2: Annotated[float, Number("1/K", -1e-3, 2e-3, source=_MANN)] = 23.54e-5


@dataclass(frozen=True, kw_only=True)
class Fva3Modulus(ModulusLaw, name="modulus_fva_3"):
    """That of the paraffinic reference oil FVA 3."""

    a1: Annotated[float, Number("Pa", -2e8, 2e8, source=_FVA)] = -4.8789e7
    a2: Annotated[float, Number("Pa/K", 1e4, 2e6, source=_FVA)] = 2.9862e5
    b1: Annotated[float, Number("1", -0.5, 0.5, source=_FVA)] = -77.840e-3
    b2: Annotated[float, Number("1/K", -1e-3, 2e-3, source=_FVA)] = 30.115e-5
