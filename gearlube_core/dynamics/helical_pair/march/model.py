"""The pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearlube_core.checks import check_finite, check_within
from gearlube_core.dynamics.helical_pair.march.bearing_shares import bearing_shares
from gearlube_core.dynamics.helical_pair.march.communication import communication_step
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants
from gearlube_core.dynamics.helical_pair.march.equilibrium import (
    MarchRates,
    natural_frequencies,
    settle,
)
from gearlube_core.dynamics.helical_pair.march.integrate import (
    NOT_FINITE,
    OK,
    TOO_MANY_STEPS,
    WORK_SIZE,
    StepControl,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import pack_march_mesh, pair_data
from gearlube_core.dynamics.helical_pair.march.output_names import N_OUTPUTS
from gearlube_core.dynamics.helical_pair.march.outputs import write_outputs
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
from gearlube_core.errors import ConvergenceError, StepError
from gearlube_core.flat_tuples import flatten

Array = NDArray[np.float64]

MAX_TORQUE = 1e5  # N.m on either shaft
MAX_SPEED = 5e3  # rad/s
MAX_STEP = 0.1  # s, communication step
_FULL_CONTACT = 1e-5  # m, compression at which all lines touch
_N_INPUTS = 3
_MESSAGES = {
    NOT_FINITE: (
        "the state is no longer finite or the teeth have parted by more than 0.1 m. "
        "Reduce the torques"
    ),
    TOO_MANY_STEPS: (
        "the step needs more than 1000000 integrator steps. Shorten the communication step"
    ),
}


class HelicalPairModel:
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
    He et al. 2007.
    """

    def __init__(self, parameters: HelicalMarchParameters) -> None:
        self.parameters = parameters
        self.constants: MarchConstants = parameters.constants()
        self.mesh = pack_march_mesh(parameters.mesh)
        self._data = pair_data(self.constants, parameters.mesh)
        self._rates = MarchRates(self.constants, self.mesh, self._data)
        self._oil_range = parameters.oil.temperature_low, parameters.oil.temperature_high
        self._bearings = np.concatenate(
            [
                bearing_shares(body, parameters.support_damping_ratio)
                for body in (parameters.pinion, parameters.gear)
            ]
        )
        self._state = np.zeros(N_STATE)
        self._trial = np.zeros(N_STATE)
        self._outputs = np.zeros(N_OUTPUTS)
        self._work = np.zeros(WORK_SIZE)
        self._control_values = flatten(StepControl(0.0, 0.0, 1.0))
        self._inputs = np.zeros(_N_INPUTS)
        self.outputs: Array = self._outputs.view()
        self.outputs.flags.writeable = False
        self.state_view: Array = self._state.view()
        self.state_view.flags.writeable = False

    @property
    def step_control(self) -> StepControl:
        """What the integrator step is tied to."""
        return StepControl(*self._control_values.tolist())

    def initialise(
        self,
        *,
        pinion_speed: float,
        pinion_torque: float,
        wheel_torque: float,
        oil_temperature: float,
    ) -> None:
        """Put the pair into static equilibrium under the pinion torque, turning.

        The equilibrium is that at mesh phase zero; the gear turns in the ratio of the teeth.

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
        s = self._state
        s[:] = 0.0
        s[LOAD_TORQUE] = abs(pinion_torque)
        s[MU : MU + 2 * FLANK_POINTS] = self.constants.mu
        s[REFRESHED] = -1.0
        self._inputs[:] = pinion_torque, wheel_torque, oil_temperature
        try:
            settle(s, pinion_torque, pinion_speed, oil_temperature, self._rates)
        except ConvergenceError:
            self._take(before)
            raise
        self._control_values[:] = self._step_control(pinion_torque, oil_temperature)
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
            When the step cannot be made; the pair is then as before the step.
        """
        if not 0.0 < h <= MAX_STEP:
            check_finite("step size", h, "s")
            raise StepError(
                f"step size must be above 0 and at most {MAX_STEP:g} s, got {h:g} s. "
                "A communication step of about 1e-4 s resolves the mesh frequency."
            )
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature)
        status = communication_step(
            self._state,
            self._trial,
            h,
            pinion_torque,
            wheel_torque,
            oil_temperature,
            *self.mesh,
            self._data,
            self._bearings,
            self._control_values,
            self._work,
            self._outputs,
        )
        if status != OK:
            raise StepError(f"step of {h:g} s refused: {_MESSAGES[status]}.")
        inputs = self._inputs
        inputs[0] = pinion_torque
        inputs[1] = wheel_torque
        inputs[2] = oil_temperature

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

    def get_state(self) -> Array:
        """Return everything that the future depends on, shape (N_STATE + 6,)."""
        return np.concatenate([self._state, self._inputs, self._control_values])

    def set_state(self, state: Array) -> None:
        """Continue from what `get_state` returned; bit-exact.

        Raises
        ------
        StepError
            When the array has the wrong length or holds a NaN; the pair is then as before.
        """
        values = np.asarray(state, dtype=np.float64)
        size = N_STATE + _N_INPUTS + len(StepControl._fields)
        if values.shape != (size,) or not np.all(np.isfinite(values)):
            raise StepError(
                f"a state of the pair has {size} finite numbers, got shape {values.shape}. "
                "Use an array from get_state of the same release."
            )
        control = StepControl(*values[N_STATE + _N_INPUTS :].tolist())
        if min(control) <= 0.0:
            raise StepError(
                f"a state of the pair must have step control values above 0, got {control}. "
                "Use an array from get_state after initialise."
            )
        self._take(values)
        self._write_outputs()

    def _take(self, values: Array) -> None:
        self._state[:] = values[:N_STATE]
        self._inputs[:] = values[N_STATE : N_STATE + _N_INPUTS]
        self._control_values[:] = values[N_STATE + _N_INPUTS :]

    def _check_inputs(self, pinion_torque: float, wheel_torque: float, oil: float) -> None:
        low, high = self._oil_range
        limit = MAX_TORQUE
        if abs(pinion_torque) <= limit and abs(wheel_torque) <= limit and low <= oil <= high:
            return  # the usual case, thousands of times a second
        check_within("pinion.torque", pinion_torque, -limit, limit, "N.m", "Check the unit.")
        check_within("wheel.torque", wheel_torque, -limit, limit, "N.m", "Check the unit.")
        self.parameters.oil.check_temperature(oil, "oil.temperature")

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising."""
        return natural_frequencies(self._state, self._rates)

    def _step_control(self, pinion_torque: float, oil_temperature: float) -> StepControl:
        """Tie the step to the highest mode with all lines in contact, loaded or not."""
        parameters = self.parameters
        plane = self.constants.motion.flanks.plane
        pressed = plane.r_bp * plane.W * float(np.mean(self.mesh.density)) * _FULL_CONTACT
        state = self._state
        if abs(pinion_torque) < pressed:
            state = state.copy()
            torque = -pressed if pinion_torque < 0.0 else pressed
            settle(state, torque, float(state[W_P]), oil_temperature, self._rates)
        return StepControl(
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            float(natural_frequencies(state, self._rates)[-1]),
        )

    def _write_outputs(self) -> None:
        pinion_torque, wheel_torque, oil_temperature = self._inputs.tolist()
        write_outputs(
            self._state,
            pinion_torque,
            wheel_torque,
            oil_temperature,
            *self.mesh,
            self._data,
            self._bearings,
            self._work,
            self._outputs,
        )
