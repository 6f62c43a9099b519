"""Right-hand side of the 8-DOF hypoid axle."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    NO_RACEWAYS,
    RollerFilms,
    ShaftMotion,
    SolvedRaceways,
    expanded_forces,
)
from gearlube_core.bearings.followed_shaft import (
    N_FOLLOWED,
    N_FORCES,
    ShaftDrag,
    drag_holds,
    drag_near,
    drag_of_shaft,
    expand_about,
    follow_forces,
    forget_forces,
    moving_parts,
    raceways_of_shaft,
    renew_drag,
)
from gearlube_core.bearings.parameters import cage_torque
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    CHURNING,
    MESH_DAMPING,
    N_ROLLERS,
    PHI_G,
    PHI_P,
    PINION_WORK,
    ROLLING,
    SEALS,
    SIDE,
    U_G,
    U_P,
    UM,
    V_G,
    V_P,
    VISCOUS,
    W_G,
    W_P,
    WHEEL_WORK,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import N_FRICTION, flank_sum
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, follow_flank
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForceConstants,
    MeshMotion,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_mesh.step_parts import MICRO
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantState

AT_EXPANSION = N_FRICTION + N_CHANNELS
AT_ROLLERS = AT_EXPANSION + 2 * N_FORCES  # `roller_nodes` of outputs
SCRATCH = AT_ROLLERS + N_ROLLERS


class StepInputs(NamedTuple):
    """What is constant over one integrator step."""

    pinion_torque: float  # N.m
    wheel_torque: float  # N.m
    drag_p: float  # drag torque of both pinion bearings [N.m]
    drag_g: float  # ditto of the gear's
    churning: float  # of the gear in its oil [N.m]
    seal_p: float  # of the pinion's seal [N.m]
    seal_g: float  # of the seals of both wheels, at the gear [N.m]


@kernel
def pinion_motion(s: Array) -> ShaftMotion:
    """Return the motion of the pinion in its bearings.

    The shaft lies along x: r1 = z, r2 = y turns with the pinion, which drives about -x.
    """
    return ShaftMotion(
        s[U_P + 2] * UM,
        s[U_P + 1] * UM,
        s[U_P] * UM,
        s[V_P + 2],
        s[V_P + 1],
        s[V_P],
        s[CAGE_P],
        s[W_P],
    )


@kernel
def gear_motion(s: Array) -> ShaftMotion:
    """Return the motion of the gear in its bearings; the shaft lies along z."""
    return ShaftMotion(
        s[U_G] * UM,
        s[U_G + 1] * UM,
        s[U_G + 2] * UM,
        s[V_G],
        s[V_G + 1],
        s[V_G + 2],
        s[CAGE_G],
        s[W_G],
    )


@kernel
def mesh_motion(s: Array) -> MeshMotion:
    """Return the motion of both members as their mesh takes it."""
    return MeshMotion(
        s[PHI_P],
        s[X] * UM,
        s[W_P],
        s[W_G],
        (s[U_P] - s[U_G]) * UM,
        (s[U_P + 1] - s[U_G + 1]) * UM,
        (s[U_P + 2] - s[U_G + 2]) * UM,
        s[V_P] - s[V_G],
        s[V_P + 1] - s[V_G + 1],
        s[V_P + 2] - s[V_G + 2],
    )


class AxleRaceways(NamedTuple):
    """Raceways of both shafts by solved films."""

    pinion: SolvedRaceways = NO_RACEWAYS
    gear: SolvedRaceways = NO_RACEWAYS


class AxleDrag(NamedTuple):
    """Drag of the bearings of both shafts."""

    pinion: ShaftDrag
    gear: ShaftDrag


@inside
def _films_of(films: RollerFilms, shaft: int) -> RollerFilms:
    if films.nodes.size == 0:
        return films
    return RollerFilms(
        films.model, part(films.nodes, shaft * N_ROLLER_NODES, N_ROLLER_NODES), films.kept
    )


@kernel
def axle_raceways(
    s: Array, oil: LubricantState, p: AxleParameters, films: RollerFilms
) -> AxleRaceways:
    """Return torques and films of the raceways if p.drag is SOLVED_FILMS; else NO_RACEWAYS.

    `films` has the nodes of both shafts, shape (N_ROLLERS,), read only if they are kept.
    """
    return AxleRaceways(
        raceways_of_shaft(p.bearing_p, pinion_motion(s), p.drag, oil, _films_of(films, 0)),
        raceways_of_shaft(p.bearing_g, gear_motion(s), p.drag, oil, _films_of(films, 1)),
    )


@kernel
def axle_drag(s: Array, oil: LubricantState, p: AxleParameters, raceways: AxleRaceways) -> AxleDrag:
    """Return the drag of the bearings by the law p.drag, see `drag_of_shaft`.

    `raceways` are those of `axle_raceways` at this state.
    """
    pinion, gear = pinion_motion(s), gear_motion(s)
    return AxleDrag(
        drag_of_shaft(p.bearing_p, pinion, p.preload_p, p.drag, oil, raceways.pinion),
        drag_of_shaft(p.bearing_g, gear, p.preload_g, p.drag, oil, raceways.gear),
    )


@kernel
def kept_drag(s: Array, kept: Array) -> AxleDrag:
    """Return the drag by what is kept of both shafts, shape (N_DRAG,), see `drag_near`."""
    return AxleDrag(
        drag_near(pinion_motion(s), part(kept, 0, N_FOLLOWED)),
        drag_near(gear_motion(s), part(kept, N_FOLLOWED, N_FOLLOWED)),
    )


@kernel
def drag_after_step(
    s: Array, oil: LubricantState, p: AxleParameters, kept: Array, raceways: AxleRaceways
) -> AxleDrag:
    """Return the drag with which the next step begins: by what is kept, where that holds.

    Arguments as in `axle_drag` and `kept_drag`.
    """
    near, exact = kept_drag(s, kept), axle_drag(s, oil, p, raceways)
    of_pinion, of_gear = part(kept, 0, N_FOLLOWED), part(kept, N_FOLLOWED, N_FOLLOWED)
    return AxleDrag(
        near.pinion if drag_holds(pinion_motion(s), oil.temperature, of_pinion) else exact.pinion,
        near.gear if drag_holds(gear_motion(s), oil.temperature, of_gear) else exact.gear,
    )


@kernel
def drag_is_kept(s: Array, temperature: float, kept: Array) -> bool:
    """Return whether what is kept of both shafts holds."""
    of_pinion, of_gear = part(kept, 0, N_FOLLOWED), part(kept, N_FOLLOWED, N_FOLLOWED)
    holds = drag_holds(pinion_motion(s), temperature, of_pinion)
    return holds and drag_holds(gear_motion(s), temperature, of_gear)


@kernel
def follow_drag(
    s: Array, oil: LubricantState, p: AxleParameters, films: RollerFilms, kept: Array
) -> float:
    """Renew what is kept where it no longer holds; return how many evaluations that took.

    Arguments as in `axle_raceways` and `kept_drag`.
    """
    pinion, gear, taken = pinion_motion(s), gear_motion(s), 0.0
    own = part(kept, 0, N_FOLLOWED)
    if not drag_holds(pinion, oil.temperature, own):
        of_pinion = _films_of(films, 0)
        taken += renew_drag(p.bearing_p, pinion, p.preload_p, p.drag, oil, of_pinion, own)
    own = part(kept, N_FOLLOWED, N_FOLLOWED)
    if not drag_holds(gear, oil.temperature, own):
        of_gear = _films_of(films, 1)
        taken += renew_drag(p.bearing_g, gear, p.preload_g, p.drag, oil, of_gear, own)
    return taken


@kernel
def follow_flank_of(
    s: Array, load_torque: float, table: MeshLevels, p: MeshForceConstants, mesh: MeshAtLoad
) -> None:
    """Do what `follow_flank` does in the state `s` of an axle, (N_STATE,), at X and SIDE."""
    x, side = follow_flank(mesh_motion(s), load_torque, s[SIDE], table, p, mesh)
    if side != s[SIDE]:
        s[X], s[SIDE] = x * MICRO, side


@kernel
def gear_frequency(p: AxleParameters, gear_speed: float) -> float:
    """Return the mesh frequency by the gear's speed [Hz], see `reference_frequency`."""
    return reference_frequency(p.mesh, p.ratio * gear_speed)


