"""One tooth between its two flanks, in cylindrical coordinates about the member's axis."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role, Side
from gearlube_core.hypoid_geometry.flank.surface_point import march
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

LOWEST = -0.1  # s, below the root line, where the search for the end of a flank gives up
_STEP = 0.005  # s
_HALVINGS = 12
_MIDDLE = 0.6  # s, where every search starts
_LEAP = 1e-3  # m of blade height; more between neighbouring solutions is another sheet
_MARGIN = 0.05  # s above a fold, where the slope of the flank is still that of its sound part
_SLOPE_STEP = 0.02  # s
_STATIONS = 33  # face positions at which the end of the flank is searched
_TRACE_STEP = 1e-3  # t


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


@dataclass(frozen=True)
class Tooth:
    """A tooth: the drive flank at rotation zero, and the coast flank that bounds the same tooth.

    Both blades pass through one curve in the reference plane and follow each other by half a blade
    pitch, in which the work turns by half a tooth pitch. The coast flank of the tooth is therefore
    the coast flank at rotation zero turned by half a pitch, away from the outward normal of the
    drive flank. With single indexing the same division of the pitch is assumed.

    Parameters
    ----------
    drive, coast : Flank
        Of the same member.
    blank : HypoidBlank
    """

    drive: Flank
    coast: Flank
    blank: HypoidBlank

    @classmethod
    def from_file(cls, file: HypoidGearFile, role: Role) -> Tooth:
        """Return a tooth of a member of a gear file."""
        return cls(
            Flank.from_file(file, role, "drive"),
            Flank.from_file(file, role, "coast"),
            file.blank(),
        )

    @property
    def pitch(self) -> float:
        """Angular pitch [rad]."""
        return 2.0 * math.pi / self.drive.teeth

    @property
    def blade_tip(self) -> float:
        """Height of the blade tips over the reference plane [m]."""
        return 0.5 * self.blank.working_depth + self.blank.root_clearance

    @cached_property
    def towards(self) -> float:
        """+1 if the tooth lies at growing angles about the work axis from its drive flank."""
        point = self.drive.sample_parameters(self.drive.start)
        swing = np.cross(self.drive.axis, point.r - self.drive.axis_point)
        return -math.copysign(1.0, float(point.normal @ swing))

    @property
    def coast_turn(self) -> float:
        """Rotation [rad] that brings the coast flank of rotation zero to this tooth."""
        return 0.5 * self.towards * self.pitch

    def limit(self, side: Side, t: Array) -> FlankRootLimit:
        """Return where a flank ends towards the root, at face positions t (n,)."""
        return flank_root_limit(self._flank(side), np.asarray(t, float), self.blade_tip)

    def angles(self, side: Side, s: Array, t: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return the polar angle of a flank of this tooth, and where it had to be extended.

        Below a fold the angle goes on linearly in s, from a little above it, where the flank is
        still smooth; a flank without fold is followed down to s = -0.05.

        Parameters
        ----------
        side : {"drive", "coast"}
        s : ndarray of shape (m,)
        t : ndarray of shape (n,)

        Returns
        -------
        angle : ndarray of shape (m, n)
            [rad] about the work axis, from the drive flank's reference point.
        extended : ndarray of bool, shape (m, n)
        """
        s, t = np.meshgrid(np.asarray(s, float), np.asarray(t, float), indexing="ij")
        fold = np.interp(t, *self._folds[side])
        lowest = fold + _MARGIN
        held = np.maximum(s, lowest)
        angle = self._cut_angle(side, held, t)
        above = self._cut_angle(side, held + _SLOPE_STEP, t)
        extended = (s < lowest) | np.isnan(angle)
        return np.where(s < lowest, angle + (s - held) * (above - angle) / _SLOPE_STEP, angle), (
            extended
        )

    def points(self, angle: Array, s: Array, t: Array) -> Array:
        """Return the points [m] at polar angles `angle` (m, n), s (m,) and t (n,): (m, n, 3)."""
        s, t = np.meshgrid(s, t, indexing="ij")
        radius, axial = self.drive.region.section(s, t)
        angle = angle + self._zero
        e1, e2 = self._directions
        return np.asarray(
            self.drive.axis_point
            + (radius * np.cos(angle))[..., None] * e1
            + (radius * np.sin(angle))[..., None] * e2
            + axial[..., None] * self.drive.axis
        )

    def thickness_angle(self, s: Array, t: Array) -> Array:
        """Return the angle [rad] that the tooth fills, (m, n); negative beyond a pointed tip."""
        drive, _ = self.angles("drive", s, t)
        coast, _ = self.angles("coast", s, t)
        return self.towards * (coast - drive)

    def normal_shares(self, s: Array, t: Array) -> Array:
        """Return radius times cosine of the tooth's spiral angle [m], (m, n).

        Times an angle about the axis: an arc normal to the tooth trace.
        """
        s, t = np.asarray(s, float), np.asarray(t, float)
        late, early = np.minimum(t + _TRACE_STEP, 1.0), np.maximum(t - _TRACE_STEP, 0.0)
        turned = sum(self.angles(k, s, late)[0] - self.angles(k, s, early)[0] for k in self._sides)
        distance = self.drive.region.cone_distance(late) - self.drive.region.cone_distance(early)
        radius, _ = self.drive.region.section(*np.meshgrid(s, t, indexing="ij"))
        return np.asarray(radius * np.cos(np.arctan(radius * 0.5 * turned / distance)))

    @property
    def _sides(self) -> tuple[Side, Side]:
        return "drive", "coast"

    def _flank(self, side: Side) -> Flank:
        return self.drive if side == "drive" else self.coast

    @cached_property
    def _folds(self) -> dict[Side, tuple[Array, Array]]:
        """Fold of each flank over the face, searched once."""
        t = np.linspace(0.0, 1.0, _STATIONS)
        return {side: (t, self.limit(side, t).fold) for side in self._sides}

    @cached_property
    def _directions(self) -> tuple[Array, Array]:
        """Directions of polar angles zero and a quarter turn: y for both at the quarter turn."""
        quarter = np.array([0.0, 1.0, 0.0])
        return np.cross(quarter, self.drive.axis), quarter

    @cached_property
    def _zero(self) -> float:
        point = self.drive.sample_parameters(self.drive.start).r
        return float(self._polar(point))

    def _polar(self, r: Array) -> Array:
        e1, e2 = self._directions
        w = r - self.drive.axis_point
        return np.asarray(np.arctan2(w @ e2, w @ e1))

    def _cut_angle(self, side: Side, s: Array, t: Array) -> Array:
        """Return the polar angle of a flank as cut; NaN where it does not exist."""
        angle = self._polar(self._flank(side).sample(s, t).r) - self._zero
        angle = np.angle(np.exp(1j * angle))
        return np.asarray(angle + (self.coast_turn if side == "coast" else 0.0))
