"""Fixed-step RK4 over one communication interval, friction refreshed between: kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    N_FRICTION,
    MarchConstants,
)
from gearlube_core.dynamics.helical_pair.march.jumps import (
    LOAD_FILTER_TIME,
    LOAD_REACH,
    REFRESH_COST,
    SOLVED_REFRESH_COST,
    STATIONS,
    time_to_jump,
)
from gearlube_core.dynamics.helical_pair.march.line_points import refresh_friction
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    LEAST_OFFSET,
    MeshFields,
    laws_of_oil,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import (
    LOAD_TORQUE,
    N_ENERGIES,
    N_ODE,
    N_STATE,
    PINION_WORK,
    PSI,
    REFRESHED,
    TIME_IN_STEP,
    W_G,
    W_P,
    WORK_MARK,
    pair_motion,
)
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import lubricant_state

OK = 0
NOT_FINITE = 1
TOO_MANY_STEPS = 2
TOO_FAST = 3

# Steps in one communication interval, or their cost: 0.7 s of computing; see STATIONS
MAX_STEPS = 150_000
DIVERGED = 0.1  # m along the line of action: teeth long broken


class StepControl(NamedTuple):
    """What the integrator step is tied to."""

    steps_per_mesh_period: float
    steps_per_highest_period: float
    highest_frequency: float  # Hz


WORK_SIZE = N_STATE + 2 * N_ODE  # work array of `advance` and `write_outputs`


@kernel
def step_rate(p: MarchConstants, control: StepControl, pinion_speed: float) -> float:
    """Return the least number of integrator steps a second: by mesh period and highest mode."""
    mesh = p.teeth * abs(pinion_speed) / (2.0 * math.pi)
    return max(
        mesh * control.steps_per_mesh_period,
        control.highest_frequency * control.steps_per_highest_period,
    )


@kernel
def rk4_step(
    s: Array,
    h: float,
    pinion_torque: float,
    wheel_torque: float,
    data: Array,
    stages: Array,
) -> None:
    """Advance `s` by `h` [s] with the classic fourth-order Runge-Kutta scheme.

    Friction coefficients stay as they are in `s`. `stages` is work space of shape
    (N_STATE + 2 N_ODE,), whose first N_STATE hold the coefficients too. See `march_rates`.
    """
    trial = stages[0:N_STATE]
    slope = stages[N_STATE : N_STATE + N_ODE]
    total = stages[N_STATE + N_ODE : N_STATE + 2 * N_ODE]
    march_rates(s, pinion_torque, wheel_torque, data, slope)
    for i in range(N_ODE):
        total[i] = slope[i]
        trial[i] = s[i] + 0.5 * h * slope[i]
    march_rates(trial, pinion_torque, wheel_torque, data, slope)
    for i in range(N_ODE):
        total[i] += 2.0 * slope[i]
        trial[i] = s[i] + 0.5 * h * slope[i]
    march_rates(trial, pinion_torque, wheel_torque, data, slope)
    for i in range(N_ODE):
        total[i] += 2.0 * slope[i]
        trial[i] = s[i] + h * slope[i]
    march_rates(trial, pinion_torque, wheel_torque, data, slope)
    for i in range(N_ODE):
        s[i] += h / 6.0 * (total[i] + slope[i])


@kernel
def advance(
    s: Array,
    duration: float,
    inputs: Array,
    mesh: MeshFields,
    data: Array,
    control_values: Array,
    work: Array,
) -> int:
    """Advance the pair by `duration` [s] under constant inputs; return a status.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        Changed in place, also when the status is not OK.
    duration : float
        Communication step [s].
    inputs : ndarray of shape (3,)
        Torques of pinion and wheel [N.m], oil temperature [K].
    mesh : tuple
        Line mesh at all levels, the fields of `mesh_data.MarchMesh`.
    data : ndarray
        Pair data; the mesh in it is brought to the present level.
    control_values : ndarray
        Flattened StepControl.
    work : ndarray of shape (WORK_SIZE,)

    Returns
    -------
    int
        OK, NOT_FINITE, TOO_MANY_STEPS or TOO_FAST.

    Notes
    -----
    The level of the line mesh follows the pinion torque with LOAD_FILTER_TIME, to a thousandth. A
    change of level changes the springs' energy by what `energy.stored` shows.
    """
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    control: StepControl = tuple_from_array(control_values, StepControl)
    stages = work
    pinion_torque, wheel_torque = inputs[0], inputs[1]
    mesh_at_torque(s[LOAD_TORQUE], mesh, data)
    oil = lubricant_state(p.oil, inputs[2], laws_of_oil(*mesh))
    wanted = duration * step_rate(p, control, s[W_P])
    if not wanted < MAX_STEPS:
        return TOO_MANY_STEPS
    steps = max(1, math.ceil(wanted))
    h = duration / steps
    for i in range(N_ENERGIES):
        s[WORK_MARK + i] = s[PINION_WORK + i]
    s[TIME_IN_STEP] = duration
    for i in range(N_STATE):
        stages[i] = s[i]
    at_load = s[LOAD_TORQUE]
    refresh_cost = SOLVED_REFRESH_COST if p.film == SOLVED else REFRESH_COST
    step_cost = max(1.0, p.motion.flanks.stations / STATIONS)
    follows = -math.expm1(-h / LOAD_FILTER_TIME)
    cost = 0.0
    for _ in range(steps):
        if abs(s[LOAD_TORQUE] - at_load) > LOAD_REACH * (1.0 + at_load):
            at_load = s[LOAD_TORQUE]
            mesh_at_torque(at_load, mesh, data)
        rest = h
        while rest > 0.0:
            cost += step_cost
            if cost > MAX_STEPS:
                return TOO_MANY_STEPS
            m = pair_motion(s)
            if p.friction_form > 0.0 and refresh_friction(
                m, part(s, REFRESHED, N_FRICTION), data, oil
            ):
                cost += refresh_cost
                for i in range(N_ODE, N_STATE):
                    stages[i] = s[i]
            piece = min(rest, time_to_jump(m, data[LEAST_OFFSET], p.motion.flanks))
            rk4_step(s, piece, pinion_torque, wheel_torque, data, stages)
            rest -= piece
        s[LOAD_TORQUE] += follows * (abs(pinion_torque) - s[LOAD_TORQUE])
        if max(abs(s[W_P]), abs(s[W_G])) > MAX_SPEED:
            return NOT_FINITE if abs(s[PSI]) > DIVERGED else TOO_FAST
    total = 0.0
    for i in range(N_ODE):
        total += abs(s[i])
    if not total < math.inf or abs(s[PSI]) > DIVERGED:
        return NOT_FINITE
    return OK
