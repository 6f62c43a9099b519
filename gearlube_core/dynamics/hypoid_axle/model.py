"""The axle as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np
from scipy.optimize import root

from gearlube_core.arrays import Array
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.integrate import (
    NOT_FINITE,
    TOO_FAST,
    TOO_MANY_STEPS,
    StepControl,
    step_inputs,
    work_size,
)
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.linearise import linearise
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import (
    MeshAtLoad,
    MeshFields,
    MeshLevels,
    blend_mesh,
)
from gearlube_core.dynamics.hypoid_axle.outputs import OUTPUT_NAMES
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
from gearlube_core.dynamics.stepped_model import (
    TOO_FAST_WORDS,
    Kernels,
    SteppedModel,
    TorqueLimits,
    Words,
)
from gearlube_core.errors import ConvergenceError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.kernels import N_SERIES, blend_levels, load_bracket
from gearlube_core.oil.lubricant_state import lubricant_state

MAX_TORQUE = 1e4  # N.m at the pinion: far beyond any car axle
MAX_WHEEL_TORQUE = 3e4  # N.m
_WORDS = Words(
    "axle",
    "the bearing modes",
    {
        NOT_FINITE: (
            "the axle state is no longer finite or the teeth have parted by more than 0.1 m. "
            "Reduce the torques or check for an unstable option (equations='as_printed')"
        ),
        TOO_MANY_STEPS: (
            "the step needs more than 1000000 integrator steps. Shorten the communication step"
        ),
        TOO_FAST: TOO_FAST_WORDS,
    },
)


class HypoidAxle(SteppedModel[StepControl]):
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
    [mohammadpour_2015]

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.parameters import mohammadpour_2015_axle
    >>> axle = HypoidAxle(mohammadpour_2015_axle())
    >>> axle.initialise(
    ...     pinion_speed=209.4, pinion_torque=50.0, wheel_torque=140.0, oil_temperature=333.15
    ... )
    >>> axle.step(1e-4, 50.0, 140.0, 333.15)
    >>> round(axle.output("mesh.force"), 1)  # N
    2400.1
    """

    def __init__(self, parameters: HypoidAxleParameters) -> None:
        self.parameters = parameters
        self.packed: PackedMesh = pack_mesh(
            parameters.mesh,
            contact_modulus(parameters.solid, parameters.solid),
            parameters.radii,
            parameters.mesh_stiffness,
            parameters.contact_pressure,
        )
        self.kernel_parameters: AxleParameters = parameters.kernel_parameters()
        super().__init__(
            states=N_STATE,
            output_names=OUTPUT_NAMES,
            control=StepControl(0.0, 0.0, 1.0, 1.0, 0.0),
            oil=parameters.oil,
            torque_limits=TorqueLimits.around(
                parameters.torque_range, parameters.mesh.ratio, MAX_TORQUE, MAX_WHEEL_TORQUE
            ),
            ranges=parameters.ranges,
            words=_WORDS,
        )

    def _with_data(self) -> Kernels:
        mesh = self.packed
        fields: MeshFields = (mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
        data = fields, flatten(self.kernel_parameters)
        work, rollers = np.zeros(work_size(mesh.orders, mesh.nodes)), np.zeros(ROLLERS_MAX)
        p = self.kernel_parameters
        kernels = axle_kernels(type(p.bearing_p), type(p.flank_law))
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
        oil = lubricant_state(p.oil, oil_temperature)
        table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
        at_load = MeshAtLoad(
            np.zeros(mesh.series_size), mesh.orders, np.zeros(mesh.window_size), mesh.nodes
        )
        blend_mesh(full[LOAD_TORQUE], full[SIDE], table, at_load)
        slope = np.zeros(N_ODE)
        inputs = step_inputs(full, torque_p, torque_g, oil, p)
        scratch = np.zeros(SCRATCH)
        axle_rhs(full, inputs, at_load, oil, p, 1.0, 1.0, scratch, slope)
        return slope

    def _rest(self, speed: float, torque: float, oil_temperature: float) -> None:
        s = self._state
        s[W_P] = speed
        s[W_G] = speed / self.parameters.mesh.ratio
        s[LOAD_TORQUE] = abs(torque)
        s[SIDE] = -1.0 if torque < 0.0 else 1.0
        self._settle(torque, oil_temperature)

    def _settle(self, pinion_torque: float, oil_temperature: float) -> None:
        """Solve the six displacements and the transmission error for static equilibrium."""
        s = self._state
        p = self.kernel_parameters._replace(friction=0.0)
        mesh = self.packed
        oil = lubricant_state(p.oil, oil_temperature)
        series = self._series_at(pinion_torque)
        slope = np.zeros(N_ODE)
        scratch = np.zeros(SCRATCH)
        inputs = StepInputs(pinion_torque, 0.0, 0.0, 0.0)
        at_load = MeshAtLoad(series, mesh.orders, mesh.windows, mesh.nodes)
        deflection = pinion_torque / series[1] / series[0]
        s[X] = MICRO * (deflection if deflection >= 0.0 else deflection - p.mesh.backlash)
        # at rest: hysteresis and the ratio error's speed play no part in a static state
        speeds = s[W_P], s[W_G]
        free = np.r_[U_P : U_P + 3, U_G : U_G + 3]
        rows = np.r_[V_P : V_P + 3, V_G : V_G + 3]
        at_rest = s.copy()
        at_rest[W_P] = at_rest[W_G] = 0.0
        scale = np.array(3 * [p.m_p] + 3 * [p.m_g])

        def residual(u: Array) -> Array:
            at_rest[free] = u
            axle_rhs(at_rest, inputs, at_load, oil, p, 1.0, 1.0, scratch, slope)
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
