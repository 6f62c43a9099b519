"""Outputs of the axle from its state."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    ShaftBearings,
    ShaftMotion,
    roller_load_range,
    shaft_energy,
    shaft_forces,
)
from gearlube_core.dynamics.hypoid_axle import output_names as at
from gearlube_core.dynamics.hypoid_axle.flanks import pair_friction, sliding_speed
from gearlube_core.dynamics.hypoid_axle.integrate import step_inputs
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.dynamics.hypoid_axle.mesh_force import (
    backlash_deflection,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_axle.rhs import (
    AT_EXPANSION,
    N_FRICTION,
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
    LOAD_TORQUE,
    MESH_DAMPING,
    N_ENERGIES,
    N_ODE,
    PHI_G,
    PHI_P,
    PINION_WORK,
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
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, SHARE
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, pair_channels
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

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
    f = backlash_deflection(s[X] * UM, p.backlash)
    elastic = 0.5 * mesh_stiffness * f * f
    elastic += shaft_energy(p.bearing_p, pinion_motion(s), oil)
    elastic += shaft_energy(p.bearing_g, gear_motion(s), oil)
    return 0.5 * kinetic + elastic


@kernel
def write_flanks(
    s: Array,
    force: float,
    window: Array,
    n_nodes: int,
    oil_temperature: float,
    oil: LubricantState,
    p: AxleParameters,
    channels: Array,
    out: Array,
) -> None:
    """Write load, film, film ratio, friction coefficient and temperature of every flank.

    A flank without load has no film: zeros, and the temperature of the oil.
    """
    for pair in range(at.N_FLANKS):
        first = at.FLANKS + pair * at.N_FLANK_QUANTITIES
        pair_channels(window, n_nodes, p.z_p, s[PHI_P], pair, N_CHANNELS, channels)
        load = abs(force) * channels[SHARE]
        out[first + at.FLANK_LOAD] = load
        out[first + at.FILM_THICKNESS] = 0.0
        out[first + at.FILM_RATIO] = 0.0
        out[first + at.FRICTION_COEFFICIENT] = 0.0
        out[first + at.TEMPERATURE] = oil_temperature
        if load > 0.0:
            flank = pair_friction(s, load, sliding_speed(s, channels), channels, oil, p)
            out[first + at.FILM_THICKNESS] = flank.film_thickness
            out[first + at.FILM_RATIO] = flank.film_ratio
            if p.friction != 0.0:
                out[first + at.FRICTION_COEFFICIENT] = flank.friction_coefficient
                out[first + at.TEMPERATURE] = oil_temperature + flank.temperature_rise


@kernel
def write_shaft(
    motion: ShaftMotion,
    f_ref: float,
    oil: LubricantState,
    bearings: ShaftBearings,
    first: int,
    axes: tuple[int, int, int],
    rollers: Array,
    out: Array,
) -> float:
    """Write forces and extreme roller loads of two bearings; return roller 1 of the first [N].

    Their outputs begin at `first`. `axes` are the places (0, 1, 2) of r1, r2 and the shaft in
    x, y, z; `rollers` is work space of shape (ROLLERS_MAX,).
    """
    F = shaft_forces(bearings, motion, f_ref, oil)
    one = first + at.BEARING_FORCE
    out[one + axes[0]] = F[0]
    out[one + axes[1]] = F[1]
    out[one + axes[2]] = F[2]
    two = one + at.N_BEARING_QUANTITIES
    out[two + axes[0]] = F[3]
    out[two + axes[1]] = F[4]
    out[two + axes[2]] = F[5]
    first_roller = 0.0
    for k in range(2):
        side = 1.0 - 2.0 * k
        load, largest, smallest = roller_load_range(bearings, motion, f_ref, oil, side, rollers)
        base = first + k * at.N_BEARING_QUANTITIES
        out[base + at.ROLLER_LOAD_MAX] = largest
        out[base + at.ROLLER_LOAD_MIN] = smallest
        if k == 0:
            first_roller = load
    return first_roller


@kernel
def write_losses(s: Array, rates: Array, out: Array) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

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
    friction = viscous + boundary
    out[at.FRICTION_LOSS] = friction
    out[at.BOUNDARY_LOSS] = boundary
    out[at.BEARING_LOSS] = drag
    out[at.DAMPING_LOSS] = mesh + rollers
    out[at.EFFICIENCY] = 0.0
    out[at.AXLE_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if put_in > idle_power:
        out[at.EFFICIENCY] = 1.0 - friction / put_in
        out[at.AXLE_EFFICIENCY] = 1.0 - (friction + mesh + rollers + drag) / put_in


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
    at_window = at_series + N_SERIES * (2 * table.n_orders + 1)
    rates = work[0:N_ODE]
    scratch = work[N_ODE:at_series]
    data = MeshAtLoad(work[at_series:at_window], table.n_orders, work[at_window:], table.n_nodes)
    oil = lubricant_state(p.oil, oil_temperature)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], table, data)
    inputs = step_inputs(s, torques[0], torques[1], oil, p)
    axle_rhs(s, inputs, data, oil, p, 1.0, 1.0, scratch, rates)
    mesh = mesh_force(s, data.series, data.n_orders, p)
    x = s[X] * UM
    out[at.PINION_ANGLE] = s[PHI_P]
    out[at.WHEEL_ANGLE] = s[PHI_G]
    out[at.PINION_SPEED] = s[W_P]
    out[at.WHEEL_SPEED] = s[W_G]
    out[at.PINION_ACCELERATION] = rates[W_P]
    out[at.WHEEL_ACCELERATION] = rates[W_G]
    out[at.DTE] = x
    out[at.MESH_FORCE] = mesh.force
    out[at.SEPARATED] = 1.0 if -p.backlash < x < 0.0 else 0.0
    out[at.MESH_STIFFNESS] = mesh.stiffness
    out[at.MESH_FREQUENCY] = p.z_p * s[W_P] / (2.0 * math.pi)
    channels = scratch[N_FRICTION:AT_EXPANSION]
    write_flanks(s, mesh.force, data.window, data.n_nodes, oil_temperature, oil, p, channels, out)
    write_losses(s, rates, out)
    for i in range(3):
        out[at.PINION_DISPLACEMENT + i] = s[U_P + i] * UM
        out[at.WHEEL_DISPLACEMENT + i] = s[U_G + i] * UM
    f_ref = reference_frequency(p, s[W_P])
    out[at.FIRST_ROLLER] = write_shaft(
        pinion_motion(s), f_ref, oil, p.bearing_p, at.PINION_BEARINGS, (2, 1, 0), rollers, out
    )
    write_shaft(gear_motion(s), f_ref, oil, p.bearing_g, at.GEAR_BEARINGS, (0, 1, 2), rollers, out)
    out[at.PINION_CAGE] = s[CAGE_P]
    out[at.GEAR_CAGE] = s[CAGE_G]
    for i in range(N_ENERGIES):
        out[at.ENERGIES + i] = s[PINION_WORK + i]
    out[at.STORED_ENERGY] = stored_energy(s, mesh.stiffness, oil, p)
