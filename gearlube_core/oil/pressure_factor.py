"""Pressure factor of the viscosity of a measured oil, exp[p/(A + B p)]: kernels."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.kernels.jit import kernel

_POLE = 2e10  # Pa, the lowest pressure at which a cold oil's viscosity may grow without bound


class PressureFactor(NamedTuple):
    """Numbers of ln(eta/eta0) = p/(A + B p), A = a1 + a2 T, B = b1 + b2 T; all floats, SI.

    Notes
    -----
    ln(eta/eta0) tends to 1/B: above 1 GPa the viscosity is likely too low. Source:
    [arana_2019 (30)].
    """

    a1: float  # [Pa]
    a2: float  # [Pa/K]
    b1: float  # [-]
    b2: float  # [1/K]

    @kernel
    def growth(self, x: float, temperature: float, cold: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and its slope by the pressure x [Pa] at a temperature [K]."""
        A, B = modulus_at(self, temperature)
        below = A + B * x
        return x / below, A / (below * below)

    def scaled(self, scale: float) -> PressureFactor:
        """Return the factor that has at a pressure what this one has at `scale` times as much."""
        return self._replace(a1=self.a1 / scale, a2=self.a2 / scale)


NO_FACTOR = PressureFactor(0.0, 0.0, 0.0, 0.0)  # formulas then use their own law


@kernel
def modulus_at(factor: PressureFactor, temperature: float) -> tuple[float, float]:
    """Return A [Pa] and B [-] at a temperature [K]; 0, 0 of `NO_FACTOR`."""
    if factor.a2 == 0.0:
        return 0.0, 0.0
    A = factor.a1 + factor.a2 * temperature
    return A, max(factor.b1 + factor.b2 * temperature, -A / _POLE)


@kernel
def slope_turn(factor: PressureFactor, temperature: float, B: float) -> float:
    """Return dB/dT [1/K] at a temperature [K], where `modulus_at` gives B."""
    return factor.b2 if factor.b1 + factor.b2 * temperature >= B else 0.0


@kernel
def film_coefficient(A: float, B: float) -> float:
    """Return [integral of exp[-p/(A + B p)] over p]^-1, the pressure coefficient of films [1/Pa].

    1/alpha = A (1 + 2 B + 6 B^2 + 24 B^3 + 120 B^4)

    Notes
    -----
    Expansion for small B: within 1e-3 for B below 0.07. The integral itself ends before the
    exponent saturates, see `pressure_coefficient`.

    Examples
    --------
    >>> round(1e9 * film_coefficient(7.26e7, 0.0389), 2)  # 1/GPa, 13.77 at ambient pressure
    12.65
    """
    return 1.0 / (A * (1.0 + B * (2.0 + B * (6.0 + B * (24.0 + B * 120.0)))))
