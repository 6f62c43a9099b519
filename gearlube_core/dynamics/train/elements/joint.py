"""Springs and dampers between two bodies: bearings on a housing, on a carrier, between shafts."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.elements.orbit import centre_of, check_place
from gearlube_core.dynamics.train.elements.spring_support import Springs
from gearlube_core.dynamics.train.elements.turned_moves import (
    Moves,
    add_turned,
    swept,
    turned_moves,
    turned_rates,
)
from gearlube_core.dynamics.train.gear_pair import worded
from gearlube_core.dynamics.train.part import GROUND, AxisPlace, Body, Element, Node
from gearlube_core.helical_geometry.gear_body import POSITION
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields, constants_of
from gearlube_core.oil.lubricant_state import LubricantState

_ERROR = Number("m", -1e-2, 1e-2, "20 um is 2e-5 m.", shown="um")
_ARM = POSITION._replace(shown="mm")


class _Bent(NamedTuple):
    """All in the joint's axes."""

    cos: float
    sin: float
    one: Moves  # of the first body
    two: Moves  # of the second one
    moved: Moves  # between both in the joint
    rate: Moves
    force: Moves  # on the first body in the joint


class JointKernels(NamedTuple):
    """Constants of a joint, and its kernels: see `element.Kernels`."""

    radius: float  # [m]
    azimuth: float  # [rad]
    arm_1: float  # [m]
    arm_2: float
    error_x: float  # [m]
    error_y: float
    K_xx: float  # [N/m]
    K_yy: float
    K_zz: float
    K_ax: float  # [N.m/rad]
    K_ay: float
    K_x_ay: float  # [N/rad]
    K_y_ax: float
    c_x: float  # [N s/m]
    c_y: float
    c_z: float
    c_ax: float  # [N.m s/rad]
    c_ay: float

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        b = _bent(self, at, s)
        f, arm_1, arm_2 = b.force, self.arm_1, self.arm_2
        one = Moves(f.x, f.y, f.z, f.rx - arm_1 * f.y, f.ry + arm_1 * f.x, 0.0)
        about_y = self.radius * f.z - arm_2 * f.x - f.ry
        two = Moves(-f.x, -f.y, -f.z, arm_2 * f.y - f.rx, about_y, -self.radius * f.y)
        add_turned(ds, at[0], one, b.cos, b.sin)
        add_turned(ds, at[1], two, b.cos, b.sin)
        # its axes turn with the second body, which moves them against the displacements
        ds[at[1] + RATE + RZ] -= swept(b.one, one) + swept(b.two, two)
        r = b.rate
        power = self.c_x * r.x * r.x + self.c_y * r.y * r.y + self.c_z * r.z * r.z
        ds[at[2]] += power + self.c_ax * r.rx * r.rx + self.c_ay * r.ry * r.ry

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        d = _bent(self, at, s).moved
        elastic = self.K_xx * d.x * d.x + self.K_yy * d.y * d.y + self.K_zz * d.z * d.z
        elastic += self.K_ax * d.rx * d.rx + self.K_ay * d.ry * d.ry
        return 0.5 * elastic + (self.K_x_ay * d.x * d.ry + self.K_y_ax * d.y * d.rx)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        force = _bent(self, at, s).force
        for i in range(5):
            out[first + i] = force[i]


@inside
def _between(self: JointKernels, one: Moves, two: Moves) -> Moves:
    return Moves(
        one.x + self.arm_1 * one.ry - two.x - self.arm_2 * two.ry,
        one.y - self.arm_1 * one.rx - two.y + self.arm_2 * two.rx,
        one.z - two.z + self.radius * two.ry,
        one.rx - two.rx,
        one.ry - two.ry,
        0.0,
    )


@kernel
def _bent(self: JointKernels, at: Any, s: Array) -> _Bent:
    angle, turning = self.azimuth + s[at[1] + RZ], s[at[1] + W]
    cos, sin = math.cos(angle), math.sin(angle)
    one, two = turned_moves(s, at[0], cos, sin), turned_moves(s, at[1], cos, sin)
    d = _between(self, one, two)
    d = Moves(d.x - self.error_x, d.y - self.error_y, d.z, d.rx, d.ry, 0.0)
    r = _between(
        self,
        turned_rates(s, at[0], one, cos, sin, turning),
        turned_rates(s, at[1], two, cos, sin, turning),
    )
    force = Moves(
        -(self.K_xx * d.x + self.K_x_ay * d.ry + self.c_x * r.x),
        -(self.K_yy * d.y + self.K_y_ax * d.rx + self.c_y * r.y),
        -(self.K_zz * d.z + self.c_z * r.z),
        -(self.K_ax * d.rx + self.K_y_ax * d.y + self.c_ax * r.rx),
        -(self.K_ay * d.ry + self.K_x_ay * d.x + self.c_ay * r.ry),
        0.0,
    )
    return _Bent(cos, sin, one, two, d, r, force)


