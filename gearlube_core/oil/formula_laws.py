"""Laws of viscosity and shear of one's own in formulas of films and friction: kernels.

A formula has the law that its source prints: Barus in Evans and Johnson's traction, Roelands at the
ribs, Eyring in both. `Printed` stands for these, and costs nothing. An oil with another
law, of the package or of one's own, brings that law instead, see `film_laws`. Friction takes the
viscosity under the pressure of the contact from it; films take alpha, by default its slope at
ambient pressure. A shear law bounds the stress of the film by that of its isothermal flow. No
formula knows the density under pressure.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import ScaledViscosity, log_viscosity, rate_ratio
from gearlube_core.oil.roelands_1966 import (
    ROELANDS_LOG_VISCOSITY,
    ROELANDS_PRESSURE,
    roelands_viscosity,
)

_HALVINGS = 100  # of a bracket as wide as the Newtonian stress: 1e-30 of it is left


class Printed(NamedTuple):
    """The law that a formula's source prints, or the pressure factor of the oil."""

    @kernel
    def law_at(self, eta0: float, alpha: float) -> Printed:
        """Return the same."""
        return self

    @kernel
    def mean_slope(self, oil: Any, p: float) -> float:
        """Return alpha [1/Pa], by Barus, or that of the pressure factor p/(A + B p)."""
        if oil.modulus > 0.0:
            return 1.0 / (oil.modulus + oil.modulus_slope * p)
        return oil.alpha

    @kernel
    def log_viscosity_under(self, oil: Any, p: float) -> float:
        """Return ln eta by Roelands, or by the pressure factor."""
        if oil.modulus > 0.0:
            return math.log(oil.eta0) + p / (oil.modulus + oil.modulus_slope * p)
        Z = oil.alpha / (ROELANDS_PRESSURE * (math.log(oil.eta0) + ROELANDS_LOG_VISCOSITY))
        return math.log(roelands_viscosity(oil.eta0, Z, p))

    @kernel
    def bounded_stress(
        self, stress: float, unit: float, oil: Any, p: float, slip: float, film: float
    ) -> float:
        """Return the stress, at most Lambda p of an oil that has a Lambda."""
        if oil.eyring_slope > 0.0:
            return min(stress, oil.eyring_slope * p / unit)
        return stress

    @kernel
    def is_own(self) -> bool:
        """Return False."""
        return False


class OverAlpha(NamedTuple):
    """A viscosity law in which ln(eta/eta0) depends on alpha p alone."""

    law: Any
    alpha: float  # that it was made for [1/Pa]

    @kernel
    def law_at(self, eta0: float, alpha: float) -> ScaledViscosity:
        """Return the law of another alpha [1/Pa]."""
        return ScaledViscosity(self.law, alpha / self.alpha)


class OilLaws(NamedTuple):
    """Laws of an oil in formulas; made by `Lubricant.own_laws`."""

    viscosity: Any  # a law with the kernel `law_at`
    shear: Any


FORMULA_LAWS = OilLaws(Printed(), Printed())


@by_class()
def law_at(law: Any, eta0: float, alpha: float) -> Any:
    """Return the viscosity law of an oil that has eta0 [Pa s] and alpha [1/Pa] now."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _given_alpha(law: Any, alpha: float) -> float:
    return alpha


@by_class(_given_alpha)
def alpha_at(law: Any, alpha: float) -> float:
    """Return alpha of a viscosity law that has its own [1/Pa]; else that of the oil."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _own_mean_slope(law: Any, oil: Any, p: float) -> float:
    return log_viscosity(law, p, 1.0)[0] / p


@by_class(_own_mean_slope)
def mean_slope(law: Any, oil: Any, p: float) -> float:
    """Return ln(eta/eta0)/p [1/Pa] of a `LubricantState` under a pressure above zero [Pa]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _own_log_viscosity(law: Any, oil: Any, p: float) -> float:
    return math.log(oil.eta0) + log_viscosity(law, p, 1.0)[0]


@by_class(_own_log_viscosity)
def log_viscosity_under(law: Any, oil: Any, p: float) -> float:
    """Return ln eta, eta in Pa s, of a `LubricantState` under a pressure [Pa]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _own_bound(
    law: Any, stress: float, unit: float, oil: Any, p: float, slip: float, film: float
) -> float:
    if not (stress > 0.0 and slip > 0.0 and law.tau0 > 0.0):
        return stress
    rate = oil.eta0 * slip / (film * law.tau0)
    rate *= math.exp(min(mean_slope(oil.viscosity, oil, p) * p, 600.0))
    low, high = 0.0, rate  # G is never below 1
    for _ in range(_HALVINGS):
        t = 0.5 * (low + high)
        if t * rate_ratio(law, t * t)[0] < rate:
            low = t
        else:  # or beyond the largest stress of the law, where there is no number
            high = t
    return min(stress, high * law.tau0 / unit)


@by_class(_own_bound)
def bounded_stress(
    law: Any, stress: float, unit: float, oil: Any, p: float, slip: float, film: float
) -> float:
    """Return the shear stress of a film, at most that of its isothermal flow.

    tau <= t tau0,  t G(t^2) = eta |dU|/(h tau0)

    Parameters
    ----------
    law
        Shear law of the oil.
    stress, unit
        By a formula, and its unit [Pa].
    oil
        `LubricantState`.
    p, slip, film
        Mean pressure [Pa], magnitude of the sliding speed [m/s], film thickness [m].

    Notes
    -----
    Heat only weakens a film. A law that yields less than Eyring's before heat does is followed, as
    a limiting stress; where heat decides, the formula's film is Eyring's.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _own(law: Any) -> bool:
    return True


@by_class(_own)
def is_own(law: Any) -> bool:
    """Return whether a law is no printed one."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def has_own_law(oil: Any) -> bool:
    """Return whether a `LubricantState` has a law of its own: no film model knows it."""
    return is_own(oil.viscosity) or is_own(oil.shear)
