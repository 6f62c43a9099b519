"""Fixed-step RK4 over one communication interval."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import NO_RACEWAYS, RollerFilms
from gearlube_core.bearings.followed_shaft import DRAG_COST, EXPANSION_REACH, PALMGREN
from gearlube_core.drag import churning_torque, seal_drag
from gearlube_core.dynamics.hypoid_axle.rhs import (
    SCRATCH,
    AxleDrag,
    AxleRaceways,
    StepInputs,
    axle_drag,
    axle_rhs,
    follow_bearings,
    follow_drag,
    follow_flank_of,
    forget_bearings,
    kept_drag,
    mesh_motion,
    parts_of_step,
)
from gearlube_core.dynamics.hypoid_axle.state import (
    DRAG_BOUND,
    FILM_NODES,
    FRICTION_BOUND,
    KEPT_DRAG,
    LOAD_TORQUE,
    N_ENERGIES,
    N_ODE,
    N_STATE,
    PINION_WORK,
    ROLLER_NODES,
    SIDE,
    TIME_IN_STEP,
    W_G,
    W_P,
    WORK_MARK,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import (
    BOUND_POWER,
    FILMS,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import mesh_force, reference_frequency
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.hypoid_mesh.step_parts import (
    LOAD_FILTER_TIME,
    LOAD_REACH,
    MICRO,
    REAL_AXIS_LIMIT,
    contact_parts,
)
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import (
    BETWEEN_NODES,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M
from gearlube_core.oil.lubricant import LubricantState, lubricant_state

OK = 0
NOT_FINITE = 1
TOO_MANY_STEPS = 2
TOO_FAST = 3

MAX_STEPS = 200_000  # in one communication interval, or their cost; half a second of computing
DIVERGED_UM = 1.0e5  # transmission error of 0.1 m: teeth long broken [um]


class StepControl(NamedTuple):
    """What the integrator step is tied to."""

    steps_per_mesh_period: float
    steps_per_highest_period: float
    highest_frequency: float  # Hz, at reference_stiffness
    reference_stiffness: float  # N/m
    compliance_rate: float  # R_p^2/I_p + R_g^2/I_g + 1/m_p + 1/m_g [1/kg]


@kernel
def step_limit(
    p: AxleParameters, control: StepControl, pinion_speed: float, mean_stiffness: float
) -> float:
    """Return the longest integrator step [s].

    A share of the mesh period, a share of the period of the highest mode (which rises at most with
    the root of the mesh stiffness), and the stability limit of the mesh damping.
    """
    mesh = p.mesh.z_p * abs(pinion_speed) / (2.0 * math.pi)
    stiffening = math.sqrt(max(1.0, mean_stiffness / control.reference_stiffness))
    mode = control.highest_frequency * stiffening
    rate = max(mesh * control.steps_per_mesh_period, mode * control.steps_per_highest_period)
    c = p.mesh.modal_damping
    if c == 0.0:
        c = p.mesh.hysteretic_loss * mean_stiffness / reference_frequency(p.mesh, pinion_speed)
    rate = max(rate, c * control.compliance_rate / REAL_AXIS_LIMIT)
    return 1.0 / rate


@kernel
def rk4_step(
    s: Array,
    h: float,
    first: float,
    inputs: StepInputs,
    mesh: MeshAtLoad,
    oil: LubricantState,
    p: AxleParameters,
    scratch: Array,
    stages: Array,
) -> None:
    """Advance `s` by `h` [s] with the classic fourth-order Runge-Kutta scheme.

    Bearing forces follow the expansion in `scratch`. Tractions are evaluated at the first middle
    and the last stage, with `first` also at the first; the stages after these keep them, which lie
    within O(h^2) of them. Everything else is evaluated at every stage.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    scratch : ndarray of shape (SCRATCH,)
    stages : ndarray of shape (N_STATE + 2 N_ODE,)
        Work space. See `axle_rhs` for the others.
    """
    trial = part(stages, 0, N_STATE)
    slope = part(stages, N_STATE, N_ODE)
    total = part(stages, N_STATE + N_ODE, N_ODE)
    axle_rhs(s, inputs, mesh, oil, p, BETWEEN_NODES * first, 0.0, scratch, slope)
    bound = scratch[BOUND_POWER]
    for i in range(N_ODE):
        total[i] = slope[i]
        trial[i] = s[i] + 0.5 * h * slope[i]
    axle_rhs(trial, inputs, mesh, oil, p, BETWEEN_NODES, 0.0, scratch, slope)
    bound += 2.0 * scratch[BOUND_POWER]
    for i in range(N_ODE):
        total[i] += 2.0 * slope[i]
        trial[i] = s[i] + 0.5 * h * slope[i]
    axle_rhs(trial, inputs, mesh, oil, p, 0.0, 0.0, scratch, slope)
    bound += 2.0 * scratch[BOUND_POWER]
    for i in range(N_ODE):
        total[i] += 2.0 * slope[i]
        trial[i] = s[i] + h * slope[i]
    axle_rhs(trial, inputs, mesh, oil, p, BETWEEN_NODES, 0.0, scratch, slope)
    for i in range(N_ODE):
        s[i] += h / 6.0 * (total[i] + slope[i])
    s[FRICTION_BOUND] += h / 6.0 * (bound + scratch[BOUND_POWER])
    s[LOAD_TORQUE] += -math.expm1(-h / LOAD_FILTER_TIME) * (
        abs(inputs.pinion_torque) - s[LOAD_TORQUE]
    )


def work_size(series: int, n_nodes: int) -> int:
    """Return the length of the work array of `advance` and `write_outputs`.

    `series` is the number of series coefficients at one load, `series_size`.
    """
    return N_STATE + 2 * N_ODE + SCRATCH + series + (n_nodes + 1) * N_CHANNELS


@kernel
def step_inputs(
    s: Array,
    pinion_torque: float,
    wheel_torque: float,
    oil: LubricantState,
    p: AxleParameters,
    raceways: AxleRaceways,
) -> StepInputs:
    """Return torques on both shafts and what drags on each; `raceways` as in `axle_drag`."""
    drag = axle_drag(s, oil, p, raceways)
    return inputs_with_drag(s, pinion_torque, wheel_torque, drag, oil, p)


@kernel
def inputs_with_drag(
    s: Array,
    pinion_torque: float,
    wheel_torque: float,
    drag: AxleDrag,
    oil: LubricantState,
    p: AxleParameters,
) -> StepInputs:
    """Return the same with a drag of the bearings that is given."""
    return StepInputs(
        pinion_torque,
        wheel_torque,
        drag.pinion.torque,
        drag.gear.torque,
        churning_torque(s[W_G], oil.nu, p.oil.density, p.churning),
        seal_drag(s[W_P], p.pinion_seal_torque),
        seal_drag(s[W_G], p.wheel_seal_torque),
    )


@kernel
def advance(
    s: Array,
    duration: float,
    torques: tuple[float, float],
    oil_temperature: float,
    table: MeshLevels,
    p: AxleParameters,
    control: StepControl,
    work: Array,
) -> int:
    """Advance the axle by `duration` [s] under constant inputs; return a status.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        Changed in place, also when the status is not OK.
    duration : float
        Communication step [s].
    torques : tuple of 2 floats
        Of pinion and wheel [N.m].
    oil_temperature : float
        [K]
    table : MeshLevels
    p : AxleParameters
    control : StepControl
    work : ndarray of shape (work_size(series_size(table), n_nodes),)

    Returns
    -------
    int
        OK, NOT_FINITE, TOO_MANY_STEPS or TOO_FAST.

    Notes
    -----
    The load level of the mesh table follows the pinion torque with LOAD_FILTER_TIME, and the mesh
    data follow it within LOAD_REACH. The side, drive or coast flanks, is chosen after every
    step or part of one, see `follow_flank`. All this happens at times that integrator steps decide.
    So a communication step matters only as it is a whole number of integrator steps.
    """
    at_scratch = N_STATE + 2 * N_ODE
    at_series = at_scratch + SCRATCH
    at_window = at_series + series_size(table)
    stages = work[0:at_scratch]
    scratch = work[at_scratch:at_series]
    mesh = place_at_load(table, work[at_series:at_window], work[at_window:])
    oil = lubricant_state(p.oil, oil_temperature, table.laws)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], table, mesh)
    wanted = duration / step_limit(p, control, s[W_P], mesh.series[K_M])
    if not wanted < MAX_STEPS:
        return TOO_MANY_STEPS
    steps = max(1, math.ceil(wanted))
    h = duration / steps
    for i in range(N_ENERGIES):
        s[WORK_MARK + i] = s[PINION_WORK + i]
    s[TIME_IN_STEP] = duration
    s[FRICTION_BOUND] = 0.0
    s[DRAG_BOUND] = 0.0
    n_films = N_FILMS if mesh.film_model.size > 0 else 0
    for i in range(n_films):
        scratch[FILMS + i] = s[FILM_NODES + i]
    reach = EXPANSION_REACH / control.steps_per_highest_period**2
    forget_bearings(scratch)
    at_load = s[LOAD_TORQUE]
    rate = mesh_force(mesh_motion(s), mesh.series, mesh.n_orders, p.mesh).x_rate * MICRO
    rollers = RollerFilms(table.roller_model, s[ROLLER_NODES:KEPT_DRAG], 1.0)
    kept = s[KEPT_DRAG:N_STATE]
    cost = 0.0
    first = 1.0
    for _ in range(steps):
        rest = h
        while rest > 0.0:
            # flanks or shafts that leap take a part of the step, whatever its other parts were
            parts = max(contact_parts(s[X], h * rate, p.mesh.backlash * MICRO), parts_of_step(s, h))
            piece = min(rest, h / parts)
            if abs(s[LOAD_TORQUE] - at_load) > LOAD_REACH * (1.0 + max(at_load, abs(torques[0]))):
                at_load = s[LOAD_TORQUE]
                blend_mesh(at_load, s[SIDE], table, mesh)
            follow_bearings(s, piece, reach, oil, p, scratch)
            if p.drag <= PALMGREN:
                drag = axle_drag(s, oil, p, AxleRaceways(NO_RACEWAYS, NO_RACEWAYS))
            else:  # dear
                cost += DRAG_COST * follow_drag(s, oil, p, rollers, kept)
                drag = kept_drag(s, kept)
            inputs = inputs_with_drag(s, torques[0], torques[1], drag, oil, p)
            cost += 1.0
            if cost > MAX_STEPS:
                return TOO_MANY_STEPS
            rk4_step(s, piece, first, inputs, mesh, oil, p, scratch, stages)
            first = 0.0
            s[DRAG_BOUND] += piece * (drag.pinion.bound + drag.gear.bound)
            if table.levels[0] < 0.0:
                follow_flank_of(s, at_load, table, p.mesh, mesh)
            rate = stages[N_STATE + X]
            rest -= piece
        if max(abs(s[W_P]), abs(s[W_G])) > MAX_SPEED:
            return NOT_FINITE if abs(s[X]) > DIVERGED_UM else TOO_FAST
    for i in range(n_films):
        s[FILM_NODES + i] = scratch[FILMS + i]
    total = 0.0
    for i in range(N_ODE):
        total += abs(s[i])
    if not total < math.inf or abs(s[X]) > DIVERGED_UM:
        return NOT_FINITE
    return OK
