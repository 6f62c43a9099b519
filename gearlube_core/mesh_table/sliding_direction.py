"""The direction of sliding of a tooth pair, from what a mesh table keeps of it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gearlube_core.arrays import Array


def sliding_direction(psi: Array, chi: Array, along: Array) -> Array:
    """Return the angle of sliding from the minor axis on the side where entrainment is positive.

    Parameters
    ----------
    psi, chi : ndarray, shape (N,)
        Angles of entrainment and of sliding from the minor axis [rad], both folded to 0..pi/2.
    along : ndarray, shape (N,)
        Component of the entrainment along sliding, over the entrainment [-].

    Notes
    -----
    A table keeps chi without its quadrant. Of the four directions that fold to it, that one is
    taken whose angle to the entrainment has the cosine that the arms of both members give.
    """
    turns = np.stack([chi, np.pi - chi, -chi, chi - np.pi])
    best = np.argmin(np.abs(np.cos(turns - psi) - along), axis=0)
    return np.asarray(np.take_along_axis(turns, best[None], axis=0)[0])


def pair_sliding_direction(window: Mapping[str, Array], ratio: float) -> Array:
    """Return `sliding_direction` of a tooth pair at one load.

    Parameters
    ----------
    window : mapping of str to ndarray, shape (N,)
        Windows of a `MeshTable` at one of its loads.
    ratio : float
        Teeth of the gear over those of the pinion [-].
    """
    pinion, gear = window["friction_arm_p"], window["friction_arm_g"] / ratio
    along = np.clip(0.5 * (pinion + gear) / window["entrainment_arm"], -1.0, 1.0)
    return sliding_direction(window["psi"], window["chi"], along)


def turned_on(angles: Array) -> Array:
    """Return angles of undirected lines without jumps along rows and from row to row.

    Parameters
    ----------
    angles : ndarray, shape (L, N)
        [rad]; a line at an angle is the line at that angle plus pi.
    """
    rows = np.unwrap(angles, period=np.pi, axis=1)
    middle = np.median(rows, axis=1)
    return np.asarray(rows + (np.unwrap(middle, period=np.pi) - middle)[:, None])
