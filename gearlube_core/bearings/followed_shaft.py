"""Forces and drag of the bearings of a shaft, followed linearly while the shaft moves little.

Forces are expanded about a motion, which serves some integrator steps. A step in which the shaft is
thrown across its bearings is taken in parts, each with an expansion of its own.

Drag has its laws here. Those that take each roller by itself cost as much as some integrator steps,
and depend on where the shaft stands in its bearings, on speed and on oil alone. So the drag is kept
with its slopes, followed linearly, and evaluated again when the shaft has moved, or speed or oil
have changed. Slopes are renewed by what a change has done; the first ones take an evaluation each.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    N_EXPANSION,
    NO_RACEWAYS,
    RollerFilms,
    ShaftBearings,
    ShaftMotion,
    SolvedRaceways,
    beside_raceways,
    expand_forces,
    loaded_drag,
    raceway_torque,
    shaft_drag,
    solved_raceways,
)
from gearlube_core.bearings.losses.laws import PALMGREN as PALMGREN_LAW
from gearlube_core.bearings.losses.laws import ROLLING, ROLLING_LAWS, SKF, number_at
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

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


STEPS_PER_EXPANSION = 12  # integrator steps that share an expansion of the forces, at most
# m at 1 step per highest period, displacement from where they were expanded that ends it sooner;
# 0.07 um at 17 steps. It falls with the square of the step, so that what is left out, of second
# order in it, falls with the fourth power as the error of the integrator does.
EXPANSION_REACH = 20e-6
# of the forces: the expansion, steps that it has served, 0 for none, displacements of then [m]
_AGE, _PLACE = N_EXPANSION, N_EXPANSION + 1
N_FORCES = N_EXPANSION + 4
# Parts of a step that moves the shaft by more than this: rollers of a bearing with 15 um of
# approach change their stiffness by some per cent over it, and forces that are linear over such a
# move put errors into the motion that teeth which bounce enlarge a hundredfold
STEP_PARTS = 8
_LARGEST_MOVE = 0.5e-6  # m


class ShaftDrag(NamedTuple):
    """Drag of both bearings of a shaft."""

    torque: float  # with the sign of the speed [N.m]
    bound: float  # of its power by solved films, not negative [W]; 0 with other laws


@kernel
def _fastest(motion: ShaftMotion) -> float:
    return max(abs(motion.v1), max(abs(motion.v2), abs(motion.v_axial)))


@kernel
def moving_parts(motion: ShaftMotion, h: float) -> int:
    """Return into how many parts a step of `h` [s] is divided: STEP_PARTS where the shaft leaps."""
    return STEP_PARTS if h * _fastest(motion) > _LARGEST_MOVE else 1


@kernel
def expand_about(
    bearings: ShaftBearings, motion: ShaftMotion, f_ref: float, oil: LubricantState, kept: Array
) -> None:
    """Expand the forces about a motion; `kept` begins with the expansion, shape (N_FORCES,)."""
    expand_forces(bearings, motion, f_ref, oil, part(kept, 0, N_EXPANSION))
    kept[_PLACE], kept[_PLACE + 1], kept[_PLACE + 2] = motion.r1, motion.r2, motion.axial


@kernel
def forget_forces(kept: Array) -> None:
    """Have the next step expand the forces."""
    kept[_AGE] = 0.0


@kernel
def follow_forces(
    bearings: ShaftBearings,
    motion: ShaftMotion,
    f_ref: float,
    oil: LubricantState,
    h: float,
    reach: float,
    kept: Array,
) -> None:
    """Make the expansion of the forces fit for a step.

    Parameters
    ----------
    f_ref : float
        Reference frequency of the hysteresis [Hz].
    h : float
        Of the integrator step that begins, or of its part [s].
    reach : float
        EXPANSION_REACH over the square of the steps per highest period [m].
    kept : ndarray of shape (N_FORCES,)
    """
    m, age = motion, kept[_AGE]
    moved = abs(m.r1 + h * m.v1 - kept[_PLACE])
    moved = max(moved, abs(m.r2 + h * m.v2 - kept[_PLACE + 1]))
    moved = max(moved, abs(m.axial + h * m.v_axial - kept[_PLACE + 2]))
    if age == 0.0 or age >= STEPS_PER_EXPANSION or moved > reach:
        # about where the shaft is half of the time later that the expansion will serve
        most = 0.5 * h * STEPS_PER_EXPANSION
        later = max(0.5 * h, min(most, reach / max(_fastest(m), reach)))
        ahead = ShaftMotion(
            m.r1 + later * m.v1,
            m.r2 + later * m.v2,
            m.axial + later * m.v_axial,
            m.v1,
            m.v2,
            m.v_axial,
            m.cage_angle + later * bearings.cage_ratio * m.speed,
            m.speed,
        )
        expand_about(bearings, ahead, f_ref, oil, kept)
        age = 0.0
    kept[_AGE] = age + 1.0


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
def drag_of_motion(
    bearings: ShaftBearings,
    motion: ShaftMotion,
    preload: float,
    law: float,
    oil: LubricantState,
    model: Array,
) -> ShaftDrag:
    """Return the drag in this motion alone, each roller by itself; arguments as in `renew_drag`.

    `model` are the numbers of the film model of rollers, empty with other laws.
    """
    films = RollerFilms(model, part(model, 0, 0), 0.0)
    raceways = raceways_of_shaft(bearings, motion, law, oil, films)
    return drag_of_shaft(bearings, motion, preload, law, oil, raceways)


@kernel
def drag_is_known(kept: Array) -> bool:
    """Return whether a step has kept anything."""
    return kept[_KNOWN] == 1.0


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
