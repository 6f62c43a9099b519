"""The pair as an object: initialise, step, read outputs, save and restore the state."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from gearlube_core.checks import check_finite, check_within
from gearlube_core.dynamics.helical_pair.communication import communication_step
from gearlube_core.dynamics.helical_pair.film_refresh import refresh_friction
from gearlube_core.dynamics.helical_pair.integrate import (
    NOT_FINITE,
    OK,
    TOO_MANY_STEPS,
    StepControl,
    work_size,
)
from gearlube_core.dynamics.helical_pair.march_constants import MarchConstants
from gearlube_core.dynamics.helical_pair.march_mesh import mesh_at_torque, pack_march_mesh
from gearlube_core.dynamics.helical_pair.march_parameters import Body, HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.march_rates import march_rates
from gearlube_core.dynamics.helical_pair.output_names import N_OUTPUTS
from gearlube_core.dynamics.helical_pair.outputs import write_outputs
from gearlube_core.dynamics.helical_pair.state import (
    FLANK_POINTS,
    LOAD_TORQUE,
    MU,
    N_LATERAL,
    N_ODE,
    N_STATE,
    PSI,
    REFRESHED,
    U_P,
    V_P,
    W_G,
    W_P,
)
from gearlube_core.dynamics.helical_pair.supports import bearing_matrix, support_damping
from gearlube_core.errors import ConvergenceError, StepError
from gearlube_core.flat_tuples import flatten
from gearlube_core.rheology.lubricant_state import lubricant_state

Array = NDArray[np.float64]

MAX_TORQUE = 1e5  # N.m on either shaft
MAX_SPEED = 5e3  # rad/s
MAX_STEP = 0.1  # s, communication step
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
        self._oil_range = parameters.oil.temperature_low, parameters.oil.temperature_high
        self._flat_constants = flatten(self.constants)
        self._bearings = np.concatenate(
            [
                _bearing_rows(body, parameters.support_damping_ratio)
                for body in (parameters.pinion, parameters.gear)
            ]
        )
        self._state = np.zeros(N_STATE)
        self._trial = np.zeros(N_STATE)
        self._outputs = np.zeros(N_OUTPUTS)
        self._work = np.zeros(work_size(self.mesh.density.shape[1]))
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
            self._settle(pinion_torque, pinion_speed, oil_temperature)
        except ConvergenceError:
            self._take(before)
            raise
        self._control_values[:] = self._step_control()
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
            self._flat_constants,
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
        slope = np.zeros(N_ODE)
        density, offset, least = self._mesh_at(full[LOAD_TORQUE])
        torque_p, torque_g, _ = self._inputs.tolist()
        march_rates(
            full, torque_p, torque_g, density, offset, self.mesh.station, least,
            self._flat_constants, slope,
        )  # fmt: skip
        return slope

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

    def _mesh_at(self, torque: float) -> tuple[Array, Array, float]:
        mesh = self.mesh
        density, offset = np.zeros((2, mesh.density.shape[1]))
        least = mesh_at_torque(torque, mesh.torque, mesh.density, mesh.offset, density, offset)
        return density, offset, least

    def _settle(self, pinion_torque: float, pinion_speed: float, oil_temperature: float) -> None:
        """Find displacements, tilts and transmission error of static equilibrium."""
        s = self._state
        p = self.constants
        plane = p.motion.flanks.plane
        density, offset, least = self._mesh_at(s[LOAD_TORQUE])
        oil = lubricant_state(p.oil, oil_temperature)
        slope = np.zeros(N_ODE)
        free = self._free()
        unknowns = np.r_[PSI, U_P + free]
        rows = np.r_[W_P, V_P + free]
        trial = s.copy()
        scale = 1.0 / np.r_[p.motion.pinion.mobility_r, self._mobilities()[free]]
        scale[0] /= plane.r_bp

        def residual(u: Array) -> Array:
            trial[unknowns] = 1e-6 * u
            march_rates(
                trial,
                pinion_torque,
                0.0,
                density,
                offset,
                self.mesh.station,
                least,
                self._flat_constants,
                slope,
            )
            return np.asarray(scale * slope[rows])

        force = pinion_torque / plane.r_bp
        guess = np.zeros(unknowns.size)
        guess[0] = 1e6 * force / (plane.W * float(np.mean(density))) * 2.0
        if pinion_torque < 0.0:
            guess[0] -= 1e6 * p.motion.flanks.backlash / plane.cos_b
        worst = np.inf
        for _ in range(3):  # with the friction of the film, which depends on the loads
            found = root(residual, guess, method="hybr", options={"xtol": 1e-13})
            guess = found.x
            worst = float(np.max(np.abs(residual(found.x))))
            s[unknowns] = 1e-6 * found.x
            s[W_P] = pinion_speed
            if p.friction_form > 0.0:
                s[REFRESHED] = -1.0
                refresh_friction(s, density, offset, self.mesh.station, least, oil, p)
            # at speed for the direction of friction; without losses in the supports
            trial[:] = s
            trial[W_P] = pinion_speed
            trial[W_G] = pinion_speed * p.motion.flanks.plane.r_bp / p.motion.flanks.plane.r_bg
        s[W_G] = pinion_speed * p.motion.flanks.plane.r_bp / p.motion.flanks.plane.r_bg
        if not worst <= 1e-6 * max(abs(force), 1.0):
            raise ConvergenceError(
                f"no static equilibrium at a pinion torque of {pinion_torque:g} N.m: forces are "
                f"out by {worst:g} N. Reduce the torque or stiffen the supports."
            )

    def _free(self) -> NDArray[np.intp]:
        """Return which of the ten lateral motions are free."""
        return np.flatnonzero(self._mobilities() > 0.0)

    def _mobilities(self) -> Array:
        p = self.constants
        return np.array(
            [
                value
                for k in (p.motion.pinion, p.motion.gear)
                for value in (k.mobility, k.mobility, k.mobility_z, k.mobility_a, k.mobility_a)
            ]
        )

    def natural_frequencies(self) -> Array:
        """Return the undamped natural frequencies about the present state [Hz], rising."""
        free = self._free()
        places = np.r_[PSI, U_P + free]
        rows = np.r_[W_P, W_G, V_P + free]
        p = self.constants
        base = self._state[:N_ODE].copy()
        base[V_P : V_P + N_LATERAL] = 0.0
        base[W_G] = base[W_P] * p.motion.flanks.plane.r_bp / p.motion.flanks.plane.r_bg
        step = 1e-8  # m and rad: small against micrometres of deflection
        columns = []
        for place in places:
            high, low = base.copy(), base.copy()
            high[place] += step
            low[place] -= step
            columns.append((self.derivative(high)[rows] - self.derivative(low)[rows]) / (2 * step))
        slope = np.array(columns).T
        relative = p.motion.flanks.plane.r_bp * slope[0] - p.motion.flanks.plane.r_bg * slope[1]
        matrix = -np.vstack([relative, slope[2:]])
        squares = np.linalg.eigvals(matrix)
        return np.sort(np.sqrt(np.maximum(squares.real, 0.0))) / (2.0 * np.pi)

    def _step_control(self) -> StepControl:
        """Tie the step to the highest mode, with the mesh as stiff as its lines can be."""
        parameters = self.parameters
        frequency = float(self.natural_frequencies()[-1])
        return StepControl(
            float(parameters.steps_per_mesh_period),
            float(parameters.steps_per_highest_period),
            max(frequency, 1.0),
        )

    def _write_outputs(self) -> None:
        pinion_torque, wheel_torque, oil_temperature = self._inputs.tolist()
        write_outputs(
            self._state,
            pinion_torque,
            wheel_torque,
            oil_temperature,
            *self.mesh,
            self._flat_constants,
            self._bearings,
            self._work,
            self._outputs,
        )


def _bearing_rows(body: Body, ratio: float) -> Array:
    """Return K_x, K_x_ay, K_y, K_y_ax, K_z, c_x, c_y, c_z of both bearings of a member.

    The member's damping is shared in the ratio of the bearings' stiffness.
    """
    support = body.support
    c = support_damping(support, body.mass, body.inertia, ratio, False)
    matrices = []
    for bearing in (support.first, support.second):
        T = np.eye(6)
        T[0, 4], T[1, 3] = bearing.position, -bearing.position
        matrices.append(bearing_matrix(bearing, support.shaft) @ T)
    total = np.array([sum(K[i, i] for K in matrices) for i in range(3)])
    rows = [
        np.r_[K[0, 0], K[0, 4], K[1, 1], K[1, 3], K[2, 2], c[:3] * np.diag(K)[:3] / total]
        for K in matrices
    ]
    return np.concatenate(rows)
