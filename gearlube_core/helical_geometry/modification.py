"""Modifications of helical and spur flanks: material removed from the true involute helicoids.

Removal is measured in the transverse plane, normal to the profile: along the line of action. In
the direction normal to the flank it is that times cos(beta_b).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.involute import (
    InvoluteFlank,
    check_facets,
    facet_depth,
    involute_flank,
)
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.number import Checked, Number, check_fields

_METRES = "Give metres, not micrometres or millimetres."
WIDEST_RELIEF = 0.1  # m
_REMOVAL, _SLOPE = Number("m", 0.0, 1e-3, _METRES), Number("m", -1e-3, 1e-3, _METRES)


def _check_extent(extent: float) -> None:
    check_positive("extent", extent, "m", _METRES)
    check_within("extent", extent, 0.0, WIDEST_RELIEF, "m", _METRES)


@dataclass(frozen=True, slots=True, kw_only=True)
class TipRelief:
    """Relief that begins as a parabola and continues as its tangent.

    r_ce = r_start + k (r_tip - r_start),  c_e = (r_ce - r_start)/(2 r_tip - r_ce - r_start) c_t
    r <= r_ce: ((r - r_start)/(r_ce - r_start))^2 c_e
    r >= r_ce: c_e + (c_t - c_e)/(r_tip - r_ce) (r - r_ce)

    Parameters
    ----------
    amount : float
        c_t, at the tip in the transverse plane, normal to the profile [m]; 0 to 1 mm.
    extent : float
        r_tip - r_start, radial [m].
    k : float
        Share of the extent that is parabola [-]: 0 linear, 1 parabolic.

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    Source: [jamali_2015 (5.1)] [jamali_2015 (5.2)] [jamali_2015 (5.3)] [jamali_2015 (5.4)]
    [jamali_2015 (5.5)]
    The slope is continuous for k > 0; with k = 0 it steps at r_start. Past the tip, where no flank
    is left, the tangent goes on.
    """

    amount: Annotated[float, _REMOVAL]
    extent: float
    k: Annotated[float, Number("1", 0.0, 1.0, "0 is linear relief, 1 parabolic.")]

    def __post_init__(self) -> None:
        check_fields(self)
        _check_extent(self.extent)

    @property
    def parabola_end_removal(self) -> float:
        """c_e: removal where the parabola ends [m]."""
        return self.k / (2.0 - self.k) * self.amount

    @property
    def tip_slope(self) -> float:
        """Removal over radius at the tip [-]: 2 c_t/((2 - k)(r_tip - r_start))."""
        return 2.0 * self.amount / ((2.0 - self.k) * self.extent)

    def removal(self, r: ArrayLike, tip_radius: float) -> Array:
        """Return the removal [m] at radius `r` [m], any shape; zero below r_start."""
        depth = np.maximum(np.asarray(r, dtype=float) - (tip_radius - self.extent), 0.0)
        parabola = self.k * self.extent
        line = self.tip_slope * (depth - 0.5 * parabola)
        if parabola == 0.0:
            return line
        return np.where(depth < parabola, 0.5 * self.tip_slope * depth**2 / parabola, line)


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerTipRelief:
    """Relief by a power of the radial depth.

    z_t' = c_t ((r - r_start)/(r_tip - r_start))^beta

    Parameters
    ----------
    amount : float
        c_t, at the tip in the transverse plane, normal to the profile [m]; 0 to 1 mm.
    extent : float
        r_tip - r_start, radial [m].
    beta : float
        [-], 1 (linear) to 10; Jamali uses 1 to 4.

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    Source: [jamali_2015 (5.6)]. Past the tip, where no flank is left, the power goes on.
    """

    amount: Annotated[float, _REMOVAL]
    extent: float
    beta: Annotated[float, Number("1", 1.0, 10.0, "1 is linear relief, 2 parabolic.")]

    def __post_init__(self) -> None:
        check_fields(self)
        _check_extent(self.extent)

    def removal(self, r: ArrayLike, tip_radius: float) -> Array:
        """Return the removal [m] at radius `r` [m], any shape; zero below r_start."""
        depth = np.maximum(np.asarray(r, dtype=float) - (tip_radius - self.extent), 0.0)
        return np.asarray(self.amount * (depth / self.extent) ** self.beta)


@dataclass(frozen=True, slots=True, kw_only=True)
class Crown(Checked):
    """Axial crown of one flank, parabolic from |z| = F_o outwards.

    z_c' = c_r ((|z| - F_o)/(F/2 - F_o))^2

    Parameters
    ----------
    amount : float
        c_r, at both face edges [m]; 0 to 1 mm.
    start : float
        F_o, from mid-face [m]; at least 0, less than half the face width.

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    Source: [jamali_2015 (4.3)] and [jamali_2015 (4.4)] before their factor cos(beta_b). (4.4) puts
    the lower half's start at -F_o, so both halves are one formula in |z|.
    """

    amount: Annotated[float, _REMOVAL]
    start: Annotated[float, Number("m", 0.0, 1.0, _METRES)]

    def removal(self, z: ArrayLike, face_width: float) -> Array:
        """Return the removal [m] at z [m] from mid-face, any shape; goes on past the faces."""
        depth = np.maximum(np.abs(np.asarray(z, dtype=float)) - self.start, 0.0)
        return np.asarray(self.amount * (depth / (0.5 * face_width - self.start)) ** 2)

    def curvature_radius(self, face_width: float, base_helix_angle: float) -> float:
        """Return the radius of curvature along the contact line [m], where the crown has begun.

        R_y = (F/2 - F_o)^2/(2 c_r cos^3(beta_b))
        """
        check_positive("amount", self.amount, "m", "A crown of zero has no curvature.")
        half = 0.5 * face_width - self.start
        return half**2 / (2.0 * self.amount * math.cos(base_helix_angle) ** 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankModification:
    """Modifications of one member's flank from an involute helicoid.

    Parameters
    ----------
    tip_relief : TipRelief or PowerTipRelief or None
    crown : Crown or None
    lead_slope : float
        f_Hbeta over the face width [m]: the removal at z = +W/2 less that at -W/2, zero at
        mid-face. Positive values open the gap towards +z, on either member.
    profile_slope : float
        f_Halpha over the active profile [m]: the removal at its tip end less that at its root
        end, zero in the middle of its roll length. Positive values open the gap at this member's
        tip; [iso_1328_1] counts material there, the opposite sign.
    facets : int
        n_f, over the active profile [-]; 0 leaves the profile smooth.

    Raises
    ------
    ParameterError
        A slope larger than 1 mm or not finite, a negative number of facets.
    """

    tip_relief: TipRelief | PowerTipRelief | None = None
    crown: Crown | None = None
    lead_slope: Annotated[float, _SLOPE] = 0.0
    profile_slope: Annotated[float, _SLOPE] = 0.0
    facets: int = 0

    def __post_init__(self) -> None:
        check_facets("facets", self.facets)
        check_fields(self)

    def removal(self, roll: ArrayLike, z: ArrayLike, flank: InvoluteFlank) -> Array:
        """Return the transverse removal, down to the facets where there are any.

        Parameters
        ----------
        roll
            Roll length of the point [m].
        z
            From mid-face [m]; shapes broadcast.
        flank
            Involute flank of the member.

        Returns
        -------
        array
            [m], of the broadcast shape.
        """
        total = self.smooth_removal(roll, z, flank)
        if self.facets > 0:
            total = total + facet_depth(roll, 0.0, roll, flank, self.facets)
        return total

    def smooth_removal(self, roll: ArrayLike, z: ArrayLike, flank: InvoluteFlank) -> Array:
        """Return the transverse removal without facets."""
        roll, z = np.broadcast_arrays(np.asarray(roll, dtype=float), np.asarray(z, dtype=float))
        total = np.zeros(roll.shape)
        if self.tip_relief is not None:
            total += self.tip_relief.removal(flank.radius(roll), flank.tip_radius)
        if self.crown is not None:
            total += self.crown.removal(z, flank.face_width)
        if self.lead_slope != 0.0:
            total += self.lead_slope * z / flank.face_width
        if self.profile_slope != 0.0:
            middle = 0.5 * (flank.roll_low + flank.roll_high)
            total += self.profile_slope * (roll - middle) / (flank.roll_high - flank.roll_low)
        return total


@dataclass(frozen=True, slots=True, kw_only=True)
class ModifiedPair:
    """A gear pair with modified flanks.

    Parameters
    ----------
    pair : HelicalPair
    pinion, gear : FlankModification
        Plain flanks by default.

    Raises
    ------
    ParameterError
        Crown that starts outside the face, or relief that starts inside the base circle.
    """

    pair: HelicalPair
    pinion: FlankModification = FlankModification()
    gear: FlankModification = FlankModification()

    def __post_init__(self) -> None:
        half = 0.5 * self.pair.face_width
        for member in ("pinion", "gear"):
            modification: FlankModification = getattr(self, member)
            flank = involute_flank(self.pair, member)
            crown, relief = modification.crown, modification.tip_relief
            if crown is not None and not crown.start < half:
                raise ParameterError(
                    f"{member}.crown.start must be below half the face width, {half:g} m, "
                    f"got {crown.start:g} m. {_METRES}"
                )
            if relief is not None and relief.extent > flank.tip_radius - flank.base_radius:
                raise ParameterError(
                    f"{member}.tip_relief.extent must end above the base circle, at most "
                    f"{flank.tip_radius - flank.base_radius:g} m, got {relief.extent:g} m. "
                    "Shorten the relief."
                )

    @property
    def pinion_flank(self) -> InvoluteFlank:
        """The pinion's involute."""
        return involute_flank(self.pair, "pinion")

    @property
    def gear_flank(self) -> InvoluteFlank:
        """The gear's involute."""
        return involute_flank(self.pair, "gear")

    @property
    def contact_start(self) -> float:
        """Position x [m] where the gear's relief ends and unrelieved contact starts."""
        return self.pair.tangent_length - _relief_start(self.gear, self.gear_flank)

    @property
    def contact_end(self) -> float:
        """Position x [m] where the pinion's relief begins."""
        return _relief_start(self.pinion, self.pinion_flank)

    def pinion_removal(self, roll: ArrayLike, z: ArrayLike) -> Array:
        """Return the pinion's transverse removal [m] at roll length and z [m]."""
        return self.pinion.removal(roll, z, self.pinion_flank)

    def gear_removal(self, roll: ArrayLike, z: ArrayLike) -> Array:
        """Return the gear's transverse removal [m] at its roll length and z [m]."""
        return self.gear.removal(roll, z, self.gear_flank)

    def removal(self, x: ArrayLike, z: ArrayLike) -> Array:
        """Return the transverse removal of both flanks at points of the plane of contact.

        Parameters
        ----------
        x
            Along the line of action from the pinion's tangent point [m].
        z
            From mid-face [m]; shapes broadcast.

        Returns
        -------
        array
            [m]: how much later than unmodified flanks the point comes into contact.
        """
        x = np.asarray(x, dtype=float)
        return self.pinion_removal(x, z) + self.gear_removal(self.pair.tangent_length - x, z)


def _relief_start(modification: FlankModification, flank: InvoluteFlank) -> float:
    relief = modification.tip_relief
    if relief is None:
        return flank.roll_high
    return float(flank.roll(flank.tip_radius - relief.extent))