@kernel
def expand_bearings(s: Array, oil: LubricantState, p: AxleParameters, scratch: Array) -> None:
    """Expand the bearing forces of both shafts about the state `s`; others as in `axle_rhs`."""
    f_p, f_g = reference_frequency(p.mesh, s[W_P]), gear_frequency(p, s[W_G])
    expand_about(p.bearing_p, pinion_motion(s), f_p, oil, part(scratch, AT_EXPANSION, N_FORCES))
    of_gear = part(scratch, AT_EXPANSION + N_FORCES, N_FORCES)
    expand_about(p.bearing_g, gear_motion(s), f_g, oil, of_gear)


@kernel
def forget_bearings(scratch: Array) -> None:
    """Have the next step expand the forces of both shafts."""
    forget_forces(part(scratch, AT_EXPANSION, N_FORCES))
    forget_forces(part(scratch, AT_EXPANSION + N_FORCES, N_FORCES))


@kernel
def follow_bearings(
    s: Array, h: float, reach: float, oil: LubricantState, p: AxleParameters, scratch: Array
) -> None:
    """Make the expansions fit for a step of `h` [s], see `follow_forces`; others as `axle_rhs`."""
    f_p, f_g = reference_frequency(p.mesh, s[W_P]), gear_frequency(p, s[W_G])
    of_pinion = part(scratch, AT_EXPANSION, N_FORCES)
    follow_forces(p.bearing_p, pinion_motion(s), f_p, oil, h, reach, of_pinion)
    of_gear = part(scratch, AT_EXPANSION + N_FORCES, N_FORCES)
    follow_forces(p.bearing_g, gear_motion(s), f_g, oil, h, reach, of_gear)


