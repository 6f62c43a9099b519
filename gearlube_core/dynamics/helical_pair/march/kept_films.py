"""Results of a film model at nodes of the mesh phase, kept for later mesh periods.

Evaluating the model takes ten times as long as the formulas, and in each mesh period the lines meet
the same places under much the same load and speed. So the model is evaluated at nodes, one for each
refresh of the friction, and there in the middle of bins of load, speed and oil temperature, with
its slopes. Node and bin alone decide what is found. So it does not matter what is kept and what is
found again: it is no part of the state.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import FLANK_POINTS, POINTS_PER_LINE
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below

NODES_KEPT = 16  # nodes of a mesh period; with more refreshes nothing is kept
LOAD_BIN, SPEED_BIN = 0.1, 0.1  # widths, of logarithms
OIL_BIN = 2.0  # K
NUDGES = (0.02, 0.02, 0.5, 0.01)  # for slopes: ln load, ln speed, oil [K], ln sliding
N_FILMS = 1 + len(NUDGES)  # of a bin
LEAST_SPEED = 1e-2  # rad/s of the pinion, below which nothing is kept


class NodeFilm(NamedTuple):
    """Result of the model at a place: floats that can be interpolated."""

    log_film: float  # of the central film over that of Dowson and Toyoda [-]
    log_friction: float  # of the film's own coefficient [-]
    border: float  # part of the domain's border that is passed, of which `outside` is a smooth step


class Bin(NamedTuple):
    """A bin of load, speed and oil temperature, and where in it, from -1/2 to 1/2."""

    load: float
    speed: float
    oil: float
    of_load: float
    of_speed: float
    of_oil: float


# places of what is kept: 1 where it is, bin, sliding over pinion speed, exponent of the friction
# over it, values, and slopes of the values over each number of the bin
_FULL, _LOAD, _SPEED, _OIL, _SLIDE, _EXPONENT, _VALUES = range(7)
_N = len(NodeFilm._fields)
_SLOPES = _VALUES + _N
N_KEPT = _SLOPES + 3 * _N
_SIDES = 4  # neighbours in load and in speed have places of their own
N_KEPT_FILMS = 2 * NODES_KEPT * FLANK_POINTS * _SIDES * N_KEPT


@kernel
def bin_of(line_load: float, pinion_speed: float, temperature: float) -> Bin:
    """Return the bin of a load [N/m], a speed [rad/s], both above zero, and an oil [K]."""
    load, speed = math.log(line_load) / LOAD_BIN, math.log(pinion_speed) / SPEED_BIN
    oil = temperature / OIL_BIN
    i, j, k = np.floor(load), np.floor(speed), np.floor(oil)
    return Bin(i, j, k, load - i - 0.5, speed - j - 0.5, oil - k - 0.5)


@kernel
def middle_of(box: Bin) -> tuple[float, float, float]:
    """Return load [N/m], pinion speed [rad/s] and oil temperature [K] in the middle of a bin."""
    return (
        math.exp(LOAD_BIN * (box.load + 0.5)),
        math.exp(SPEED_BIN * (box.speed + 0.5)),
        OIL_BIN * (box.oil + 0.5),
    )


@kernel
def place_of(coast: bool, node: int, line: int, place: int, box: Bin) -> int:
    """Return where a point of a line at a node has its place in what is kept."""
    point = line * POINTS_PER_LINE + place
    at = ((NODES_KEPT if coast else 0) + node) * FLANK_POINTS + point
    odd = 2.0 * (box.load - 2.0 * np.floor(0.5 * box.load))
    odd += box.speed - 2.0 * np.floor(0.5 * box.speed)
    return (at * _SIDES + place_below(odd, _SIDES)) * N_KEPT


@kernel
def is_kept(kept: Array, at: int, box: Bin) -> bool:
    """Return whether what is kept at a place is of this bin."""
    return (
        kept[at + _FULL] == 1.0
        and kept[at + _LOAD] == box.load
        and kept[at + _SPEED] == box.speed
        and kept[at + _OIL] == box.oil
    )


@kernel
def begin_bin(kept: Array, at: int, box: Bin, slide: float) -> None:
    """Give a place to a bin; `slide` is the node's sliding speed over pinion speed [m]."""
    kept[at + _FULL] = 1.0
    kept[at + _LOAD] = box.load
    kept[at + _SPEED] = box.speed
    kept[at + _OIL] = box.oil
    kept[at + _SLIDE] = slide


@kernel
def keep_film(kept: Array, at: int, n: int, film: NodeFilm) -> None:
    """Keep film `n` of a bin: 0, in its middle; then, with NUDGES[n - 1] on one of its numbers."""
    if n == 0:
        for i in range(_N):
            kept[at + _VALUES + i] = film[i]
    elif n == N_FILMS - 1:
        change = film.log_friction - kept[at + _VALUES + 1]
        kept[at + _EXPONENT] = change / NUDGES[3]
    else:
        width = (LOAD_BIN, SPEED_BIN, OIL_BIN)[n - 1] / NUDGES[n - 1]
        for i in range(_N):
            change = film[i] - kept[at + _VALUES + i]
            kept[at + _SLOPES + (n - 1) * _N + i] = change * width


@kernel
def _value(kept: Array, at: int, i: int, box: Bin) -> float:
    slopes = at + _SLOPES + i
    value = kept[at + _VALUES + i] + kept[slopes] * box.of_load
    return value + kept[slopes + _N] * box.of_speed + kept[slopes + 2 * _N] * box.of_oil


@kernel
def film_in(kept: Array, at: int, box: Bin, slide: float) -> NodeFilm:
    """Return the kept results at a place, at the load, speed and oil temperature of `box`.

    `slide` is sliding speed over pinion speed now [m]: friction goes with the power of it that
    it has at the node, which is one in slow sliding. Beyond the pitch line it is that of the node.
    """
    ratio = slide / kept[at + _SLIDE] if kept[at + _SLIDE] != 0.0 else 0.0
    friction = _value(kept, at, 1, box)
    if ratio > 0.0:
        friction += kept[at + _EXPONENT] * math.log(ratio)
    return NodeFilm(_value(kept, at, 0, box), friction, _value(kept, at, 2, box))


@kernel
def forget(kept: Array) -> None:
    """Forget all that is kept, shape (>= N_KEPT_FILMS,): oil, pair or film model change."""
    for at in range(0, N_KEPT_FILMS, N_KEPT):
        kept[at + _FULL] = 0.0
