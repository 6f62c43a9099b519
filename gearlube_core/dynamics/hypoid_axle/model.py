"""The axle as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.checks import check_finite, check_within
from gearlube_core.dynamics.hypoid_axle.communication import communication_step
from gearlube_core.dynamics.hypoid_axle.integrate import (
    NOT_FINITE,
    OK,
    TOO_MANY_STEPS,
    StepControl,
    step_inputs,
    work_size,
)
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.linearise import linearise
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import blend_mesh
from gearlube_core.dynamics.hypoid_axle.output_names import N_OUTPUTS
from gearlube_core.dynamics.hypoid_axle.outputs import write_outputs
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_rhs
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    MICRO,
    N_ODE,
    N_STATE,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.packed_mesh import PackedMesh, pack_mesh
from gearlube_core.errors import ConvergenceError, StepError
from gearlube_core.flat_tuples import flatten
from gearlube_core.materials.solid import contact_modulus
from gearlube_core.mesh_table.kernels import N_SERIES, blend_levels, load_bracket
from gearlube_core.rheology.lubricant_state import lubricant_state

Array = NDArray[np.float64]

MAX_TORQUE = 1e4  # N.m at the pinion: far beyond any car axle
MAX_WHEEL_TORQUE = 3e4  # N.m
MAX_SPEED = 5e3  # rad/s
MAX_STEP = 0.1  # s, communication step
_MESSAGES = {
    NOT_FINITE: (
        "the axle state is no longer finite or the teeth have parted by more than 0.1 m. "
        "Reduce the torques or check for an unstable option (equations='as_printed')"
    ),
    TOO_MANY_STEPS: (
        "the step needs more than 1000000 integrator steps. Shorten the communication step"
    ),
}


class HypoidAxle:
    """Lubricated hypoid axle: 8 DOF, dynamic tapered roller bearings, three flanks.

    Parameters
    ----------
    parameters : HypoidAxleParameters

    Notes
    -----
    Integrated by fixed-step RK4 tied to the mesh period and the highest mode. Same input, same
    bits. Instances share nothing.

    References
    ----------
    Mohammadpour et al. 2015.
    """

    def __init__(self, parameters: HypoidAxleParameters) -> None:
        self.parameters = parameters
        self.packed: PackedMesh = pack_mesh(
            parameters.mesh,
            contact_modulus(parameters.solid, parameters.solid),
            parameters.radii,
            parameters.mesh_stiffness,
        )
        self.kernel_parameters: AxleParameters = parameters.kernel_parameters()
        self._oil_range = parameters.oil.temperature_low, parameters.oil.temperature_high
        mesh = self.packed
        self._mesh_arrays = (mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
        self._flat_parameters = flatten(self.kernel_parameters)
        self._state = np.zeros(N_STATE)
        self._trial = np.zeros(N_STATE)
        self._outputs = np.zeros(N_OUTPUTS)
        self._work = np.zeros(work_size(self.packed.orders, self.packed.nodes))
        self._rollers = np.zeros(ROLLERS_MAX)
        self._control_values = flatten(StepControl(0.0, 0.0, 1.0, 1.0, 0.0))
        self._inputs = np.zeros(3)
        self.outputs: Array = self._outputs.view()
        self.outputs.flags.writeable = False
        self.state_view: Array = self._state.view()
        self.state_view.flags.writeable = False

    @property
    def highest_frequency(self) -> float:
        """Highest natural frequency at the initial load [Hz]; 1 before `initialise`."""
        return self.step_control.highest_frequency

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
        """Put the axle into static equilibrium under the torques, turning at `pinion_speed`.

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
        s[W_P] = pinion_speed
        s[W_G] = pinion_speed / self.parameters.mesh.ratio
        s[LOAD_TORQUE] = abs(pinion_torque)
        s[SIDE] = -1.0 if pinion_torque < 0.0 else 1.0
        self._inputs[:] = pinion_torque, wheel_torque, oil_temperature
        try:
            self._settle(pinion_torque, oil_temperature)
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
            When the step cannot be made; the axle is then as before the step.
        """
        if not 0.0 < h <= MAX_STEP:
            check_finite("step size", h, "s")
            raise StepError(
                f"step size must be above 0 and at most {MAX_STEP:g} s, got {h:g} s. "
                "A communication step of about 1e-4 s resolves the bearing modes."
            )
        self._check_inputs(pinion_torque, wheel_torque, oil_temperature)
        status = communication_step(
            self._state,
            self._trial,
            h,
            pinion_torque,
            wheel_torque,
            oil_temperature,
            *self._mesh_arrays,
            self._flat_parameters,
            self._control_values,
            self._work,
            self._rollers,
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
        oil = lubricant_state(p.oil, oil_temperature)
        series = np.zeros(mesh.series_size)
        window = np.zeros(mesh.window_size)
        blend_mesh(
            full[LOAD_TORQUE],
            full[SIDE],
            mesh.levels,
            mesh.series,
            mesh.orders,
            mesh.windows,
            mesh.nodes,
            series,
            window,
        )
        slope = np.zeros(N_ODE)
        inputs = step_inputs(full, torque_p, torque_g, oil, p)
        scratch = np.zeros(SCRATCH)
        axle_rhs(
            full,
            inputs,
            series,
            mesh.orders,
            window,
            mesh.nodes,
            oil,
            p,
            1.0,
            1.0,
            scratch,
            slope,
        )
        return slope

    def get_state(self) -> Array:
        """Return everything that the future depends on, shape (N_STATE + 8,)."""
        return np.concatenate([self._state, self._inputs, self._control_values])

    def set_state(self, state: Array) -> None:
        """Continue from what `get_state` returned; bit-exact.

        Raises
        ------
        StepError
            When the array has the wrong length or holds a NaN; the axle is then as before.
        """
        values = np.asarray(state, dtype=np.float64)
        size = N_STATE + 3 + len(StepControl._fields)
        if values.shape != (size,) or not np.all(np.isfinite(values)):
            raise StepError(
                f"an axle state has {size} finite numbers, got shape {values.shape}. "
                "Use an array from get_state of the same release."
            )
        control = StepControl(*values[N_STATE + 3 :].tolist())
        if min(control[:4]) <= 0.0:
            raise StepError(
                f"an axle state must have step control values above 0, got {control}. "
                "Use an array from get_state after initialise."
            )
        self._take(values)
        self._write_outputs()

    def _take(self, values: Array) -> None:
        self._state[:] = values[:N_STATE]
        self._inputs[:] = values[N_STATE : N_STATE + 3]
        self._control_values[:] = values[N_STATE + 3 :]

    def _check_inputs(self, pinion_torque: float, wheel_torque: float, oil: float) -> None:
        low, high = self._oil_range
        if (
            abs(pinion_torque) <= MAX_TORQUE
            and abs(wheel_torque) <= MAX_WHEEL_TORQUE
            and low <= oil <= high
        ):
            return  # the usual case, thousands of times a second
        limit = MAX_TORQUE
        check_within("pinion.torque", pinion_torque, -limit, limit, "N.m", "Check the unit.")
        limit = MAX_WHEEL_TORQUE
        check_within("wheel.torque", wheel_torque, -limit, limit, "N.m", "Check the unit.")
        self.parameters.oil.check_temperature(oil, "oil.temperature")

    def _settle(self, pinion_torque: float, oil_temperature: float) -> None:
        """Solve the six displacements and the transmission error for static equilibrium."""
        s = self._state
        p = self.kernel_parameters._replace(friction_form=-1.0)
        mesh = self.packed
        oil = lubricant_state(p.oil, oil_temperature)
        series = self._series_at(pinion_torque)
        slope = np.zeros(N_ODE)
        scratch = np.zeros(SCRATCH)
        inputs = StepInputs(pinion_torque, 0.0, 0.0, 0.0)
        deflection = pinion_torque / series[1] / series[0]
        s[X] = MICRO * (deflection if deflection >= 0.0 else deflection - p.backlash)
        # at rest: hysteresis and the ratio error's speed play no part in a static state
        speeds = s[W_P], s[W_G]
        free = np.r_[U_P : U_P + 3, U_G : U_G + 3]
        rows = np.r_[V_P : V_P + 3, V_G : V_G + 3]
        at_rest = s.copy()
        at_rest[W_P] = at_rest[W_G] = 0.0
        scale = np.array(3 * [p.m_p] + 3 * [p.m_g])

        def residual(u: Array) -> Array:
            at_rest[free] = u
            axle_rhs(
                at_rest,
                inputs,
                series,
                mesh.orders,
                mesh.windows,
                mesh.nodes,
                oil,
                p,
                1.0,
                1.0,
                scratch,
                slope,
            )
            return scale * slope[rows]

        force = max(abs(pinion_torque / series[1]), 1.0)
        found = root(residual, np.zeros(6), method="hybr", options={"xtol": 1e-12})
        worst = float(np.max(np.abs(residual(found.x))))
        if worst > 1e-4 * force:
            raise ConvergenceError(
                f"no static equilibrium at a pinion torque of {pinion_torque:g} N.m: bearing "
                f"forces are out by {worst:g} N. Increase the bearing preload or reduce the torque."
            )
        s[free] = found.x
        s[W_P], s[W_G] = speeds

    def _series_at(self, torque: float) -> Array:
        """Return the series' means at a load as packed coefficients without harmonics."""
        mesh = self.packed
        means = np.zeros(mesh.series_size)
        bracket = load_bracket(torque, float(np.sign(torque)), mesh.levels, mesh.levels.size)
        blend_levels(mesh.series, mesh.series_size, bracket, means)
        means[N_SERIES:] = 0.0
        return means

    def _step_control(self, torque: float, oil_temperature: float) -> StepControl:
        parameters = self.parameters
        linear = linearise(self, oil_temperature, torque)
        frequencies = linear.modes()[0]
        series = self._series_at(torque)
        p = self.kernel_parameters
        compliance = series[1] ** 2 / p.I_p + series[2] ** 2 / p.I_g + 1.0 / p.m_p + 1.0 / p.m_g
        return StepControl(
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            float(np.max(frequencies)),
            float(series[0]),
            float(compliance),
        )

    def _write_outputs(self) -> None:
        pinion_torque, wheel_torque, oil_temperature = self._inputs.tolist()
        write_outputs(
            self._state,
            pinion_torque,
            wheel_torque,
            oil_temperature,
            *self._mesh_arrays,
            self._flat_parameters,
            self._work,
            self._rollers,
            self._outputs,
        )
