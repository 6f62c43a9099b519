"""Where the parts of a mesh of a hypoid pair stand in its memory and in the state of its train."""

from __future__ import annotations

from typing import Any

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.flanks import N_FRICTION
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForce,
    MeshForceConstants,
    MeshMotion,
    mesh_force,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.train.element import RZ, W
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, blend_levels, load_bracket

# places of `at` behind both bodies
AT_X, AT_VISCOUS, AT_BOUNDARY, AT_ROLLING, AT_DAMPING, AT_BOUND, AT_KEPT, AT_PORT = range(2, 10)
N_LEVELS, N_ORDERS, N_NODES, N_SERIES_AT, N_FILM = range(10, 15)
# what is kept: load that selects the level [N.m], side, mean stiffness at the start [N/m], films at
# the nodes with a film model
KEPT_LOAD, KEPT_SIDE, KEPT_STIFFNESS, OWN_FILMS = range(4)
# places in the memory: load and side of the data in use, torque on the pinion [N.m], rate of the
# transmission error [m/s] in the last stage, 1 while tractions are to be found again, length of
# the last step [s], how much of a difference the load level follows in it, how films are asked for
# outputs, 1 where periodic data are held at their means, the table
OF_LOAD, OF_SIDE, TORQUE, X_RATE, RENEWED, LAST_STEP, FOLLOWS, ASKED, AT_MEANS, TABLE = range(10)


@inside
def mesh_motion(at: Any, s: Array) -> MeshMotion:
    """Return the motion of both members as their mesh takes it."""
    p, g = at[0], at[1]
    return MeshMotion(
        s[p + RZ], s[at[AT_X]], s[p + W], s[g + W],
        s[p] - s[g], s[p + 1] - s[g + 1], s[p + 2] - s[g + 2],
        s[p + 6] - s[g + 6], s[p + 7] - s[g + 7], s[p + 8] - s[g + 8],
    )  # fmt: skip


@inside
def torque_of(at: Any, memory: Array, s: Array) -> float:
    """Return the torque that selects the level of the table [N.m]."""
    return s[at[AT_PORT]] if at[AT_PORT] > 0 else memory[TORQUE]


@inside
def window_size(at: Any) -> int:
    """Return how many numbers the tooth pairs have at one load."""
    return (at[N_NODES] + 1) * N_CHANNELS


@inside
def friction_at(at: Any) -> int:
    """Return where friction stands in the memory: behind the table at all loads and at this one."""
    return TABLE + at[N_LEVELS] + (at[N_LEVELS] + 1) * (at[N_SERIES_AT] + window_size(at))


@inside
def friction_in(at: Any, memory: Array) -> Array:
    """Return the kept friction, shape (N_FRICTION,)."""
    return part(memory, friction_at(at), N_FRICTION)


@inside
def table_in(at: Any, memory: Array) -> MeshLevels:
    """Return the table at all loads."""
    levels = at[N_LEVELS]
    at_series = TABLE + levels
    at_windows = at_series + levels * at[N_SERIES_AT]
    at_film = friction_at(at) + N_FRICTION + N_CHANNELS
    return MeshLevels(
        part(memory, TABLE, levels),
        part(memory, at_series, levels * at[N_SERIES_AT]),
        at[N_ORDERS],
        part(memory, at_windows, levels * window_size(at)),
        at[N_NODES],
        part(memory, at_film, at[N_FILM]),
        part(memory, at_film, 0),
    )


@inside
def _at_load(at: Any, memory: Array, size: int, orders: int) -> MeshAtLoad:
    at_friction = friction_at(at)
    at_window = at_friction - window_size(at)
    at_film = at_friction + N_FRICTION + N_CHANNELS
    return MeshAtLoad(
        part(memory, at_window - at[N_SERIES_AT], size),
        orders,
        part(memory, at_window, window_size(at)),
        at[N_NODES],
        part(memory, at_film, at[N_FILM]),
        part(memory, at_film, 0),
    )


@inside
def now_in(at: Any, memory: Array) -> MeshAtLoad:
    """Return the table at the present load, or its means."""
    size, orders = at[N_SERIES_AT], at[N_ORDERS]
    if memory[AT_MEANS] != 0.0:
        size, orders = N_SERIES, 0
    return _at_load(at, memory, size, orders)


@kernel
def blend(at: Any, memory: Array, s: Array) -> None:
    """Interpolate the table to the load that is kept."""
    memory[OF_LOAD], memory[OF_SIDE] = s[at[AT_KEPT] + KEPT_LOAD], s[at[AT_KEPT] + KEPT_SIDE]
    whole = _at_load(at, memory, at[N_SERIES_AT], at[N_ORDERS])
    blend_mesh(memory[OF_LOAD], memory[OF_SIDE], table_in(at, memory), whole)


@kernel
def force_at_load(
    p: MeshForceConstants, at: Any, memory: Array, s: Array, series: Array
) -> MeshForce:
    """Return the mesh force in a state with the table at its load; memory stays as it is.

    Parameters
    ----------
    series : ndarray of shape (coefficients at a load,)
        Scratch memory, its values are lost.
    """
    table = table_in(at, memory)
    load, side = s[at[AT_KEPT] + KEPT_LOAD], s[at[AT_KEPT] + KEPT_SIDE]
    bracket = load_bracket(load, side, table.levels, table.levels.size)
    blend_levels(table.series, series.size, bracket, series)
    return mesh_force(mesh_motion(at, s), series, at[N_ORDERS], p)
