"""First point of contact on the gear flank as the pinion rotates, on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_rotations import contact_rotations
from gearlube_core.hypoid_contact.pair import FlankPair

_GRID = (9, 13)  # profile and face positions


@dataclass(frozen=True, slots=True)
class FirstContactPoint:
    """The grid point of first contact, with the starting values of an exact search."""

    gear_angle: float  # rad
    gear_s: float
    gear_t: float
    gear_parameters: Array
    pinion_parameters: Array
    pinion_turn: float  # rad, about the work axis


def first_contact_point(pair: FlankPair, gear_angle: float) -> FirstContactPoint | None:
    """Return the first point of contact on a coarse grid of the gear flank, or None."""
    s, t = np.meshgrid(*(np.linspace(0.0, 1.0, k) for k in _GRID), indexing="ij")
    gear = pair.gear.parameters(s, t)
    reach = contact_rotations(pair, gear, np.array([gear_angle])).on_tooth()
    order = pair.touching_sign * reach.pinion_angle[0]
    if np.isnan(order).all():
        return None
    i, j = np.unravel_index(np.nanargmin(order), order.shape)
    return FirstContactPoint(
        gear_angle,
        float(s[i, j]),
        float(t[i, j]),
        gear[i, j],
        reach.pinion_parameters[0, i, j],
        pair.pinion_turn(float(reach.pinion_angle[0, i, j] - reach.by_correction[0, i, j])),
    )
