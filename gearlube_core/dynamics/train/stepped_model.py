"""Base class of gear models that are trains with two shafts: checked inputs, steps, outputs."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_within
from gearlube_core.dynamics.ranges import (
    FILM_SHARES,
    MAX_ANGLE,
    MAX_SPEED,
    RANGE_EXCEEDED,
    TOO_FAR,
    TORQUE_MARGIN,
    Range,
    left_ranges,
)
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.choice import generated_kernel
from gearlube_core.dynamics.train.elements.held_port import N_KEPT, REFERENCE, SpeedHolder
from gearlube_core.dynamics.train.march import DIVERGED, NOT_FINITE, TOO_FAST, WRITE
from gearlube_core.dynamics.train.marched import MarchedTrain
from gearlube_core.dynamics.train.rest_search import NO_MODES, OK
from gearlube_core.errors import ConvergenceError, ParameterError, StepError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant

Control = TypeVar("Control", bound=tuple[float, ...])  # a NamedTuple of floats

MAX_STEP = 0.1  # s, communication step
# of MAX_STEP: a host's step is a difference of times, rounded at late times
STEP_ROUNDING = 1e-3
_N_INPUTS = 4
REVERSED = 30  # status of a start, beside those of the kernels
REVERSED_WORDS = (
    "speed.reference must not be against pinion.speed_start where the speed is held. Start in the "
    "sense of the reference, or at 0 rad/s"
)


@kernel
def shafts_status(distance: float, speed: float, angle: float) -> int:
    """Return OK, or why a state is outside the model: NOT_FINITE, TOO_FAST or TOO_FAR.

    Arguments are of the greatest magnitude: of the coordinate of the mesh [m], the speeds of shafts
    [rad/s], the angles of shafts and cages [rad].
    """
    if not distance <= DIVERGED:
        return NOT_FINITE
    if not speed <= MAX_SPEED:
        return TOO_FAST
    return OK if angle <= MAX_ANGLE else TOO_FAR


@kernel
def put_speed(pinion_speed: float, work: Array) -> None:
    """Write what START begins with: the wheel bears what the torques leave, and follows."""
    work[0], work[1], work[2] = 1.0, pinion_speed, math.nan


class MessageTerms(NamedTuple):
    """Terms that error messages about a model use."""

    name: str  # "axle"
    resolved: str  # what a communication step of 1e-4 s resolves
    refusals: Mapping[int, str]  # why a step was refused, by status
    forces: str  # which are out where there is no static equilibrium
    cure: str  # of that
    no_modes: str  # why natural frequencies were not found


class TorqueLimits(NamedTuple):
    """Torques beyond which a step is refused [N.m], and why."""

    pinion_low: float
    pinion_high: float
    wheel: float  # of its magnitude
    cure: str

    @classmethod
    def around(
        cls, of_mesh: tuple[float, float], ratio: float, pinion: float, wheel: float
    ) -> TorqueLimits:
        """Return `TORQUE_MARGIN` times the torques of the mesh data, at most the given largest.

        Parameters
        ----------
        of_mesh : tuple of 2 floats
            Pinion torques at the ends of the mesh data, of both signs [N.m].
        ratio : float
            Teeth of the gear over those of the pinion.
        pinion, wheel : float
            Largest magnitudes for any mesh data [N.m].
        """
        low, high = (TORQUE_MARGIN * end for end in of_mesh)
        cure = "Check the unit."
        if min(-low, high) < pinion:
            cure = (
                f"The mesh data end at {of_mesh[0]:g} and {of_mesh[1]:g} N.m at the pinion; "
                f"beyond {TORQUE_MARGIN:g} times that results have no meaning. Check the unit, or "
                "analyse the contact at higher torques."
            )
        return cls(max(low, -pinion), min(high, pinion), min(max(-low, high) * ratio, wheel), cure)


class SteppedModel(MarchedTrain, Generic[Control]):
    """A train with two shafts that is advanced by communication steps.

    Parameters
    ----------
    made : Assembly
        Its first two ports, whose torques stand behind the integrated states, are the inputs.
    output_names
        Of the outputs, in their order.
    control
        What the integrator step is tied to, before `initialise`; its values are part of the state.
    oil
        Its range of temperatures is that of the input.
    torque_limits
        Of pinion and wheel.
    ranges
        Of tables and formulas, in the order of `ranges.RANGE_OUTPUTS` without the first.
    words
        Terms used in error messages.
    holder
        Of the speed of the first port, a `HeldPort`; by default none.
    """

    parameters: Any  # the one argument of the models
    _origin, _temperature_at = "release", 2

    def __init__(
        self,
        made: Assembly,
        *,
        output_names: tuple[str, ...],
        control: Control,
        oil: Lubricant,
        torque_limits: TorqueLimits,
        ranges: tuple[Range, ...],
        words: MessageTerms,
        holder: SpeedHolder | None = None,
    ) -> None:
        beside = np.concatenate([np.zeros(_N_INPUTS), flatten(control)])
        super().__init__(made, generated_kernel(made), beside)
        # of the last step: torques of pinion and wheel [N.m], oil temperature [K], reference speed
        # of the pinion [rad/s]
        self._inputs, self._control_values = beside[:_N_INPUTS], beside[_N_INPUTS:]
        self._first_port, self._holder = made.sizes.integrated, holder
        self.output_names = output_names
        self._outputs = np.zeros(len(output_names))
        self._control_type = type(control)
        self._oil, self._oil_range = oil, (oil.temperature_low, oil.temperature_high)
        self._torque_limits, self._words, self._ranges = torque_limits, words, ranges
        self._name, self._refusals = f"the {words.name}", words.refusals
        self.outputs: Array = self._outputs.view()
        self.outputs.flags.writeable = False
        self.state_view: Array = self._state.view()
        self.state_view.flags.writeable = False

    @abstractmethod
    def _start(self, speed: float) -> int:
        """Put the state, of zeros and torques, into equilibrium by START; return its status."""

    @abstractmethod
    def _step_control(self, rate: float) -> Control:
        """Return the periods that limit the step, from the least rate that START has found."""

    @abstractmethod
    def _gather(self) -> None:
        """Write the outputs from what WRITE has left."""

    def _given(self) -> dict[str, Any]:
        return {"parameters": self.parameters, "holder": self._holder}

    @property
    def step_control(self) -> Control:
        """Periods that limit the integrator step."""
        return self._control_type(*self._control_values.tolist())

    def initialise(
        self,
        *,
        pinion_speed: float,
        pinion_torque: float,
        wheel_torque: float,
        oil_temperature: float,
        speed_reference: float | None = None,
    ) -> None:
        """Put the model into static equilibrium under the pinion torque, turning.

        Parameters
        ----------
        pinion_speed : float
            [rad/s]
        pinion_torque, wheel_torque : float
            [N.m]; the wheel torque is a load.
        oil_temperature : float
            [K]
        speed_reference : float, optional
            At which a holder keeps the pinion [rad/s]; by default `pinion_speed`.

        Raises
        ------
        ParameterError
            When an input is not finite or out of range, or a held speed is to be reversed.
        ConvergenceError
            When no static equilibrium is found.
        """
        check_within("pinion_speed", pinion_speed, -MAX_SPEED, MAX_SPEED, "rad/s")
        reference = pinion_speed if speed_reference is None else speed_reference
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature, reference)
        if self._holder and self._holder.mode != "none" and reference * pinion_speed < 0.0:
            got = f"got {reference:g} rad/s and {pinion_speed:g} rad/s"
            raise ParameterError(f"{REVERSED_WORDS}; {got}.")
        before = self.get_state()
        self._state[:] = 0.0
        self._inputs[:] = pinion_torque, wheel_torque, oil_temperature, reference
        self._put_inputs(self._state, pinion_torque, wheel_torque, reference)
        status = self._start(float(pinion_speed))
        if status != OK:
            self._take_state(before)
            words = self._words
            raise ConvergenceError(
                words.no_modes
                if status == NO_MODES
                else f"no static equilibrium at a pinion torque of {pinion_torque:g} N.m: "
                f"{words.forces} are out by {self._work[1]:g} N. {words.cure}"
            )
        self._put_inputs(self._state, pinion_torque, wheel_torque, reference)
        self._control_values[:] = self._step_control(float(self._work[0]))
        self._write_outputs()

    def step(
        self,
        h: float,
        pinion_torque: float,
        wheel_torque: float,
        oil_temperature: float,
        speed_reference: float | None = None,
    ) -> None:
        """Advance by `h` [s] under constant torques [N.m] and oil temperature [K].

        The reference of a held speed [rad/s] stays as it is by default.

        Raises
        ------
        ParameterError
            When an input is not finite or out of range.
        StepError
            When the step cannot be made; the model is then as before the step.
        """
        if not 0.0 < h <= MAX_STEP * (1.0 + STEP_ROUNDING):
            check_finite("step size", h, "s")
            raise StepError(
                f"step size must be above 0 and at most {MAX_STEP:g} s, got {h:g} s. "
                f"A communication step of about 1e-4 s resolves {self._words.resolved}."
            )
        inputs = self._inputs
        reference = float(inputs[3]) if speed_reference is None else speed_reference
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature, reference)
        self._trial[:] = self._state
        self._put_inputs(self._trial, pinion_torque, wheel_torque, reference)
        self._march(h, float(oil_temperature))
        inputs[0], inputs[1], inputs[2] = pinion_torque, wheel_torque, oil_temperature
        inputs[3] = reference
        self._write_outputs()

    def output(self, name: str) -> float:
        """Return one output by its name, an entry of `output_names`; units as in docs/fmu.md.

        Raises
        ------
        ParameterError
            The model has no output of this name.
        """
        if name not in self.output_names:
            near = get_close_matches(name, self.output_names, n=3)
            cure = f"Did you mean {' or '.join(near)}?" if near else "`output_names` lists them."
            raise ParameterError(
                f"name must be an output of the {self._words.name}, got {name!r}. {cure}"
            )
        return float(self._outputs[self.output_names.index(name)])

    def exceeded(self) -> dict[str, str]:
        """Return all ranges that the last step left: a sentence for each, by its output.

        Tables and formulas are extrapolated there. docs/fmu.md lists the ranges. Shares of load
        outside a film model are among them.
        """
        shares = [one for one in FILM_SHARES if one.output in self.output_names]
        left = left_ranges(self._ranges, self.output(RANGE_EXCEEDED))
        left += [one for one in shares if self.output(one.output) > one.high]
        return {one.output: one.sentence(self.output(one.output)) for one in left}

    def _check_state(self, values: Array) -> None:
        super()._check_state(values)
        control = self._control_type(*values[self._state.size + _N_INPUTS :].tolist())
        if min(control) <= 0.0:
            raise StepError(
                f"a state of {self._name} must have step control values above 0, got "
                f"{control}. Use an array from get_state after initialise."
            )

    def _take_state(self, values: Array) -> None:
        super()._take_state(values)
        if self._temperature() > 0.0:  # the model has been started
            self._write_outputs()

    def _check_inputs(
        self, pinion_torque: float, wheel_torque: float, oil: float, reference: float
    ) -> None:
        (least, most, wheel, cure), (low, high) = self._torque_limits, self._oil_range
        usual = least <= pinion_torque <= most and abs(wheel_torque) <= wheel and low <= oil <= high
        if usual and abs(reference) <= MAX_SPEED:
            return  # thousands of times a second
        check_within("pinion.torque", pinion_torque, least, most, "N.m", cure)
        check_within("wheel.torque", wheel_torque, -wheel, wheel, "N.m", cure)
        self._oil.check_temperature(oil, "oil.temperature")
        check_within("speed.reference", reference, -MAX_SPEED, MAX_SPEED, "rad/s")

    def _put_inputs(self, s: Array, pinion: float, wheel: float, reference: float) -> None:
        at = self._first_port
        s[at], s[at + REFERENCE], s[at + N_KEPT] = pinion, reference, wheel

    def _write_outputs(self) -> None:
        self._call(WRITE, self._state)
        self._gather()
