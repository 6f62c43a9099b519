"""Lines of constant radius on a flank in the tangent plane: grinding lay and relief."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.helical_geometry.involute import (
    involute_flank,
    parabola_distance,
    relative_position,
)
from gearlube_core.helical_geometry.pair import HelicalPair

FORMS = ("involute", "parabola")
_Array = Array


class LayAngles(NamedTuple):
    """Angle between the contact line and the grinding marks of each flank."""

    pinion: _Array  # theta_p [rad]
    gear: _Array  # theta_w [rad]


def lay_angles(
    s: ArrayLike, pair: HelicalPair, distance: float = 1e-3, form: str = "involute"
) -> LayAngles:
    """Return the angles of chords from A to the mark through A, at B a distance on.

    theta = arctan(BT/AB),  s_B = s_A + AB sin(beta_b),  r_Q = r_A

    Parameters
    ----------
    s
        Of A, from the pitch line along the line of action [m], any shape.
    pair
        Helical gear pair, not spur.
    distance
        AB along the contact line [m]; the thesis takes 1 mm.
    form
        "involute", exact, or "parabola" as printed.

    Returns
    -------
    LayAngles
        [rad], of the shape of s; positive: both marks run from the contact line towards +x of
        the tangent plane as y rises.

    Notes
    -----
    Source: [jamali_2015 (7.1)] [jamali_2015 (7.2)] [jamali_2015 (7.3)] [jamali_2015 (7.4)]
    [jamali_2015 (7.5)] [jamali_2015 (7.6)] [jamali_2015 (7.7)]
    """
    check_option("form", form, FORMS)
    check_positive("distance", distance, "m", "Give metres; for its limit use lay_angle_limits.")
    plane = pair.plane
    start = plane.P + np.asarray(s, dtype=float)
    x = start + distance * plane.sin_b
    angles = []
    for roll, mark, r_b in ((x, start, plane.r_bp), (plane.x_g - x, plane.x_g - start, plane.r_bg)):
        if form == "parabola":
            t = parabola_distance(roll, mark, r_b)
        else:
            t, _depth = relative_position(roll, mark, r_b)
        angles.append(np.arctan(np.abs(t) / distance))
    return LayAngles(*angles)


def lay_angle_limits(s: ArrayLike, pair: HelicalPair) -> LayAngles:
    """Return the angles where the marks cross the contact line, the limit AB -> 0.

    tan(theta) = sin(beta_b) R/r_b

    Parameters
    ----------
    s
        From the pitch line along the line of action [m], any shape.
    pair
        Gear pair; zero for spur gears.

    Returns
    -------
    LayAngles
        [rad]. At the pitch line both are arctan(sin(beta_b) tan(alpha_w)).
    """
    plane = pair.plane
    x = plane.P + np.asarray(s, dtype=float)
    return LayAngles(
        np.arctan(plane.sin_b * x / plane.r_bp),
        np.arctan(plane.sin_b * (plane.x_g - x) / plane.r_bg),
    )


def equal_radius_line(
    radius: ArrayLike, y: ArrayLike, X: float, pair: HelicalPair, member: str
) -> _Array:
    """Return x of a line of constant radius, such as equal tip relief, on the tangent plane.

    Parameters
    ----------
    radius
        From the member's axis, not inside its base circle [m].
    y
        Along the contact line, from mid-face [m]; shapes broadcast.
    X
        Of the contact line, on the face z = +W/2 [m].
    pair
        Helical or spur gear pair.
    member
        Which member: "pinion" or "gear".

    Returns
    -------
    array
        Across the contact line, towards the pinion's root [m]; NaN inside the base circle.

    Notes
    -----
    Source: [jamali_2015 fig. 5.17]. Its inclination dx/dy where it crosses the contact line is
    that of `lay_angle_limits`.
    """
    flank, plane = involute_flank(pair, member), pair.plane
    middle = X - 0.5 * plane.W * plane.sin_b / plane.cos_b
    on_line = middle + np.asarray(y, dtype=float) * plane.sin_b
    roll = on_line if member == "pinion" else plane.x_g - on_line
    t, _depth = relative_position(roll, flank.roll(radius), flank.base_radius)
    return -t if member == "pinion" else t
