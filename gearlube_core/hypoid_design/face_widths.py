"""Face width of the pinion: how far its teeth reach to both sides of the calculation point."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_within
from gearlube_core.hypoid_geometry.blank.pitch_cones import PitchCones


class FaceWidth(NamedTuple):
    """Face of a member along its pitch cone [m]: from the calculation point out and in."""

    outer: float  # b_e, to the heel
    inner: float  # b_i, to the toe

    @property
    def total(self) -> float:
        """Face width [m]."""
        return self.outer + self.inner


def pinion_face(cones: PitchCones, gear: FaceWidth, working_depth: float, method: int) -> FaceWidth:
    """Return the face of the pinion that covers that of the gear, for uniform depth.

    Parameters
    ----------
    cones : PitchCones
    gear : FaceWidth
    working_depth : float
        h_mw [m].
    method : int
        0 to 3, of ISO 23509.

    Notes
    -----
    Method 0: both alike. Method 1: the gear's ends carried to the pinion's cone along the pitch
    plane, and a working depth more on each side as the root plane is turned; the offset angle in
    the root plane is taken as that in the axial plane, 0.03 mm on the shipped pair. Method 2:
    b_2 (1 + tan^2 zeta_mp). Method 3: the gear's ends seen along the pinion's generator plus
    3 m_mn tan zeta_mp, as whole millimetres, what is added shared by both ends.

    References
    ----------
    [iso_23509 7.3]; checked against the samples F.3 to F.5 of annex F.
    """
    offset = cones.offset_angle
    if method == 0:
        return gear
    if method == 1:
        ratio = cones.gear_teeth / cones.pinion_teeth
        cos1, cos2 = math.cos(cones.pinion_pitch_angle), math.cos(cones.gear_pitch_angle)
        turned = math.atan2(math.sin(offset) * cos2, ratio * cos1 + cos2 * math.cos(offset))
        stretch = 1.0 / math.cos(offset - turned)
        more = working_depth * math.sin(cones.axial_offset_angle) * (1.0 - 1.0 / ratio) / cos1
        return FaceWidth(gear.outer * stretch + more, gear.inner * stretch + more)
    if method == 2:
        stretch = 1.0 + math.tan(offset) ** 2
        return FaceWidth(gear.outer * stretch, gear.inner * stretch)
    mean = cones.gear_mean_cone_distance
    along, across = mean * math.cos(offset), mean * math.sin(offset)
    check_within(
        "R_m2 sin(zeta_mp) / (R_m2 - b_i2)",
        across / (mean - gear.inner),
        0.0,
        1.0,
        cure="Reduce the face width or the offset.",
    )
    outer = math.sqrt((mean + gear.outer) ** 2 - across**2) - along
    inner = along - math.sqrt((mean - gear.inner) ** 2 - across**2)
    needed = outer + inner + 3.0 * cones.normal_module * math.tan(offset)
    spare = 0.5 * (1e-3 * math.floor(1e3 * needed + 1.0) - outer - inner)
    return FaceWidth(outer + spare, inner + spare)
