"""A rolling bearing between a body and its housing, which follows both in five directions."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.catalogue import drag_torque
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.ring_loads import (
    RingLoads,
    RingMotion,
    Rings,
    moment_on_cage,
    ring_loads,
    ring_pressure,
    write_of_rings,
)
from gearlube_core.contact.solid import YOUNGS_MODULUS
from gearlube_core.dynamics.ranges import HERTZ_LIMIT, Range
from gearlube_core.dynamics.train.element import RATE, W
from gearlube_core.dynamics.train.elements.opposed_bearings import FORCES
from gearlube_core.dynamics.train.elements.seat import Seat, SeatedBearing, add_to_both, between
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.checked_numbers import all_finite, is_whole
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant_state import LubricantState

# places in the memory: drag of the present step [N.m], spring of a search of the rest [N/m], gaps
# of the laminae of a roller
_DRAG, _SPRING, _GAPS = range(3)
_MOMENT = RingLoads._fields.index("m_x")
_STEPS_PER_PASS = 16.0  # integrator steps from one element to the next, at least
N_ELEMENTS = Number("1", 3, ROLLERS_MAX)
DIAMETER = Number("m", 1e-3, 2.0, "11.5 mm is 0.0115 m.", shown="mm")
OUTPUTS = (
    *FORCES,
    *(Output(f"moment.{c}", "N.m", f"moment about {c} on the body", 10.0) for c in "xy"),
    Output("torque", "N.m", "drag"),
    Output("load_max", "N", "largest load of an element", 1e3),
    Output("loaded", "1", "number of elements under load", 10.0),
    Output("pressure", "Pa", "largest Hertz pressure on the inner ring", 1e9, "GPa"),
    Output("tilt", "rad", "tilt of the body in its housing", 1e-4),
)


class RingBearingNumbers(NamedTuple):
    """Constants of a bearing in a train, and its kernels: see `element.Kernels`."""

    seat: Seat
    damping_time: float  # [s]
    mean_diameter: float  # of the drag [m]
    axial_factor: float  # load of the drag over the axial load [-]
    f0: float  # viscous factor of the drag [-], 0: off
    f1: float  # load factor of the drag [-], 0: off
    rings: Rings

    @kernel
    def ease(self, at: Any, memory: Array, s: Array, oil: LubricantState, share: float) -> float:
        """See `Kernels.ease`."""
        memory[_SPRING] = share * self.rings.spring
        return 1.0

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.each_step`."""
        memory[_DRAG] = 0.0
        if self.f0 > 0.0 or self.f1 > 0.0:
            found = ring_loads(self.rings, _motion(self, at, s), 0.0, _gaps(memory))
            radial, speed = math.hypot(found.f_x, found.f_y), s[at[0] + W] - s[at[1] + W]
            memory[_DRAG] = drag_torque(speed, found.f_z, radial, oil.nu, self)  # type: ignore[arg-type]
        return 0.0

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        body, housing, cage, damping, drag = at
        m, found = _loads(self, at, memory, s)
        on_cage, ratio, torque = moment_on_cage(m, found), self.rings.cage_ratio, memory[_DRAG]
        force, moment = (found.f_x, found.f_y, found.f_z), (found.m_x, found.m_y, -torque)
        add_to_both(ds, self.seat, body, housing, force, moment, on_cage, ratio)
        ds[cage] = m.cage_speed
        ds[damping] += found.lost
        ds[drag] += torque * (s[body + W] - s[housing + W])

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        _, found = _loads(self, at, memory, s)
        return found.energy

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`: the bearing is as stiff as its elements stand."""
        passing = abs(s[at[0] + W] - s[at[1] + W]) * (1.0 - self.rings.cage_ratio)
        return _STEPS_PER_PASS * self.rings.n_elements * passing / (2.0 * math.pi)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        m, found = _loads(self, at, memory, s)
        out[first], out[first + 1], out[first + 2] = found.f_x, found.f_y, found.f_z
        out[first + 3], out[first + 4], out[first + 5] = found.m_x, found.m_y, memory[_DRAG]
        out[first + 6], out[first + 7] = found.largest, found.loaded
        out[first + 8] = ring_pressure(self.rings, found)
        out[first + 9] = math.hypot(m.rx, m.ry)
        write_of_rings(self.rings, found, out, first + 10)

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        fits = memory.size >= _GAPS and is_whole(self.rings.n_elements, 3.0, float(ROLLERS_MAX))
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@kernel
def _gaps(memory: Array) -> Array:
    return part(memory, _GAPS, memory.size - _GAPS)


@kernel
def _motion(self: RingBearingNumbers, at: Any, s: Array) -> RingMotion:
    """Return the motion of the body in its housing in the middle of the bearing."""
    u, g, ratio = at[0], at[1], self.rings.cage_ratio
    x, y, z, rx, ry = between(self.seat, u, g, s)
    v_x, v_y, v_z, w_x, w_y = between(self.seat, u + RATE, g + RATE, s)
    turning = ratio * s[u + W] + (1.0 - ratio) * s[g + W]
    return RingMotion(x, y, z, rx, ry, v_x, v_y, v_z, w_x, w_y, s[at[2]], turning)


@kernel
def _loads(
    self: RingBearingNumbers, at: Any, memory: Array, s: Array
) -> tuple[RingMotion, RingLoads]:
    m, k = _motion(self, at, s), memory[_SPRING]
    found = ring_loads(self.rings, m, self.damping_time, _gaps(memory))
    if k > 0.0:
        found = RingLoads(
            found.f_x - k * m.x, found.f_y - k * m.y, found.f_z - k * m.z, *found[_MOMENT:]
        )
    return m, found


@dataclass(frozen=True, slots=True, kw_only=True)
class RingBearing(SeatedBearing):
    """Common base of ball and cylindrical roller bearings of a train."""

    pitch_diameter: Annotated[
        float, DIAMETER._replace(text="Diameter of the circle of the elements' centres")
    ]
    clearance: Annotated[
        float,
        Number("m", -1e-4, 1e-3, "10 um is 1e-5 m.", shown="um",
               text="Internal radial clearance of the mounted bearing, of the diameter"),
    ] = 0.0  # fmt: skip
    damping_time: Annotated[
        float,
        Number("s", 0.0, 1e-3, "10 us is 1e-5 s.", shown="us",
               text="Damper over stiffness of every contact; 2.5 to 25 us are usual"),
    ] = 0.0  # fmt: skip
    f0: Annotated[
        float,
        Number("1", 0.0, 100.0, text="Viscous factor of the drag by Palmgren: some 2 for a ball "
               "bearing in an oil bath, 2 to 3 for cylindrical rollers; 0: none"),
    ]  # fmt: skip
    f1: Annotated[
        float,
        Number("1", 0.0, 0.1, text="Load factor of the drag by Palmgren: some 0.0002 to 0.0004 "
               "for either; 0: none"),
    ]  # fmt: skip
    axial_factor: Annotated[
        float,
        Number("1", 0.0, 10.0, text="Y of the load of the drag, which is the larger of Y F_a and "
               "F_r: 3 for deep groove bearings, 0.9/tan(contact angle) for others"),
    ] = 0.0  # fmt: skip
    youngs_modulus: Annotated[
        float, YOUNGS_MODULUS._replace(text="Young's modulus of rings and elements", shown="GPa")
    ] = 2.1e11
    poisson_ratio: Annotated[
        float, Number("1", 0.0, 0.5, text="Poisson's ratio of rings and elements")
    ] = 0.3
    outputs: ClassVar = OUTPUTS

    @abstractmethod
    def rings(self) -> tuple[Rings, Array]:
        """Return the numbers between both rings, and the gaps of laminae [m], empty for balls."""

    @property
    def contact_modulus(self) -> float:
        """E* of two elements of this material [Pa]."""
        return 0.5 * self.youngs_modulus / (1.0 - self.poisson_ratio**2)

    def numbers(self) -> RingBearingNumbers:
        """Return the constants of the kernels."""
        return RingBearingNumbers(
            self.seat,
            float(self.damping_time),
            float(self.pitch_diameter),
            float(self.axial_factor),
            float(self.f0),
            float(self.f1),
            self.rings()[0],
        )

    def memory(self) -> Array:
        """Return room for the drag of this step and the spring of a search, then the gaps."""
        return np.concatenate([np.zeros(_GAPS), self.rings()[1]])

    def variants(self) -> tuple[type, ...]:
        """Return the class of the numbers between both rings."""
        return (type(self.rings()[0]),)

    def ranges(self) -> tuple[Range, ...]:
        """Return the range of the pressure."""
        beyond = "Contacts of steel do not stay elastic there; take a larger bearing."
        what = "largest Hertz pressure on the inner ring"
        return (Range("pressure", what, 0.0, HERTZ_LIMIT, "Pa", beyond),)

    def check_elements(self, count: int, diameter: float) -> None:
        """Raise ParameterError unless numbers are as declared and the elements have room."""
        check_fields(self)
        if count != int(count):
            raise ParameterError(
                f"{self.name} must have a whole number of elements, got {count:g}."
            )
        most = int(math.pi / math.asin(min(1.0, diameter / self.pitch_diameter)))
        if count > most or diameter >= self.pitch_diameter:
            raise ParameterError(
                f"elements of {self.name} must be at most {most} of {1e3 * diameter:g} mm on the "
                f"pitch diameter of {1e3 * self.pitch_diameter:g} mm, got {count:g}."
            )
