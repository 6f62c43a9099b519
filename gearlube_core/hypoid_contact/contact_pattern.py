"""Contact pattern: the area where marking compound is wiped off during meshing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.hypoid_contact.ease_off import EaseOff
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error

MARKING_COMPOUND = 6.35e-6  # m, a quarter of a thousandth of an inch: customary in bevel gear tests


@dataclass(frozen=True, slots=True)
class ContactPattern:
    """Closest approach of the pinion to each point of the gear flank during the mesh.

    Parameters
    ----------
    s, t : ndarray of shape (m,), (n,)
        Profile (root 0, tip 1) and face (toe 0, heel 1) positions on the gear [-].
    closest : ndarray of shape (m, n)
        Least normal gap over the mesh [m]; NaN where the pinion tooth never comes.
    thickness : float
        Of the marking compound [m].
    """

    s: Array
    t: Array
    closest: Array
    thickness: float

    @property
    def marked(self) -> NDArray[np.bool_]:
        """Whether the compound is wiped off, (m, n)."""
        return np.asarray(np.nan_to_num(self.closest, nan=np.inf) <= self.thickness)

    @property
    def centre(self) -> tuple[float, float]:
        """Mean profile and face position of the marked points [-]."""
        i, j = np.nonzero(self.marked)
        return float(self.s[i].mean()), float(self.t[j].mean())


def contact_pattern(
    ease: EaseOff,
    *,
    thickness: float = MARKING_COMPOUND,
    pairs: Literal["one", "all"] = "all",
) -> ContactPattern:
    """Return the unloaded contact pattern on the gear flank.

    Parameters
    ----------
    ease : EaseOff
        Its gear angles divide the pitch evenly and span the mesh of a pair.
    thickness : float
        Of the marking compound [m], 0.1 um to 0.1 mm.
    pairs : {"one", "all"}
        Whether one pair rolls through alone, its neighbours cut away, or every pair takes its turn
        and holds the others apart.

    References
    ----------
    [stadtfeld_1993] (unloaded contact pattern from the ease-off).
    """
    check_option("pairs", pairs, ("one", "all"))
    check_within("thickness", thickness, 1e-7, 1e-4, "m", "6.35e-6 is customary.")
    pair = ease.pair
    sign = pair.touching_sign
    leading = sign * searched_transmission_error(pair, ease.gear_angle).error
    leading[np.isnan(leading)] = np.inf
    if pairs == "all":
        leading = _envelope(leading, ease.gear_angle, pair.gear_pitch)
    with np.errstate(invalid="ignore"):
        gap = (sign * ease.error - leading[:, None, None]) * ease.R_p
    closest = np.where(np.isnan(gap), np.inf, gap).min(axis=0)
    return ContactPattern(
        ease.s, ease.t, np.where(np.isinf(closest), np.nan, closest), float(thickness)
    )


def _envelope(leading: Array, angle: Array, pitch: float) -> Array:
    """Return the minimum over a pair and its neighbours, whole pitches away."""
    shift = round(pitch / float(angle[1] - angle[0]))
    out = leading.copy()
    for k in range(shift, leading.size, shift):
        out[:-k] = np.minimum(out[:-k], leading[k:])
        out[k:] = np.minimum(out[k:], leading[:-k])
    return out
