"""How the teeth of a pair differ from each other: pitch, running axis, waves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.flank.flank import Role, Side


class Wave(NamedTuple):
    """Waves of a flank along its contact lines: deviation A cos(n theta + phase).

    theta is the rotation of the member in the drive direction at which a point is in contact,
    zero where the reference point of tooth 1 stands at the mean point.
    """

    waves: int  # n, waves a turn
    amplitude: float  # A [m], along the normal, plus for more material
    phase: float  # rad


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberErrors:
    """Errors of one member's teeth.

    Parameters
    ----------
    pitch : mapping of side to ndarray of shape (z,)
        How far the flank of each tooth is turned on in the sense in which teeth are counted [rad].
    eccentricity : float
        Of the teeth from the running axis [m].
    eccentricity_angle : float
        Its direction: angle from the reference point of tooth 1 in the sense of counting [rad].
    wobble : float
        Tilt of the teeth against the running axis [rad], about the point of the axis at the level
        of the mean point.
    wobble_angle : float
        Where the teeth stand farthest from the crossing point, counted as eccentricity_angle [rad].
    waves : mapping of side to tuple of Wave
    """

    pitch: Mapping[Side, Array] = field(default_factory=dict)
    eccentricity: float = 0.0
    eccentricity_angle: float = 0.0
    wobble: float = 0.0
    wobble_angle: float = 0.0
    waves: Mapping[Side, tuple[Wave, ...]] = field(default_factory=dict)

    @property
    def is_none(self) -> bool:
        """Whether all teeth are alike."""
        return not (
            any(np.ptp(values) > 0.0 for values in self.pitch.values())
            or self.eccentricity
            or self.wobble
            or any(wave.amplitude for waves in self.waves.values() for wave in waves)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothErrors:
    """Errors of both members' teeth.

    Teeth are counted in the order in which they come into mesh when the pair is driven forward:
    tooth 2 follows tooth 1. Tooth 1 of the pinion meshes with tooth 1 of the gear at mesh phase
    zero.

    Parameters
    ----------
    pinion, gear : MemberErrors
    """

    pinion: MemberErrors = field(default_factory=MemberErrors)
    gear: MemberErrors = field(default_factory=MemberErrors)

    def of(self, role: Role) -> MemberErrors:
        """Return the errors of a member."""
        return self.pinion if role == "pinion" else self.gear

    @property
    def is_none(self) -> bool:
        """Whether all teeth of both members are alike."""
        return self.pinion.is_none and self.gear.is_none
