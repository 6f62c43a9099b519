"""The axle as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.as_train import (
    hypoid_axle,
    memory_of_means,
    numbers_at_rest,
)
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.state import (
    CAGE_G,
    CAGE_P,
    PHI_G,
    PHI_P,
    PINION_TORQUE,
    W_G,
    W_P,
    WHEEL_TORQUE,
    X,
)
from gearlube_core.dynamics.hypoid_axle.train_outputs import gather_outputs, output_places
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    MARCH_WITH_WARM_FLANKS,
    HypoidAxleParameters,
)
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.stepped_model import Kernels, SteppedModel, TorqueLimits, Words
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.choice import generated_kernel
from gearlube_core.dynamics.train.march import (
    ADVANCE,
    DIVERGED,
    NOT_FINITE,
    RATES,
    REFUSALS,
    RENEW,
    START,
    TOO_FAST,
    WRITE,
    work_size,
)
from gearlube_core.dynamics.train.rest_search import NO_MODES, OK
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.kernels.jit import kernel

MAX_TORQUE = 1e4  # N.m at the pinion: far beyond any car axle
MAX_WHEEL_TORQUE = 3e4  # N.m
NO_EQUILIBRIUM_CURE = "Increase the bearing preload or reduce the torque."
NO_MODES_WORDS = (
    "the natural frequencies at the static equilibrium could not be found. "
    "Change the torque or the preload a little."
)
STEP_REFUSALS = {
    **REFUSALS,
    NOT_FINITE: (
        "the axle state is no longer finite or a shaft has moved by more than 0.1 m. "
        "Reduce the torques or check for an unstable option (equations='as_printed')"
    ),
}
_WORDS = Words("axle", "the bearing modes", STEP_REFUSALS)


class StepControl(NamedTuple):
    """What the integrator step is tied to."""

    least_rate: float  # integrator steps a second


def torque_limits(parameters: HypoidAxleParameters) -> TorqueLimits:
    """Return the torques beyond which a step of the axle is refused."""
    return TorqueLimits.around(
        parameters.torque_range, parameters.mesh.ratio, MAX_TORQUE, MAX_WHEEL_TORQUE
    )


@kernel
def state_status(s: Array) -> int:
    """Return OK, or why a state is outside the model: NOT_FINITE, TOO_FAST or TOO_FAR."""
    if not abs(s[X]) <= DIVERGED:
        return NOT_FINITE
    if not max(abs(s[W_P]), abs(s[W_G])) <= MAX_SPEED:
        return TOO_FAST
    angle = max(abs(s[PHI_P]), abs(s[PHI_G]), abs(s[CAGE_P]), abs(s[CAGE_G]))
    return OK if angle <= MAX_ANGLE else TOO_FAR


@kernel
def put_start(inputs: Array, s: Array, work: Array) -> None:
    """Write what START begins with; the gear bears what the pinion's torque leaves.

    Shafts do not turn yet: films of rollers build up from those at rest.
    """
    s[PINION_TORQUE], s[WHEEL_TORQUE] = inputs[0], inputs[1]
    work[0], work[1], work[2] = 1.0, 0.0, math.nan


@kernel
def take_speeds(s: Array, speed: float, ratio: float, torque: float) -> None:
    """Let an axle at rest under a torque [N.m] turn at a speed of the pinion [rad/s]."""
    if torque == 0.0:  # flanks just touch
        s[X] = 0.0
    s[W_P], s[W_G] = speed, speed / ratio


class HypoidAxle(SteppedModel[StepControl]):
    """Lubricated hypoid axle in motion: give it torques, step it in time, read its outputs.

    The model has 8 degrees of freedom, dynamic tapered roller bearings and three lubricated flanks.

    Parameters
    ----------
    parameters : HypoidAxleParameters

    Notes
    -----
    Equations of motion are integrated by RK4 with a fixed step, which follows from the mesh period
    and the highest natural frequency. The same input gives the same output to the bit. Instances
    share nothing. It is a train of elements, see `hypoid_axle_train`.

    References
    ----------
    [mohammadpour_2015]

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> axle = HypoidAxle(mohammadpour_2015_axle())
    >>> axle.initialise(
    ...     pinion_speed=209.4, pinion_torque=50.0, wheel_torque=140.0, oil_temperature=333.15
    ... )
    >>> axle.step(1e-4, 50.0, 140.0, 333.15)
    >>> round(axle.output("mesh.force"), 1)  # N
    2400.1
    """

    def __init__(self, parameters: HypoidAxleParameters) -> None:
        if parameters.flank_bulk_resistance > 0.0:
            raise ParameterError(
                f"{MARCH_WITH_WARM_FLANKS} Got {parameters.flank_bulk_resistance:g} K/W."
            )
        self.parameters = parameters
        self.kernel_parameters: AxleParameters = parameters.kernel_parameters()
        bodies, self.elements = hypoid_axle(parameters)
        made = self.assembly = assemble(bodies, self.elements, parameters.oil, kinds=())
        self.operate = generated_kernel(made)
        self._at_rest = numbers_at_rest(self.elements, made, parameters.oil)
        super().__init__(
            states=made.sizes.states,
            output_names=OUTPUT_NAMES,
            control=StepControl(1.0),
            oil=parameters.oil,
            torque_limits=torque_limits(parameters),
            ranges=parameters.ranges,
            words=_WORDS,
        )

    def _with_data(self) -> Kernels:
        made = self.assembly
        operate, work, places = self.operate, np.zeros(work_size(made.sizes)), output_places(made)
        numbers, memory, plan = made.numbers, made.memory, made.plan
        control, out = self._control_values, self._outputs
        self._work = work

        def write(s: Array, inputs: Array) -> None:
            operate(WRITE, s, inputs[2], numbers, memory, plan, 0.0, 0.0, work)
            gather_outputs(s, work, places, out)

        def step(s: Array, trial: Array, h: float, inputs: Array) -> int:
            status = state_status(s)
            if status != OK:
                return int(status)
            trial[:] = s
            trial[PINION_TORQUE], trial[WHEEL_TORQUE] = inputs[0], inputs[1]
            rate = control[0]
            status = int(operate(ADVANCE, trial, inputs[2], numbers, memory, plan, h, rate, work))
            if status == OK:
                status = state_status(trial)
            if status == OK:
                s[:] = trial
                write(s, inputs)
            return int(status)

        return Kernels(step, (), write, ())

    @property
    def highest_frequency(self) -> float:
        """Highest natural frequency at the initial load [Hz]; 1 / steps before `initialise`."""
        return self.step_control.least_rate / self.parameters.steps_per_highest_period

    def derivative(self, state: Array) -> Array:
        """Return d/dt of the N_ODE integrated states, for any other integrator.

        The inputs, the load level and the side of the mesh table are those of the last step.

        Parameters
        ----------
        state : ndarray of shape (N_ODE,)
            In the order of `state`, SI units.
        """
        made, rates = self.assembly, np.zeros(self._work.size)
        full = self._state.copy()
        full[: state.size] = state
        given = self._inputs[2], made.numbers, made.memory, made.plan, 0.0, 0.0, rates
        self.operate(RENEW, full, *given)
        self.operate(RATES, full, *given)
        return rates[: made.sizes.integrated]

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        made, work, s = self.assembly, self._work, self._state
        put_start(self._inputs, s, work)
        memory = memory_of_means(made)
        per_period = float(self.parameters.steps_per_highest_period)
        status = int(
            self.operate(
                START, s, oil_temperature, self._at_rest, memory, made.plan, per_period, 0.0, work
            )
        )
        if status == NO_MODES:
            raise ConvergenceError(NO_MODES_WORDS)
        if status != OK:
            raise ConvergenceError(
                f"no static equilibrium at a pinion torque of {torque:g} N.m: bearing forces are "
                f"out by {work[1]:g} N. {NO_EQUILIBRIUM_CURE}"
            )

        take_speeds(s, float(speed), self.parameters.mesh.ratio, float(torque))

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        return StepControl(float(self._work[0]))
