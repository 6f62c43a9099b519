"""Fixed-step RK4 over one communication interval, friction refreshed between: kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
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
    N_FRICTION,
    N_ODE,
    N_STATE,
    PINION_WORK,
    PSI,
    REFRESHED,
    TIME_IN_STEP,
    W_G,
    W_P,
    WORK_MARK,
    FlankConstants,
    MarchConstants,
    PairMotion,
    coast_near,
    drive_view,
    pair_motion,
    touches,
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

# Steps in one communication interval, or their cost: 0.7 s of computing. The unit is a step with
# as many stations along a line as the line mesh of he_2007 has.
MAX_STEPS = 150_000
STATIONS = 14.0
REFRESH_COST, SOLVED_REFRESH_COST = 1.0, 4.0  # of friction by the formulas and by solved films
# Relative change of the load level that the line mesh follows at once
LOAD_REACH = 1e-3
# Of a mesh period: vibration moves the phase in a step by less than the first, in a step as long as
# the first by less than the second
NEAR_JUMP, AT_JUMP = 2e-5, 1e-7
LOAD_FILTER_TIME = 0.02  # s, the load level follows the torque below the shafts' own motions
DIVERGED = 0.1  # m along the line of action: teeth long broken


@kernel
def _gap(phase: float, at: float, forward: bool) -> float:
    """Return how far a phase is before `at` in the direction of rotation, 0 to 1."""
    gap = at - phase if forward else phase - at
    return gap - np.floor(gap)


@kernel
def time_to_jump(m: PairMotion, least_offset: float, p: FlankConstants) -> float:
    """Return after what time [s] a step must end because stiffness or friction jump there.

    Lines of spur gears enter, leave and pass the pitch point over their whole length at once. A
    step ends NEAR_JUMP before, a short one AT_JUMP before, and a third one AT_JUMP behind, so that
    all others are smooth. Infinite for helical gears, whose lines come and go by and by.
    """
    plane = p.plane
    if plane.sin_b > 0.0 or m.w_p == 0.0:
        return math.inf
    forward = m.w_p > 0.0
    phase = plane.r_bp * m.phi_p / plane.pitch
    leaving, pitch_point = (plane.D - plane.A) / plane.pitch, (plane.P - plane.A) / plane.pitch
    drives = touches(drive_view(m, p), least_offset, p)
    coasts = coast_near(m, least_offset, p)
    nearest = math.inf
    for at in (0.0, leaving, pitch_point):
        if drives:
            nearest = min(nearest, _gap(phase, at, forward))
        if coasts:
            nearest = min(nearest, _gap(phase, p.coast_phase - at, forward))
    way = nearest + AT_JUMP
    if nearest > 2.0 * NEAR_JUMP:
        way = nearest - NEAR_JUMP
    elif nearest > 2.0 * AT_JUMP:
        way = nearest - AT_JUMP
    return way * plane.pitch / (plane.r_bp * abs(m.w_p))


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
