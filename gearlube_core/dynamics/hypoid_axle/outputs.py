"""Outputs of the axle: their names, which are the FMU's public contract, and their kernels."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import shaft_energy
from gearlube_core.dynamics.hypoid_axle.bearing_outputs import (
    BEARING_OUTPUTS,
    N_BEARING_QUANTITIES,
    write_shaft,
)
from gearlube_core.dynamics.hypoid_axle.continuous import (
    EVENT_INDICATORS,
    RATE_NAMES,
    STATE_NAMES,
    write_event_indicators,
    write_rates,
)
from gearlube_core.dynamics.hypoid_axle.film_nodes import N_FILMS
from gearlube_core.dynamics.hypoid_axle.flank_outputs import (
    FLANK_BOUNDS,
    FLANK_OUTPUTS,
    write_flanks,
)
from gearlube_core.dynamics.hypoid_axle.flanks import (
    BETWEEN_NODES,
    BOUND_POWER,
    EXACT,
    FILMS,
    N_FRICTION,
)
from gearlube_core.dynamics.hypoid_axle.integrate import step_inputs
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import (
    MeshLevels,
    blend_mesh,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_axle.mesh_force import (
    MeshForce,
    backlash_deflection,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_axle.rhs import (
    AT_EXPANSION,
    SCRATCH,
    axle_rhs,
    gear_motion,
    pinion_motion,
)
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    CHURNING,
    FILM_NODES,
    FRICTION_BOUND,
    LOAD_TORQUE,
    MESH_DAMPING,
    N_ENERGIES,
    N_ODE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    ROLLING,
    SEALS,
    SIDE,
    TIME_IN_STEP,
    U_G,
    U_P,
    UM,
    V_G,
    V_P,
    VISCOUS,
    W_G,
    W_P,
    WHEEL_WORK,
    WORK_MARK,
    X,
)
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED, RANGE_OUTPUTS, write_ranges
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import R_P, blend_levels, load_bracket
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

_OUTPUTS: tuple[str, ...] = (
    "pinion.angle",
    "wheel.angle",
    "pinion.speed",
    "wheel.speed",
    "pinion.acceleration",
    "wheel.acceleration",
    "mesh.dte",
    "mesh.force",
    "mesh.separated",
    "mesh.stiffness",
    "mesh.frequency",
    *FLANK_OUTPUTS,
    "friction.power_loss",
    "friction.power_loss_boundary",
    "bearing.power_loss",
    "churning.power_loss",
    "seal.power_loss",
    "friction.power_loss_rolling",
    "damping.power_loss",
    "efficiency",
    "axle.efficiency",
    "friction.power_loss_bound",
    "efficiency_bound",
    *(f"{member}.displacement.{c}" for member in ("pinion", "wheel") for c in "xyz"),
    *BEARING_OUTPUTS,
    "bearing[1].roller[1].load",
    "bearing[1].cage.angle",
    "bearing[3].cage.angle",
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction_viscous",
    "energy.friction_boundary",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.bearing_torque",
    "energy.churning",
    "energy.seals",
    "energy.friction_rolling",
    "energy.stored",
    *RANGE_OUTPUTS,
    "film.share_outside",
    *FLANK_BOUNDS,
)
# for another integrator: the other states, the rates of all, and the event indicators
_OTHER_STATES = tuple(name for name in STATE_NAMES if name not in _OUTPUTS)
OUTPUT_NAMES = (*_OUTPUTS, *_OTHER_STATES, *RATE_NAMES, *EVENT_INDICATORS)
OUTPUT_INDEX = {name: index for index, name in enumerate(OUTPUT_NAMES)}
N_OUTPUTS = len(OUTPUT_NAMES)

# places of the outputs that the kernel writes by name
PINION_ANGLE = OUTPUT_INDEX["pinion.angle"]
WHEEL_ANGLE = OUTPUT_INDEX["wheel.angle"]
PINION_SPEED = OUTPUT_INDEX["pinion.speed"]
WHEEL_SPEED = OUTPUT_INDEX["wheel.speed"]
PINION_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
WHEEL_ACCELERATION = OUTPUT_INDEX["wheel.acceleration"]
DTE = OUTPUT_INDEX["mesh.dte"]
MESH_FORCE = OUTPUT_INDEX["mesh.force"]
SEPARATED = OUTPUT_INDEX["mesh.separated"]
MESH_STIFFNESS = OUTPUT_INDEX["mesh.stiffness"]
MESH_FREQUENCY = OUTPUT_INDEX["mesh.frequency"]
FRICTION_LOSS = OUTPUT_INDEX["friction.power_loss"]
BOUNDARY_LOSS = OUTPUT_INDEX["friction.power_loss_boundary"]
BEARING_LOSS = OUTPUT_INDEX["bearing.power_loss"]
CHURNING_LOSS = OUTPUT_INDEX["churning.power_loss"]
SEAL_LOSS = OUTPUT_INDEX["seal.power_loss"]
ROLLING_LOSS = OUTPUT_INDEX["friction.power_loss_rolling"]
DAMPING_LOSS = OUTPUT_INDEX["damping.power_loss"]
EFFICIENCY = OUTPUT_INDEX["efficiency"]
AXLE_EFFICIENCY = OUTPUT_INDEX["axle.efficiency"]
LOSS_BOUND = OUTPUT_INDEX["friction.power_loss_bound"]
EFFICIENCY_BOUND = OUTPUT_INDEX["efficiency_bound"]
FIRST_ROLLER = OUTPUT_INDEX["bearing[1].roller[1].load"]
PINION_CAGE = OUTPUT_INDEX["bearing[1].cage.angle"]
GEAR_CAGE = OUTPUT_INDEX["bearing[3].cage.angle"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]
SHARE_OUTSIDE = OUTPUT_INDEX["film.share_outside"]

# first place of a group of outputs of one kind
FLANKS = OUTPUT_INDEX[FLANK_OUTPUTS[0]]
FIRST_FLANK_BOUND = OUTPUT_INDEX[FLANK_BOUNDS[0]]
PINION_DISPLACEMENT = OUTPUT_INDEX["pinion.displacement.x"]
WHEEL_DISPLACEMENT = OUTPUT_INDEX["wheel.displacement.x"]
PINION_BEARINGS = OUTPUT_INDEX[BEARING_OUTPUTS[0]]
GEAR_BEARINGS = PINION_BEARINGS + 2 * N_BEARING_QUANTITIES
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state
RANGES = OUTPUT_INDEX[RANGE_EXCEEDED]
PINION_VELOCITY = OUTPUT_INDEX["pinion.velocity.x"]
WHEEL_VELOCITY = OUTPUT_INDEX["wheel.velocity.x"]
LOAD_LEVEL = OUTPUT_INDEX["mesh.load_torque"]
RATES = OUTPUT_INDEX[RATE_NAMES[0]]  # in the order of the state
EVENTS = OUTPUT_INDEX[EVENT_INDICATORS[0]]

# what follows from the state and the mean mesh data alone
MOTION_OUTPUTS: tuple[str, ...] = (
    *OUTPUT_NAMES[:PINION_ACCELERATION],
    *OUTPUT_NAMES[DTE:FLANKS],
    *OUTPUT_NAMES[FRICTION_LOSS : EFFICIENCY_BOUND + 1],
    *OUTPUT_NAMES[PINION_DISPLACEMENT : WHEEL_DISPLACEMENT + 3],
    OUTPUT_NAMES[PINION_CAGE],
    OUTPUT_NAMES[GEAR_CAGE],
    *OUTPUT_NAMES[ENERGIES : ENERGIES + N_ENERGIES],
    *_OTHER_STATES,
)

# of these, what an input changes at once while no step has been taken
POWERS = frozenset(OUTPUT_NAMES[FRICTION_LOSS : EFFICIENCY_BOUND + 1])

_IDLE_WORK = 1e-12  # J; no efficiency is stated for less work


@kernel
def stored_energy(
    s: Array,
    mesh_stiffness: float,
    oil: LubricantState,
    p: AxleParameters,
) -> float:
    """Return kinetic plus elastic energy of the axle [J]."""
    kinetic = p.I_p * s[W_P] * s[W_P] + p.I_g * s[W_G] * s[W_G]
    for i in range(3):
        kinetic += p.m_p * s[V_P + i] * s[V_P + i] + p.m_g * s[V_G + i] * s[V_G + i]
    f = backlash_deflection(s[X] * UM, p.mesh.backlash)
    elastic = 0.5 * mesh_stiffness * f * f
    elastic += shaft_energy(p.bearing_p, pinion_motion(s), oil)
    elastic += shaft_energy(p.bearing_g, gear_motion(s), oil)
    return 0.5 * kinetic + elastic


@kernel
def write_losses(s: Array, rates: Array, bound: float, out: Array) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    `bound` is that of the power lost in flank friction [W], read before the first step only.

    Efficiency is 1 - loss/input with the work put in at the side that drives; 0 where no work is
    put in.

    References
    ----------
    [mohammadpour_2015 (20)] [mohammadpour_2015 (21)]
    """
    duration = s[TIME_IN_STEP]
    pinion = mean_power(s, rates, PINION_WORK, WORK_MARK, duration)
    wheel = mean_power(s, rates, WHEEL_WORK, WORK_MARK + 1, duration)
    viscous = mean_power(s, rates, VISCOUS, WORK_MARK + 2, duration)
    boundary = mean_power(s, rates, BOUNDARY, WORK_MARK + 3, duration)
    mesh = mean_power(s, rates, MESH_DAMPING, WORK_MARK + 4, duration)
    rollers = mean_power(s, rates, BEARING_DAMPING, WORK_MARK + 5, duration)
    drag = mean_power(s, rates, BEARING_TORQUE, WORK_MARK + 6, duration)
    churning = mean_power(s, rates, CHURNING, WORK_MARK + 7, duration)
    seals = mean_power(s, rates, SEALS, WORK_MARK + 8, duration)
    rolling = mean_power(s, rates, ROLLING, WORK_MARK + 9, duration)
    friction = viscous + boundary
    out[FRICTION_LOSS] = friction
    out[BOUNDARY_LOSS] = boundary
    out[BEARING_LOSS] = drag
    out[CHURNING_LOSS] = churning
    out[SEAL_LOSS] = seals
    out[ROLLING_LOSS] = rolling
    out[DAMPING_LOSS] = mesh + rollers
    out[EFFICIENCY] = 0.0
    out[AXLE_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if duration > 0.0:
        bound = s[FRICTION_BOUND] * (1.0 / duration)
    out[LOSS_BOUND] = bound
    out[EFFICIENCY_BOUND] = 0.0
    if put_in > idle_power:
        out[EFFICIENCY_BOUND] = bound / put_in
        out[EFFICIENCY] = 1.0 - friction / put_in
        others = mesh + rollers + drag + churning + seals + rolling
        out[AXLE_EFFICIENCY] = 1.0 - (friction + others) / put_in


@kernel
def write_motion(
    s: Array,
    rates: Array,
    bound: float,
    series: Array,
    n_orders: int,
    p: AxleParameters,
    out: Array,
) -> MeshForce:
    """Write `MOTION_OUTPUTS`; return the mesh force.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    rates : ndarray of shape (N_ODE,)
        Its rates; read before the first step only.
    bound : float
        Of the power lost in flank friction [W], likewise.
    series : ndarray of shape (series_size(table),)
        Of the mesh table at the present load.
    """
    mesh = mesh_force(s, series, n_orders, p.mesh)
    x = s[X] * UM
    out[PINION_ANGLE] = s[PHI_P]
    out[WHEEL_ANGLE] = s[PHI_G]
    out[PINION_SPEED] = s[W_P]
    out[WHEEL_SPEED] = s[W_G]
    out[DTE] = x
    out[MESH_FORCE] = mesh.force
    out[SEPARATED] = 1.0 if -p.mesh.backlash < x < 0.0 else 0.0
    out[MESH_STIFFNESS] = mesh.stiffness
    out[MESH_FREQUENCY] = p.mesh.z_p * s[W_P] / (2.0 * math.pi)
    write_losses(s, rates, bound, out)
    for i in range(3):
        out[PINION_DISPLACEMENT + i] = s[U_P + i] * UM
        out[WHEEL_DISPLACEMENT + i] = s[U_G + i] * UM
        out[PINION_VELOCITY + i] = s[V_P + i]
        out[WHEEL_VELOCITY + i] = s[V_G + i]
    out[LOAD_LEVEL] = s[LOAD_TORQUE]
    out[PINION_CAGE] = s[CAGE_P]
    out[GEAR_CAGE] = s[CAGE_G]
    for i in range(N_ENERGIES):
        out[ENERGIES + i] = s[PINION_WORK + i]
    return mesh


@kernel
def write_motion_after_step(
    s: Array, table: MeshLevels, p: AxleParameters, work: Array, out: Array
) -> None:
    """Write `MOTION_OUTPUTS` of a state that a step has left; arguments as in `write_outputs`."""
    size = series_size(table)
    series = work[N_ODE : N_ODE + size]
    bracket = load_bracket(s[LOAD_TORQUE], s[SIDE], table.levels, table.levels.size)
    blend_levels(table.series, size, bracket, series)
    write_motion(s, work[0:N_ODE], 0.0, series, table.n_orders, p, out)


@kernel
def write_derivatives(
    s: Array,
    torques: tuple[float, float],
    oil_temperature: float,
    table: MeshLevels,
    p: AxleParameters,
    work: Array,
    out: Array,
) -> None:
    """Write the rates of the continuous states and the event indicators.

    The right-hand side is exact: films, tractions and bearing forces are evaluated at `s`, and
    nothing is kept between calls. Arguments as in `write_outputs`.
    """
    _write_rates(s, torques, oil_temperature, table, p, EXACT, work, out)


@kernel
def _write_rates(
    s: Array,
    torques: tuple[float, float],
    oil_temperature: float,
    table: MeshLevels,
    p: AxleParameters,
    asked: float,
    work: Array,
    out: Array,
) -> None:
    at_series = N_ODE + SCRATCH
    at_window = at_series + series_size(table)
    rates = work[0:N_ODE]
    data = place_at_load(table, work[at_series:at_window], work[at_window:])
    oil = lubricant_state(p.oil, oil_temperature)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], table, data)
    inputs = step_inputs(s, torques[0], torques[1], oil, p)
    scratch = work[N_ODE:at_series]
    if data.film_model.size > 0:
        for i in range(N_FILMS):
            scratch[FILMS + i] = s[FILM_NODES + i]
    axle_rhs(s, inputs, data, oil, p, asked, 1.0, scratch, rates)
    write_rates(s, rates, torques[0], out[RATES:EVENTS])
    write_event_indicators(s, table, data, p.mesh, out[EVENTS:])


