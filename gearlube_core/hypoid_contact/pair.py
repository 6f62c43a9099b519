"""Two meshing flanks, one of the pinion and one of the gear, and the positions of the members."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.placement import (
    ALIGNED,
    Misalignment,
    Placement,
    gear_placement,
    pinion_placement,
    place_direction,
    place_point,
    turned,
)
from gearlube_core.hypoid_geometry.flank.correction import NO_CORRECTION
from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state
from gearlube_core.hypoid_geometry.flank.flank import Flank, Side
from gearlube_core.hypoid_geometry.flank.machine_frames import reference_point
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

Angle = TypeVar("Angle", float, Array)


@dataclass(frozen=True)
class FlankPair:
    """A pinion flank and a gear flank in mesh.

    Angles of both members count in the drive direction: the gear about +z, the pinion about -x.
    At gear angle zero the reference point of the gear's cutter path stands at the mean point of the
    blank, at pinion angle zero the pinion's; both are common to the drive and the coast flanks, so
    the two pairs share their angles and backlash is the difference of their touching angles.

    Parameters
    ----------
    pinion, gear : Flank
        Of the same side.
    misalignment : Misalignment
    mean_point : ndarray of shape (3,)
        Reference point of the blank [m].
    """

    pinion: Flank
    gear: Flank
    misalignment: Misalignment
    mean_point: Array

    @classmethod
    def from_file(
        cls, file: HypoidGearFile, side: Side, misalignment: Misalignment = ALIGNED
    ) -> FlankPair:
        """Return the pair of drive or coast flanks of a gear file."""
        return cls(
            Flank.from_file(file, "pinion", side),
            Flank.from_file(file, "gear", side),
            misalignment,
            reference_point(file.blank()),
        )

    def misaligned(self, misalignment: Misalignment) -> FlankPair:
        """Return the same flanks, displaced; the zero of the angles stays."""
        return replace(self, misalignment=misalignment)

    def uncorrected(self) -> FlankPair:
        """Return the same pair without the corrections of its flanks."""
        plain = replace(self.pinion, correction=NO_CORRECTION)
        return replace(self, pinion=plain, gear=replace(self.gear, correction=NO_CORRECTION))

    @property
    def is_corrected(self) -> bool:
        """Whether material is taken off either flank as it is cut."""
        return not (self.pinion.correction.is_none and self.gear.correction.is_none)

    def check_uncorrected(self) -> None:
        """Raise ParameterError where flanks have corrections, for what knows none."""
        if self.is_corrected:
            raise ParameterError(
                "Derivatives of the unloaded contact need flanks without reliefs, crowns and "
                f"twist, got a pair with corrected {self.side} flanks. Take `pair.uncorrected()`, "
                "or differences of two analyses."
            )

    @property
    def side(self) -> Side:
        """Side of the flanks: drive or coast."""
        return self.pinion.side

    @property
    def ratio(self) -> float:
        """Teeth ratio gear / pinion [-]."""
        return self.gear.teeth / self.pinion.teeth

    @property
    def gear_pitch(self) -> float:
        """Angle of the gear over a mesh period [rad]."""
        return 2.0 * math.pi / self.gear.teeth

    @property
    def pinion_pitch(self) -> float:
        """Angle of the pinion over a mesh period [rad]."""
        return 2.0 * math.pi / self.pinion.teeth

    @property
    def touching_sign(self) -> float:
        """+1 if the pinion closes the gap by turning in the drive direction, -1 for coast."""
        return 1.0 if self.side == "drive" else -1.0

    def gear_placed(self, angle: float) -> Placement:
        """Return the placement of the gear at `angle` [rad]."""
        return turned(self.gear_base, self.gear_turn(angle))

    def pinion_placed(self, angle: float) -> Placement:
        """Return the placement of the pinion at `angle` [rad]; zero as at gear angle zero."""
        return turned(self.pinion_base, self.pinion_turn(angle))

    @property
    def pinion_base(self) -> Placement:
        """Placement of the pinion with its work at rotation zero."""
        return pinion_placement(self.pinion.motion, self.misalignment)

    @property
    def gear_base(self) -> Placement:
        """Placement of the gear with its work at rotation zero."""
        return gear_placement(self.gear.motion, self.misalignment)

    def gear_turn(self, angle: Angle) -> Angle:
        """Return the rotation about the work axis [rad] of the gear angle `angle` [rad]."""
        return self._gear_turn + angle

    def pinion_turn(self, angle: Angle) -> Angle:
        """Return the rotation about the work axis [rad] of the pinion angle `angle` [rad]."""
        return self._pinion_turn_zero - angle

    def pinion_angle(self, turn: Angle) -> Angle:
        """Return the pinion angle [rad] of a rotation about the work axis [rad]."""
        return self._pinion_turn_zero - turn

    def gear_in_place(self, angle: float, r: Array, direction: Array) -> tuple[Array, Array]:
        """Return points (..., 3) [m] and directions of the gear in the fixed frame at `angle`."""
        turn = Rotation.from_rotvec((self._gear_turn + angle) * self.gear.axis).as_matrix()
        shift = np.array([0.0, 0.0, self.misalignment.gear_axial])
        return r @ turn.T + shift, direction @ turn.T

    @property
    def pinion_axis_placed(self) -> tuple[Array, Array]:
        """Unit vector of the pinion's work axis and a point on it [m], in the fixed frame."""
        base = self.pinion_base
        point = np.array(place_point(base, base.point))
        return np.array(place_direction(base, base.axis)), point

    @cached_property
    def _gear_turn(self) -> float:
        """Rotation about z that brings the gear's reference point to the mean point [rad]."""
        r = np.array(cut_state(self.gear.motion, *self.gear.start).r)
        m = self.mean_point
        return math.atan2(m[1], m[0]) - math.atan2(r[1], r[0])

    @cached_property
    def _pinion_turn_zero(self) -> float:
        """Rotation about the work axis that brings the pinion's reference point there [rad]."""
        r = np.array(cut_state(self.pinion.motion, *self.pinion.start).r) - self.pinion.axis_point
        m = self.mean_point - self.pinion.axis_point
        return math.atan2(m[2], m[1]) - math.atan2(r[2], r[1])
