"""What a film model said at the two nodes of the mesh table around each tooth pair.

It is part of the state of an axle: evaluating the model takes longer than all else of a flank, so
each node is evaluated once, when a pair comes before it.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.friction.flank_bound import ModelFilm
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.table import PAIRS

# places of one pair: 1 + the node before it, 0 for none; force [N] and speed [rad/s] of then; films
_NODE, _FORCE, _SPEED, _VALUES = range(4)
_N_VALUES = 3
N_NODE_FILM = _VALUES + 2 * _N_VALUES
N_FILMS = PAIRS * N_NODE_FILM
SAME, NEXT, OTHER = range(3)  # where a pair is now: before the same node, the next, another
_FORCE_REACH = 0.1  # change of the mesh force that asks for new values, relative
_SPEED_REACH = 0.05


@kernel
def node_films(films: Array, pair: int) -> Array:
    """Return the part of one pair of `films`, shape (>= N_FILMS,)."""
    first = pair * N_NODE_FILM
    return films[first : first + N_NODE_FILM]


@kernel
def forget_films(kept: Array) -> None:
    """Mark that nothing is kept of a pair; `kept` of shape (N_NODE_FILM,) here and below."""
    kept[_NODE] = 0.0


@kernel
def nodes_on(kept: Array, node: int, n_nodes: int, force: float, speed: float) -> int:
    """Return whether a pair is past the SAME node as before, the NEXT, or anything OTHER.

    Parameters
    ----------
    node, n_nodes : int
        The node before the pair now, and the number of nodes.
    force, speed : float
        Mesh force [N] and pinion speed [rad/s] now.
    """
    before = int(kept[_NODE]) - 1
    turned = abs(speed - kept[_SPEED]) > _SPEED_REACH * abs(kept[_SPEED])
    if before < 0 or turned or abs(force - kept[_FORCE]) > _FORCE_REACH * abs(kept[_FORCE]):
        return OTHER
    if node == before:
        return SAME
    return NEXT if node == (before + 1) % n_nodes else OTHER


@kernel
def start_films(kept: Array, node: int, force: float, speed: float) -> None:
    """Keep where both values are from that follow; arguments as in `nodes_on`."""
    kept[_NODE] = node + 1.0
    kept[_FORCE] = force
    kept[_SPEED] = speed


@kernel
def take_next(kept: Array, node: int) -> None:
    """Move on by a node: what was ahead is behind."""
    kept[_NODE] = node + 1.0
    for i in range(_N_VALUES):
        kept[_VALUES + i] = kept[_VALUES + _N_VALUES + i]


@kernel
def keep_film(kept: Array, place: int, film: ModelFilm) -> None:
    """Keep what the model said behind (place 0) or ahead (1)."""
    for i in range(_N_VALUES):
        kept[_VALUES + place * _N_VALUES + i] = film[i]


@kernel
def film_between(kept: Array, t: float) -> ModelFilm:
    """Return the film between both nodes, 0 <= t <= 1."""
    a = _VALUES
    b = _VALUES + _N_VALUES
    return ModelFilm(
        kept[a] + t * (kept[b] - kept[a]),
        kept[a + 1] + t * (kept[b + 1] - kept[a + 1]),
        kept[a + 2] + t * (kept[b + 2] - kept[a + 2]),
    )
