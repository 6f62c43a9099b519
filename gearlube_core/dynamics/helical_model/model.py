"""The helical pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_model.outputs import (
    OUTPUT_NAMES,
    PINION,
    PSI,
    RATES,
    SENSES,
    STATE_PLACES,
    WHEEL,
    write_derivatives,
    write_pair,
)
from gearlube_core.dynamics.helical_model.pair import bearing_shares, helical_pair
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.element import RZ, W
from gearlube_core.dynamics.train.elements.held_port import SpeedHolder
from gearlube_core.dynamics.train.march import NOT_FINITE, REFUSALS, START
from gearlube_core.dynamics.train.stepped_model import (
    MessageTerms,
    SteppedModel,
    TorqueLimits,
    put_speed,
    shafts_status,
)
from gearlube_core.errors import ConvergenceError
from gearlube_core.kernels.jit import kernel

MAX_TORQUE = 1e5  # N.m on either shaft
NO_EQUILIBRIUM_CURE = "Reduce the torque or stiffen the supports"
NO_FREQUENCIES_WORDS = (
    "the natural frequencies about the static equilibrium are not finite. Use stiffness, masses "
    "and damping nearer to those of gears"
)
WORDS = MessageTerms(
    name="pair",
    resolved="the mesh frequency",
    refusals={
        **REFUSALS,
        NOT_FINITE: (
            "the state is no longer finite or the teeth have parted by more than 0.1 m. "
            "Reduce the torques"
        ),
    },
    forces="forces",
    cure=f"{NO_EQUILIBRIUM_CURE}.",
    no_modes=f"{NO_FREQUENCIES_WORDS}.",
)
# coordinates of a member, besides its rotation, that move
FREE = {"twelve_dof": 5, "six_dof": 2}


class StepControl(NamedTuple):
    """Periods that limit the integrator step."""

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
    angle = max(abs(s[PINION + RZ]), abs(s[WHEEL + RZ]))
    return shafts_status(abs(s[PSI]), max(abs(s[PINION + W]), abs(s[WHEEL + W])), angle)


class HelicalPairModel(SteppedModel[StepControl]):
    """Lubricated helical or spur pair in motion: give torques, step it in time, read its outputs.

    The model has 12 degrees of freedom. It is the train of `helical_pair`.

    Parameters
    ----------
    parameters : HelicalMarchParameters
    holder : SpeedHolder, optional
        Of the speed of the pinion, by default none.

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

    def __init__(
        self, parameters: HelicalMarchParameters, holder: SpeedHolder | None = None
    ) -> None:
        self.parameters = parameters
        made = assemble(*helical_pair(parameters, holder), parameters.oil, kinds=())
        of_pair = float(parameters.pair.pinion_teeth), bearing_shares(parameters)
        self._of_pair = FREE[parameters.form], *of_pair
        super().__init__(
            made,
            output_names=OUTPUT_NAMES,
            control=StepControl(0.0, 0.0, 1.0),
            oil=parameters.oil,
            torque_limits=torque_limits(parameters),
            ranges=parameters.ranges,
            words=WORDS,
            holder=holder,
        )

    _status = staticmethod(state_status)

    @property
    def _least_rate(self) -> float:
        return float(self._control_values[1] * self._control_values[2])

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
        found = np.zeros(len(OUTPUT_NAMES))
        write_derivatives(self._exchanged(s), found)
        return found[RATES : RATES + len(STATE_PLACES)]

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising.

        Raises
        ------
        ConvergenceError
            When they are not finite.
        """
        try:
            squares = np.linalg.eigvals(self._stiffness()).real
        except np.linalg.LinAlgError:
            raise ConvergenceError(f"{NO_FREQUENCIES_WORDS}.") from None
        # the lowest is the rotation of both members together
        return np.sqrt(np.maximum(np.sort(squares)[1:], 0.0)) / (2.0 * np.pi)

    def _start(self, speed: float) -> int:
        """Find the equilibrium at mesh phase zero; the wheel turns in the ratio of the teeth."""
        put_speed(-speed, self._work)  # the pinion turns about -z of the train
        return int(self._call(START, self._state, float(self.parameters.steps_per_highest_period)))

    def _step_control(self, rate: float) -> StepControl:
        """Tie the step to the highest mode with all lines in contact, loaded or not."""
        given = self.parameters
        per_period = float(given.steps_per_highest_period)
        return StepControl(float(given.steps_per_mesh_period), per_period, rate / per_period)

    def _gather(self) -> None:
        write_pair(self._state, *self._of_pair, self._work, self._outputs)
