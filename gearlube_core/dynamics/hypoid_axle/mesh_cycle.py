"""Mean losses over one mesh period of an axle that turns steadily, without a march in time.

Every angle is a state of rest of the teeth: the mesh force that the pinion's torque asks for, the
shafts at their displacements under the mean force, and a gear that turns so that the deflection
stays. The powers are those of the kernels of the elements that the march integrates.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    RollerFilms,
    ShaftMotion,
    SolvedRaceways,
    expanded_forces,
)
from gearlube_core.bearings.followed_shaft import (
    N_FORCES,
    PALMGREN,
    drag_of_shaft,
    expand_about,
    raceways_of_shaft,
)
from gearlube_core.bearings.parameters import cage_torque
from gearlube_core.drag import churning_torque, seal_drag
from gearlube_core.dynamics.hypoid_axle.shafts_at_rest import (
    N_FREE,
    OK,
    REST_WORK,
    gear_motion,
    pinion_motion,
    shafts_at_rest,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_OUTPUTS, FLANK_RECORDS
from gearlube_core.dynamics.hypoid_mesh.flanks import N_FRICTION, flank_sum, force_on_pinion
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshMotion,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import EXACT
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, N_X, R_P, load_bracket, mesh_series
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

NO_BALANCE = 6  # beside the statuses of `shafts_at_rest`
# in this order
LOSS_SOURCES = (
    "friction_viscous",
    "friction_boundary",
    "mesh_damping",
    "bearing_damping",
    "bearing_torque",
    "churning",
    "seals",
    "friction_rolling",
)
N_LOSSES = len(LOSS_SOURCES)
(
    _VISCOUS, _BOUNDARY, _MESH_DAMPING, _BEARING_DAMPING, _BEARING_TORQUE, _CHURNING, _SEALS,
    _ROLLING,
) = range(N_LOSSES)  # fmt: skip
_MOST_BALANCES = 40
_RESTS = 2  # of them that find the shafts' displacements again; later ones change nothing
_BALANCED = 1e-6  # of the torques on the pinion
_LEAST_TORQUE = 1e-3  # N.m, of which this share is taken at least

# what a mean is taken of: powers, then forces on pinion and gear, torque on the pinion
_PUSHES = N_LOSSES
_MISSING = _PUSHES + N_FREE
_N_MEANS = _MISSING + 1
# places in the work array
AT_U = 0
AT_FORCES = AT_U + N_FREE
_AT_PUSH = AT_FORCES + N_FREE
_AT_MEAN = _AT_PUSH + N_FREE
_AT_REST = _AT_MEAN + _N_MEANS
AT_FRICTION = _AT_REST + REST_WORK
AT_CHANNELS = AT_FRICTION + N_FRICTION
AT_EXPANSION = AT_CHANNELS + N_CHANNELS
AT_SHOWN = AT_EXPANSION + N_FORCES
BOUNDS_SHOWN, RANGES_SHOWN = len(FLANK_OUTPUTS), len(FLANK_RECORDS)  # in what is shown
AT_MEANS = AT_SHOWN + RANGES_SHOWN + len(RANGE_OUTPUTS)
AT_SERIES = AT_MEANS + N_SERIES


def cycle_work(series: int, n_nodes: int) -> int:
    """Return the length of the work array of `mesh_cycle`; `series` are coefficients at a load."""
    return AT_SERIES + series + (n_nodes + 1) * N_CHANNELS


class Drag(NamedTuple):
    """Torques against both shafts and raceways, constant over a mesh period."""

    bearings_p: float  # N.m
    bearings_g: float
    seal_p: float
    seal_g: float
    churning: float
    raceways_p: SolvedRaceways
    raceways_g: SolvedRaceways


class Turning(NamedTuple):
    """The axle at an angle, at rest along the line of action."""

    mesh: MeshMotion
    pinion: ShaftMotion
    gear: ShaftMotion


@kernel
def drag_at(
    u: Array, w_p: float, w_g: float, oil: LubricantState, table: MeshLevels, p: AxleParameters
) -> Drag:
    """Return the drag on both shafts displaced by `u` [m] at their speeds [rad/s]."""
    pinion, gear = pinion_motion(u, w_p), gear_motion(u, w_g)
    films = RollerFilms(table.roller_model, u[0:0], 0.0)
    races_p = raceways_of_shaft(p.bearing_p, pinion, p.drag, oil, films)
    races_g = raceways_of_shaft(p.bearing_g, gear, p.drag, oil, films)
    return Drag(
        drag_of_shaft(p.bearing_p, pinion, p.preload_p, p.drag, oil, races_p).torque,
        drag_of_shaft(p.bearing_g, gear, p.preload_g, p.drag, oil, races_g).torque,
        seal_drag(w_p, p.pinion_seal_torque),
        seal_drag(w_g, p.wheel_seal_torque + p.hub_torque),
        churning_torque(w_g, oil.nu, p.oil.density, p.churning),
        races_p,
        races_g,
    )


@kernel
def turning_at(
    angle: float, torque: float, speed: float, u: Array, data: MeshAtLoad, p: AxleParameters
) -> Turning:
    """Return deflection and gear speed at an angle of the pinion [rad], at rest.

    The teeth carry `torque` [N.m] at the pinion; the deflection does not change at the pinion's
    `speed` [rad/s].
    """
    m = mesh_series(data.series, data.n_orders, p.mesh.z_p, angle)
    d_x, d_y, d_z = u[0] - u[3], u[1] - u[4], u[2] - u[5]
    arm = m.R_p - m.de + m.dn_x * d_x + m.dn_y * d_y + m.dn_z * d_z
    deflection = torque / arm / m.k_m
    x = deflection if torque >= 0.0 else deflection - p.mesh.backlash
    w_g = arm * speed / m.R_g
    motion = MeshMotion(angle, x, speed, w_g, d_x, d_y, d_z, 0.0, 0.0, 0.0)
    return Turning(motion, pinion_motion(u, speed), gear_motion(u, w_g))


@kernel
def _add_angle(
    here: Turning,
    torque: float,
    drag: Drag,
    share: float,
    data: MeshAtLoad,
    oil: LubricantState,
    p: AxleParameters,
    work: Array,
) -> None:
    """Add a share of powers, forces and torques at an angle to their means."""
    mean = work[_AT_MEAN:_AT_REST]
    expansion = work[AT_EXPANSION:AT_SHOWN]
    m, w_p, w_g = here.mesh, here.mesh.w_p, here.mesh.w_g
    mesh = mesh_force(m, data.series, data.n_orders, p.mesh)
    friction = flank_sum(
        m,
        mesh.force,
        data.window,
        data.n_nodes,
        oil,
        p,
        EXACT,
        work[AT_FRICTION:AT_CHANNELS],
        work[AT_CHANNELS:AT_EXPANSION],
        data.film_model,
    )
    f_p, f_g = reference_frequency(p.mesh, w_p), reference_frequency(p.mesh, p.ratio * w_g)
    expand_about(p.bearing_p, here.pinion, f_p, oil, expansion)
    p_z, p_y, p_x, lost_p = expanded_forces(p.bearing_p, here.pinion, expansion)
    expand_about(p.bearing_g, here.gear, f_g, oil, expansion)
    g_x, g_y, g_z, lost_g = expanded_forces(p.bearing_g, here.gear, expansion)
    f_x, f_y, f_z = force_on_pinion(mesh, friction, p.lateral_sign, p.mesh.consistent)
    cage = p.bearing_p.cage_ratio * cage_torque(here.pinion.r1, here.pinion.r2, p_z, p_y)
    on_shaft = p.mesh.consistent * cage - drag.bearings_p - drag.seal_p
    mean[_VISCOUS] += share * friction.viscous_power
    mean[_BOUNDARY] += share * friction.boundary_power
    mean[_MESH_DAMPING] += share * mesh.damping_power
    mean[_BEARING_DAMPING] += share * (lost_p + lost_g)
    mean[_BEARING_TORQUE] += share * (drag.bearings_p * w_p + drag.bearings_g * w_g)
    mean[_CHURNING] += share * drag.churning * w_g
    mean[_SEALS] += share * (drag.seal_p * w_p + drag.seal_g * w_g)
    mean[_ROLLING] += share * friction.rolling_power
    mean[_PUSHES] += share * (f_x + p_x)
    mean[_PUSHES + 1] += share * (f_y + p_y)
    mean[_PUSHES + 2] += share * (f_z + p_z)
    mean[_PUSHES + 3] += share * (g_x - f_x)
    mean[_PUSHES + 4] += share * (g_y - f_y)
    mean[_PUSHES + 5] += share * (g_z - f_z)
    mean[_MISSING] += share * (torque + mesh.torque_p + friction.torque_p + on_shaft)


@kernel
def mean_series(torque: float, mesh: MeshLevels, means: Array) -> None:
    """Write the means of the series at the pinion torque [N.m] into `means`, (N_SERIES,)."""
    bracket = load_bracket(torque, torque, mesh.levels, mesh.levels.size)
    size = series_size(mesh)
    first = bracket.lower * size
    second = bracket.upper * size
    for i in range(N_SERIES):
        low = mesh.series[first + i]
        means[i] = low + bracket.weight * (mesh.series[second + i] - low)


@kernel
def _at_rest(
    carried: float,
    oil: LubricantState,
    table: MeshLevels,
    p: AxleParameters,
    lossless: AxleParameters,
    work: Array,
) -> tuple[int, float]:
    """Write the displacements under the mean mesh force and all that pushes besides."""
    means = work[AT_MEANS:AT_SERIES]
    mean_series(carried, table, means)
    force = carried / means[R_P]
    forces, push = work[AT_FORCES:_AT_PUSH], work[_AT_PUSH:_AT_MEAN]
    for i in range(3):
        of_mesh = p.lateral_sign * force * means[N_X + i]
        forces[i], forces[3 + i] = push[i] - of_mesh, push[3 + i] + of_mesh
    u = work[AT_U:AT_FORCES]
    return shafts_at_rest(u, forces, abs(force), oil, lossless, work[_AT_REST:AT_FRICTION])


@kernel
def mesh_cycle(
    speed: float,
    torque: float,
    oil_temperature: float,
    angles: int,
    table: MeshLevels,
    p: AxleParameters,
    lossless: AxleParameters,
    work: Array,
    losses: Array,
) -> tuple[int, float, float, Drag]:
    """Write the mean powers lost over a mesh period; return a status and the torque of the teeth.

    Parameters
    ----------
    speed : float
        Of the pinion, above 0 [rad/s].
    torque : float
        On the pinion from outside, below 0 where the wheels drive [N.m].
    oil_temperature : float
        [K]
    angles : int
        Equal parts of a mesh period.
    table : MeshLevels
    p, lossless : AxleParameters
        As it is, and without losses for the state of rest.
    work : ndarray of shape (>= cycle_work(series_size, n_nodes),)
    losses : ndarray of shape (N_LOSSES,)
        [W]

    Returns
    -------
    tuple of (int, float, float, Drag)
        OK, a status of `shafts_at_rest`, or NO_BALANCE; the torque that the teeth carry at the
        pinion [N.m]: `torque` less friction and drag on the pinion; below 0 where the mesh data
        are those of the coast flanks; what drags on the shafts.
    """
    at_window = work.size - (table.n_nodes + 1) * N_CHANNELS
    data = place_at_load(table, work[AT_SERIES:at_window], work[at_window:])
    mean, push = work[_AT_MEAN:_AT_REST], work[_AT_PUSH:_AT_MEAN]
    u = work[AT_U:AT_FORCES]
    oil = lubricant_state(p.oil, oil_temperature, table.laws)
    # drag that takes the load of each roller feels the last hundredth of a micrometre
    rests = _RESTS + 1 if p.drag > PALMGREN else _RESTS
    for i in range(N_FREE):
        push[i], u[i] = 0.0, 0.0
    for i in range(_N_MEANS):
        mean[i] = 0.0
    carried, missing, side = torque, math.inf, 1.0
    drag = drag_at(u, speed, speed / p.ratio, oil, table, p)
    for balance in range(_MOST_BALANCES):
        if balance < rests:
            # after the first time under the mean of what friction and the varying mesh push with
            for i in range(N_FREE):
                push[i] += mean[_PUSHES + i]
            # drag may outdo a small torque, so that the other flanks carry
            side = -1.0 if carried < 0.0 else 1.0
            blend_mesh(abs(torque), side, table, data)
            status, worst = _at_rest(carried, oil, table, p, lossless, work)
            if status != OK:
                return status, worst, side, drag
            drag = drag_at(u, speed, speed / p.ratio, oil, table, p)
        for i in range(_N_MEANS):
            mean[i] = 0.0
        for k in range(angles):
            angle = 2.0 * math.pi * k / (angles * p.mesh.z_p)
            here = turning_at(angle, carried, speed, u, data, p)
            _add_angle(here, torque, drag, 1.0 / angles, data, oil, p, work)
        missing = mean[_MISSING]
        if abs(missing) <= _BALANCED * max(abs(torque), abs(carried), _LEAST_TORQUE):
            break
        carried += missing
    else:
        return NO_BALANCE, missing, side, drag
    for i in range(N_LOSSES):
        losses[i] = mean[i]
    return OK, carried, side, drag
