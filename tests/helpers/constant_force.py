"""An element from outside the package: a constant force on a body, with its work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, add_wrench
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class _Force(NamedTuple):
    x: float  # N
    y: float
    z: float
    arm: float  # m

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, lost = at
        v = body + RATE
        add_wrench(ds, body, self.arm, (self.x, self.y, self.z), (0.0, 0.0, 0.0))
        along_x, along_y = s[v] + self.arm * s[v + 4], s[v + 1] - self.arm * s[v + 3]
        ds[lost] -= self.x * along_x + self.y * along_y + self.z * s[v + 2]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstantForce(Element):
    """Force [N] at `arm` [m] along z from the centre of a body; its work is a negative loss."""

    name: str
    body: str
    force: tuple[float, float, float]
    arm: float = 0.0
    on: ClassVar = ("body",)
    losses: ClassVar = ("given",)

    def numbers(self) -> _Force:
        return _Force(*self.force, self.arm)
