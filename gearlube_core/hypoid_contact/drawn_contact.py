"""Directions at a contact as they look on the drawn gear tooth."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.pair import FlankPair

_STEP = 1e-3  # of the flank's parameters, for its tangents


def drawn_axes(
    pair: FlankPair, life: Array, s: Array, t: Array, minor_axis: Array
) -> tuple[Array, Array]:
    """Return minor and major axis of contact ellipses on the drawn gear tooth, (N, 2) each [1/m].

    A step of one metre along the axis is a step of so many face widths, from toe to heel, and of
    so many tooth heights, from root to tip.

    Parameters
    ----------
    pair : FlankPair
    life : ndarray of shape (N,)
        Mesh phase of the tooth pair [mesh periods], 0 where it meets at the mean point.
    s, t : ndarray of shape (N,)
        Centre on the gear flank: root 0 to tip 1, toe 0 to heel 1 [-].
    minor_axis : ndarray of shape (N, 3)
        Unit vector in the fixed frame [-].

    Notes
    -----
    The drawn tooth is the gear's axial section: both surfaces' tangents are taken from the flank.
    """
    gear, step = pair.gear, _STEP
    up = (gear.sample(s + step, t).r - gear.sample(s - step, t).r) / (2.0 * step)
    along = (gear.sample(s, t + step).r - gear.sample(s, t - step).r) / (2.0 * step)
    turn = Rotation.from_rotvec(pair.gear_turn(life * pair.gear_pitch)[:, None] * gear.axis)
    along, up = turn.apply(along), turn.apply(up)
    normal = np.cross(along, up)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    major = np.cross(normal, minor_axis)
    # least squares of direction = a along + b up: of normal equations two by two
    aa, ab, bb = (np.einsum("ni,ni->n", *two) for two in ((along, along), (along, up), (up, up)))
    found = []
    for direction in (minor_axis, major):
        a, b = (np.einsum("ni,ni->n", one, direction) for one in (along, up))
        parts = np.stack([bb * a - ab * b, aa * b - ab * a], 1)
        found.append(parts / (aa * bb - ab * ab)[:, None])
    return found[0], found[1]
