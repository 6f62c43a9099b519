"""Drag torque of the bearings of both shafts."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    NO_RACEWAYS,
    RollerFilms,
    ShaftBearings,
    ShaftMotion,
    SolvedRaceways,
    beside_raceways,
    raceway_torque,
    shaft_drag,
    shaft_forces,
    solved_raceways,
)
from gearlube_core.bearings.losses.laws import PALMGREN as PALMGREN_LAW
from gearlube_core.bearings.losses.laws import ROLLING, ROLLING_LAWS, SKF
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_axle.state import W_G, W_P
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
_ROLLING_CODES = tuple(ROLLING_LAWS.get(_BY_ROLLING.get(name, ""), 0) for name in TORQUE_LOSSES)
PALMGREN = float(TORQUE_LOSSES.index("palmgren"))
_PALMGREN_LOADED = float(TORQUE_LOSSES.index("palmgren_loaded"))
_SKF = float(TORQUE_LOSSES.index("skf_2013"))
SOLVED_FILMS = float(TORQUE_LOSSES.index("solved_films"))
_NO_HYSTERESIS = 1e12  # Hz, reference frequency beyond which rollers lose nothing


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
def loaded_drag(
    bearings: ShaftBearings, motion: ShaftMotion, law: int, oil: LubricantState
) -> float:
    """Return the drag of both bearings of a shaft under their present forces [N m].

    `law` is PALMGREN or SKF of `bearings.losses.laws`. The rollers' hysteresis is no load here.
    """
    F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, _ = shaft_forces(bearings, motion, _NO_HYSTERESIS, oil)
    first = shaft_drag(bearings, motion.speed, abs(F1_a), math.hypot(F1_r1, F1_r2), law, oil)
    second = shaft_drag(bearings, motion.speed, abs(F2_a), math.hypot(F2_r1, F2_r2), law, oil)
    return first + second


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
    if p.drag == 0.0:
        return BearingDrag(0.0, 0.0, 0.0)
    if p.drag == PALMGREN:
        return BearingDrag(
            2.0 * shaft_drag(p.bearing_p, s[W_P], p.preload_p, 0.0, PALMGREN_LAW, oil),
            2.0 * shaft_drag(p.bearing_g, s[W_G], p.preload_g, 0.0, PALMGREN_LAW, oil),
            0.0,
        )
    pinion, gear = pinion_motion(s), gear_motion(s)
    if p.drag == _PALMGREN_LOADED or p.drag == _SKF:
        catalogue = SKF if p.drag == _SKF else PALMGREN_LAW
        return BearingDrag(
            loaded_drag(p.bearing_p, pinion, catalogue, oil),
            loaded_drag(p.bearing_g, gear, catalogue, oil),
            0.0,
        )
    beside_p = beside_raceways(p.bearing_p, pinion, oil)
    beside_g = beside_raceways(p.bearing_g, gear, oil)
    if p.drag == SOLVED_FILMS:
        return BearingDrag(
            raceways.pinion.torque + beside_p,
            raceways.gear.torque + beside_g,
            drag_bound_of(s, raceways),
        )
    law = _ROLLING_CODES[int(p.drag)]
    return BearingDrag(
        raceway_torque(p.bearing_p, pinion, law, oil) + beside_p,
        raceway_torque(p.bearing_g, gear, law, oil) + beside_g,
        0.0,
    )
