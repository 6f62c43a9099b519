"""Lower limit of a regular flank: the line of the blade tips, or a fold (undercut)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.grid import march

LOWEST = -0.1  # s, below the root line, where the search for the end of a flank gives up
_STEP = 0.005  # s
_HALVINGS = 12
_MIDDLE = 0.6  # s, where every search starts
_LEAP = 1e-3  # m of blade height; more between neighbouring solutions is another sheet


class FlankRootLimit(NamedTuple):
    """Lower limit of the regular flank towards the root, at each face position, shape (n,).

    Parameters
    ----------
    s : ndarray of shape (n,)
        Lowest sound profile position [-].
    undercut : ndarray of bool, shape (n,)
        True: the flank folds there, above the line of the blade tips, which cut away what would
        lie below; False: it runs into the line of the blade tips.
    fold : ndarray of shape (n,)
        Profile position of the fold [-]; `LOWEST` where there is none above.
    """

    s: Array
    undercut: NDArray[np.bool_]
    fold: Array


def flank_root_limit(flank: Flank, t: Array, blade_tip: float) -> FlankRootLimit:
    """Return where a flank ends towards the root.

    Each face position is followed from the middle of the profile down, from solution to solution,
    until the equation of meshing has none or the surface turns back on itself. The curve that the
    blade tip leaves below (the root fillet) is not part of the flank; at an undercut it crosses
    the flank a little above the fold.

    Parameters
    ----------
    flank : Flank
    t : ndarray of shape (n,)
        Face positions [-], 0 at the toe, 1 at the heel.
    blade_tip : float
        Height of the blade tips over the reference plane [m].

    Raises
    ------
    ParameterError
        When the flank is not even sound at the middle of its profile.

    References
    ----------
    [litvin_fuentes_2004 ch. 6.3] (singular points, undercutting).
    """
    t = np.asarray(t, float)
    s = np.full(t.size, _MIDDLE)
    at = flank.parameters(s, t)
    sound, _ = _follow(flank, s, t, at)
    if not sound.all():
        raise ParameterError(
            f"The {flank.role}'s {flank.side} flank is undercut up to mid profile at face position "
            f"{t[~sound][0]:.2f} (0 toe, 1 heel). Check the blade angle and the machine settings "
            "of that flank, or reduce the face width."
        )
    tip_line = np.where(at[:, 0] > blade_tip, s, np.nan)
    step = np.full(t.size, _STEP)
    halvings = np.zeros(t.size, int)
    while np.any(active := (s > LOWEST) & (halvings < _HALVINGS)):
        lower = np.where(active, s - step, s)
        sound, found = _follow(flank, lower, t, at)
        down = sound & active
        crossed = down & (found[:, 0] >= blade_tip) & np.isnan(tip_line)
        share = (blade_tip - at[:, 0]) / np.where(down, found[:, 0] - at[:, 0], 1.0)
        tip_line = np.where(crossed, s + share * (lower - s), tip_line)
        s, at = np.where(down, lower, s), np.where(down[:, None], found, at)
        stuck = active & ~sound
        step = np.where(stuck, 0.5 * step, step)
        halvings += stuck
    fold = np.maximum(s, LOWEST)
    undercut = np.isnan(tip_line) & (fold > LOWEST)
    end = np.where(np.isnan(tip_line), fold, tip_line)
    return FlankRootLimit(end, undercut, fold)


def _follow(flank: Flank, s: Array, t: Array, starts: Array) -> tuple[NDArray[np.bool_], Array]:
    """Return whether the flank is sound at (s, t), and its parameters there, (n, 3)."""
    radius, axial = flank.region.section(s, t)
    found = march(flank.motion, radius, axial, starts)
    regularity = flank.sample_parameters(found).regularity
    # NaN, no solution, compares false; a jump to another sheet moves the blade height
    sound = (regularity > 0.0) & (np.abs(found[:, 0] - starts[:, 0]) < _LEAP)
    return sound, found
