"""Viscosity as a power of pressure, McEwen 1952."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.shape_law import ShapeLaw


class McEwen(NamedTuple):
    """ln(eta/eta0) = q ln(1 + x/q), x = alpha0 p with the slope alpha0 at ambient pressure."""

    q: float  # exponent [-]

    @kernel
    def growth(self, x: float, temperature: float, cold: float) -> tuple[float, float]:
        """Return ln(eta/eta0) and its slope by x."""
        part = 1.0 + cold * x / self.q
        return self.q * math.log(part), cold / part


@dataclass(frozen=True, kw_only=True)
class McEwenLaw(ShapeLaw, name="mcewen"):
    """eta = eta0 (1 + alpha0 p/q)^q.

    It grows less than exponentially at all pressures: good to the pressure to which q was fitted,
    0.4 GPa for the default, too low far above. Source: [mcewen_1952].
    """

    q: Annotated[
        float,
        Number(
            "1", 3.0, 100.0, "Larger is closer to Barus.", text="Exponent q of McEwen",
            source="own fit of a PAO of ISO VG 320 at 40 degC, to 0.4 GPa", factor=1.5,
        ),
    ] = 10.6  # fmt: skip

    def shape(self) -> McEwen:
        """Return the shape for kernels."""
        return McEwen(float(self.q))
