"""One tooth between its two flanks, in cylindrical coordinates about the member's axis."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role, Side
from gearlube_core.hypoid_geometry.flank.flank_root_limit import FlankRootLimit, flank_root_limit
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_MARGIN = 0.05  # s above a fold, where the slope of the flank is still that of its sound part
_SLOPE_STEP = 0.02  # s
_STATIONS = 33  # face positions at which the end of the flank is searched
_TRACE_STEP = 1e-3  # t


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
