"""Where a bearing sits on a body and in its housing: the motion between both, forces on both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import add_wrench
from gearlube_core.dynamics.train.part import GROUND, AxisPlace, Element
from gearlube_core.kernels.inlining import inside
from gearlube_core.number import Number

_ARM = Number("m", -10.0, 10.0, shown="mm")


class Seat(NamedTuple):
    """Place of a bearing; all floats."""

    arm: float  # along z from the centre of the body [m]
    x: float  # from the centre of the housing [m]
    y: float
    z: float


@inside
def between(p: Seat, body: int, housing: int, s: Array) -> tuple[float, float, float, float, float]:
    """Return x, y, z [m], rx, ry [rad] of a body relative to its housing at the bearing.

    `body` and `housing` are their first places, or those of their rates: then the rates.
    """
    u, g = body, housing
    return (
        s[u] + p.arm * s[u + 4] - (s[g] + p.z * s[g + 4] - p.y * s[g + 5]),
        s[u + 1] - p.arm * s[u + 3] - (s[g + 1] - p.z * s[g + 3] + p.x * s[g + 5]),
        s[u + 2] - (s[g + 2] + p.y * s[g + 3] - p.x * s[g + 4]),
        s[u + 3] - s[g + 3],
        s[u + 4] - s[g + 4],
    )


@inside
def add_to_both(
    ds: Array,
    p: Seat,
    body: int,
    housing: int,
    force: tuple[float, float, float],
    moment: tuple[float, float, float],
    on_cage: float,
    ratio: float,
) -> None:
    """Add force [N] and moment [N.m] of a bearing to its body, and the opposite to its housing.

    Of the moment about z on the cage the body takes the cage's `ratio`, the housing the rest, so
    that energy and moments balance where the cage turns with these shares of both speeds.
    """
    f_x, f_y, f_z = force
    m_x, m_y, m_z = moment
    add_wrench(ds, body, p.arm, force, (m_x, m_y, ratio * on_cage + m_z))
    turning = (1.0 - ratio) * on_cage - m_z + p.y * f_x - p.x * f_y
    reaction = -m_x - p.y * f_z, -m_y + p.x * f_z, turning
    add_wrench(ds, housing, p.z, (-f_x, -f_y, -f_z), reaction)


@dataclass(frozen=True, slots=True, kw_only=True)
class SeatedBearing(Element):
    """Common base of bearings between a body and a housing."""

    name: str
    body: str
    housing: str = GROUND
    arm: Annotated[
        float,
        _ARM._replace(text="Middle of the bearing, of tapered rollers where their forces meet the "
                      "axis, along z from the centre of the body"),
    ] = 0.0  # fmt: skip
    housing_x: Annotated[
        float, _ARM._replace(text="The same place along x from the centre or node of the housing")
    ] = 0.0
    housing_y: Annotated[float, _ARM._replace(text="Likewise along y")] = 0.0
    housing_z: Annotated[float, _ARM._replace(text="Likewise along z")] = 0.0
    on: ClassVar = ("body", "housing")
    angles: ClassVar = ("cage",)
    losses: ClassVar = ("bearing_damping", "bearing_torque")

    @property
    def seat(self) -> Seat:
        """Its place for kernels."""
        return Seat(
            float(self.arm), float(self.housing_x), float(self.housing_y), float(self.housing_z)
        )

    def between_axes(self) -> list[AxisPlace]:
        """Return where the axis of the body is in its housing."""
        there = complex(self.housing_x, self.housing_y)
        return [AxisPlace(self.housing, self.body, there)] if self.housing != GROUND else []
