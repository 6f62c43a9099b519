"""Drag torque of the bearings of both shafts.

Drag of the rollers, kept in the state and followed linearly while little changes.

The laws that take each roller by itself cost as much as some integrator steps, and depend on where
the shafts stand in their bearings, on speed and on oil alone. So the drag of both shafts is kept
with its slopes, and evaluated again when a shaft has moved, or speed or oil have changed. Slopes
are renewed by what a change has done; the first ones take an evaluation each.
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
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_axle.state import (
    N_CONTINUOUS,
    U_G,
    U_P,
    W_G,
    W_P,
)
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
PALMGREN = float(TORQUE_LOSSES.index("palmgren"))
_PALMGREN_LOADED = float(TORQUE_LOSSES.index("palmgren_loaded"))
_SKF = float(TORQUE_LOSSES.index("skf_2013"))
SOLVED_FILMS = float(TORQUE_LOSSES.index("solved_films"))
# places of what is kept: 1 where it is, oil temperature of then [K], bound [W]; of each shaft
# its torque [N m], displacements [um] and speed [rad/s] of then, and slopes over their reaches
_KNOWN, _OIL, _BOUND, _SHAFTS = range(4)
_N = 4  # displacements and speed
_TORQUE, _THEN, _SLOPES = 0, 1, 1 + _N
_N_SHAFT = 1 + 2 * _N
# what asks for another evaluation: a move of 0.3 um bends the drag of a roller under 15 um by 1e-4
_REACH = 0.3  # um
_SPEED_REACH = 0.02  # of 1 rad/s more than the speed
_OIL_REACH = 0.02  # K, as for the nodes of `roller_nodes`


class BearingDrag(NamedTuple):
    """Drag torques with the signs of the speeds."""

    pinion: float  # of both bearings [N.m]
    gear: float
    bound: float = 0.0  # of the power of all bearings by solved films [W]; 0 with other laws


class AxleRaceways(NamedTuple):
    """Raceways of both shafts by solved films."""

    pinion: SolvedRaceways = NO_RACEWAYS
    gear: SolvedRaceways = NO_RACEWAYS


NO_AXLE_RACEWAYS = AxleRaceways()


@kernel
def axle_raceways(
    s: Array, oil: LubricantState, p: AxleParameters, films: RollerFilms
) -> AxleRaceways:
    """Return torques and films of the raceways if p.drag is SOLVED_FILMS; else NO_RACEWAYS.

    `films` has the nodes of both shafts, shape (N_ROLLERS,), read only if they are kept.
    """
    if p.drag != SOLVED_FILMS:
        return AxleRaceways(NO_RACEWAYS, NO_RACEWAYS)
    of_pinion = RollerFilms(films.model, films.nodes[:N_ROLLER_NODES], films.kept)
    of_gear = RollerFilms(films.model, films.nodes[N_ROLLER_NODES:], films.kept)
    return AxleRaceways(
        solved_raceways(p.bearing_p, pinion_motion(s), oil, of_pinion),
        solved_raceways(p.bearing_g, gear_motion(s), oil, of_gear),
    )


@kernel
def drag_bound_of(s: Array, raceways: AxleRaceways) -> float:
    """Return the bound of the power that the bearings of both shafts lose [W]."""
    of_pinion = raceways.pinion.torque_bound * abs(s[W_P])
    return of_pinion + raceways.gear.torque_bound * abs(s[W_G])


@kernel
def bearing_drag(
    s: Array, oil: LubricantState, p: AxleParameters, raceways: AxleRaceways
) -> BearingDrag:
    """Return the drag of the bearings by the law p.drag.

    Palmgren's is that of the preload; the laws of the catalogues, "palmgren_loaded" and "skf_2013",
    take the present forces of either bearing; the others sum raceways and ribs under the present
    load of each roller, see `raceway_drag`, `solved_raceway_drag` and `rib_drag`. `raceways` are
    those of `axle_raceways` at this state.
    """
    pinion, gear = pinion_motion(s), gear_motion(s)
    if p.drag == SOLVED_FILMS:
        return BearingDrag(
            raceways.pinion.torque + beside_raceways(p.bearing_p, pinion, oil),
            raceways.gear.torque + beside_raceways(p.bearing_g, gear, oil),
            drag_bound_of(s, raceways),
        )
    return BearingDrag(
        drag_of_shaft(p.bearing_p, pinion, p.preload_p, p.drag, oil),
        drag_of_shaft(p.bearing_g, gear, p.preload_g, p.drag, oil),
        0.0,
    )


@kernel
def drag_of_shaft(
    bearings: ShaftBearings, motion: ShaftMotion, preload: float, law: float, oil: LubricantState
) -> float:
    """Return the drag of both bearings of a shaft [N m] by a law of TORQUE_LOSSES.

    All but "solved_films". `preload` is that of `Bearing.preload_force` [N].
    """
    if law == 0.0:
        return 0.0
    if law == PALMGREN:
        return 2.0 * shaft_drag(bearings, motion.speed, preload, 0.0, PALMGREN_LAW, oil)
    if law in (_PALMGREN_LOADED, _SKF):
        return loaded_drag(bearings, motion, SKF if law == _SKF else PALMGREN_LAW, oil)
    rolling = raceway_torque(bearings, motion, _rolling_law(law), oil)
    return rolling + beside_raceways(bearings, motion, oil)


@kernel
def _change(s: Array, kept: Array, shaft: int, i: int) -> float:
    """Return how far number `i` of a shaft is from where it was, over its reach."""
    u, w = (U_P, W_P) if shaft == 0 else (U_G, W_G)
    then = kept[_SHAFTS + shaft * _N_SHAFT + _THEN + i]
    if i == _N - 1:
        return (s[w] - then) / (_SPEED_REACH * (1.0 + abs(then)))
    return (s[u + i] - then) / _REACH


@kernel
def _moved(s: Array, i: int, moved: Array) -> None:
    """Write the state with number `i` of both shafts changed by its reach."""
    for j in range(N_CONTINUOUS):
        moved[j] = s[j]
    if i == _N - 1:
        moved[W_P] += _SPEED_REACH * (1.0 + abs(s[W_P]))
        moved[W_G] += _SPEED_REACH * (1.0 + abs(s[W_G]))
    else:
        moved[U_P + i] += _REACH
        moved[U_G + i] += _REACH


@kernel
def drag_near(s: Array, kept: Array) -> BearingDrag:
    """Return the drag in the state `s` by what is kept, linear about it."""
    pinion = kept[_SHAFTS + _TORQUE]
    gear = kept[_SHAFTS + _N_SHAFT + _TORQUE]
    for i in range(_N):
        pinion += kept[_SHAFTS + _SLOPES + i] * _change(s, kept, 0, i)
        gear += kept[_SHAFTS + _N_SHAFT + _SLOPES + i] * _change(s, kept, 1, i)
    return BearingDrag(pinion, gear, kept[_BOUND])


@kernel
def drag_holds(s: Array, temperature: float, kept: Array) -> bool:
    """Return whether what is kept was found near the state `s`, at about this oil [K]."""
    holds = kept[_KNOWN] == 1.0 and abs(temperature - kept[_OIL]) <= _OIL_REACH
    for i in range(_N):
        largest = max(abs(_change(s, kept, 0, i)), abs(_change(s, kept, 1, i)))
        holds = holds and largest <= 1.0
    return holds


@kernel
def renew_drag(
    s: Array, oil: LubricantState, p: AxleParameters, films: RollerFilms, kept: Array, moved: Array
) -> float:
    """Evaluate the drag in the state `s` and keep it; return how many evaluations that took.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    oil, p, films
        As in `bearing_drag.axle_raceways`.
    kept : ndarray of shape (N_DRAG,)
        Zeros: nothing is kept.
    moved : ndarray of shape (N_STATE,)
        Work space.

    Notes
    -----
    S + (y - S d) d^T/(d^T d), with slopes S over the step d that has been made and the change y of
    the torque. Source: [broyden_1965], method 1.
    """
    drag = bearing_drag(s, oil, p, axle_raceways(s, oil, p, films))
    evaluations = 1.0
    for shaft in range(2):
        at = _SHAFTS + shaft * _N_SHAFT
        torque = drag.pinion if shaft == 0 else drag.gear
        square, missed = 0.0, torque - kept[at + _TORQUE]
        for i in range(_N):
            step = _change(s, kept, shaft, i)
            square += step * step
            missed -= kept[at + _SLOPES + i] * step
        if kept[_KNOWN] == 1.0 and square > 0.25:
            for i in range(_N):
                kept[at + _SLOPES + i] += missed * _change(s, kept, shaft, i) / square
    if kept[_KNOWN] == 0.0:
        evaluations += _N
        for i in range(_N):
            _moved(s, i, moved)
            there = bearing_drag(moved, oil, p, axle_raceways(moved, oil, p, films))
            kept[_SHAFTS + _SLOPES + i] = there.pinion - drag.pinion
            kept[_SHAFTS + _N_SHAFT + _SLOPES + i] = there.gear - drag.gear
    kept[_KNOWN], kept[_OIL], kept[_BOUND] = 1.0, oil.temperature, drag.bound
    kept[_SHAFTS + _TORQUE] = drag.pinion
    kept[_SHAFTS + _N_SHAFT + _TORQUE] = drag.gear
    for i in range(3):
        kept[_SHAFTS + _THEN + i] = s[U_P + i]
        kept[_SHAFTS + _N_SHAFT + _THEN + i] = s[U_G + i]
    kept[_SHAFTS + _THEN + 3] = s[W_P]
    kept[_SHAFTS + _N_SHAFT + _THEN + 3] = s[W_G]
    return evaluations
