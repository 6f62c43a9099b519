"""Axial section of one blank: pitch, face and root cone, corners of the tooth."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.checks import check_within
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank, MemberBlank


@dataclass(frozen=True, slots=True, kw_only=True)
class BlankCone:
    """A cone of revolution about the member's axis.

    Parameters
    ----------
    angle : float
        Half angle [rad].
    apex : float
        Distance of the apex beyond the crossing point [m]; negative: before it.
    """

    angle: float
    apex: float

    def radius(self, axial: float) -> float:
        """Return the radius [m] at an axial distance from the crossing point into the body [m]."""
        return (axial + self.apex) * math.tan(self.angle)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberProfile:
    """Axial section of a uniform-depth blank: all cones are parallel to the pitch cone.

    Points are (axial, radial): axial counts from the crossing point along the member's axis into
    its body. For the shipped pair that is z of the gear and x of the pinion.

    Parameters
    ----------
    member : MemberBlank
    dedendum : float
        Height of the tooth below the pitch cone [m].

    References
    ----------
    [iso_23509 7.4] [iso_23509 7.9], with addendum and dedendum angles of zero.
    """

    member: MemberBlank
    dedendum: float

    def __post_init__(self) -> None:
        low = -self.member.addendum
        check_within("dedendum", self.dedendum, low, 0.2, "m", "Give metres, not millimetres.")

    @classmethod
    def of_pinion(cls, blank: HypoidBlank) -> MemberProfile:
        """Return the section of the pinion."""
        return cls(member=blank.pinion, dedendum=blank.pinion_dedendum)

    @classmethod
    def of_gear(cls, blank: HypoidBlank) -> MemberProfile:
        """Return the section of the gear."""
        return cls(member=blank.gear, dedendum=blank.gear_dedendum)

    @property
    def whole_depth(self) -> float:
        """Addendum and dedendum [m]."""
        return self.member.addendum + self.dedendum

    @property
    def inner_cone_distance(self) -> float:
        """Cone distance at the toe [m]."""
        return self.member.outer_cone_distance - self.member.face_width

    @property
    def pitch_cone(self) -> BlankCone:
        """Pitch cone."""
        return BlankCone(angle=self.member.pitch_angle, apex=self.member.pitch_apex)

    @property
    def face_cone(self) -> BlankCone:
        """Cone of the tooth tips."""
        return BlankCone(angle=self.member.pitch_angle, apex=self.member.face_apex)

    @property
    def root_cone(self) -> BlankCone:
        """Cone of the tooth roots."""
        shift = self.dedendum / math.sin(self.member.pitch_angle)
        return BlankCone(angle=self.member.pitch_angle, apex=self.member.pitch_apex - shift)

    def point(self, cone_distance: float, height: float) -> tuple[float, float]:
        """Return (axial, radial) [m] of a point at a pitch cone distance and height above it.

        Parameters
        ----------
        cone_distance : float
            Along the pitch cone's generator to the foot of the normal [m].
        height : float
            Along that normal, towards the tip positive [m].
        """
        sine, cosine = math.sin(self.member.pitch_angle), math.cos(self.member.pitch_angle)
        axial = cone_distance * cosine - height * sine - self.member.pitch_apex
        return axial, cone_distance * sine + height * cosine

    @property
    def outer_tip(self) -> tuple[float, float]:
        """Crown at the heel (axial, radial) [m]."""
        return self.point(self.member.outer_cone_distance, self.member.addendum)

    @property
    def inner_tip(self) -> tuple[float, float]:
        """Front crown at the toe (axial, radial) [m]."""
        return self.point(self.inner_cone_distance, self.member.addendum)

    @property
    def outer_root(self) -> tuple[float, float]:
        """Root at the heel (axial, radial) [m]."""
        return self.point(self.member.outer_cone_distance, -self.dedendum)

    @property
    def inner_root(self) -> tuple[float, float]:
        """Root at the toe (axial, radial) [m]."""
        return self.point(self.inner_cone_distance, -self.dedendum)
