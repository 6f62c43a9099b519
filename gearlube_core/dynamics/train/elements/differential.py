"""Differential: a case that turns as the mean of two sides, with friction between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, constants_of
from gearlube_core.oil.lubricant_state import LubricantState

_STILL = 1e-9  # rad


class _Split(NamedTuple):
    rate: float  # speed of the case over the mean of both sides [rad/s]
    torque: float  # on both sides together, without friction [N.m]
    slip: float  # speed of the left side over the right one [rad/s]
    friction: float  # from the left side to the right one [N.m]


class DifferentialKernels(NamedTuple):
    """Constants of a differential, and its kernels: see `element.Kernels`."""

    stiffness: float  # [N.m/rad]
    damping: float  # [N.m s/rad]
    preload: float  # [N.m]
    locking: float
    slip_speed: float  # [rad/s]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        twist = s[at[3]] / self.stiffness
        s[at[3]] = twist if twist != 0.0 else _STILL

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        case, left, right, twist, lost, damped = at
        one = _split(self, at, s)
        ds[case + RATE + RZ] -= one.torque
        ds[left + RATE + RZ] += 0.5 * (one.torque - one.friction)
        ds[right + RATE + RZ] += 0.5 * (one.torque + one.friction)
        ds[twist] = one.rate
        ds[lost] += 0.5 * one.friction * one.slip
        ds[damped] += self.damping * one.rate * one.rate

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        twist = s[at[3]]
        return 0.5 * self.stiffness * twist * twist

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`; friction below the slip speed is a stiff damper."""
        most = self.preload + self.locking * abs(_split(self, at, s).torque)
        return 0.5 * most / self.slip_speed * memory[0]

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        one = _split(self, at, s)
        out[first] = 0.5 * (one.torque - one.friction)
        out[first + 1] = 0.5 * (one.torque + one.friction)
        out[first + 2] = one.slip
        out[first + 3] = 0.5 * one.friction * one.slip

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        fits = memory.size == 1 and self.slip_speed > 0.0 and self.stiffness > 0.0
        return 1.0 if fits else 0.0


@inside
def _split(self: DifferentialKernels, at: Any, s: Array) -> _Split:
    left, right = s[at[1] + W], s[at[2] + W]
    rate = s[at[0] + W] - 0.5 * (left + right)
    torque = self.stiffness * s[at[3]] + self.damping * rate
    most = self.preload + self.locking * abs(torque)
    return _Split(rate, torque, left - right, most * math.tanh((left - right) / self.slip_speed))


@dataclass(frozen=True, slots=True, kw_only=True)
class Differential(Element):
    """Differential whose case turns as the mean of both sides and shares its torque equally.

    w_case = (w_left + w_right) / 2 + d(twist)/dt,  T = stiffness twist + damping d(twist)/dt

    T_left = (T - T_f) / 2,  T_right = (T + T_f) / 2

    T_f = (preload + locking |T|) tanh((w_left - w_right) / slip_speed)

    The slower side has more torque. Two sides that slip have torques in the ratio (1 + S)/(1 - S),
    the torque bias ratio, with S = T_f / T. The power 0.5 T_f (w_left - w_right) is lost.

    Parameters
    ----------
    name, case, left, right : str
        Of the differential, and of the bodies of the case and of both sides: all about one axis.
    stiffness : float
        Torque of the case per twist of the case against the mean of the sides: pinion shafts and
        bevel teeth [N.m/rad].
    damping : float
        [N.m s/rad]
    preload : float
        Friction without load, as of preloaded clutches [N.m].
    locking : float
        Friction over the torque of the case, S: 0.05 to 0.1 of open ones, below 1 [-].
    slip_speed : float
        Difference of the speeds at which 76 % of the friction act [rad/s].

    Notes
    -----
    Friction is a function of the speeds: sides that should stick creep. While it is below the slip
    speed it damps by 0.5 T_f / slip_speed, for which steps of rigid sides are made short enough;
    sides that are nodes of shafts do not ask for that.

    Examples
    --------
    >>> axle = Differential(name="differential", case="case", left="left", right="right",
    ...                     locking=0.5)
    >>> axle.bias_ratio
    3.0
    """

    name: str
    case: str
    left: str
    right: str
    stiffness: Annotated[
        float, Number("N.m/rad", 1.0, 1e9, text="Torque of the case per twist against both sides")
    ] = 1e6
    damping: Annotated[
        float, Number("N.m.s/rad", 0.0, 1e6, text="Torque of the case per rate of this twist")
    ] = 0.0
    preload: Annotated[float, Number("N.m", 0.0, 1e6, text="Friction without load")] = 0.0
    locking: Annotated[
        float, Number("1", 0.0, 0.95, text="Friction over the torque of the case")
    ] = 0.0
    slip_speed: Annotated[
        float,
        Number("rad/s", 1e-3, 100.0, text="Difference of the speeds at which 76 % of it act"),
    ] = 0.2
    kind: ClassVar = "differential"
    interpreted: ClassVar = (Listed(DifferentialKernels, (), 6),)
    on: ClassVar = ("case", "left", "right")
    states: ClassVar = (
        Output("twist", "rad", "rotation of the case against the mean of both sides", 1e-3),
    )
    losses: ClassVar = ("differential", "shaft_damping")
    outputs: ClassVar = (
        Output("torque.left", "N.m", "torque on the left side", 100.0),
        Output("torque.right", "N.m", "torque on the right side", 100.0),
        Output("slip", "rad/s", "speed of the left side over the right one"),
        Output("friction", "W", "power lost in friction now", 10.0),
    )

    @property
    def bias_ratio(self) -> float:
        """Torque of the slower side over that of the faster one, without preload [-]."""
        return (1.0 + self.locking) / (1.0 - self.locking)

    def numbers(self) -> DifferentialKernels:
        """Return the constants of the kernels."""
        return constants_of(DifferentialKernels, self)

    def memory_among(self, bodies: Sequence[Body]) -> Array:
        """Return how easily the sides turn against each other, 0 for nodes [1/(kg m2)]."""
        sides = [one for one in bodies if one.name in (self.left, self.right)]
        return np.array([sum(float(one.mobility[RZ]) for one in sides)])
