"""Outputs of the axle from its state."""

from __future__ import annotations

import math

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.shaft_energy import shaft_bearing_energy
from gearlube_core.bearings.shaft_forces import shaft_bearing_forces
from gearlube_core.dynamics.hypoid_axle.flanks import pair_friction, sliding_speed
from gearlube_core.dynamics.hypoid_axle.integrate import step_inputs
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import blend_mesh
from gearlube_core.dynamics.hypoid_axle.mesh_force import (
    backlash_deflection,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARINGS_AT,
    DISPLACEMENTS_AT,
    ENERGIES_AT,
    FLANKS_AT,
    LOSSES_AT,
    N_BEARING_QUANTITIES,
    N_FLANK_QUANTITIES,
    N_FLANKS,
    ROLLER_AT,
)
from gearlube_core.dynamics.hypoid_axle.rhs import AT_EXPANSION, N_FRICTION, SCRATCH, axle_rhs
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    LOAD_TORQUE,
    MESH_DAMPING,
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
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, SHARE
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, pair_channels
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

_IDLE_WORK = 1e-12  # J; no efficiency is stated for less work


@kernel
def stored_energy(
    s: NDArray[float64],
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
    elastic += shaft_bearing_energy(
        s[U_P + 2] * UM,
        s[U_P + 1] * UM,
        s[U_P] * UM,
        s[CAGE_P],
        s[W_P],
        oil.eta0,
        oil.alpha,
        p.bearing_p,
    )
    elastic += shaft_bearing_energy(
        s[U_G] * UM,
        s[U_G + 1] * UM,
        s[U_G + 2] * UM,
        s[CAGE_G],
        s[W_G],
        oil.eta0,
        oil.alpha,
        p.bearing_g,
    )
    return 0.5 * kinetic + elastic


@kernel
def write_flanks(
    s: NDArray[float64],
    force: float,
    window: NDArray[float64],
    n_nodes: int,
    oil_temperature: float,
    oil: LubricantState,
    p: AxleParameters,
    channels: NDArray[float64],
    out: NDArray[float64],
) -> None:
    """Write load, film, film ratio, friction coefficient and temperature of every flank.

    A flank that carries no load has no film to speak of: zeros, and the temperature of the oil.
    """
    for pair in range(N_FLANKS):
        at = FLANKS_AT + pair * N_FLANK_QUANTITIES
        pair_channels(window, n_nodes, p.z_p, s[PHI_P], pair, N_CHANNELS, channels)
        load = abs(force) * channels[SHARE]
        out[at] = load
        out[at + 1] = 0.0
        out[at + 2] = 0.0
        out[at + 3] = 0.0
        out[at + 4] = oil_temperature
        if load > 0.0:
            flank = pair_friction(s, load, sliding_speed(s, channels), channels, oil, p)
            out[at + 1] = flank.film_thickness
            out[at + 2] = flank.film_ratio
            if p.friction_form >= 0.0:
                out[at + 3] = flank.friction_coefficient
                out[at + 4] = oil_temperature + flank.temperature_rise


@kernel
def write_shaft(
    radial_1: float,
    radial_2: float,
    axial: float,
    velocity_1: float,
    velocity_2: float,
    velocity_axial: float,
    cage_angle: float,
    speed: float,
    f_ref: float,
    oil: LubricantState,
    bearing: BearingParameters,
    at: int,
    order_1: int,
    order_2: int,
    order_axial: int,
    rollers: NDArray[float64],
    out: NDArray[float64],
) -> float:
    """Write forces and extreme roller loads of two bearings; return roller 1 of the first [N].

    `order_*` are the places (0, 1, 2) of the bearing's directions in x, y, z.
    """
    F = shaft_bearing_forces(
        radial_1,
        radial_2,
        axial,
        velocity_1,
        velocity_2,
        velocity_axial,
        cage_angle,
        speed,
        f_ref,
        oil.eta0,
        oil.alpha,
        bearing,
    )
    out[at + order_1] = F[0]
    out[at + order_2] = F[1]
    out[at + order_axial] = F[2]
    second = at + N_BEARING_QUANTITIES
    out[second + order_1] = F[3]
    out[second + order_2] = F[4]
    out[second + order_axial] = F[5]
    count = int(bearing.n_rollers)
    first_roller = 0.0
    for k in range(2):
        side = 1.0 - 2.0 * k
        roller_loads(
            radial_1,
            radial_2,
            axial,
            velocity_1,
            velocity_2,
            velocity_axial,
            cage_angle,
            speed,
            f_ref,
            oil.eta0,
            oil.alpha,
            bearing,
            side,
            rollers,
        )
        largest = rollers[0]
        smallest = rollers[0]
        for i in range(1, count):
            largest = max(largest, rollers[i])
            smallest = min(smallest, rollers[i])
        base = at + k * N_BEARING_QUANTITIES
        out[base + 3] = largest
        out[base + 4] = smallest
        if k == 0:
            first_roller = rollers[0]
    return first_roller


@kernel
def write_losses(
    s: NDArray[float64], rates: NDArray[float64], p: AxleParameters, out: NDArray[float64]
) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    Before the first step: instantaneous. Efficiency is 1 - loss/input with the work put in at the
    side that drives; 0 where no work is put in.

    References
    ----------
    [mohammadpour_2015 (20)] [mohammadpour_2015 (21)]
    """
    duration = s[TIME_IN_STEP]
    averaged = duration > 0.0
    scale = 1.0 / duration if averaged else 1.0
    at = PINION_WORK
    pinion = (s[at] - s[WORK_MARK]) * scale if averaged else rates[at]
    wheel = (s[WHEEL_WORK] - s[WORK_MARK + 1]) * scale if averaged else rates[WHEEL_WORK]
    viscous = (s[VISCOUS] - s[WORK_MARK + 2]) * scale if averaged else rates[VISCOUS]
    boundary = (s[BOUNDARY] - s[WORK_MARK + 3]) * scale if averaged else rates[BOUNDARY]
    mesh = (s[MESH_DAMPING] - s[WORK_MARK + 4]) * scale if averaged else rates[MESH_DAMPING]
    rollers = (
        (s[BEARING_DAMPING] - s[WORK_MARK + 5]) * scale if averaged else rates[BEARING_DAMPING]
    )
    drag = (s[BEARING_TORQUE] - s[WORK_MARK + 6]) * scale if averaged else rates[BEARING_TORQUE]
    friction = viscous + boundary
    out[LOSSES_AT] = friction
    out[LOSSES_AT + 1] = boundary
    out[LOSSES_AT + 2] = drag
    out[LOSSES_AT + 3] = mesh + rollers
    put_in = pinion if pinion > 0.0 else -wheel
    if put_in > _IDLE_WORK * scale:
        out[LOSSES_AT + 4] = 1.0 - friction / put_in
        out[LOSSES_AT + 5] = 1.0 - (friction + mesh + rollers + drag) / put_in
    else:
        out[LOSSES_AT + 4] = 0.0
        out[LOSSES_AT + 5] = 0.0


@kernel
def write_outputs(
    s: NDArray[float64],
    pinion_torque: float,
    wheel_torque: float,
    oil_temperature: float,
    levels: NDArray[float64],
    series: NDArray[float64],
    n_orders: int,
    windows: NDArray[float64],
    n_nodes: int,
    parameters: NDArray[float64],
    work: NDArray[float64],
    rollers: NDArray[float64],
    out: NDArray[float64],
) -> None:
    """Write all outputs, in the order of OUTPUT_NAMES, into `out` of shape (N_OUTPUTS,).

    Arguments as in `integrate.advance`; `rollers` is work space of shape (ROLLERS_MAX,).
    """
    p: AxleParameters = tuple_from_array(parameters, AxleParameters)
    at_series = N_ODE + SCRATCH
    at_window = at_series + N_SERIES * (2 * n_orders + 1)
    rates = work[0:N_ODE]
    scratch = work[N_ODE:at_series]
    blended = work[at_series:at_window]
    window = work[at_window:]
    oil = lubricant_state(p.oil, oil_temperature)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], levels, series, n_orders, windows, n_nodes, blended, window)
    inputs = step_inputs(s, pinion_torque, wheel_torque, oil, p)
    axle_rhs(s, inputs, blended, n_orders, window, n_nodes, oil, p, 1.0, 1.0, scratch, rates)
    mesh = mesh_force(s, blended, n_orders, p)
    x = s[X] * UM
    out[0] = s[PHI_P]
    out[1] = s[PHI_G]
    out[2] = s[W_P]
    out[3] = s[W_G]
    out[4] = rates[W_P]
    out[5] = rates[W_G]
    out[6] = x
    out[7] = mesh.force
    out[8] = 1.0 if -p.backlash < x < 0.0 else 0.0
    out[9] = mesh.stiffness
    out[10] = p.z_p * s[W_P] / (2.0 * math.pi)
    channels = scratch[N_FRICTION:AT_EXPANSION]
    write_flanks(s, mesh.force, window, n_nodes, oil_temperature, oil, p, channels, out)
    write_losses(s, rates, p, out)
    for i in range(3):
        out[DISPLACEMENTS_AT + i] = s[U_P + i] * UM
        out[DISPLACEMENTS_AT + 3 + i] = s[U_G + i] * UM
    f_ref = reference_frequency(p, s[W_P])
    out[ROLLER_AT] = write_shaft(
        s[U_P + 2] * UM,
        s[U_P + 1] * UM,
        s[U_P] * UM,
        s[V_P + 2],
        s[V_P + 1],
        s[V_P],
        s[CAGE_P],
        s[W_P],
        f_ref,
        oil,
        p.bearing_p,
        BEARINGS_AT,
        2,
        1,
        0,
        rollers,
        out,
    )
    write_shaft(
        s[U_G] * UM,
        s[U_G + 1] * UM,
        s[U_G + 2] * UM,
        s[V_G],
        s[V_G + 1],
        s[V_G + 2],
        s[CAGE_G],
        s[W_G],
        f_ref,
        oil,
        p.bearing_g,
        BEARINGS_AT + 2 * N_BEARING_QUANTITIES,
        0,
        1,
        2,
        rollers,
        out,
    )
    out[ROLLER_AT + 1] = s[CAGE_P]
    out[ROLLER_AT + 2] = s[CAGE_G]
    for i in range(7):
        out[ENERGIES_AT + i] = s[PINION_WORK + i]
    out[ENERGIES_AT + 7] = stored_energy(s, mesh.stiffness, oil, p)
