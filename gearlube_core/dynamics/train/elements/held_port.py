"""Torque from outside on a body, and a holder of its speed, as of a test bench."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, get_args

from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.part import Body, Element, Hidden, Node
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Checked, Number, Output
from gearlube_core.oil.lubricant_state import LubricantState

Hold = Literal["none", "governor", "imposed"]
_NONE, _GOVERNOR, _IMPOSED = 1.0, 2.0, 3.0  # their numbers
# of the numbers that the element keeps, from the given torque on; the last is with the holder's
REFERENCE, HOLD_TORQUE, WHOLE_TORQUE, N_KEPT = 1, 2, 3, 4
_STEPS_PER_LAG = 2.0
# in models whose pinion has the port
PINION_HOLD_TORQUE = Output(
    "speed.hold_torque", "N.m", "Torque of the holder of the speed on the pinion, positive as "
    "pinion.torque; 0 without", 10.0,
)  # fmt: skip


class HeldPortKernels(NamedTuple):
    """Kernels of a port with a holder, whose reference is NaN while the train is put at rest."""

    sign: float  # of torques and of the reference about z
    inertia: float  # of the body [kg m2]
    mode: float  # number in `Hold`, from 1
    gain: float  # of a governor [N.m.s/rad]
    time_constant: float  # of an imposed speed [s]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        s[at[2] + HOLD_TORQUE], s[at[2] + WHOLE_TORQUE] = 0.0, s[at[2]]
        if self.mode != _NONE:
            s[at[2] + REFERENCE] = math.nan

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.begin`."""
        s[at[2] + WHOLE_TORQUE] = s[at[2]] + s[at[2] + HOLD_TORQUE]

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        body, work, given = at
        torque, reference = s[given], s[given + REFERENCE]
        if self.mode == _GOVERNOR and reference == reference:
            held = self.gain * (reference - self.sign * s[body + W])
            torque += held
            s[given + HOLD_TORQUE], s[given + WHOLE_TORQUE] = held, torque
        torque *= self.sign
        ds[body + RATE + RZ] += torque
        ds[work] += torque * s[body + W]

    @inside
    def after_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.after_forces`; the holder's torque gives the acceleration that it wants."""
        body, work, given = at
        reference = s[given + REFERENCE]
        if self.mode == _IMPOSED and reference == reference:
            speed = self.sign * s[body + W]
            wanted = (reference - speed) / self.time_constant
            held = self.inertia * (wanted - self.sign * ds[body + RATE + RZ])
            s[given + HOLD_TORQUE], s[given + WHOLE_TORQUE] = held, s[given] + held
            ds[body + RATE + RZ] = self.sign * wanted
            ds[work] += held * speed

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`."""
        if self.mode == _GOVERNOR:
            return _STEPS_PER_LAG * self.gain / self.inertia
        return _STEPS_PER_LAG / self.time_constant if self.mode == _IMPOSED else 0.0

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        out[first] = s[at[2] + HOLD_TORQUE]

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        return 1.0 if kept == N_KEPT and min(self.inertia, self.time_constant) > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedHolder(Checked):
    """How a speed is held, as on a test bench.

    governor: T = governor_gain (reference - w);
    imposed: dw/dt = (reference - w) / time_constant, whatever the other torques

    Parameters
    ----------
    mode : {"none", "governor", "imposed"}
    governor_gain : float
        [N.m.s/rad]. A torque T that the governor bears moves the speed by T / governor_gain.
    time_constant : float
        Of an imposed speed, with which it follows its reference [s].

    Raises
    ------
    ParameterError
        An unknown mode, or a number out of its limits.

    Examples
    --------
    >>> SpeedHolder(mode="governor").governor_gain
    30.0
    """

    mode: Hold = "none"
    governor_gain: Annotated[
        float, Number("N.m.s/rad", 1e-3, 1e4, text="Torque of the governor over the error of speed")
    ] = 30.0
    time_constant: Annotated[
        float,
        Number(
            "s",
            1e-4,
            1.0,
            text="Time constant with which an imposed speed follows its reference",
            shown="us",
        ),
    ] = 1e-3

    def numbers(self) -> tuple[float, float, float]:
        """Return the arguments of its kernels."""
        mode = 1.0 + get_args(Hold).index(self.mode)
        return mode, float(self.governor_gain), float(self.time_constant)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldPort(Port):
    """A `Port` whose body a holder can keep at a speed, an input of the train too.

    Parameters beside those of `Port`
    ---------------------------------
    holder : SpeedHolder
    speed_reference : float
        In the sense of a positive torque, at the start [rad/s].

    Notes
    -----
    The work of the holder is part of that put in by the port.

    Examples
    --------
    >>> holder = SpeedHolder(mode="imposed")
    >>> HeldPort(name="motor", body="rotor", holder=holder).numbers().time_constant
    0.001
    """

    holder: SpeedHolder = SpeedHolder()
    speed_reference: Annotated[
        float, Number("rad/s", -MAX_SPEED, MAX_SPEED, text="Held speed at the start")
    ] = 0.0
    kind: ClassVar = "held_port"
    interpreted: ClassVar = (Listed(HeldPortKernels, (), 3),)
    linear: ClassVar = False
    torque_at: ClassVar = WHOLE_TORQUE
    outputs: ClassVar = (Output("hold_torque", "N.m", "torque of the holder of the speed", 10.0),)

    def numbers(self) -> HeldPortKernels:  # type: ignore[override]
        """Return the constants of the kernels, with an inertia of 1 kg m2."""
        return HeldPortKernels(float(self.sign), 1.0, *self.holder.numbers())

    def numbers_among(self, bodies: Sequence[Body]) -> HeldPortKernels:
        """Return the constants of the kernels."""
        inertia = next(one.polar_inertia for one in bodies if one.name == self.body)
        return self.numbers()._replace(inertia=float(inertia))

    def fits(self, bodies: Sequence[Body], elements: Sequence[Element]) -> None:
        """Raise ParameterError where the body cannot be held at a speed."""
        body = next((one for one in bodies if one.name == self.body), None)
        if isinstance(body, Node | Hidden):
            wrong = self.holder.mode != "none"
        else:
            wrong = body is not None and "rz" in body.held
        if wrong:
            raise ParameterError(
                f"body of {self.name} must be a rigid body that turns, got {self.body}. Hold the "
                "speed of a rigid body, such as one with the inertia of a motor."
            )

    def kept_size(self) -> int:
        """Return how many numbers are kept."""
        return N_KEPT


def speed_references(elements: Sequence[object]) -> dict[str, float]:
    """Return the inputs of ports that hold a speed, with their start values [rad/s]."""
    return {
        f"{one.name}.speed_reference": one.speed_reference
        for one in elements
        if isinstance(one, HeldPort) and one.holder.mode != "none"
    }
