"""What a film model and asperities give at the nodes of the mesh table.

It is part of the state of an axle. Evaluating the model takes longer than all else of a flank, and
in steady running each tooth pair meets a node under the load and speed of the pair before it. So
each node is evaluated once and kept until force, speed or oil have changed.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.friction.flank_bound import ModelFilm
from gearlube_core.kernels.jit import kernel


class NodeFlank(NamedTuple):
    """A flank at a node: all floats, and fit to be interpolated.

    Its forces are those over the mesh force, so that they are zero where the flank carries nothing.
    """

    log_film: float  # as in `ModelFilm`
    log_friction: float
    outside: float
    viscous: float  # friction of the film over the mesh force [-]
    boundary: float  # of asperities [-]
    bound: float  # of both together [-]


# places of one node: 1 + its number, 0 for none; mesh force [N], pinion speed [rad/s] and oil
# temperature [K] of then; its flank
_NODE, _FORCE, _SPEED, _OIL, _VALUES = range(5)
_N_VALUES = len(NodeFlank._fields)
N_NODE_FILM = _VALUES + _N_VALUES
NODES_KEPT = 64  # a table with more nodes works too: nodes 64 apart then take one another's place
N_FILMS = NODES_KEPT * N_NODE_FILM
# changes that ask for new values
_FORCE_REACH = 0.01  # relative
_SPEED_REACH = 0.005  # relative
_OIL_REACH = 0.1  # K


@kernel
def node_film(films: Array, node: int) -> Array:
    """Return the part of a node of `films`, shape (>= N_FILMS,): `kept` of shape (N_NODE_FILM,)."""
    first = (node % NODES_KEPT) * N_NODE_FILM
    return films[first : first + N_NODE_FILM]


@kernel
def still_holds(kept: Array, node: int, force: float, speed: float, temperature: float) -> bool:
    """Return whether what is kept was found at this node, and about under the same conditions.

    Parameters
    ----------
    kept : ndarray of shape (N_NODE_FILM,)
    node : int
    force, speed, temperature : float
        Mesh force [N], pinion speed [rad/s] and oil temperature [K] now.
    """
    return (
        kept[_NODE] == node + 1.0
        and abs(force - kept[_FORCE]) <= _FORCE_REACH * abs(kept[_FORCE])
        and abs(speed - kept[_SPEED]) <= _SPEED_REACH * abs(kept[_SPEED])
        and abs(temperature - kept[_OIL]) <= _OIL_REACH
    )


@kernel
def keep_flank(
    kept: Array, node: int, force: float, speed: float, temperature: float, flank: NodeFlank
) -> None:
    """Keep the flank at a node; others as in `still_holds`."""
    kept[_NODE] = node + 1.0
    kept[_FORCE] = force
    kept[_SPEED] = speed
    kept[_OIL] = temperature
    for i in range(_N_VALUES):
        kept[_VALUES + i] = flank[i]


@kernel
def film_between(before: Array, after: Array, t: float) -> ModelFilm:
    """Return the model's film between two nodes as they are kept, 0 <= t <= 1."""
    v = _VALUES
    return ModelFilm(
        before[v] + t * (after[v] - before[v]),
        before[v + 1] + t * (after[v + 1] - before[v + 1]),
        before[v + 2] + t * (after[v + 2] - before[v + 2]),
    )


@kernel
def friction_between(before: Array, after: Array, t: float) -> tuple[float, float, float]:
    """Return viscous and boundary friction and their bound between two nodes, over mesh force."""
    v = _VALUES + 3
    return (
        before[v] + t * (after[v] - before[v]),
        before[v + 1] + t * (after[v + 1] - before[v + 1]),
        before[v + 2] + t * (after[v + 2] - before[v + 2]),
    )
