"""A shear law of another package, in one file: a limiting stress.

Nothing else names it. To import this file is to register the law, so tests do it in a process of
their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.named_laws import ShearLaw


@dataclass(frozen=True, kw_only=True)
class GecimWinerLaw(ShearLaw, name="gecim_winer", text="tau = tau_l tanh(eta du/dz/tau_l)"):
    """tau = tau_l tanh(eta du/dz/tau_l), Gecim and Winer 1980."""

    limit: Annotated[float, Number("Pa", 1e5, 1e9, text="Limiting stress", source="a guess")] = 5e6

    def __call__(self, tau0: float) -> GecimWiner:
        """Return the law for kernels."""
        return GecimWiner(self.limit)


class GecimWiner(NamedTuple):
    """What the kernels take; all floats, SI."""

    tau0: float  # the limiting stress

    @kernel
    def rate_ratio(self, q):
        t = math.sqrt(q)
        if t < 0.01:
            return 1.0 + q / 3.0 + q * q / 5.0, 1.0 / 3.0 + 2.0 * q / 5.0
        if t >= 1.0:
            return math.inf, math.inf
        G = math.atanh(t) / t
        return G, 0.5 * (1.0 / (1.0 - q) - G) / q
