"""Drag torque of the bearings of a shaft: its laws, and how it is kept while little changes.

The laws that take each roller by itself cost as much as some integrator steps, and depend on where
the shaft stands in its bearings, on speed and on oil alone. So the drag is kept with its slopes,
followed linearly, and evaluated again when the shaft has moved, or speed or oil have changed.
Slopes are renewed by what a change has done; the first ones take an evaluation each.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    NO_RACEWAYS,
    RollerFilms,
    ShaftBearings,
    ShaftMotion,
    SolvedRaceways,
    beside_raceways,
    loaded_drag,
    raceway_torque,
    shaft_drag,
    solved_raceways,
)
from gearlube_core.bearings.losses.laws import PALMGREN as PALMGREN_LAW
from gearlube_core.bearings.losses.laws import ROLLING, ROLLING_LAWS, SKF, number_at
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantState

_BY_ROLLING = {one.in_axle: one.name for one in ROLLING if one.in_axle}
# what `bearings.losses.laws` calls them
BEARING_LAWS = {
    "palmgren": "palmgren",
    "palmgren_loaded": "palmgren",
    "skf_2013": "skf",
    "solved_films": "solved_films",
} | _BY_ROLLING
# their places are values of an FMU's parameter: the released ones stay, later laws stand behind
_RELEASED = (
    "none",
    "palmgren",
    "zhou_hoeprich_1991",
    "biboulet_houpert_2010",
    "aihara_1987",
    "palmgren_loaded",
    "skf_2013",
    "solved_films",
)
TORQUE_LOSSES = (*_RELEASED, *(name for name in _BY_ROLLING if name not in _RELEASED))
_rolling_law = number_at([ROLLING_LAWS.get(_BY_ROLLING.get(name, ""), 0) for name in TORQUE_LOSSES])
PALMGREN = float(TORQUE_LOSSES.index("palmgren"))  # laws up to this one take no single rollers
_PALMGREN_LOADED = float(TORQUE_LOSSES.index("palmgren_loaded"))
_SKF = float(TORQUE_LOSSES.index("skf_2013"))
SOLVED_FILMS = float(TORQUE_LOSSES.index("solved_films"))
# places of what is kept of a shaft: 1 where it is, oil temperature of then [K], torque [N.m] and
# bound [W], displacements [m] and speed [rad/s] of then, and slopes over their reaches
_KNOWN, _OIL, _TORQUE, _BOUND, _THEN = range(5)
_N = 4  # displacements and speed
_SLOPES = _THEN + _N
N_FOLLOWED = _SLOPES + _N
# what asks for another evaluation: a move of 0.3 um bends the drag of a roller under 15 um by 1e-4
_REACH = 0.3e-6  # m
_SPEED_REACH = 0.02  # of 1 rad/s more than the speed
_OIL_REACH = 0.02  # K, as for the nodes of `roller_nodes`
_LEAST_MOVE = 0.25  # square of a move over its reach that says something of the slopes
DRAG_COST = 3.0  # of an evaluation, in integrator steps


class ShaftDrag(NamedTuple):
    """Drag of both bearings of a shaft."""

    torque: float  # with the sign of the speed [N.m]
    bound: float  # of its power by solved films, not negative [W]; 0 with other laws


@kernel
def raceways_of_shaft(
    bearings: ShaftBearings,
    motion: ShaftMotion,
    law: float,
    oil: LubricantState,
    films: RollerFilms,
) -> SolvedRaceways:
    """Return torques and films of the raceways if the law is SOLVED_FILMS; else NO_RACEWAYS."""
    if law != SOLVED_FILMS:
        return NO_RACEWAYS
    return solved_raceways(bearings, motion, oil, films)


@kernel
def drag_of_shaft(
    bearings: ShaftBearings,
    motion: ShaftMotion,
    preload: float,
    law: float,
    oil: LubricantState,
    raceways: SolvedRaceways,
) -> ShaftDrag:
    """Return the drag of both bearings of a shaft by a law, its place in TORQUE_LOSSES.

    Palmgren's is that of the preload; the laws of the catalogues, "palmgren_loaded" and "skf_2013",
    take the present forces of either bearing; the others sum raceways and ribs under the present
    load of each roller, see `raceway_drag`, `solved_raceway_drag` and `rib_drag`.

    Parameters
    ----------
    preload : float
        That of `Bearing.preload_force` [N].
    raceways : SolvedRaceways
        Those of `raceways_of_shaft` at this motion.
    """
    if law == 0.0:
        return ShaftDrag(0.0, 0.0)
    if law == PALMGREN:
        one = shaft_drag(bearings, motion.speed, preload, 0.0, PALMGREN_LAW, oil)
        return ShaftDrag(2.0 * one, 0.0)
    if law in (_PALMGREN_LOADED, _SKF):
        by_catalogue = SKF if law == _SKF else PALMGREN_LAW
        return ShaftDrag(loaded_drag(bearings, motion, by_catalogue, oil), 0.0)
    beside = beside_raceways(bearings, motion, oil)
    if law == SOLVED_FILMS:
        return ShaftDrag(raceways.torque + beside, raceways.torque_bound * abs(motion.speed))
    rolling = raceway_torque(bearings, motion, _rolling_law(law), oil)
    return ShaftDrag(rolling + beside, 0.0)


@kernel
def _change(motion: ShaftMotion, kept: Array, i: int) -> float:
    """Return how far a number is from where the drag was evaluated, over its reach."""
    then = kept[_THEN + i]
    if i == _N - 1:
        return (motion.speed - then) / (_SPEED_REACH * (1.0 + abs(then)))
    return ((motion.r1, motion.r2, motion.axial)[i] - then) / _REACH


@kernel
def _moved(motion: ShaftMotion, i: int) -> ShaftMotion:
    """Return the motion with one number changed by its reach."""
    return ShaftMotion(
        motion.r1 + (_REACH if i == 0 else 0.0),
        motion.r2 + (_REACH if i == 1 else 0.0),
        motion.axial + (_REACH if i == 2 else 0.0),
        motion.v1,
        motion.v2,
        motion.v_axial,
        motion.cage_angle,
        motion.speed + (_SPEED_REACH * (1.0 + abs(motion.speed)) if i == _N - 1 else 0.0),
    )


@kernel
def drag_holds(motion: ShaftMotion, temperature: float, kept: Array) -> bool:
    """Return whether what is kept was found near this motion, at about this oil [K]."""
    holds = kept[_KNOWN] == 1.0 and abs(temperature - kept[_OIL]) <= _OIL_REACH
    for i in range(_N):
        holds = holds and abs(_change(motion, kept, i)) <= 1.0
    return holds


@kernel
def drag_near(motion: ShaftMotion, kept: Array) -> ShaftDrag:
    """Return the drag in this motion by what is kept, linear about it."""
    torque = kept[_TORQUE]
    for i in range(_N):
        torque += kept[_SLOPES + i] * _change(motion, kept, i)
    return ShaftDrag(torque, kept[_BOUND])


@kernel
def renew_drag(
    bearings: ShaftBearings,
    motion: ShaftMotion,
    preload: float,
    law: float,
    oil: LubricantState,
    films: RollerFilms,
    kept: Array,
) -> float:
    """Evaluate the drag in this motion and keep it; return how many evaluations that took.

    Parameters
    ----------
    films : RollerFilms
        With the nodes of this shaft; read with SOLVED_FILMS alone.
    kept : ndarray of shape (N_FOLLOWED,)
        Zeros: nothing is kept.

    Others as in `drag_of_shaft`.

    Notes
    -----
    S + (y - S d) d^T/(d^T d), with slopes S over the step d that has been made and the change y of
    the torque. Source: [broyden_1965], method 1.
    """
    raceways = raceways_of_shaft(bearings, motion, law, oil, films)
    drag = drag_of_shaft(bearings, motion, preload, law, oil, raceways)
    evaluations = 1.0
    square, missed = 0.0, drag.torque - kept[_TORQUE]
    for i in range(_N):
        step = _change(motion, kept, i)
        square += step * step
        missed -= kept[_SLOPES + i] * step
    if kept[_KNOWN] == 0.0:
        evaluations += _N
        for i in range(_N):
            moved = _moved(motion, i)
            there = raceways_of_shaft(bearings, moved, law, oil, films)
            torque = drag_of_shaft(bearings, moved, preload, law, oil, there).torque
            kept[_SLOPES + i] = torque - drag.torque
    elif square > _LEAST_MOVE:
        for i in range(_N):
            kept[_SLOPES + i] += missed * _change(motion, kept, i) / square
    kept[_KNOWN], kept[_OIL] = 1.0, oil.temperature
    kept[_TORQUE], kept[_BOUND] = drag.torque, drag.bound
    kept[_THEN], kept[_THEN + 1], kept[_THEN + 2] = motion.r1, motion.r2, motion.axial
    kept[_THEN + 3] = motion.speed
    return evaluations
