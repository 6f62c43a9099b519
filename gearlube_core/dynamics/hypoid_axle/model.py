"""The axle as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.as_train import (
    hypoid_axle,
    memory_of_means,
    numbers_at_rest,
)
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.state import CAGE_G, CAGE_P, PHI_G, PHI_P, W_G, W_P, X
from gearlube_core.dynamics.hypoid_axle.train_outputs import (
    NO_BAND,
    gather_outputs,
    output_places,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    MARCH_WITH_WARM_FLANKS,
    HypoidAxleParameters,
)
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.elements.held_port import SpeedHolder
from gearlube_core.dynamics.train.march import NOT_FINITE, REFUSALS, START
from gearlube_core.dynamics.train.rest_search import OK
from gearlube_core.dynamics.train.stepped_model import (
    MessageTerms,
    SteppedModel,
    TorqueLimits,
    put_speed,
    shafts_status,
)
from gearlube_core.errors import ParameterError
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
_WORDS = MessageTerms(
    name="axle",
    resolved="the bearing modes",
    refusals=STEP_REFUSALS,
    forces="bearing forces",
    cure=NO_EQUILIBRIUM_CURE,
    no_modes=NO_MODES_WORDS,
)


class StepControl(NamedTuple):
    """Periods that limit the integrator step."""

    least_rate: float  # integrator steps a second


def torque_limits(parameters: HypoidAxleParameters) -> TorqueLimits:
    """Return the torques beyond which a step of the axle is refused."""
    return TorqueLimits.around(
        parameters.torque_range, parameters.mesh.ratio, MAX_TORQUE, MAX_WHEEL_TORQUE
    )


@kernel
def state_status(s: Array) -> int:
    """Return OK, or why a state is outside the model: NOT_FINITE, TOO_FAST or TOO_FAR."""
    angle = max(abs(s[PHI_P]), abs(s[PHI_G]), abs(s[CAGE_P]), abs(s[CAGE_G]))
    return shafts_status(abs(s[X]), max(abs(s[W_P]), abs(s[W_G])), angle)


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
    loss_sensitivities : ndarray of shape (8, 8), optional
        For `loss.low` and `loss.high`, see `loss_band.loss_sensitivities`; without them both are
        the power lost in all.
    holder : SpeedHolder, optional
        Of the speed of the pinion, by default none.

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

    def __init__(
        self,
        parameters: HypoidAxleParameters,
        loss_sensitivities: Array = NO_BAND,
        holder: SpeedHolder | None = None,
    ) -> None:
        if parameters.flank_bulk_resistance > 0.0:
            raise ParameterError(
                f"{MARCH_WITH_WARM_FLANKS} Got {parameters.flank_bulk_resistance:g} K/W."
            )
        self.parameters = parameters
        self.kernel_parameters: AxleParameters = parameters.kernel_parameters()
        bodies, self.elements = hypoid_axle(parameters, holder)
        made = assemble(bodies, self.elements, parameters.oil, kinds=())
        self._at_rest = numbers_at_rest(self.elements, made, parameters.oil)
        self._places, self._band = output_places(made), loss_sensitivities.ravel()
        super().__init__(
            made,
            output_names=OUTPUT_NAMES,
            control=StepControl(1.0),
            oil=parameters.oil,
            torque_limits=torque_limits(parameters),
            ranges=parameters.ranges,
            words=_WORDS,
            holder=holder,
        )

    _status = staticmethod(state_status)

    @property
    def _least_rate(self) -> float:
        return float(self._control_values[0])

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
        full = self._state.copy()
        full[: state.size] = state
        return self._rates(full)

    def _start(self, speed: float) -> int:
        """Find the equilibrium without losses at rest: films of rollers build up from there."""
        made, s, work, given = self._made, self._state, self._work, self.parameters
        put_speed(0.0, work)
        per_period, memory = float(given.steps_per_highest_period), memory_of_means(made)
        at_rest = self._temperature(), self._at_rest, memory, made.plan
        status = int(self.operate(START, s, *at_rest, per_period, 0.0, work))
        if status == OK:
            take_speeds(s, speed, given.mesh.ratio, float(self._inputs[0]))
        return status

    def _step_control(self, rate: float) -> StepControl:
        return StepControl(rate)

    def _gather(self) -> None:
        gather_outputs(self._state, self._work, self._places, self._band, self._outputs)
