"""Kernels that write the outputs of the axle; `output_names` says which these are."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import NO_RACEWAYS, RollerFilms, shaft_energy
from gearlube_core.bearings.followed_shaft import PALMGREN, SOLVED_FILMS
from gearlube_core.dynamics.hypoid_axle.continuous import (
    write_event_indicators,
    write_rates,
)
from gearlube_core.dynamics.hypoid_axle.integrate import inputs_with_drag
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_SHARE_OUTSIDE,
    DTE,
    ENERGIES,
    EVENTS,
    FIRST_BEARING_FILM,
    FIRST_FLANK_BOUND,
    FIRST_ROLLER,
    FLANKS,
    GEAR_BEARINGS,
    GEAR_CAGE,
    LOAD_LEVEL,
    MESH_FORCE,
    MESH_FREQUENCY,
    MESH_STIFFNESS,
    PINION_ACCELERATION,
    PINION_ANGLE,
    PINION_BEARINGS,
    PINION_CAGE,
    PINION_DISPLACEMENT,
    PINION_SPEED,
    PINION_VELOCITY,
    RANGES,
    RATES,
    SEPARATED,
    SHARE_OUTSIDE,
    STORED_ENERGY,
    WHEEL_ACCELERATION,
    WHEEL_ANGLE,
    WHEEL_DISPLACEMENT,
    WHEEL_SPEED,
    WHEEL_VELOCITY,
    write_losses,
    write_raceways,
    write_shaft,
)
from gearlube_core.dynamics.hypoid_axle.rhs import (
    AT_EXPANSION,
    AT_ROLLERS,
    SCRATCH,
    AxleRaceways,
    axle_drag,
    axle_raceways,
    axle_rhs,
    drag_after_step,
    drag_is_kept,
    gear_frequency,
    gear_motion,
    kept_drag,
    mesh_motion,
    pinion_motion,
)
from gearlube_core.dynamics.hypoid_axle.state import (
    CAGE_G,
    CAGE_P,
    FILM_NODES,
    KEPT_DRAG,
    LOAD_TORQUE,
    N_ENERGIES,
    N_ODE,
    N_ROLLERS,
    N_STATE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    ROLLER_NODES,
    SIDE,
    TIME_IN_STEP,
    U_G,
    U_P,
    UM,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import (
    write_flanks,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import (
    BOUND_POWER,
    FILMS,
    N_FRICTION,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForce,
    backlash_deflection,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import (
    BETWEEN_NODES,
    EXACT,
)
from gearlube_core.dynamics.ranges import write_ranges
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import R_P, blend_levels, load_bracket
from gearlube_core.oil.lubricant import LubricantState, lubricant_state


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
def write_motion(
    s: Array,
    rates: Array,
    friction_bound: float,
    drag_bound: float,
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
    friction_bound, drag_bound : float
        Of the power lost in flank friction and in the bearings [W], likewise.
    series : ndarray of shape (series_size(table),)
        Of the mesh table at the present load.
    """
    mesh = mesh_force(mesh_motion(s), series, n_orders, p.mesh)
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
    write_losses(s, rates, friction_bound, drag_bound, out)
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
    write_motion(s, work[0:N_ODE], 0.0, 0.0, series, table.n_orders, p, out)


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
    """Write the rates of the continuous states, both accelerations and the event indicators.

    They are those among the outputs of `write_outputs`, with the same arguments: a function of the
    state alone, whatever was read before.
    """
    none = AxleRaceways(NO_RACEWAYS, NO_RACEWAYS)
    _write_rates(s, torques, oil_temperature, table, p, True, none, work, out)


@kernel
def raceways_of(
    s: Array, oil: LubricantState, p: AxleParameters, film_model: Array, scratch: Array
) -> AxleRaceways:
    """Return the raceways in the state `s`; what is kept of their films stays as it is."""
    rollers = scratch[AT_ROLLERS:SCRATCH]
    if p.drag == SOLVED_FILMS:
        for i in range(N_ROLLERS):
            rollers[i] = s[ROLLER_NODES + i]
    kept = 1.0 if films_asked(s) == BETWEEN_NODES else 0.0
    return axle_raceways(s, oil, p, RollerFilms(film_model, rollers, kept))


@kernel
def films_asked(s: Array) -> float:
    """Return how film models are evaluated in the state `s`, see `tooth_pair`.

    After a step as the step has done it. Otherwise, as in model exchange, where there are no
    steps, at the contact itself.
    """
    return BETWEEN_NODES if s[TIME_IN_STEP] > 0.0 else EXACT


