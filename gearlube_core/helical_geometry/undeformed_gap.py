"""Gap between the unloaded flanks near a contact line, input of film and contact solvers.

The grid lies in the common tangent plane: y along the line from mid-face, rising with z; x across
it in the transverse plane, towards the pinion's root and the gear's tip, which is where both
surfaces move relative to the line. The gap is measured normal to that plane.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.involute import (
    MEMBERS,
    InvoluteFlank,
    facet_depth,
    facet_depth_parabola,
    involute_flank,
    relative_position,
    roll_at_tangent_distance,
)
from gearlube_core.helical_geometry.modification import FlankModification, ModifiedPair

FORMS = ("involute", "parabola")
_Array = Array
_SECTION_STEPS = 3  # each gains two digits: the gap moves its section by sin(b) times itself


@dataclass(frozen=True, slots=True, kw_only=True)
class UndeformedGap:
    """The gap h_u(x, y) of a modified pair at any line position.

    z_j = g_j cos(beta_b),  y_j' = y +- z_j tan(beta_b),  h_u = z_1 + z_2

    g_j is the depth of flank j below the tangent plane in its transverse section at y_j' (+ on
    the pinion, - on the gear), removal included.

    Parameters
    ----------
    modified : ModifiedPair
        Pair with reliefs, crowns, slopes and facets.
    form : str
        "involute": the true profile, exact. "parabola": its osculating parabola, as printed.

    Raises
    ------
    ParameterError
        An unknown form.

    Notes
    -----
    Source: [jamali_2015 (2.9)] [jamali_2015 (2.10)] [jamali_2015 (2.11)] [jamali_2015 (2.12)]
    [jamali_2015 (2.13)] [jamali_2015 (2.16)] [jamali_2015 (2.17)] [jamali_2015 (2.18)]
    [jamali_2015 (6.2)]
    The involute helicoid is developable: its tangent plane is the same along the whole line, so
    (2.11) is exact but for the parabola. Removal is added along the normal of the line; the
    profile's own normal turns by less than 0.03 rad across a film's grid and would change it by
    less than 5e-4 of itself. Past the tips the flanks go on as their modification does; where no
    involute exists, below the base circle, the gap is infinite.
    """

    modified: ModifiedPair
    form: str = "involute"

    def __post_init__(self) -> None:
        check_option("form", self.form, FORMS)

    def heights(self, x: ArrayLike, y: ArrayLike, X: float) -> _Array:
        """Return h_u [m].

        Parameters
        ----------
        x, y
            In the tangent plane [m], shapes that broadcast: x[:, None], y[None, :] for a grid.
        X
            Of the contact line, on the face z = +W/2 [m].

        Returns
        -------
        array
            [m], of the broadcast shape.
        """
        return self.tooth_heights("pinion", x, y, X) + self.tooth_heights("gear", x, y, X)

    def tooth_heights(self, member: str, x: ArrayLike, y: ArrayLike, X: float) -> _Array:
        """Return how far one flank lies from the tangent plane [m]; see `heights`."""
        check_option("member", member, MEMBERS)
        plane = self.modified.pair.plane
        flank = involute_flank(self.modified.pair, member)
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        on_line = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + y * plane.sin_b
        if member == "pinion":
            modification, side, roll, t = self.modified.pinion, 1.0, on_line, -x
        else:
            modification, side, roll, t = self.modified.gear, -1.0, plane.x_g - on_line, x
        depth = np.zeros(np.broadcast_shapes(x.shape, y.shape))
        for _ in range(_SECTION_STEPS):
            shift = depth * plane.sin_b  # along the line, towards larger roll on either member
            z = (y + side * shift) * plane.cos_b
            depth = self._section(roll + shift * plane.sin_b, t, z, modification, flank)
        return np.where(np.isnan(depth), np.inf, depth * plane.cos_b)

    def _section(
        self,
        roll: _Array,
        t: _Array,
        z: _Array,
        modification: FlankModification,
        flank: InvoluteFlank,
    ) -> _Array:
        """Return the depth in the transverse sections whose lines lie at `roll`, NaN off it."""
        # parabola: [jamali_2015 (2.5)] [jamali_2015 (2.6)] [jamali_2015 (6.4-a)]
        # [jamali_2015 (6.4-b)]; radius and roll length of its point: [jamali_2015 (6.3-a)]
        # [jamali_2015 (6.3-b)] [jamali_2015 (6.5)]
        r_b = flank.base_radius
        roll = np.where(roll > 0.0, roll, np.nan)
        if self.form == "involute":
            point = roll_at_tangent_distance(roll, t, r_b)
            _reached, depth = relative_position(roll, point, r_b)
        else:
            depth = 0.5 * t**2 / roll
            point = flank.roll(np.hypot(r_b + t, roll - depth))
        if modification.facets > 0:
            faceted = facet_depth if self.form == "involute" else facet_depth_parabola
            depth = faceted(roll, t, point, flank, modification.facets)
        return depth + modification.smooth_removal(point, z, flank)


class ContactLineGap(NamedTuple):
    """The gap along one contact line; arrays of shape (n,)."""

    y: _Array  # along the line, from mid-face [m]
    gap: _Array  # of all modifications, normal [m]
    crown: _Array  # of the crowns alone [m]
    pinion_relief_start: float  # y where the pinion's tip relief begins: it acts above [m]
    gear_relief_start: float  # y where the gear's tip relief begins: it acts below [m]


def contact_line_gap(modified: ModifiedPair, X: float, y: ArrayLike) -> ContactLineGap:
    """Return the gap along a contact line of a helical pair, see [jamali_2015 fig. 5.2].

    Parameters
    ----------
    modified
        Pair with its flank modifications.
    X
        Of the line, on the face z = +W/2 [m].
    y
        Along the line, from mid-face [m], shape (n,).

    Returns
    -------
    ContactLineGap
        Starts of relief lie outside the face where a line does not reach them; NaN for spur
        gears, whose lines lie wholly inside or outside the relief.
    """
    plane = modified.pair.plane
    y = np.asarray(y, dtype=float)
    crown = np.zeros(y.shape)
    for flank in (modified.pinion, modified.gear):
        if flank.crown is not None:
            crown = crown + flank.crown.removal(y * plane.cos_b, plane.W) * plane.cos_b
    centre = X - 0.5 * plane.W * plane.sin_b / plane.cos_b
    rate = plane.sin_b if plane.sin_b > 0.0 else np.nan
    return ContactLineGap(
        y=y,
        gap=UndeformedGap(modified=modified).heights(0.0, y, X),
        crown=crown,
        pinion_relief_start=(modified.contact_end - centre) / rate,
        gear_relief_start=(modified.contact_start - centre) / rate,
    )
