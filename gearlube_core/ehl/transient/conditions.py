"""Gap, load and speeds of a film at one time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from gearlube_core.arrays import Array


@dataclass(frozen=True, slots=True)
class FilmConditions:
    """What acts on a film at one time, on the nodes of one grid.

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        Of the undeformed solids [m], finite, up to a constant.
    load : float
        W [N].
    speed_1, speed_2 : ndarray, shape (ny,)
        Surface speeds along x [m/s]; their mean is above zero. They may vary across the motion,
        not along it.
    slope : float
        Entrainment along y over that along x [-], not below zero.
    side_sliding : float
        Speed along y of surface 2 less that of surface 1 [m/s], on all rows; where it is not
        zero the sliding along x must not vary either. It acts in an Eyring film alone.
    """

    gap: Array
    load: float
    speed_1: Array
    speed_2: Array
    slope: float = 0.0
    side_sliding: float = 0.0


# (x, y, time) to what acts then: nodes [m], shapes (nx,) and (ny,); time [s]
Conditions = Callable[[Array, Array, float], FilmConditions]