@kernel
def write_outputs(
    s: Array,
    torques: tuple[float, float],
    oil_temperature: float,
    table: MeshLevels,
    p: AxleParameters,
    work: Array,
    rollers: Array,
    out: Array,
) -> None:
    """Write all outputs, in the order of OUTPUT_NAMES, into `out` of shape (N_OUTPUTS,).

    Arguments as in `integrate.advance`; `rollers` is work space of shape (ROLLERS_MAX,).
    """
    at_series = N_ODE + SCRATCH
    at_window = at_series + series_size(table)
    rates = work[0:N_ODE]
    scratch = work[N_ODE:at_series]
    data = place_at_load(table, work[at_series:at_window], work[at_window:])
    oil = lubricant_state(p.oil, oil_temperature)
    # after a step a film model is taken as the step has taken it
    asked = BETWEEN_NODES if s[TIME_IN_STEP] > 0.0 else EXACT
    _write_rates(s, torques, oil_temperature, table, p, asked, work, out)
    mesh = write_motion(s, rates, scratch[BOUND_POWER], data.series, data.n_orders, p, out)
    out[PINION_ACCELERATION] = rates[W_P]
    out[WHEEL_ACCELERATION] = rates[W_G]
    channels = scratch[N_FRICTION:AT_EXPANSION]
    most_loaded = write_flanks(
        s,
        mesh.force,
        data.window,
        data.n_nodes,
        oil_temperature,
        oil,
        p,
        data.film_model,
        asked,
        scratch[FILMS:N_FRICTION],
        FLANKS,
        FIRST_FLANK_BOUND,
        channels,
        out,
    )
    out[SHARE_OUTSIDE] = most_loaded.outside
    torque = max(abs(s[LOAD_TORQUE]), abs(mesh.force) * data.series[R_P])
    write_ranges(
        -torque if s[SIDE] < 0.0 else torque,
        most_loaded.film_load,
        most_loaded.film_material,
        most_loaded.traction,
        most_loaded.temperature,
        most_loaded.pressure,
        p.ranges,
        RANGES,
        out,
    )
    f_ref = reference_frequency(p.mesh, s[W_P])
    out[FIRST_ROLLER] = write_shaft(
        pinion_motion(s), f_ref, oil, p.bearing_p, PINION_BEARINGS, (2, 1, 0), rollers, out
    )
    write_shaft(gear_motion(s), f_ref, oil, p.bearing_g, GEAR_BEARINGS, (0, 1, 2), rollers, out)
    out[STORED_ENERGY] = stored_energy(s, mesh.stiffness, oil, p)
