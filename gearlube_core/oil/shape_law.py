"""Viscosity as a shape over pressure, scaled to the alpha of an oil, on its line of Walther.

    ln(eta/eta0) = g(s p, T)

The scale s gives the oil its own alpha at one temperature, at others alpha is that of the shape.
A shape is a NamedTuple of floats with the kernel `growth`.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import log_viscosity
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.named_laws import ViscosityLaw
from gearlube_core.oil.pressure_coefficients import MEAN_PRESSURE, AlphaIs, slope_for
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY
from gearlube_core.oil.walther_1931 import walther_temperature, walther_viscosity

_POINTS = 48  # of the integral of films, which is smooth
_STEP = 1e-4  # of the temperature, for the slope of ln eta over it
_HALVINGS = 60  # of a range of temperatures
_RANGE = (0.4, 2.5)  # of T over that of the oil, where a temperature is looked for


@by_class()
def growth(shape: Any, x: float, temperature: float, cold: float) -> tuple[float, float]:
    """Return ln(eta/eta0) and its slope by x.

    Parameters
    ----------
    shape
    x
        Scale times pressure, from 0 [Pa, or 1 of a shape over alpha p].
    temperature
        [K].
    cold
        For a shape without a temperature of its own: alpha over that where alpha is given, at a
        constant Roelands exponent [-].
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


class OilLine(NamedTuple):
    """Viscosity of an oil at ambient pressure; all floats, SI."""

    walther_a: float  # [-]
    walther_b: float  # [-]; 0: one viscosity at all temperatures
    density: float  # [kg/m3]
    exponent: float  # ln eta0 + 9.67 at the temperature where alpha is given [-]


class ShapedViscosity(NamedTuple):
    """The law for kernels; all floats, SI."""

    shape: Any
    scale: float  # s
    films: float  # 1: alpha is that of films, 0: slope at ambient pressure
    line: OilLine
    temperature: float  # of the oil [K]
    cold: float  # as in `growth`, at that temperature [-]
    unit: float  # of pressure [Pa]

    @kernel
    def log_viscosity(self, p: float, cooling: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and its derivative by p; below ambient pressure the tangent there."""
        T, thicker, line = cooling * self.temperature, 0.0, self.line
        if cooling != 1.0 and line.walther_b > 0.0:
            now = walther_viscosity(line.walther_a, line.walther_b, T)[0]
            then = walther_viscosity(line.walther_a, line.walther_b, self.temperature)[0]
            thicker = math.log(now / then)
        s = self.scale * self.unit
        value, slope = growth(self.shape, s * max(p, 0.0), T, self.cold + thicker / line.exponent)
        return thicker + value + s * slope * min(p, 0.0), s * slope

    @kernel
    def law_at(self, eta0: float, alpha: float) -> ShapedViscosity:
        """Return the law at the temperature of a viscosity; it has its own alpha there."""
        line = self.line
        T = walther_temperature(line.walther_a, line.walther_b, eta0 / line.density)
        cold = (math.log(eta0) + ROELANDS_LOG_VISCOSITY) / line.exponent
        return ShapedViscosity(self.shape, self.scale, self.films, line, T, cold, self.unit)

    @kernel
    def alpha_at(self, alpha: float) -> float:
        """Return [integral of eta0/eta over pressure]^-1, or the slope at ambient pressure."""
        slope = log_viscosity(self, 0.0, 1.0)[1]
        if self.films == 0.0:
            return slope
        thin = 0.0
        for i in range(_POINTS):  # over p = [u/(1 - u)]^3/slope: the integrand is flat at both ends
            u = (i + 0.5) / _POINTS
            p = (u / (1.0 - u)) ** 3 / slope
            thin += 3.0 * p / (u * (1.0 - u)) * math.exp(-log_viscosity(self, p, 1.0)[0])
        return _POINTS / thin

    @kernel
    def cooling_factor(self, temperature: float, oil_temperature: float) -> float:
        """Return T over that of the oil."""
        return temperature / oil_temperature

    @kernel
    def cooling_at(self, p: float, log_ratio: float) -> float:
        """Return T over that of the oil at which ln(eta/eta0) is `log_ratio`."""
        if self.line.walther_b == 0.0:
            return 1.0
        low, high = _RANGE
        for _ in range(_HALVINGS):
            mid = 0.5 * (low + high)
            if log_viscosity(self, p, mid)[0] > log_ratio:
                low = mid
            else:
                high = mid
        return 0.5 * (low + high)

    @kernel
    def viscosity_decline(self, p: float, temperature: float, oil_temperature: float) -> float:
        """Return -d ln eta/dT [1/K], a difference over 1e-4 of the temperature."""
        if self.line.walther_b == 0.0:
            return 0.0
        cooling = temperature / oil_temperature
        more = log_viscosity(self, p, cooling * (1.0 - _STEP))[0]
        less = log_viscosity(self, p, cooling * (1.0 + _STEP))[0]
        return (more - less) / (2.0 * _STEP * temperature)

    def in_units(self, unit: float) -> ShapedViscosity:
        """Return the law with pressure in a unit [Pa]."""
        return self._replace(unit=self.unit * unit)


@cache
def _scaled(law: ShapedViscosity, alpha: float, alpha_is: AlphaIs, to: float) -> ShapedViscosity:
    """Return the law whose coefficient at its temperature is alpha [1/Pa]."""
    own = float(log_viscosity(law, 0.0, 1.0)[1])

    def sloped(slope: float) -> ShapedViscosity:
        return law._replace(scale=slope / own)

    return sloped(slope_for(sloped, alpha, alpha_is, to))


@dataclass(frozen=True, kw_only=True)
class ShapeLaw(ViscosityLaw):
    """A shape by name; an oil's own alpha counts, else that of films."""

    factor_temperature: float = 353.15  # [K], where there is no oil
    oil: Lubricant | None = None

    @abstractmethod
    def shape(self) -> Any:
        """Return the shape for kernels."""

    def at(self, oil: Lubricant, temperature: float) -> tuple[ViscosityLaw, float]:
        """Return the law of an oil at a temperature [K], and eta0 there [Pa s]."""
        law = replace(self, oil=oil, factor_temperature=temperature)
        return law, oil.dynamic_viscosity(temperature)

    def line(self) -> OilLine:
        """Return the viscosity of the oil at ambient pressure."""
        oil = self.oil
        if oil is None:
            return OilLine(0.0, 0.0, 1.0, 1.0)
        exponent = math.log(oil.dynamic_viscosity(oil.alpha_temperature)) + ROELANDS_LOG_VISCOSITY
        return OilLine(
            float(oil.walther_a), float(oil.walther_b), float(oil.density), float(exponent)
        )

    def __call__(self, eta0: float, alpha: float) -> ShapedViscosity:
        """Return the law for kernels."""
        oil, T = self.oil, float(self.factor_temperature)
        law = ShapedViscosity(self.shape(), 1.0, 1.0, self.line(), T, 1.0, 1.0)
        if oil is None:
            return _scaled(law, float(alpha), "film", MEAN_PRESSURE)
        at = law._replace(
            temperature=float(oil.alpha_temperature), films=float(oil.alpha_is != "slope")
        )
        made = _scaled(at, float(oil.alpha), oil.alpha_is, float(oil.alpha_pressure))
        here: ShapedViscosity = made.law_at(float(eta0), 0.0)
        return here
