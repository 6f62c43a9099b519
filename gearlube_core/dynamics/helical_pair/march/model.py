"""The pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.communication import communication_step
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants
from gearlube_core.dynamics.helical_pair.march.equilibrium import (
    MarchRates,
    natural_frequencies,
    settle,
)
from gearlube_core.dynamics.helical_pair.march.integrate import (
    NOT_FINITE,
    TOO_FAST,
    TOO_MANY_STEPS,
    WORK_SIZE,
    StepControl,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import pack_march_mesh, pair_data
from gearlube_core.dynamics.helical_pair.march.outputs import OUTPUT_NAMES, write_outputs
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.march.state import (
    FLANK_POINTS,
    LOAD_TORQUE,
    MU,
    N_ODE,
    N_STATE,
    REFRESHED,
    W_P,
)
from gearlube_core.dynamics.stepped_model import (
    TOO_FAST_WORDS,
    Kernels,
    SteppedModel,
    TorqueLimits,
    Words,
)

MAX_TORQUE = 1e5  # N.m on either shaft
_FULL_CONTACT = 1e-5  # m, compression at which all lines touch
_WORDS = Words(
    "pair",
    "the mesh frequency",
    {
        NOT_FINITE: (
            "the state is no longer finite or the teeth have parted by more than 0.1 m. "
            "Reduce the torques"
        ),
        TOO_MANY_STEPS: (
            "the step needs more than 1000000 integrator steps. Shorten the communication step"
        ),
        TOO_FAST: TOO_FAST_WORDS,
    },
)


class HelicalPairModel(SteppedModel[StepControl]):
    """Lubricated helical or spur pair in motion: 12 degrees of freedom.

    Parameters
    ----------
    parameters : HelicalMarchParameters

    Notes
    -----
    The contact lines follow the actual angle of the pinion; flanks press on either side of the
    backlash. Integrated by fixed-step RK4 tied to the mesh period and the highest mode. Same
    input, same bits. Instances share nothing.

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
        self.constants: MarchConstants = parameters.constants()
        self.mesh = pack_march_mesh(parameters.mesh)
        self._data = pair_data(self.constants, parameters.mesh)
        self._rates = MarchRates(self.constants, self.mesh, self._data)
        self._bearings = parameters.bearing_shares()
        super().__init__(
            states=N_STATE,
            output_names=OUTPUT_NAMES,
            control=StepControl(0.0, 0.0, 1.0),
            oil=parameters.oil,
            torque_limits=TorqueLimits.around(
                parameters.torque_range, parameters.pair.ratio, MAX_TORQUE, MAX_TORQUE
            ),
            ranges=parameters.ranges,
            words=_WORDS,
        )

    def _with_data(self) -> Kernels:
        data, work = (tuple(self.mesh), self._data, self._bearings), np.zeros(WORK_SIZE)
        return Kernels(
            communication_step,
            (*data, self._control_values, work, self._outputs),
            write_outputs,
            (*data, work, self._outputs),
        )

    def derivative(self, state: Array) -> Array:
        """Return d/dt of the N_ODE integrated states, for any other integrator.

        Inputs, load level and friction coefficients are those of the last step.

        Parameters
        ----------
        state : ndarray of shape (N_ODE,)
        """
        full = self._state.copy()
        full[:N_ODE] = state
        return self._rates.at(full, *self._inputs[:2].tolist())

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising."""
        return natural_frequencies(self._state, self._rates)

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        """Write the equilibrium at mesh phase zero; the gear turns in the ratio of the teeth."""
        s = self._state
        s[LOAD_TORQUE] = abs(torque)
        s[MU : MU + 2 * FLANK_POINTS] = self.constants.mu
        s[REFRESHED] = -1.0
        settle(s, torque, speed, oil_temperature, self._rates)

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        """Tie the step to the highest mode with all lines in contact, loaded or not."""
        parameters = self.parameters
        plane = self.constants.motion.flanks.plane
        pressed = plane.r_bp * plane.W * float(np.mean(self.mesh.density)) * _FULL_CONTACT
        state = self._state
        if abs(torque) < pressed:
            state = state.copy()
            least = -pressed if torque < 0.0 else pressed
            settle(state, least, float(state[W_P]), oil_temperature, self._rates)
        return StepControl(
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            float(natural_frequencies(state, self._rates)[-1]),
        )
