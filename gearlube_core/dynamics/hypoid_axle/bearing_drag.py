"""Drag torque of the bearings of both shafts."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple, get_args

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    ShaftBearings,
    ShaftMotion,
    raceway_torque,
    shaft_drag,
    shaft_forces,
)
from gearlube_core.bearings.losses.laws import AIHARA, BIBOULET_HOUPERT, SKF, ZHOU_HOEPRICH
from gearlube_core.bearings.losses.laws import PALMGREN as PALMGREN_LAW
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_axle.state import W_G, W_P
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

TorqueLoss = Literal[
    "none",
    "palmgren",
    "zhou_hoeprich_1991",
    "biboulet_houpert_2010",
    "aihara_1987",
    "palmgren_loaded",
    "skf_2013",
]
TORQUE_LOSSES: tuple[str, ...] = get_args(TorqueLoss)
# what `bearings.losses.laws` calls them
BEARING_LAWS = {
    "palmgren": "palmgren",
    "zhou_hoeprich_1991": "zhou_hoeprich",
    "biboulet_houpert_2010": "biboulet_houpert",
    "aihara_1987": "aihara",
    "palmgren_loaded": "palmgren",
    "skf_2013": "skf",
}
PALMGREN = float(TORQUE_LOSSES.index("palmgren"))
_ZHOU_HOEPRICH = float(TORQUE_LOSSES.index("zhou_hoeprich_1991"))
_AIHARA = float(TORQUE_LOSSES.index("aihara_1987"))
_PALMGREN_LOADED = float(TORQUE_LOSSES.index("palmgren_loaded"))
_SKF = float(TORQUE_LOSSES.index("skf_2013"))
_NO_HYSTERESIS = 1e12  # Hz, reference frequency beyond which rollers lose nothing


class BearingDrag(NamedTuple):
    """Drag torques with the signs of the speeds."""

    pinion: float  # of both bearings [N.m]
    gear: float


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
def bearing_drag(s: Array, oil: LubricantState, p: AxleParameters) -> BearingDrag:
    """Return the drag of the bearings by the law p.drag.

    Palmgren's is that of the preload; the laws of the catalogues, "palmgren_loaded" and "skf_2013",
    take the present forces of either bearing; the others sum raceways and ribs under the present
    load of each roller, see `raceway_drag` and `rib_drag`.
    """
    if p.drag == 0.0:
        return BearingDrag(0.0, 0.0)
    if p.drag == PALMGREN:
        return BearingDrag(
            2.0 * shaft_drag(p.bearing_p, s[W_P], p.preload_p, 0.0, PALMGREN_LAW, oil),
            2.0 * shaft_drag(p.bearing_g, s[W_G], p.preload_g, 0.0, PALMGREN_LAW, oil),
        )
    if p.drag >= _PALMGREN_LOADED:
        catalogue = SKF if p.drag == _SKF else PALMGREN_LAW
        return BearingDrag(
            loaded_drag(p.bearing_p, pinion_motion(s), catalogue, oil),
            loaded_drag(p.bearing_g, gear_motion(s), catalogue, oil),
        )
    law = BIBOULET_HOUPERT
    if p.drag == _ZHOU_HOEPRICH:
        law = ZHOU_HOEPRICH
    elif p.drag == _AIHARA:
        law = AIHARA
    return BearingDrag(
        raceway_torque(p.bearing_p, pinion_motion(s), law, oil),
        raceway_torque(p.bearing_g, gear_motion(s), law, oil),
    )
