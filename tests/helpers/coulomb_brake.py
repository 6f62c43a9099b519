"""An element from outside the package: a brake with Coulomb friction between a body and ground."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, check_fields
from gearlube_core.oil.lubricant_state import LubricantState


class _Brake(NamedTuple):
    torque: float  # N.m
    speed: float  # rad/s, below which the torque falls to zero

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, lost = at
        w = s[body + W]
        torque = self.torque * math.tanh(w / self.speed)
        ds[body + RATE + RZ] -= torque
        ds[lost] += torque * w


@dataclass(frozen=True, slots=True, kw_only=True)
class CoulombBrake(Element):
    """Brake whose torque [N.m] does not depend on the speed."""

    name: str
    body: str
    torque: Annotated[float, Number("N.m", 0.0, 1e5)]
    speed: Annotated[float, Number("rad/s", 1e-3, 10.0)] = 0.1
    kind: ClassVar = "coulomb_brake"
    on: ClassVar = ("body",)
    losses: ClassVar = ("brake",)

    def __post_init__(self) -> None:
        check_fields(self)

    def numbers(self) -> _Brake:
        return _Brake(float(self.torque), float(self.speed))