@dataclass(frozen=True, kw_only=True)
class Joint(Springs, Element):
    """Linear springs and dampers between a point of one body and one of another.

    Its axes are fixed in the second body and turn with it: x at `azimuth`, z along the shafts.

    Parameters
    ----------
    name, first, second : str
        Of the joint, and of the bodies; `second` may be `ground`. The joint stands on the axis of
        the first one.
    radius, azimuth : float
        Of the joint on the second body: from its axis [m], and from x towards y [rad]. A first body
        off the axis orbits with the second one, see `Orbit`, unless that holds rz, as housings do.
    arm_1, arm_2 : float
        Of the joint along z, from the centre of each body [m].
    error_x, error_y : float
        Place of the joint on the second body, off its nominal one, in the joint's axes [m].
    K_xx, K_yy, K_zz, K_ax, K_ay : float
        Stiffness along and about the joint's axes [N/m], [N.m/rad].
    K_x_ay, K_y_ax : float
        Symmetric coupling of x with tilting about y, and of y with tilting about x [N/rad].
    c_x, c_y, c_z, c_ax, c_ay : float
        Dampers [N s/m], [N.m s/rad].

    Examples
    --------
    >>> pin = Joint(name="pin", first="planet", second="carrier", radius=0.1, K_xx=1e8, K_yy=1e8)
    >>> pin.numbers().radius
    0.1
    """

    name: str
    first: str
    second: str
    radius: Annotated[
        float, Number("m", 0.0, 10.0, text="Distance from the second body's axis", shown="mm")
    ] = 0.0
    azimuth: Annotated[
        float,
        Number(
            "rad", -2.0 * math.pi, 2.0 * math.pi, text="Azimuth of its x axis, x towards y",
            shown="deg",
        ),
    ] = 0.0  # fmt: skip
    arm_1: Annotated[float, worded(_ARM, "Along z, from the centre of the first body")] = 0.0
    arm_2: Annotated[float, worded(_ARM, "Along z, from the centre of the second body")] = 0.0
    error_x: Annotated[float, worded(_ERROR, "Place error on the second body along x")] = 0.0
    error_y: Annotated[float, worded(_ERROR, "Place error on the second body along y")] = 0.0
    kind: ClassVar = "joint"
    interpreted: ClassVar = (Listed(JointKernels, (), 3),)
    on: ClassVar = ("first", "second")
    losses: ClassVar = ("bearing_damping",)
    outputs: ClassVar = (
        *(Output(f"force.{c}", "N", f"force on the first body along {c}", 1e3) for c in "xyz"),
        *(Output(f"moment.{c}", "N.m", f"moment on the first body about {c}", 10.0) for c in "xy"),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        self.check_couplings()

    def fits(self, bodies: Sequence[Body], elements: Sequence[Element]) -> None:
        """Raise ParameterError where the first body is not carried at this place."""
        there = cmath.rect(self.radius, self.azimuth)
        second = next(one for one in bodies if one.name == self.second)
        stands = "rz" in second.held and not isinstance(second, Node)  # nodes turn with their body
        if stands and centre_of(elements, self.first, self.second) == 0.0:
            return
        check_place(elements, self.name, self.first, self.second, there)

    def between_axes(self) -> list[AxisPlace]:
        """Return both bodies, unless one is the ground."""
        there = cmath.rect(self.radius, self.azimuth)
        return [AxisPlace(self.second, self.first, there)] if self.second != GROUND else []

    def linear_among(self, bodies: Sequence[Body]) -> bool:
        """Return whether the second body stands, as housings do, and the joint in its place."""
        turning = [one.name for one in bodies if "rz" not in one.held]
        return self.error_x == self.error_y == 0.0 and self.second.partition(".")[0] not in turning

    def numbers(self) -> JointKernels:
        """Return the constants of the kernels."""
        return constants_of(JointKernels, self)
