"""A single tapered roller bearing anywhere on a shaft, which follows the shaft's tilt."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import Bearing, ShaftMotion, shaft_drag
from gearlube_core.bearings.losses.laws import PALMGREN, SKF
from gearlube_core.bearings.parameters import cage_torque
from gearlube_core.bearings.roller_loads import bearing_forces
from gearlube_core.bearings.shaft_expansion import bearing_energy
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.dynamics.train.element import RATE, W, add_wrench
from gearlube_core.dynamics.train.part import Element
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant import LubricantState

_DRAG = 0  # place in the memory: drag of the present step [N.m]
_LAWS = {"none": -1.0, "palmgren": float(PALMGREN), "skf_2013": float(SKF)}
TorqueLoss = Literal["none", "palmgren", "skf_2013"]


class _RollerBearing(NamedTuple):
    side: float  # +1: a displacement along +z loads it, -1: along -z
    arm: float  # of its middle along z from the centre of the body [m]
    law: float
    orders: float  # of the reference frequency of the hysteresis, over that of rotation
    least_frequency: float  # [Hz]
    bearings: TaperedRollerParameters

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        memory[_DRAG] = _drag(self, at, s, oil)
        return 0.0

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, cage, damping, drag = at
        m = _motion(self, at, s)
        f_1, f_2, f_a, lost = _forces(self, m, oil)
        turning = self.bearings.cage_ratio * cage_torque(m.r1, m.r2, f_1, f_2) - memory[_DRAG]
        add_wrench(ds, body, self.arm, (f_1, f_2, f_a), (0.0, 0.0, turning))
        ds[cage] = self.bearings.cage_ratio * m.speed
        ds[damping] += lost
        ds[drag] += memory[_DRAG] * m.speed

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        m = _motion(self, at, s)
        return bearing_energy(
            m.r1,
            m.r2,
            m.axial,
            m.cage_angle,
            m.speed,
            oil.eta0,
            oil.alpha,
            self.bearings,
            self.side,
        )

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        f_1, f_2, f_a, _ = _forces(self, _motion(self, at, s), oil)
        out[first], out[first + 1], out[first + 2] = f_1, f_2, f_a
        out[first + 3] = _drag(self, at, s, oil)


@kernel
def _motion(self: _RollerBearing, at: Any, s: Array) -> ShaftMotion:
    """Return the motion of the shaft in the middle of the bearing."""
    u, v = at[0], at[0] + RATE
    return ShaftMotion(
        s[u] + self.arm * s[u + 4],
        s[u + 1] - self.arm * s[u + 3],
        s[u + 2],
        s[v] + self.arm * s[v + 4],
        s[v + 1] - self.arm * s[v + 3],
        s[v + 2],
        s[at[1]],
        s[u + W],
    )


@kernel
def _forces(
    self: _RollerBearing, m: ShaftMotion, oil: LubricantState
) -> tuple[float, float, float, float]:
    frequency = max(self.orders * abs(m.speed) / (2.0 * math.pi), self.least_frequency)
    return bearing_forces(m, frequency, oil.eta0, oil.alpha, self.bearings, self.side)


@kernel
def _drag(self: _RollerBearing, at: Any, s: Array, oil: LubricantState) -> float:
    if self.law < 0.0:
        return 0.0
    m = _motion(self, at, s)
    f_1, f_2, f_a, _ = _forces(self, m, oil)
    radial = math.sqrt(f_1 * f_1 + f_2 * f_2)
    return shaft_drag(self.bearings, m.speed, abs(f_a), radial, int(self.law), oil)


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerBearing(Element):
    """One tapered roller bearing on a shaft along z; two of them carry a tilting shaft.

    Every roller is summed at every stage of a step, so that it costs more than `OpposedBearings`.

    Parameters
    ----------
    name, body : str
    bearing : TaperedRollerBearing
        Its preload holds with another one mounted against it.
    arm : float
        Where the lines of its roller forces meet the axis, along z from the centre of the body
        [m], -10 to 10.
    side : int
        +1 where a displacement of the shaft along +z loads it, -1 where one along -z does.
    torque_loss : {"none", "palmgren", "skf_2013"}
        Law of the drag, under the present loads.
    orders : float
        Cycles in a turn that the hysteresis of the rollers is taken at, 1 to 1000.
    least_frequency : float
        Lower clamp of that frequency [Hz], 1 to 1e4.

    Notes
    -----
    Rollers take the displacement of the shaft at `arm`; a tilt within the length of a roller is
    left out.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> bearing = mohammadpour_2015_axle().bearing
    >>> left = RollerBearing(name="left", body="shaft", bearing=bearing, arm=-0.05, side=-1)
    >>> left.numbers().side
    -1.0
    """

    name: str
    body: str
    bearing: Bearing
    arm: Annotated[
        float,
        Number("m", -10.0, 10.0, text="Where the roller forces meet the axis, along z from the "
               "centre of the body", shown="mm"),
    ] = 0.0  # fmt: skip
    side: Annotated[
        int,
        Number("1", -1, 1, text="1: a displacement along +z loads it, -1: one along -z"),
    ] = 1
    torque_loss: TorqueLoss = "none"
    orders: Annotated[
        float, Number("1", 1.0, 1000.0, text="Cycles in a turn for the hysteresis of the rollers")
    ] = 20.0
    least_frequency: Annotated[
        float, Number("Hz", 1.0, 1e4, text="Lower clamp of the frequency of these cycles")
    ] = 50.0
    kind: ClassVar = "roller_bearing"
    on: ClassVar = ("body",)
    angles: ClassVar = ("cage",)
    losses: ClassVar = ("bearing_damping", "bearing_torque")
    outputs: ClassVar = (
        *(Output(f"force.{c}", "N", f"force along {c} on the body", 1e3) for c in "xyz"),
        Output("torque", "N.m", "drag"),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        if self.side == 0:
            raise ParameterError(f"side of {self.name} must be 1 or -1, got 0.")
        if not isinstance(self.bearing.parameters(), TaperedRollerParameters):
            raise ParameterError(
                f"bearing of {self.name} must be a tapered roller bearing, got one of the type "
                f"{self.bearing.name}. OpposedBearings take any type."
            )

    def numbers(self) -> _RollerBearing:
        """Return the constants of the kernels."""
        bearings: Any = self.bearing.parameters()
        return _RollerBearing(
            float(self.side),
            float(self.arm),
            _LAWS[self.torque_loss],
            float(self.orders),
            float(self.least_frequency),
            bearings,
        )

    def memory(self) -> Array:
        """Return room for the drag of the present step."""
        return np.zeros(1)
