"""Two opposed bearings of a shaft, of any type that is registered."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    N_EXPANSION,
    Bearing,
    ShaftBearings,
    ShaftMotion,
    expand_forces,
    expanded_forces,
    shaft_energy,
)
from gearlube_core.bearings.parameters import cage_torque
from gearlube_core.checks import check_option
from gearlube_core.dynamics.hypoid_axle.bearing_drag import PALMGREN, TORQUE_LOSSES, drag_of_shaft
from gearlube_core.dynamics.hypoid_axle.integrate import EXPANSION_REACH, STEPS_PER_EXPANSION
from gearlube_core.dynamics.train.element import RATE, RZ, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant import LubricantState

# places in the memory behind the expansion: steps since then, 0 for none; displacements of then
# [m]; drag of the present step [N.m]
_AGE, _THEN, _DRAG = N_EXPANSION, N_EXPANSION + 1, N_EXPANSION + 4
_MEMORY = N_EXPANSION + 5
# what is kept of a drag that takes single rollers: 1 where it is, oil temperature of then [K],
# torque [N.m], displacements and speed of then, slopes over their reaches
_KNOWN, _OIL, _TORQUE, _KEPT_THEN = range(4)
_N_MOVES = 4  # displacements and speed
_SLOPES = _KEPT_THEN + _N_MOVES
_N_KEPT = _SLOPES + _N_MOVES
# what asks for another evaluation, see `bearing_drag`
_REACH = 0.3e-6  # m
_SPEED_REACH = 0.02  # of 1 rad/s more than the speed
_OIL_REACH = 0.02  # K
_LEAST_MOVE = 0.25  # square of a move over its reach that says something of the slopes
_DRAG_COST = 3.0  # of an evaluation, in integrator steps


class _OpposedBearings(NamedTuple):
    bearings: ShaftBearings
    preload: float  # [N]
    law: float  # place in TORQUE_LOSSES
    orders: float  # of the reference frequency of the hysteresis, over that of rotation
    least_frequency: float  # [Hz]
    reach: float  # move of the shaft that ends an expansion [m]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        for i in range(_N_KEPT):
            s[at[4] + i] = 0.0

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        memory[_AGE] = 0.0

    @kernel
    def expand(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        _expand(self, _motion(at, s), memory, oil)

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        m = _motion(at, s)
        moved = abs(m.r1 + h * m.v1 - memory[_THEN])
        moved = max(moved, abs(m.r2 + h * m.v2 - memory[_THEN + 1]))
        moved = max(moved, abs(m.axial + h * m.v_axial - memory[_THEN + 2]))
        age = memory[_AGE]
        if age == 0.0 or age >= STEPS_PER_EXPANSION or moved > self.reach:
            # about where the shaft is half of the time later that the expansion will serve
            speed = max(abs(m.v1), max(abs(m.v2), abs(m.v_axial)))
            most = 0.5 * h * STEPS_PER_EXPANSION
            later = max(0.5 * h, min(most, self.reach / max(speed, self.reach)))
            ahead = ShaftMotion(
                m.r1 + later * m.v1,
                m.r2 + later * m.v2,
                m.axial + later * m.v_axial,
                m.v1,
                m.v2,
                m.v_axial,
                m.cage_angle + later * self.bearings.cage_ratio * m.speed,
                m.speed,
            )
            _expand(self, ahead, memory, oil)
            age = 0.0
        memory[_AGE] = age + 1.0
        kept, cost = part(s, at[4], _N_KEPT), 0.0
        if self.law > PALMGREN and not _drag_holds(m, oil, kept):
            cost = _DRAG_COST * _renew_drag(self, m, oil, kept)
        memory[_DRAG] = _drag_near(self, m, oil, kept)
        return cost

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, cage, damping, drag = at[0], at[1], at[2], at[3]
        m = _motion(at, s)
        f_1, f_2, f_a, lost = expanded_forces(self.bearings, m, part(memory, 0, N_EXPANSION))
        v = body + RATE
        ds[v + at[5]] += f_1
        ds[v + at[6]] += f_2
        ds[v + at[7]] += f_a
        ds[v + RZ] += self.bearings.cage_ratio * cage_torque(m.r1, m.r2, f_1, f_2) - memory[_DRAG]
        ds[cage] = self.bearings.cage_ratio * m.speed
        ds[damping] += lost
        ds[drag] += memory[_DRAG] * m.speed

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        return shaft_energy(self.bearings, _motion(at, s), oil)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        m = _motion(at, s)
        f_1, f_2, f_a, _ = expanded_forces(self.bearings, m, part(memory, 0, N_EXPANSION))
        out[first + at[5]], out[first + at[6]], out[first + at[7]] = f_1, f_2, f_a
        out[first + 3] = _drag_near(self, m, oil, part(s, at[4], _N_KEPT))


@kernel
def _change(m: ShaftMotion, kept: Array, i: int) -> float:
    """Return how far a number is from where the drag was evaluated, over its reach."""
    then = kept[_KEPT_THEN + i]
    if i == 3:
        return (m.speed - then) / (_SPEED_REACH * (1.0 + abs(then)))
    return ((m.r1, m.r2, m.axial)[i] - then) / _REACH


@kernel
def _drag_holds(m: ShaftMotion, oil: LubricantState, kept: Array) -> bool:
    holds = kept[_KNOWN] == 1.0 and abs(oil.temperature - kept[_OIL]) <= _OIL_REACH
    for i in range(_N_MOVES):
        holds = holds and abs(_change(m, kept, i)) <= 1.0
    return holds


@kernel
def _drag_near(self: _OpposedBearings, m: ShaftMotion, oil: LubricantState, kept: Array) -> float:
    if self.law <= PALMGREN:
        return drag_of_shaft(self.bearings, m, self.preload, self.law, oil)
    torque = kept[_TORQUE]
    for i in range(_N_MOVES):
        torque += kept[_SLOPES + i] * _change(m, kept, i)
    return torque


@kernel
def _renew_drag(self: _OpposedBearings, m: ShaftMotion, oil: LubricantState, kept: Array) -> float:
    """Evaluate the drag and keep it with its slopes; return how many evaluations that took.

    Slopes from nothing take one each; later ones follow from what a move has done to the torque.
    Source: [broyden_1965], method 1.
    """
    torque = drag_of_shaft(self.bearings, m, self.preload, self.law, oil)
    square, missed = 0.0, torque - kept[_TORQUE]
    for i in range(_N_MOVES):
        step = _change(m, kept, i)
        square += step * step
        missed -= kept[_SLOPES + i] * step
    evaluations = 1.0
    if kept[_KNOWN] == 0.0:
        evaluations += _N_MOVES
        w = _SPEED_REACH * (1.0 + abs(m.speed))
        for i in range(_N_MOVES):
            moved = ShaftMotion(
                m.r1 + (_REACH if i == 0 else 0.0),
                m.r2 + (_REACH if i == 1 else 0.0),
                m.axial + (_REACH if i == 2 else 0.0),
                m.v1,
                m.v2,
                m.v_axial,
                m.cage_angle,
                m.speed + (w if i == 3 else 0.0),
            )
            there = drag_of_shaft(self.bearings, moved, self.preload, self.law, oil)
            kept[_SLOPES + i] = there - torque
    elif square > _LEAST_MOVE:
        for i in range(_N_MOVES):
            kept[_SLOPES + i] += missed * _change(m, kept, i) / square
    kept[_KNOWN], kept[_OIL], kept[_TORQUE] = 1.0, oil.temperature, torque
    kept[_KEPT_THEN], kept[_KEPT_THEN + 1], kept[_KEPT_THEN + 2] = m.r1, m.r2, m.axial
    kept[_KEPT_THEN + 3] = m.speed
    return evaluations


@kernel
def _motion(at: Any, s: Array) -> ShaftMotion:
    u, v = at[0], at[0] + RATE
    r1, r2, axial = at[5], at[6], at[7]
    return ShaftMotion(
        s[u + r1], s[u + r2], s[u + axial], s[v + r1], s[v + r2], s[v + axial], s[at[1]], s[u + W]
    )  # fmt: skip


@kernel
def _expand(self: _OpposedBearings, m: ShaftMotion, memory: Array, oil: LubricantState) -> None:
    frequency = max(self.orders * abs(m.speed) / (2.0 * math.pi), self.least_frequency)
    expand_forces(self.bearings, m, frequency, oil, part(memory, 0, N_EXPANSION))
    memory[_THEN], memory[_THEN + 1], memory[_THEN + 2] = m.r1, m.r2, m.axial


@dataclass(frozen=True, slots=True, kw_only=True)
class OpposedBearings(Element):
    """Both bearings of a body, mounted against each other about its centre.

    They carry no tilt: the body holds rx and ry, or has another support against it.

    Parameters
    ----------
    name, body : str
    bearing : Bearing
        Of any type among `bearing_types`.
    torque_loss : str
        Law of the drag, as `bearing_torque_loss` of the axle; not "solved_films".
    orders : float
        Cycles in a turn that the hysteresis of the rollers is taken at, such as the teeth of the
        gear, 1 to 1000.
    least_frequency : float
        Lower clamp of that frequency [Hz], 1 to 1e4.
    steps_per_highest_period : int
        Of the train, which decides how long an expansion of the forces serves.
    axes : tuple of 3 int
        Which of x, y, z are the two radial axes, the first one turned towards the second, and the
        axial one: (0, 1, 2) for a shaft along z.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> bearing = mohammadpour_2015_axle().bearing
    >>> pair = OpposedBearings(name="bearings", body="input", bearing=bearing)
    >>> pair.losses
    ('bearing_damping', 'bearing_torque')
    """

    name: str
    body: str
    bearing: Bearing
    torque_loss: str = "none"
    orders: Annotated[
        float, Number("1", 1.0, 1000.0, text="Cycles in a turn for the hysteresis of the rollers")
    ] = 20.0
    least_frequency: Annotated[
        float, Number("Hz", 1.0, 1e4, text="Lower clamp of the frequency of these cycles")
    ] = 50.0
    steps_per_highest_period: int = 16
    axes: tuple[int, int, int] = (0, 1, 2)
    kind: ClassVar = "opposed_bearings"
    on: ClassVar = ("body",)
    angles: ClassVar = ("cage",)
    losses: ClassVar = ("bearing_damping", "bearing_torque")
    outputs: ClassVar = (
        *(Output(f"force.{c}", "N", f"force along {c} on the body", 1e3) for c in "xyz"),
        Output("torque", "N.m", "drag"),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        check_option(f"torque_loss of {self.name}", self.torque_loss, TORQUE_LOSSES)
        if self.torque_loss == "solved_films":
            raise ParameterError(
                f"torque_loss of {self.name} must not be solved_films, which only the hypoid axle "
                "has. Take a law such as zhou_hoeprich_1991."
            )

        if sorted(self.axes) != [0, 1, 2]:
            raise ParameterError(
                f"axes of {self.name} must be 0, 1 and 2, each once, got {list(self.axes)}."
            )

    def variants(self) -> tuple[type, ...]:
        """Return the class of the bearings."""
        return (type(self.bearing.parameters()),)

    def numbers(self) -> _OpposedBearings:
        """Return the constants of the kernels."""
        reach = 1e-6 * EXPANSION_REACH / self.steps_per_highest_period**2
        return _OpposedBearings(
            self.bearing.parameters(),
            self.bearing.preload_force(),
            float(TORQUE_LOSSES.index(self.torque_loss)),
            float(self.orders),
            float(self.least_frequency),
            reach,
        )

    def sizes(self) -> tuple[int, ...]:
        """Return the axes."""
        return self.axes

    def memory(self) -> Array:
        """Return room for the expansion of the forces and the drag."""
        return np.zeros(_MEMORY)

    def kept_size(self) -> int:
        """Return the places of what is kept of the drag."""
        return _N_KEPT