@kernel
def _write_rates(
    s: Array,
    torques: tuple[float, float],
    oil_temperature: float,
    table: MeshLevels,
    p: AxleParameters,
    alone: bool,
    raceways: AxleRaceways,
    work: Array,
    out: Array,
) -> None:
    """Write what `write_derivatives` does; `alone`: raceways are not known yet."""
    asked = films_asked(s)
    at_series = N_ODE + SCRATCH
    at_window = at_series + series_size(table)
    rates = work[0:N_ODE]
    data = place_at_load(table, work[at_series:at_window], work[at_window:])
    oil = lubricant_state(p.oil, oil_temperature, table.laws)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], table, data)
    scratch = work[N_ODE:at_series]
    kept = s[KEPT_DRAG:N_STATE]
    after_step = s[TIME_IN_STEP] > 0.0 and p.drag > PALMGREN
    if after_step and drag_is_kept(s, oil.temperature, kept):
        drag = kept_drag(s, kept)
    else:
        if alone:
            raceways = raceways_of(s, oil, p, data.roller_model, scratch)
        if after_step:  # as the next step takes it
            drag = drag_after_step(s, oil, p, kept, raceways)
        else:
            drag = axle_drag(s, oil, p, raceways)
    inputs = inputs_with_drag(s, torques[0], torques[1], drag, oil, p)
    if data.film_model.size > 0:
        for i in range(N_FILMS):
            scratch[FILMS + i] = s[FILM_NODES + i]
    axle_rhs(s, inputs, data, oil, p, asked, 1.0, scratch, rates)
    out[PINION_ACCELERATION] = rates[W_P]
    out[WHEEL_ACCELERATION] = rates[W_G]
    write_rates(s, rates, torques[0], out[RATES:EVENTS])
    write_event_indicators(s, table, data, p.mesh, out[EVENTS:])


@kernel
def write_flank_group(
    s: Array,
    force: float,
    oil_temperature: float,
    oil: LubricantState,
    data: MeshAtLoad,
    p: AxleParameters,
    scratch: Array,
    out: Array,
) -> None:
    """Write `FLANK_GROUP` under the mesh force `force` [N]; others as in `axle_rhs`."""
    channels = scratch[N_FRICTION:AT_EXPANSION]
    most_loaded = write_flanks(
        mesh_motion(s),
        force,
        data.window,
        data.n_nodes,
        oil_temperature,
        oil,
        p,
        data.film_model,
        films_asked(s),
        scratch[FILMS:N_FRICTION],
        FLANKS,
        FIRST_FLANK_BOUND,
        channels,
        out,
    )
    out[SHARE_OUTSIDE] = most_loaded.outside
    torque = max(abs(s[LOAD_TORQUE]), abs(force) * data.series[R_P])
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


@kernel
def write_bearing_group(
    s: Array, stiffness: float, oil: LubricantState, p: AxleParameters, rollers: Array, out: Array
) -> None:
    """Write `BEARING_GROUP` at a mesh stiffness [N/m]; `rollers` as in `write_outputs`."""
    f_p, f_g = reference_frequency(p.mesh, s[W_P]), gear_frequency(p, s[W_G])
    out[FIRST_ROLLER] = write_shaft(
        pinion_motion(s), f_p, oil, p.bearing_p, PINION_BEARINGS, (2, 1, 0), rollers, out
    )
    write_shaft(gear_motion(s), f_g, oil, p.bearing_g, GEAR_BEARINGS, (0, 1, 2), rollers, out)
    out[STORED_ENERGY] = stored_energy(s, stiffness, oil, p)


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
    oil = lubricant_state(p.oil, oil_temperature, table.laws)
    raceways = raceways_of(s, oil, p, data.roller_model, scratch)
    write_raceways(raceways, FIRST_BEARING_FILM, BEARING_SHARE_OUTSIDE, out)
    _write_rates(s, torques, oil_temperature, table, p, False, raceways, work, out)
    bound = raceways.pinion.torque_bound * abs(s[W_P]) + raceways.gear.torque_bound * abs(s[W_G])
    at_bound = scratch[BOUND_POWER]
    mesh = write_motion(s, rates, at_bound, bound, data.series, data.n_orders, p, out)
    write_flank_group(s, mesh.force, oil_temperature, oil, data, p, scratch, out)
    write_bearing_group(s, mesh.stiffness, oil, p, rollers, out)
