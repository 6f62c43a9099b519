"""Film and asperity data at the nodes of the mesh table.

It is part of the state of an axle. Evaluating the model takes longer than all else of a flank, and
in steady running each tooth pair meets a node under the load and speed of the pair before it. So
each node is evaluated once, with its slopes over force and speed, and kept until force, speed or
oil have changed. Unless they have changed by much, what the change has done to the values renews
the slopes: that takes one evaluation, where slopes from nothing take three.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.friction.flank_film import ModelFilm
from gearlube_core.kernels.jit import kernel


class NodeFlank(NamedTuple):
    """A flank at a node: all floats, and fit to be interpolated.

    Its forces are those over the mesh force, so that they are zero where the flank carries nothing.
    """

    log_film: float  # as in `ModelFilm`
    log_friction: float
    viscous: float  # friction of the film over the mesh force [-]
    boundary: float  # of asperities [-]
    outside: float  # as in `ModelFilm`
    bound: float  # of both frictions together [-]


# places of one node: 1 + its number, 0 for none; mesh force [N], pinion speed [rad/s] and oil
# temperature [K] of then; its flank; slopes of the first four over relative force and speed
_NODE, _FORCE, _SPEED, _OIL, _VALUES = range(5)
_SLOPED = 4
_OUTSIDE, _BOUND = _VALUES + _SLOPED, _VALUES + _SLOPED + 1
_OVER_FORCE = _VALUES + len(NodeFlank._fields)
_OVER_SPEED = _OVER_FORCE + _SLOPED
N_NODE_FILM = _OVER_SPEED + _SLOPED
NODES_KEPT = 64  # a table with more nodes works too: nodes 64 apart then take one another's place
N_FILMS = NODES_KEPT * N_NODE_FILM
# relative changes of force and speed that slopes are taken over, and that ask for new values
NUDGE = 0.02
_REACH = 0.03
_OIL_REACH = 0.1  # K
# changes of force and speed, relative to now, up to which slopes follow from what they have done
_SECANT_REACH = 0.6


@kernel
def place_of_node(node: int) -> int:
    """Return where what is kept of a node begins in `films`, shape (>= N_FILMS,)."""
    return (node % NODES_KEPT) * N_NODE_FILM


@kernel
def still_holds(films: Array, node: int, force: float, speed: float, temperature: float) -> bool:
    """Return whether what is kept was found at this node, and about under the same conditions.

    Parameters
    ----------
    films : ndarray of shape (>= N_FILMS,)
    node : int
    force, speed, temperature : float
        Mesh force [N], pinion speed [rad/s] and oil temperature [K] now.
    """
    at = place_of_node(node)
    return (
        films[at + _NODE] == node + 1.0
        and abs(force - films[at + _FORCE]) <= _REACH * abs(films[at + _FORCE])
        and abs(speed - films[at + _SPEED]) <= _REACH * abs(films[at + _SPEED])
        and abs(temperature - films[at + _OIL]) <= _OIL_REACH
    )


@kernel
def keep_flank(
    films: Array, node: int, force: float, speed: float, temperature: float, flank: NodeFlank
) -> None:
    """Keep a flank at a node; its slopes are those from before. Arguments as in `still_holds`."""
    at = place_of_node(node)
    films[at + _NODE] = node + 1.0
    films[at + _FORCE] = force
    films[at + _SPEED] = speed
    films[at + _OIL] = temperature
    for i in range(len(flank)):
        films[at + _VALUES + i] = flank[i]


@kernel
def keep_slopes(films: Array, node: int, nudged: NodeFlank, over_speed: bool) -> None:
    """Keep how the flank that is kept at a node changes with force, or with speed.

    `nudged` is the flank where that one is greater by NUDGE.
    """
    at = place_of_node(node)
    slopes = at + (_OVER_SPEED if over_speed else _OVER_FORCE)
    for i in range(_SLOPED):
        films[slopes + i] = (nudged[i] - films[at + _VALUES + i]) / NUDGE


@kernel
def tells_slopes(films: Array, node: int, force: float, speed: float, temperature: float) -> bool:
    """Return whether slopes at a node follow from those that are kept and from what has changed.

    Arguments as in `still_holds`.
    """
    at = place_of_node(node)
    return (
        films[at + _NODE] == node + 1.0
        and abs(force - films[at + _FORCE]) <= _SECANT_REACH * abs(force)
        and abs(speed - films[at + _SPEED]) <= _SECANT_REACH * abs(speed)
        and abs(temperature - films[at + _OIL]) <= _OIL_REACH
    )


@kernel
def _relative(now: float, then: float) -> float:
    return now / then - 1.0 if then != 0.0 else 0.0


@kernel
def follow_flank(films: Array, node: int, force: float, speed: float, flank: NodeFlank) -> None:
    """Keep a flank at a node that force and speed have changed at, with slopes by the change.

    S + (y - S d) d^T/(d^T d), with slopes S over force and speed relative to now, their step d and
    the change y of the values

    Parameters
    ----------
    force, speed, flank
        As they are now; others as in `still_holds`. `tells_slopes` must hold.

    Notes
    -----
    Along the step slopes are those between both states; across it they stay. Source:
    [broyden_1965], method 1.
    """
    at = place_of_node(node)
    more_force = -_relative(films[at + _FORCE], force)
    more_speed = -_relative(films[at + _SPEED], speed)
    # slopes over relative changes: what they are relative to has changed
    scale_force, scale_speed = 1.0 / (1.0 - more_force), 1.0 / (1.0 - more_speed)
    square = more_force * more_force + more_speed * more_speed
    for i in range(_SLOPED):
        over_force = films[at + _OVER_FORCE + i] * scale_force
        over_speed = films[at + _OVER_SPEED + i] * scale_speed
        done = flank[i] - films[at + _VALUES + i]
        missed = (done - over_force * more_force - over_speed * more_speed) / square
        films[at + _OVER_FORCE + i] = over_force + missed * more_force
        films[at + _OVER_SPEED + i] = over_speed + missed * more_speed
    keep_flank(films, node, force, speed, films[at + _OIL], flank)


@kernel
def _value(films: Array, at: int, i: int, force: float, speed: float) -> float:
    # value i of the node that is kept at `at`, force and speed relative to those of then
    here = films[at + _VALUES + i] + films[at + _OVER_FORCE + i] * force
    return here + films[at + _OVER_SPEED + i] * speed


@kernel
def flank_between(
    films: Array, before: int, after: int, t: float, force: float, speed: float
) -> NodeFlank:
    """Return the flank between two nodes that are kept, 0 <= t <= 1; others as in `still_holds`."""
    a, b = place_of_node(before), place_of_node(after)
    force_a, speed_a = _relative(force, films[a + _FORCE]), _relative(speed, films[a + _SPEED])
    force_b, speed_b = _relative(force, films[b + _FORCE]), _relative(speed, films[b + _SPEED])
    u = 1.0 - t
    return NodeFlank(
        u * _value(films, a, 0, force_a, speed_a) + t * _value(films, b, 0, force_b, speed_b),
        u * _value(films, a, 1, force_a, speed_a) + t * _value(films, b, 1, force_b, speed_b),
        u * _value(films, a, 2, force_a, speed_a) + t * _value(films, b, 2, force_b, speed_b),
        u * _value(films, a, 3, force_a, speed_a) + t * _value(films, b, 3, force_b, speed_b),
        u * films[a + _OUTSIDE] + t * films[b + _OUTSIDE],
        u * films[a + _BOUND] + t * films[b + _BOUND],
    )


@kernel
def film_of(flank: NodeFlank) -> ModelFilm:
    """Return film and friction of a flank by the film model."""
    return ModelFilm(flank.log_film, flank.log_friction, flank.outside)
