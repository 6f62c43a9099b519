"""The axle as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import RollerFilms
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.force_derivatives import CONTROL_WORK, NO_MODES_WORDS
from gearlube_core.dynamics.hypoid_axle.integrate import (
    MAX_STEPS,
    NOT_FINITE,
    TOO_FAST,
    TOO_MANY_STEPS,
    StepControl,
    step_inputs,
    work_size,
)
from gearlube_core.dynamics.hypoid_axle.output_names import (
    OUTPUT_NAMES,
)
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, axle_raceways, axle_rhs
from gearlube_core.dynamics.hypoid_axle.start import NO_EQUILIBRIUM_CURE, OK, REST_WORK
from gearlube_core.dynamics.hypoid_axle.state import LOAD_TORQUE, N_ODE, N_STATE, SIDE
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import (
    AxleParameters,
    without_losses,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshFields,
    MeshLevels,
    blend_mesh,
    place_at_load,
)
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.packed_mesh import PackedMesh, pack_mesh
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
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.kernels.flat_tuples import flatten

MAX_TORQUE = 1e4  # N.m at the pinion: far beyond any car axle
MAX_WHEEL_TORQUE = 3e4  # N.m
START_WORK = max(REST_WORK, CONTROL_WORK)
STEP_REFUSALS = {
    NOT_FINITE: (
        "the axle state is no longer finite or the teeth have parted by more than 0.1 m. "
        "Reduce the torques or check for an unstable option (equations='as_printed')"
    ),
    TOO_MANY_STEPS: too_many_steps_words(MAX_STEPS),
    TOO_FAST: TOO_FAST_WORDS,
    TOO_FAR: TOO_FAR_WORDS,
}
MARCH_WITH_WARM_FLANKS = (
    "flank_bulk_resistance must be 0 K/W in a march in time: teeth warm up in minutes, a march "
    "lasts a second. Take `gearlube map` or `gearlube cycle`, which use mean losses, or leave "
    "film.bulk_resistance_k_w out."
)
_WORDS = Words("axle", "the bearing modes", STEP_REFUSALS)


def torque_limits(parameters: HypoidAxleParameters) -> TorqueLimits:
    """Return the torques beyond which a step of the axle is refused."""
    return TorqueLimits.around(
        parameters.torque_range, parameters.mesh.ratio, MAX_TORQUE, MAX_WHEEL_TORQUE
    )


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
    share nothing.

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
        self.packed: PackedMesh = pack_mesh(
            parameters.mesh,
            contact_modulus(parameters.solid, parameters.solid),
            parameters.radii,
            parameters.mesh_stiffness,
            parameters.friction_law.pressure,
        )
        self.kernel_parameters: AxleParameters = parameters.kernel_parameters()
        self._film_models = parameters.film_model(), parameters.roller_model()
        self._laws = parameters.oil.own_laws()
        super().__init__(
            states=N_STATE,
            output_names=OUTPUT_NAMES,
            control=StepControl(0.0, 0.0, 1.0, 1.0, 0.0),
            oil=parameters.oil,
            torque_limits=torque_limits(parameters),
            ranges=parameters.ranges,
            words=_WORDS,
        )

    def _with_data(self) -> Kernels:
        mesh = self.packed
        fields: MeshFields = (*mesh.fields, *self._film_models, *self._laws)
        data = fields, flatten(self.kernel_parameters)
        work, rollers = np.zeros(work_size(mesh.series_size, mesh.nodes)), np.zeros(ROLLERS_MAX)
        p = self.kernel_parameters
        kernels = self._start_kernels = axle_kernels(type(p.bearing_p), type(p.flank_law))
        self._start_data = fields, flatten(without_losses(p)), np.zeros(START_WORK)
        return Kernels(
            kernels.communication_step,
            (*data, self._control_values, work, rollers, self._outputs),
            kernels.outputs,
            (*data, work, rollers, self._outputs),
        )

    @property
    def highest_frequency(self) -> float:
        """Highest natural frequency at the initial load [Hz]; 1 before `initialise`."""
        return self.step_control.highest_frequency

    def derivative(self, state: Array) -> Array:
        """Return d/dt of the N_ODE integrated states, for any other integrator.

        The inputs, the load level and the side of the mesh table are those of the last step.

        Parameters
        ----------
        state : ndarray of shape (N_ODE,)
            In the units of `state`.
        """
        mesh = self.packed
        p = self.kernel_parameters
        full = self._state.copy()
        full[:N_ODE] = state
        torque_p, torque_g, oil_temperature = self._inputs.tolist()
        table = MeshLevels(*mesh.fields, *self._film_models, *self._laws)
        oil = self.parameters.oil.state(oil_temperature)
        at_load = place_at_load(table, np.zeros(mesh.series_size), np.zeros(mesh.window_size))
        blend_mesh(full[LOAD_TORQUE], full[SIDE], table, at_load)
        slope = np.zeros(N_ODE)
        scratch = np.zeros(SCRATCH)
        exact = RollerFilms(table.roller_model, scratch[:0], 0.0)
        raceways = axle_raceways(full, oil, p, exact)
        inputs = step_inputs(full, torque_p, torque_g, oil, p, raceways)
        axle_rhs(full, inputs, at_load, oil, p, 1.0, 1.0, scratch, slope)
        return slope

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        status, error = self._start_kernels.static_state(
            self._state, speed, self._inputs, *self._start_data
        )
        if status != OK:
            raise ConvergenceError(
                f"no static equilibrium at a pinion torque of {torque:g} N.m: bearing forces are "
                f"out by {error:g} N. {NO_EQUILIBRIUM_CURE}"
            )

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        parameters = self.parameters
        values = np.zeros(len(StepControl._fields))
        status = self._start_kernels.step_control(
            self._state,
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            self._inputs,
            *self._start_data,
            values,
        )
        if status != OK:
            raise ConvergenceError(NO_MODES_WORDS)
        return StepControl(*values.tolist())
