"""A viscosity law of another package, in one file: a power of pressure.

Nothing else names it. To import this file is to register the law, so tests do it in a process of
their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.named_laws import ViscosityLaw


@dataclass(frozen=True, kw_only=True)
class OwnPowerLaw(ViscosityLaw, name="own_power", text="eta = eta0 (1 + alpha p/q)^q"):
    """eta = eta0 (1 + alpha p/q)^q."""

    q: Annotated[
        float,
        Number("1", 1.0, 100.0, text="Exponent of the power", source="mineral oils", factor=1.2),
    ] = 16.0

    def __call__(self, eta0: float, alpha: float) -> OwnPower:
        """Return the law for kernels."""
        return OwnPower(alpha, self.q)


class OwnPower(NamedTuple):
    """What the kernels take; all floats, SI."""

    alpha: float
    q: float

    @kernel
    def log_viscosity(self, p, cooling):
        part = self.alpha * p / self.q
        if part < 0.0:
            return self.alpha * p, self.alpha
        return self.q * math.log1p(part), self.alpha / (1.0 + part)
