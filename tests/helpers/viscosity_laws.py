"""Laws of viscosity that formulas take or refuse; imported in a process of its own."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.named_laws import ViscosityLaw

KAPPA, CHI = math.exp(-9.67), 5.1e-9  # Pa s, 1/Pa, of Roelands as Karagiannis 2012 rounds them


class OwnBarus(ViscosityLaw, name="own_barus", text="Barus by another package"):
    """eta = eta0 exp(alpha p)."""

    def __call__(self, eta0: float, alpha: float) -> Straight:
        """Return the law for kernels."""
        return Straight(alpha)


class Steeper(ViscosityLaw, name="steeper", text="a law with a slope of its own"):
    """eta = eta0 exp(30e-9 p), whatever alpha is."""

    def __call__(self, eta0: float, alpha: float) -> Straight:
        """Return the law for kernels."""
        return Straight(30e-9)


class OverEta0(ViscosityLaw, name="over_eta0", text="Roelands by another package"):
    """ln(eta/eta0) = A [(1 + CHI p)^Z - 1], A = ln(eta0/KAPPA), Z = alpha/(A CHI)."""

    def __call__(self, eta0: float, alpha: float) -> Power:
        """Return the law for kernels."""
        A = math.log(eta0 / KAPPA)
        return Power(A, alpha / (A * CHI))


class OverEta0Followed(ViscosityLaw, name="over_eta0_followed", text="the same with a kernel"):
    """The same with the kernel that makes it for another temperature."""

    def __call__(self, eta0: float, alpha: float) -> PowerFollowed:
        """Return the law for kernels."""
        return PowerFollowed(*OverEta0()(eta0, alpha))


class Straight(NamedTuple):
    slope: float

    @kernel
    def log_viscosity(self, p, cooling):
        return self.slope * p, self.slope


class Power(NamedTuple):
    A: float
    Z: float

    @kernel
    def log_viscosity(self, p, cooling):
        growth = (1.0 + CHI * p) ** self.Z
        return self.A * (growth - 1.0), self.A * self.Z * CHI * growth / (1.0 + CHI * p)


class PowerFollowed(NamedTuple):
    A: float
    Z: float

    @kernel
    def log_viscosity(self, p, cooling):
        growth = (1.0 + CHI * p) ** self.Z
        return self.A * (growth - 1.0), self.A * self.Z * CHI * growth / (1.0 + CHI * p)

    @kernel
    def law_at(self, eta0, alpha):
        A = math.log(eta0 / KAPPA)
        return PowerFollowed(A, alpha / (A * CHI))
