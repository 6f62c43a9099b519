"""Normal deviation of one flank from another, as a measuring machine would find it."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.gap_map import along_normals
from gearlube_core.hypoid_contact.placement import Placement, turned
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.vectors import Vector

_FURTHEST = 0.05  # rad, to either side, where the other flank is looked for
_SEARCH = np.linspace(-_FURTHEST, _FURTHEST, 41)
_EXACT = 1e-14  # rad


def flank_deviation(nominal: Flank, other: Flank, s: Array, t: Array) -> Array:
    """Return how far another flank stands out of a nominal one along its normals [m], (m, n).

    The other member is turned until the deviation at the middle of the grid is zero.

    Parameters
    ----------
    nominal, other : Flank
        Of the same member and side, as cut: corrections are left out.
    s, t : ndarray of shape (m,), (n,)
        Profile and face positions of the grid on the nominal flank [-].

    Raises
    ------
    ParameterError
        A normal of the grid does not meet the other flank, as beyond an undercut.

    Examples
    --------
    >>> from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> tilted = file.varied({"pinion.machine.tilt_angle_deg": 31.836})  # + 0.1 deg
    >>> flanks = [Flank.from_file(one, "pinion", "drive") for one in (file, tilted)]
    >>> found = flank_deviation(*flanks, np.array([0.3, 0.6, 0.9]), np.array([0.1, 0.5, 0.9]))
    >>> (1e6 * found).round(1).tolist()[0]  # um, lowest row from toe to heel
    [-9.4, -3.2, 3.8]
    """

    def deviation(s: Array, t: Array, angle: float) -> Array:
        profile, face = np.meshgrid(s, t, indexing="ij")
        points = nominal.sample(profile, face)
        found = along_normals(
            other.motion,
            turned(_own_frame(other), angle),
            _own_frame(nominal),
            points.r.reshape(-1, 3),
            points.normal.reshape(-1, 3),
            other.parameters(profile, face).reshape(-1, 3),
        )
        return np.asarray(found[:, 3].reshape(profile.shape))

    middle = np.array([0.5 * (s[0] + s[-1])]), np.array([0.5 * (t[0] + t[-1])])
    if s.size % 2 and t.size % 2:
        middle = s[[s.size // 2]], t[[t.size // 2]]
    at = np.array([float(deviation(*middle, angle)[0, 0]) for angle in _SEARCH])
    changes = np.flatnonzero(at[:-1] * at[1:] <= 0.0)
    if not changes.size:
        raise ParameterError(
            f"the other {nominal.role} flank must meet the nominal one in the middle of the grid "
            f"within {_FURTHEST:g} rad of rotation, but it does not. Change the settings by less."
        )
    k = int(changes[np.argmin(np.abs(_SEARCH[changes]))])
    turn = brentq(
        lambda angle: float(deviation(*middle, angle)[0, 0]), *_SEARCH[k : k + 2], xtol=_EXACT
    )
    found = deviation(s, t, float(turn))
    if np.isnan(found).any():
        i, j = np.argwhere(np.isnan(found))[0].tolist()
        raise ParameterError(
            f"normals of all points must meet the other flank, that at s = {s[i]:.3f}, t = "
            f"{t[j]:.3f} does not. Keep the grid above an undercut (`tooth_form` tells it)."
        )
    return found


def _own_frame(flank: Flank) -> Placement:
    """Return the placement of a member where it is cut, at rotation zero."""
    motion = flank.motion
    return Placement(motion.work_point, motion.work_axis, 1.0, 0.0, 1.0, 0.0, Vector(0.0, 0.0, 0.0))
