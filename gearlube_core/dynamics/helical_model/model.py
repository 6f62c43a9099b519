"""The helical pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.helical_model.outputs import (
    N_STATE,
    OUTPUT_NAMES,
    PINION,
    PSI,
    RATES,
    SENSES,
    STATE_PLACES,
    TORQUES,
    WHEEL,
    write_derivatives,
    write_pair,
)
from gearlube_core.dynamics.helical_model.pair import bearing_shares, helical_pair
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.stepped_model import (
    TOO_FAR_WORDS,
    TOO_FAST_WORDS,
    Kernels,
    SteppedModel,
    TorqueLimits,
    Words,
    too_many_steps_words,
)
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.choice import generated_kernel
from gearlube_core.dynamics.train.element import RZ, W
from gearlube_core.dynamics.train.march import (
    ADVANCE,
    DIVERGED,
    EXCHANGE,
    MAX_STEPS,
    NOT_FINITE,
    START,
    STIFFNESS,
    TOO_FAST,
    TOO_MANY_STEPS,
    WRITE,
    work_size,
)
from gearlube_core.dynamics.train.rest_search import NO_REST, OK
from gearlube_core.errors import ConvergenceError, StepError
from gearlube_core.kernels.jit import kernel

MAX_TORQUE = 1e5  # N.m on either shaft
NO_EQUILIBRIUM_CURE = "Reduce the torque or stiffen the supports"
NO_FREQUENCIES_WORDS = (
    "the natural frequencies about the static equilibrium are not finite. Use stiffness, masses "
    "and damping nearer to those of gears"
)
WORDS = Words(
    "pair",
    "the mesh frequency",
    {
        NOT_FINITE: (
            "the state is no longer finite or the teeth have parted by more than 0.1 m. "
            "Reduce the torques"
        ),
        TOO_MANY_STEPS: too_many_steps_words(MAX_STEPS),
        TOO_FAST: TOO_FAST_WORDS,
        TOO_FAR: TOO_FAR_WORDS,
    },
)
# coordinates of a member, besides its rotation, that move
FREE = {"twelve_dof": 5, "six_dof": 2}


class StepControl(NamedTuple):
    """What the integrator step is tied to."""

    steps_per_mesh_period: float
    steps_per_highest_period: float
    highest_frequency: float  # Hz


def torque_limits(parameters: HelicalMarchParameters) -> TorqueLimits:
    """Return the torques beyond which a pair takes no step."""
    return TorqueLimits.around(
        parameters.torque_range, parameters.pair.ratio, MAX_TORQUE, MAX_TORQUE
    )


@kernel
def state_status(s: Array) -> int:
    """Return OK, or why a state is outside the model: NOT_FINITE, TOO_FAST or TOO_FAR."""
    if not abs(s[PSI]) <= DIVERGED:
        return NOT_FINITE
    if not max(abs(s[PINION + W]), abs(s[WHEEL + W])) <= MAX_SPEED:
        return TOO_FAST
    angle = max(abs(s[PINION + RZ]), abs(s[WHEEL + RZ]))
    return OK if angle <= MAX_ANGLE else TOO_FAR


@kernel
def put_torques(inputs: Array, s: Array) -> None:
    """Put the torques of pinion and wheel into the ports of a state."""
    s[TORQUES] = inputs[0]
    s[TORQUES + 1] = inputs[1]


@kernel
def put_speed(pinion_speed: float, work: Array) -> None:
    """Write what START begins with: the wheel bears what the torques leave, and follows."""
    work[0], work[1], work[2] = 1.0, -pinion_speed, math.nan


@cache
def _kernels(operate: Callable[..., float]) -> tuple[Callable[..., int], Callable[..., None]]:
    """Return the kernels of a communication step and of the outputs over that of the train."""

    @kernel
    def write_outputs(
        s: Array,
        inputs: Array,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        free: int,
        teeth: float,
        bearings: Array,
        work: Array,
        out: Array,
    ) -> None:
        put_torques(inputs, s)
        operate(WRITE, s, inputs[2], numbers, memory, plan, 0.0, 0.0, work)
        write_pair(s, free, teeth, bearings, work, out)

    @kernel
    def step(
        s: Array,
        trial: Array,
        h: float,
        inputs: Array,
        control: Array,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        free: int,
        teeth: float,
        bearings: Array,
        work: Array,
        out: Array,
    ) -> int:
        status = state_status(s)
        if status != OK:
            return status
        for i in range(N_STATE):
            trial[i] = s[i]
        put_torques(inputs, trial)
        rate = control[1] * control[2]
        status = int(operate(ADVANCE, trial, inputs[2], numbers, memory, plan, h, rate, work))
        status = state_status(trial) if status == OK else status
        if status == OK:
            for i in range(N_STATE):
                s[i] = trial[i]
            write_outputs(s, inputs, numbers, memory, plan, free, teeth, bearings, work, out)
        return status

    return step, write_outputs


class HelicalPairModel(SteppedModel[StepControl]):
    """Lubricated helical or spur pair in motion: give torques, step it in time, read its outputs.

    The model has 12 degrees of freedom. It is the train of `helical_pair`.

    Parameters
    ----------
    parameters : HelicalMarchParameters

    Notes
    -----
    The contact lines follow the actual angle of the pinion. The flanks can touch on either side of
    the backlash. Equations of motion are integrated by RK4 with a fixed step, which follows from
    the mesh period and the highest natural frequency. The same input gives the same output to the
    bit. Instances share nothing.

    References
    ----------
    [he_2007]

    Examples
    --------
    >>> from dataclasses import replace
    >>> from gearlube_core.dynamics.helical_pair.march import gear_file_march
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> file = HelicalGearFile.named("he_2007")
    >>> parameters = gear_file_march.helical_march_parameters(file)
    >>> gears = HelicalPairModel(replace(parameters, friction="constant"))
    >>> gears.initialise(
    ...     pinion_speed=104.7, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=333.15
    ... )
    >>> gears.step(1e-4, 226.0, 280.0, 333.15)
    >>> gears.output("mesh.separated")
    0.0
    """

    def __init__(self, parameters: HelicalMarchParameters) -> None:
        self.parameters = parameters
        made = assemble(*helical_pair(parameters), parameters.oil, kinds=())
        self._operate = generated_kernel(made)
        self._train = made.numbers, made.memory, made.plan
        self._work = np.zeros(work_size(made.sizes))
        super().__init__(
            states=N_STATE,
            output_names=OUTPUT_NAMES,
            control=StepControl(0.0, 0.0, 1.0),
            oil=parameters.oil,
            torque_limits=torque_limits(parameters),
            ranges=parameters.ranges,
            words=WORDS,
        )

    def _with_data(self) -> Kernels:
        step, write_outputs = _kernels(self._operate)
        given = self.parameters
        of_pair = FREE[given.form], float(given.pair.pinion_teeth), bearing_shares(given)
        data = (*self._train, *of_pair, self._work, self._outputs)
        return Kernels(step, (self._control_values, *data), write_outputs, data)

    @property
    def continuous(self) -> Array:
        """The present values of the continuous states, in the order of STATE_NAMES."""
        return 0.0 + SENSES * self._state[STATE_PLACES]

    def derivative(self, continuous: Array) -> Array:
        """Return d/dt of the continuous states at these values, for any other integrator.

        Inputs and friction coefficients are those of the last step.

        Parameters
        ----------
        continuous : ndarray of shape (len(STATE_NAMES),)

        Raises
        ------
        StepError
            The values are not finite or beyond what the model has a meaning for.
        """
        s = self._state.copy()
        s[STATE_PLACES] = SENSES * continuous
        status = int(self._call(EXCHANGE, s))
        if status != OK:
            raise StepError(f"these values are refused: {self._words.refusals[status]}.")
        found = np.zeros(len(OUTPUT_NAMES))
        write_derivatives(self._work, found)
        return found[RATES : RATES + len(STATE_PLACES)]

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising.

        Raises
        ------
        ConvergenceError
            When they are not finite.
        """
        m = int(self._call(STIFFNESS, self._state))
        try:
            squares = np.linalg.eigvals(self._work[: m * m].reshape(m, m)).real
        except np.linalg.LinAlgError:
            raise ConvergenceError(f"{NO_FREQUENCIES_WORDS}.") from None
        # the lowest is the rotation of both members together
        return np.sqrt(np.maximum(np.sort(squares)[1:], 0.0)) / (2.0 * np.pi)

    def _call(self, operation: int, s: Array, size: float = 0.0) -> float:
        temperature = float(self._inputs[2])
        return self._operate(operation, s, temperature, *self._train, size, 0.0, self._work)

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        """Write the equilibrium at mesh phase zero; the gear turns in the ratio of the teeth."""
        put_torques(self._inputs, self._state)
        put_speed(float(speed), self._work)
        per_period = float(self.parameters.steps_per_highest_period)
        status = int(self._call(START, self._state, per_period))
        if status == NO_REST:
            raise ConvergenceError(
                f"no static equilibrium at a pinion torque of {torque:g} N.m: forces are out "
                f"by {self._work[1]:g} N. {NO_EQUILIBRIUM_CURE}."
            )
        if status != OK:
            raise ConvergenceError(f"{NO_FREQUENCIES_WORDS}.")
        self._rate = float(self._work[0])

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        """Tie the step to the highest mode with all lines in contact, loaded or not."""
        given = self.parameters
        per_period = float(given.steps_per_highest_period)
        return StepControl(float(given.steps_per_mesh_period), per_period, self._rate / per_period)
