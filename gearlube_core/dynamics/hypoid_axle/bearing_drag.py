"""Drag torque of the bearings of both shafts."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import raceway_torque, shaft_drag
from gearlube_core.bearings.losses.laws import AIHARA, BIBOULET_HOUPERT, ZHOU_HOEPRICH
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_axle.state import W_G, W_P
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

TorqueLoss = Literal[
    "none", "palmgren", "zhou_hoeprich_1991", "biboulet_houpert_2010", "aihara_1987"
]
TORQUE_LOSSES: tuple[str, ...] = get_args(TorqueLoss)
# what `bearings.losses.laws` calls them
BEARING_LAWS = {
    "palmgren": "palmgren",
    "zhou_hoeprich_1991": "zhou_hoeprich",
    "biboulet_houpert_2010": "biboulet_houpert",
    "aihara_1987": "aihara",
}
PALMGREN = float(TORQUE_LOSSES.index("palmgren"))
_ZHOU_HOEPRICH = float(TORQUE_LOSSES.index("zhou_hoeprich_1991"))
_AIHARA = float(TORQUE_LOSSES.index("aihara_1987"))


class BearingDrag(NamedTuple):
    """Drag torques with the signs of the speeds."""

    pinion: float  # of both bearings [N.m]
    gear: float


@kernel
def bearing_drag(s: Array, oil: LubricantState, p: AxleParameters) -> BearingDrag:
    """Return the drag of the bearings by the law p.drag.

    Palmgren's is that of the preload; the others sum the raceways under the present load of each
    roller, see `raceway_drag`.
    """
    if p.drag == 0.0:
        return BearingDrag(0.0, 0.0)
    if p.drag == PALMGREN:
        return BearingDrag(
            2.0 * shaft_drag(p.bearing_p, s[W_P], p.preload_p, oil),
            2.0 * shaft_drag(p.bearing_g, s[W_G], p.preload_g, oil),
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