@kernel
def parts_of_step(s: Array, h: float) -> int:
    """Return into how many parts the bearings divide a step of `h` [s], see `moving_parts`."""
    return max(moving_parts(pinion_motion(s), h), moving_parts(gear_motion(s), h))


@kernel
def axle_rhs(
    s: Array,
    inputs: StepInputs,
    mesh_data: MeshAtLoad,
    oil: LubricantState,
    p: AxleParameters,
    tractions: float,
    bearings: float,
    scratch: Array,
    ds: Array,
) -> float:
    """Write ds/dt of the N_ODE integrated states into `ds`; return the mesh force [N].

    I_p w_p' = T_p - R_p F + T_fr,p ; I_g w_g' = -T_g + R_g F + T_fr,g
    m_p u_p'' = -n F - f xi + F_b,p ; m_g u_g'' = +n F + f xi + F_b,g

    Parameters
    ----------
    s, ds : ndarray of shape (N_STATE,), (N_ODE,)
    inputs : StepInputs
    mesh_data : MeshAtLoad
    oil : LubricantState
    p : AxleParameters
    tractions, bearings : float
        Not 0: evaluate films and tractions, see `flank_sum`, and expand the bearing forces about
        this state; with EXACT and 1 the right-hand side is exact. At 0 friction coefficients are
        kept from the last time, and bearing forces are linear about the state of then. (Floats,
        because numba would compile the kernel anew for each literal integer.)
    scratch : ndarray of shape (SCRATCH,)
        What is kept between calls, and work space.

    Notes
    -----
    The printed [mohammadpour_2015 (1)] c-h has the opposite sign of n F to the one that
    [mohammadpour_2015 (2)] implies, and no flank friction in the lateral equations: p.lateral_sign
    = -1, p.mesh.consistent = 0. The moment that the loaded rollers exert on the orbiting cage is
    carried by its shaft in the consistent form; the paper has none, and its rollers then do work
    on nothing.

    References
    ----------
    [mohammadpour_2015 (1)] [mohammadpour_2015 (6)]
    """
    at_mesh = mesh_motion(s)
    mesh = mesh_force(at_mesh, mesh_data.series, mesh_data.n_orders, p.mesh)
    friction = flank_sum(
        at_mesh,
        mesh.force,
        mesh_data.window,
        mesh_data.n_nodes,
        oil,
        p,
        tractions,
        part(scratch, 0, N_FRICTION),
        part(scratch, N_FRICTION, N_CHANNELS),
        mesh_data.film_model,
    )
    w_p = s[W_P]
    w_g = s[W_G]
    if bearings != 0.0:
        expand_bearings(s, oil, p, scratch)
    expansion_p = part(scratch, AT_EXPANSION, N_FORCES)
    expansion_g = part(scratch, AT_EXPANSION + N_FORCES, N_FORCES)
    pinion = pinion_motion(s)
    gear = gear_motion(s)
    p_z, p_y, p_x, lost_p = expanded_forces(p.bearing_p, pinion, expansion_p)
    g_x, g_y, g_z, lost_g = expanded_forces(p.bearing_g, gear, expansion_g)
    shared = p.mesh.consistent
    cage_p = cage_torque(pinion.r1, pinion.r2, p_z, p_y)
    cage_g = cage_torque(gear.r1, gear.r2, g_x, g_y)
    on_shaft_p = shared * p.bearing_p.cage_ratio * cage_p - inputs.drag_p - inputs.seal_p
    drag_g = inputs.drag_g + inputs.churning + inputs.seal_g
    on_shaft_g = shared * p.bearing_g.cage_ratio * cage_g - drag_g

    ds[X] = mesh.x_rate * MICRO
    ds[W_P] = (inputs.pinion_torque + mesh.torque_p + friction.torque_p + on_shaft_p) / p.I_p
    ds[W_G] = (-inputs.wheel_torque + mesh.torque_g + friction.torque_g + on_shaft_g) / p.I_g
    ds[PHI_P] = w_p
    ds[PHI_G] = w_g
    lateral = p.lateral_sign * mesh.force
    ds[V_P] = (-mesh.n_x * lateral + shared * friction.f_x + p_x) / p.m_p
    ds[V_P + 1] = (-mesh.n_y * lateral + shared * friction.f_y + p_y) / p.m_p
    ds[V_P + 2] = (-mesh.n_z * lateral + shared * friction.f_z + p_z) / p.m_p
    ds[V_G] = (mesh.n_x * lateral - shared * friction.f_x + g_x) / p.m_g
    ds[V_G + 1] = (mesh.n_y * lateral - shared * friction.f_y + g_y) / p.m_g
    ds[V_G + 2] = (mesh.n_z * lateral - shared * friction.f_z + g_z) / p.m_g
    for i in range(3):
        ds[U_P + i] = s[V_P + i] * MICRO
        ds[U_G + i] = s[V_G + i] * MICRO
    ds[CAGE_P] = p.bearing_p.cage_ratio * w_p
    ds[CAGE_G] = p.bearing_g.cage_ratio * w_g
    ds[PINION_WORK] = inputs.pinion_torque * w_p
    ds[WHEEL_WORK] = inputs.wheel_torque * w_g
    ds[VISCOUS] = friction.viscous_power
    ds[BOUNDARY] = friction.boundary_power
    ds[MESH_DAMPING] = mesh.damping_power
    ds[BEARING_DAMPING] = lost_p + lost_g
    ds[BEARING_TORQUE] = inputs.drag_p * w_p + inputs.drag_g * w_g
    ds[CHURNING] = inputs.churning * w_g
    ds[SEALS] = inputs.seal_p * w_p + inputs.seal_g * w_g
    ds[ROLLING] = friction.rolling_power
    return mesh.force
