"""The pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.communication import communication_step
from gearlube_core.dynamics.helical_pair.march.equilibrium import (
    EQUILIBRIUM_WORK,
    MAX_UNKNOWNS,
    NO_EQUILIBRIUM,
    OK,
    highest_frequency,
    rest,
    stiffness_over_mass,
)
from gearlube_core.dynamics.helical_pair.march.flanks import MarchConstants
from gearlube_core.dynamics.helical_pair.march.integrate import (
    MAX_STEPS,
    NOT_FINITE,
    TOO_FAST,
    TOO_MANY_STEPS,
    WORK_SIZE,
    StepControl,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    MeshFields,
    mesh_at_torque,
    pack_march_mesh,
    pair_data,
)
from gearlube_core.dynamics.helical_pair.march.outputs import OUTPUT_NAMES, write_outputs
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import LOAD_TORQUE, N_ODE, N_STATE
from gearlube_core.dynamics.ranges import TOO_FAR
from gearlube_core.dynamics.stepped_model import (
    TOO_FAR_WORDS,
    TOO_FAST_WORDS,
    Kernels,
    SteppedModel,
    TorqueLimits,
    Words,
    too_many_steps_words,
)
from gearlube_core.errors import ConvergenceError

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


def torque_limits(parameters: HelicalMarchParameters) -> TorqueLimits:
    """Return the torques beyond which a pair takes no step."""
    return TorqueLimits.around(
        parameters.torque_range, parameters.pair.ratio, MAX_TORQUE, MAX_TORQUE
    )


class HelicalPairModel(SteppedModel[StepControl]):
    """Lubricated helical or spur pair in motion: give torques, step it in time, read its outputs.

    The model has 12 degrees of freedom.

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
        self.constants: MarchConstants = parameters.constants()
        self.mesh = pack_march_mesh(parameters.mesh)
        self._data = pair_data(self.constants, parameters.mesh, parameters.film_model())
        of_mesh = self.mesh.torque, self.mesh.density, self.mesh.offset
        self._fields: MeshFields = (*of_mesh, *parameters.oil.own_laws())
        self._scratch = np.zeros(EQUILIBRIUM_WORK)
        self._bearings = parameters.bearing_shares()
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
        data, work = (self._fields, self._data, self._bearings), np.zeros(WORK_SIZE)
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
        slope = np.zeros(N_ODE)
        mesh_at_torque(full[LOAD_TORQUE], self._fields, self._data)
        pinion_torque, wheel_torque = self._inputs[:2].tolist()
        march_rates(full, pinion_torque, wheel_torque, self._data, slope)
        return slope

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising.

        Raises
        ------
        ConvergenceError
            When they are not finite.
        """
        matrix = np.zeros(MAX_UNKNOWNS**2)
        data = self._fields, self._data, self._scratch
        n = stiffness_over_mass(self._state.copy(), *data, matrix)
        try:
            squares = np.linalg.eigvals(matrix[: n * n].reshape(n, n)).real
        except np.linalg.LinAlgError:
            raise ConvergenceError(f"{NO_FREQUENCIES_WORDS}.") from None
        return np.sort(np.sqrt(np.maximum(squares, 0.0))) / (2.0 * np.pi)

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        """Write the equilibrium at mesh phase zero; the gear turns in the ratio of the teeth."""
        loads = float(torque), float(speed), float(oil_temperature)
        status, worst = rest(self._state, *loads, self._fields, self._data, self._scratch)
        _check_found(status, torque, worst)

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        """Tie the step to the highest mode with all lines in contact, loaded or not."""
        parameters = self.parameters
        data = self._fields, self._data, self._scratch
        s = self._state.copy()
        status, highest = highest_frequency(s, float(torque), float(oil_temperature), *data)
        _check_found(status, torque, highest)
        return StepControl(
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            highest,
        )


def _check_found(status: int, torque: float, worst: float) -> None:
    """Raise ConvergenceError unless the status of a kernel of `equilibrium` is OK."""
    if status == NO_EQUILIBRIUM:
        raise ConvergenceError(
            f"no static equilibrium at a pinion torque of {torque:g} N.m: forces are out "
            f"by {worst:g} N. {NO_EQUILIBRIUM_CURE}."
        )
    if status != OK:
        raise ConvergenceError(f"{NO_FREQUENCIES_WORDS}.")
