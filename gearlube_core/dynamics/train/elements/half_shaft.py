"""Torsion spring and damper between two bodies that turn about one axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant import LubricantState

_STILL = 1e-9  # rad


class _HalfShaft(NamedTuple):
    stiffness: float  # [N.m/rad]
    damping: float  # [N.m s/rad]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        twist = s[at[2]] / self.stiffness
        s[at[2]] = twist if twist != 0.0 else _STILL

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        first, second, twist, lost = at
        rate = s[first + W] - s[second + W]
        torque = self.stiffness * s[twist] + self.damping * rate
        ds[first + RATE + RZ] -= torque
        ds[second + RATE + RZ] += torque
        ds[twist] = rate
        ds[lost] += self.damping * rate * rate

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        twist = s[at[2]]
        return 0.5 * self.stiffness * twist * twist

    @kernel
    def write(
        self,
        at: Any,
        memory: Array,
        s: Array,
        oil: LubricantState,
        out: Array,
        first: int,
    ) -> None:
        out[first] = self.stiffness * s[at[2]] + self.damping * (s[at[0] + W] - s[at[1] + W])


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfShaft(Element):
    """Torsion between two bodies of one axis, such as a differential and a wheel.

    Parameters
    ----------
    name, first, second : str
    stiffness : float
        [N.m/rad], 1 to 1e9.
    damping : float
        [N.m s/rad], 0 to 1e6.

    Examples
    --------
    >>> shaft = HalfShaft(name="left", first="differential", second="wheel", stiffness=8e3)
    >>> shaft.losses
    ('shaft_damping',)
    """

    name: str
    first: str
    second: str
    stiffness: Annotated[float, Number("N.m/rad", 1.0, 1e9, text="Torque per twist")]
    damping: Annotated[
        float, Number("N.m.s/rad", 0.0, 1e6, text="Torque per difference of the speeds")
    ] = 0.0
    kind: ClassVar = "half_shaft"
    interpreted: ClassVar = (Listed(_HalfShaft, (), 4),)
    on: ClassVar = ("first", "second")
    states: ClassVar = (
        Output("twist", "rad", "rotation of the first body against the second", 1e-3),
    )
    losses: ClassVar = ("shaft_damping",)
    outputs: ClassVar = (Output("torque", "N.m", "torque on the second body", 100.0),)

    def __post_init__(self) -> None:
        check_fields(self)

    def between_axes(self) -> tuple[str, str, complex]:
        """Return both bodies, which have one axis."""
        return self.first, self.second, 0.0j

    def numbers(self) -> _HalfShaft:
        """Return the constants of the kernels."""
        return _HalfShaft(float(self.stiffness), float(self.damping))
