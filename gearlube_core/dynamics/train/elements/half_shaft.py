"""Torsion spring and damper between two bodies that turn about one axis, with play in a spline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.part import AxisPlace, Body, Element
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, constants_of
from gearlube_core.oil.lubricant_state import LubricantState

_STILL = 1e-9  # rad
_TOUCH = 1e-6  # rad, deflection at which a spline with play surely touches


class _HalfShaft(NamedTuple):
    stiffness: float  # [N.m/rad]
    damping: float  # [N.m s/rad]
    backlash: float  # [rad]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        twist = s[at[2]] / self.stiffness
        if twist < 0.0:
            twist -= self.backlash
        s[at[2]] = twist if twist != 0.0 else _STILL

    @kernel
    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        if self.backlash > 0.0 and abs(_deflection(self, s[at[2]])) < _TOUCH:
            s[at[2]] = _TOUCH

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        first, second, twist, lost = at
        rate = s[first + W] - s[second + W]
        torque = _torque(self, s[twist], rate)
        ds[first + RATE + RZ] -= torque
        ds[second + RATE + RZ] += torque
        ds[twist] = rate
        if self.backlash == 0.0:
            ds[lost] += self.damping * rate * rate
        else:
            ds[lost] += (torque - self.stiffness * _deflection(self, s[twist])) * rate

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        twist = _deflection(self, s[at[2]])
        return 0.5 * self.stiffness * twist * twist

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        out[first] = _torque(self, s[at[2]], s[at[0] + W] - s[at[1] + W])


@inside
def _deflection(self: _HalfShaft, twist: float) -> float:
    """Return the twist [rad] without the play, which reaches from 0 to minus the backlash."""
    if self.backlash == 0.0 or twist > 0.0:
        return twist
    return min(twist + self.backlash, 0.0)


@inside
def _torque(self: _HalfShaft, twist: float, rate: float) -> float:
    deflection = _deflection(self, twist)
    torque = self.stiffness * deflection + self.damping * rate
    if self.backlash == 0.0:
        return torque
    if deflection == 0.0:
        return 0.0
    return max(torque, 0.0) if deflection > 0.0 else min(torque, 0.0)  # flanks do not pull


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfShaft(Element):
    """Torsion between two bodies of one axis, such as a differential and a wheel, or a spline.

    Parameters
    ----------
    name, first, second : str
    stiffness : float
        [N.m/rad], 1 to 1e12.
    damping : float
        [N.m s/rad], 0 to 1e9.
    backlash : float
        Play of the splines on the way, the whole gap; in it neither spring nor damper act [rad].
        At the start those flanks touch which turn the second body about +z, unless the torque is
        the other way.

    Examples
    --------
    >>> shaft = HalfShaft(name="left", first="differential", second="wheel", stiffness=8e3)
    >>> shaft.losses
    ('shaft_damping',)
    """

    name: str
    first: str
    second: str
    stiffness: Annotated[float, Number("N.m/rad", 1.0, 1e12, text="Torque per twist")]
    damping: Annotated[
        float, Number("N.m.s/rad", 0.0, 1e9, text="Torque per difference of the speeds")
    ] = 0.0
    backlash: Annotated[
        float, Number("rad", 0.0, 0.5, text="Play of its splines, the whole gap", shown="deg")
    ] = 0.0
    kind: ClassVar = "half_shaft"
    interpreted: ClassVar = (Listed(_HalfShaft, (), 4),)
    on: ClassVar = ("first", "second")
    states: ClassVar = (
        Output("twist", "rad", "rotation of the first body against the second", 1e-3),
    )
    losses: ClassVar = ("shaft_damping",)
    outputs: ClassVar = (Output("torque", "N.m", "torque on the second body", 100.0),)

    def between_axes(self) -> list[AxisPlace]:
        """Return both bodies, which have one axis."""
        return [AxisPlace(self.first, self.second, 0.0j)]

    def linear_among(self, bodies: Sequence[Body]) -> bool:
        """Return whether there is no play."""
        return self.backlash == 0.0

    def numbers(self) -> _HalfShaft:
        """Return the constants of the kernels."""
        return constants_of(_HalfShaft, self)
