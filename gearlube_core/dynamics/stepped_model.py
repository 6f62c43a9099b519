"""Base class of time-stepped gear models: checked inputs, steps, saved and restored states."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
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
    TORQUE_MARGIN,
    Range,
    left_ranges,
)
from gearlube_core.errors import ConvergenceError, ParameterError, StepError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.oil.lubricant import Lubricant

Control = TypeVar("Control", bound=tuple[float, ...])  # a NamedTuple of floats

MAX_STEP = 0.1  # s, communication step
# of MAX_STEP: a host's step is a difference of times, rounded at late times
STEP_ROUNDING = 1e-3
_N_INPUTS = 3
TOO_FAR_WORDS = (
    f"an angle of a shaft or cage is beyond {MAX_ANGLE:g} rad, where rounding blurs the phase of "
    "the mesh. Start again, or take whole turns of all shafts from the angles"
)
TOO_FAST_WORDS = (
    f"a shaft turns faster than {MAX_SPEED:g} rad/s, where the model has no meaning. "
    "Reduce the torque, or load the wheel"
)


def too_many_steps_words(most: int) -> str:
    """Return why a step is refused that costs more than `most` integrator steps."""
    return (
        f"the step costs more than {most} integrator steps. Shorten the communication step, or "
        "take fewer solver.steps_per_highest_period and solver.steps_per_mesh_period"
    )


_OK = 0  # status of a kernel that made its step


def _copied(
    of: Callable[[Any], SteppedModel[Any]], parameters: Any, state: Array
) -> SteppedModel[Any]:
    """Return the model of these parameters in a state."""
    model = of(parameters)
    model._take(state)
    if model._inputs[-1] > 0.0:  # an oil temperature: it has been started
        model._write_outputs()
    return model


class Kernels(NamedTuple):
    """Compiled functions of a model, and what they take behind state and inputs."""

    step: Callable[..., int]  # (state, trial, h, inputs, *step_data)
    step_data: tuple[Any, ...]
    write_outputs: Callable[..., None]  # (state, inputs, *output_data)
    output_data: tuple[Any, ...]


class Words(NamedTuple):
    """How messages speak of a model."""

    name: str  # "axle"
    resolved: str  # what a communication step of 1e-4 s resolves
    refusals: Mapping[int, str]  # why a step was refused, by status


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


class SteppedModel(ABC, Generic[Control]):
    """A model with two shafts that is advanced by communication steps.

    Parameters
    ----------
    states
        How many there are.
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
        For messages.
    """

    parameters: Any  # the one argument of the models

    def __init__(
        self,
        *,
        states: int,
        output_names: tuple[str, ...],
        control: Control,
        oil: Lubricant,
        torque_limits: TorqueLimits,
        ranges: tuple[Range, ...],
        words: Words,
    ) -> None:
        self._state = np.zeros(states)
        self._trial = np.zeros(states)
        self.output_names = output_names
        self._outputs = np.zeros(len(output_names))
        # torques of pinion and wheel [N.m], oil temperature [K]: of the last step, of one tried
        self._inputs, self._trial_inputs = np.zeros(_N_INPUTS), np.zeros(_N_INPUTS)
        self._control_type = type(control)
        self._control_values = flatten(control)
        self._oil, self._oil_range = oil, (oil.temperature_low, oil.temperature_high)
        self._torque_limits, self._words = torque_limits, words
        self._ranges = ranges
        self._kernels = self._with_data()
        self.outputs: Array = self._outputs.view()
        self.outputs.flags.writeable = False
        self.state_view: Array = self._state.view()
        self.state_view.flags.writeable = False

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        """Let a copy, also one out of a pickle, be a model of its own in the same state."""
        return _copied, (type(self), self.parameters, self.get_state())

    @abstractmethod
    def _with_data(self) -> Kernels:
        """Return the kernels, what they take made of what the base class has."""

    @abstractmethod
    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        """Write the static equilibrium at the pinion's speed and torque into the state of zeros."""

    @abstractmethod
    def _step_control(self, torque: float, oil_temperature: float) -> Control:
        """Return what the integrator step is tied to about the present equilibrium."""

    @property
    def step_control(self) -> Control:
        """What the integrator step is tied to."""
        return self._control_type(*self._control_values.tolist())

    def initialise(
        self,
        *,
        pinion_speed: float,
        pinion_torque: float,
        wheel_torque: float,
        oil_temperature: float,
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

        Raises
        ------
        ParameterError
            When an input is not finite or out of range.
        ConvergenceError
            When no static equilibrium is found.
        """
        check_within("pinion_speed", pinion_speed, -MAX_SPEED, MAX_SPEED, "rad/s")
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature)
        before = self.get_state()
        self._state[:] = 0.0
        self._inputs[:] = pinion_torque, wheel_torque, oil_temperature
        try:
            self._rest(pinion_speed, pinion_torque, oil_temperature)
            self._control_values[:] = self._step_control(pinion_torque, oil_temperature)
        except ConvergenceError:
            self._take(before)
            raise
        self._write_outputs()

    def step(
        self, h: float, pinion_torque: float, wheel_torque: float, oil_temperature: float
    ) -> None:
        """Advance by `h` [s] under constant torques [N.m] and oil temperature [K].

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
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature)
        inputs, kernels = self._trial_inputs, self._kernels
        inputs[0] = pinion_torque
        inputs[1] = wheel_torque
        inputs[2] = oil_temperature
        status = kernels.step(self._state, self._trial, h, inputs, *kernels.step_data)
        if status != _OK:
            raise StepError(f"step of {h:g} s refused: {self._words.refusals[status]}.")
        self._inputs, self._trial_inputs = inputs, self._inputs

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
        """Return what the last step left the range of: a sentence for each, by its output.

        Tables and formulas are extrapolated there. docs/fmu.md lists the ranges. Shares of load
        outside a film model are among them.
        """
        shares = [one for one in FILM_SHARES if one.output in self.output_names]
        left = left_ranges(self._ranges, self.output(RANGE_EXCEEDED))
        left += [one for one in shares if self.output(one.output) > one.high]
        return {one.output: one.sentence(self.output(one.output)) for one in left}

    def get_state(self) -> Array:
        """Return everything that the future depends on: states, inputs, step control."""
        return np.concatenate([self._state, self._inputs, self._control_values])

    def set_state(self, state: Array) -> None:
        """Continue from what `get_state` returned; bit-exact.

        Raises
        ------
        StepError
            When the array has the wrong length or holds a NaN; the model is then as before.
        """
        values = np.asarray(state, dtype=np.float64)
        at_control = self._state.size + _N_INPUTS
        size = at_control + self._control_values.size
        if values.shape != (size,) or not np.all(np.isfinite(values)):
            raise StepError(
                f"a state of the {self._words.name} has {size} finite numbers, got shape "
                f"{values.shape}. Use an array from get_state of the same release."
            )
        control = self._control_type(*values[at_control:].tolist())
        if min(control) <= 0.0:
            raise StepError(
                f"a state of the {self._words.name} must have step control values above 0, got "
                f"{control}. Use an array from get_state after initialise."
            )
        self._take(values)
        self._write_outputs()

    def _take(self, values: Array) -> None:
        at_control = self._state.size + _N_INPUTS
        self._state[:] = values[: self._state.size]
        self._inputs[:] = values[self._state.size : at_control]
        self._control_values[:] = values[at_control:]

    def _check_inputs(self, pinion_torque: float, wheel_torque: float, oil: float) -> None:
        (least, most, wheel, cure), (low, high) = self._torque_limits, self._oil_range
        if least <= pinion_torque <= most and abs(wheel_torque) <= wheel and low <= oil <= high:
            return  # the usual case, thousands of times a second
        check_within("pinion.torque", pinion_torque, least, most, "N.m", cure)
        check_within("wheel.torque", wheel_torque, -wheel, wheel, "N.m", cure)
        self._oil.check_temperature(oil, "oil.temperature")

    def _write_outputs(self) -> None:
        self._kernels.write_outputs(self._state, self._inputs, *self._kernels.output_data)
