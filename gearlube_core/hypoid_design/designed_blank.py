"""Blank of a pair from its blank file: pitch cones, faces, heights and thicknesses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank, MemberBlank
from gearlube_core.hypoid_geometry.blank.iso_23509 import HypoidDesign, method_1, method_2, method_3
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones, ToothTrace
from gearlube_core.input_file.input_file import InputNote
from gearlube_core.units import DEGREE, MILLIMETRE


class _FaceWidth(NamedTuple):
    """Face of a member along its pitch cone [m]: from the calculation point out and in."""

    outer: float  # b_e, to the heel
    inner: float  # b_i, to the toe

    @property
    def total(self) -> float:
        """Face width [m]."""
        return self.outer + self.inner


SHAFT_ANGLE = 0.5 * math.pi
WIDEST = 0.45  # face width over outer cone distance
_FROM = "follows from the blank"


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignedBlank:
    """Blank of a pair by ISO 23509, uniform depth.

    Parameters
    ----------
    file : BlankFile
    cones : PitchCones
        Touching at the calculation point.
    trace : ToothTrace
        Lengthwise trace of the gear's teeth in its pitch plane.
    pinion_face, gear_face : FaceWidth
    blank : HypoidBlank
        The same as gear files have it.
    """

    file: BlankFile
    cones: PitchCones
    trace: ToothTrace
    pinion_face: _FaceWidth
    gear_face: _FaceWidth
    blank: HypoidBlank

    @classmethod
    def from_file(cls, file: BlankFile) -> DesignedBlank:
        """Return the blank of a file.

        Raises
        ------
        ParameterError
            When no such blank exists; the message names the fields.

        References
        ----------
        [iso_23509 6], [iso_23509 7].
        """
        cones = _cones(file)
        pair, depth = file.pair, file.depth
        sine = math.sin(cones.gear_pitch_angle)
        mean = cones.gear_mean_cone_distance
        width = pair.face_width_mm * MILLIMETRE
        if pair.outer_pitch_diameter_mm is None:
            outer = 0.5 * width
        else:
            outer = 0.5 * pair.outer_pitch_diameter_mm * MILLIMETRE / sine - mean
        _check_face(file, cones.gear_pitch_angle)
        gear = _FaceWidth(outer, width - outer)
        working = depth.depth_factor * cones.normal_module
        try:
            pinion = pinion_face(cones, gear, working, file.design_method)
            trace = ToothTrace(
                cutter=_cutter(file),
                crown_teeth=cones.crown_teeth,
                mean_cone_distance=mean,
                mean_spiral_angle=cones.gear_spiral_angle,
            )
        except ParameterError as reason:
            raise _no_blank(file, str(reason)) from None
        gear_addendum = file.gear_addendum_factor * working
        blank = HypoidBlank(
            pinion=_member(cones, pinion, working - gear_addendum, "pinion"),
            gear=_member(cones, gear, gear_addendum, "gear"),
            offset=cones.offset,
            clearance=depth.clearance_factor * working,
            name=file.name,
            source=f"designed by ISO 23509, method {file.design_method}",
        )
        return cls(
            file=file, cones=cones, trace=trace, pinion_face=pinion, gear_face=gear, blank=blank
        )

    @property
    def normal_module(self) -> float:
        """Mean normal module m_mn [m]."""
        return self.cones.normal_module

    @property
    def pressure_angle(self) -> float:
        """Mean of the effective pressure angles of both flanks [rad]."""
        cutter = self.file.cutter
        return 0.5 * (cutter.drive_pressure_angle_deg + cutter.coast_pressure_angle_deg) * DEGREE

    @property
    def drive_blade_angle(self) -> float:
        """Blade angle [rad] of the gear's convex flank: effective plus limit pressure angle."""
        return self.file.cutter.drive_pressure_angle_deg * DEGREE + self.cones.limit_pressure_angle

    @property
    def coast_blade_angle(self) -> float:
        """Blade angle [rad] of the gear's concave flank: effective less limit pressure angle."""
        return self.file.cutter.coast_pressure_angle_deg * DEGREE - self.cones.limit_pressure_angle

    @property
    def pinion_thickness(self) -> float:
        """Normal tooth thickness of the pinion on its pitch cone at the mean point [m].

        Teeth and slots are equally wide at the middle of the working depth, as gear files have it:
        one point radius for the blades of both flanks, no backlash.
        """
        return 0.5 * math.pi * self.normal_module + self._thicker

    @property
    def gear_thickness(self) -> float:
        """Normal tooth thickness of the gear on its pitch cone at the mean point [m]."""
        return 0.5 * math.pi * self.normal_module - self._thicker

    @property
    def _thicker(self) -> float:
        shift = 0.5 * (self.blank.pinion.addendum - self.blank.gear.addendum)
        return shift * (math.tan(self.drive_blade_angle) + math.tan(self.coast_blade_angle))

    def results(self) -> list[InputNote]:
        """Return the numbers of the blank, each as it follows from the file."""
        cones, blank = self.cones, self.blank
        found = []
        for role, face, pitch, spiral, thickness, member in (
            (
                "pinion",
                self.pinion_face,
                cones.pinion_pitch_angle,
                cones.pinion_spiral_angle,
                self.pinion_thickness,
                blank.pinion,
            ),
            (
                "gear",
                self.gear_face,
                cones.gear_pitch_angle,
                cones.gear_spiral_angle,
                self.gear_thickness,
                blank.gear,
            ),
        ):
            found += [
                _angle(f"{role}: pitch, face and root angle", pitch),
                _angle(f"{role}: mean spiral angle", spiral),
                _length(f"{role}: outer cone distance", member.outer_cone_distance),
                _length(f"{role}: face width", face.total),
                _length(f"{role}: addendum", member.addendum),
                _length(f"{role}: dedendum", blank.whole_depth - member.addendum),
                _length(f"{role}: pitch apex beyond the crossing point", member.pitch_apex),
                _length(f"{role}: face apex beyond the crossing point", member.face_apex),
                _length(f"{role}: normal tooth thickness at the mean point", thickness),
            ]
        return [
            _length("mean normal module", self.normal_module),
            _angle("offset angle in the pitch plane", cones.offset_angle),
            _angle("limit pressure angle", cones.limit_pressure_angle),
            _length("working depth", blank.working_depth),
            _length("bottom clearance", blank.root_clearance),
            *found,
        ]


def _cutter(file: BlankFile) -> CutterHead:
    return CutterHead(
        radius=file.cutter.radius_mm * MILLIMETRE, blade_groups=file.cutter.blade_groups
    )


def _cones(file: BlankFile) -> PitchCones:
    """Return the pitch cones by the file's method."""
    pair, method = file.pair, file.design_method
    width = pair.face_width_mm * MILLIMETRE
    try:
        if method == 0:
            angle = math.atan2(pair.gear_teeth, pair.pinion_teeth)
            outer = 0.5 * (pair.outer_pitch_diameter_mm or 0.0) * MILLIMETRE
            return PitchCones.touching(
                pinion_teeth=pair.pinion_teeth,
                gear_teeth=pair.gear_teeth,
                offset=0.0,
                shaft_angle=SHAFT_ANGLE,
                gear_pitch_angle=angle,
                gear_pitch_radius=outer - 0.5 * width * math.sin(angle),
                gear_spiral_angle=(pair.gear_spiral_angle_deg or 0.0) * DEGREE,
            )
        design = HypoidDesign(
            pinion_teeth=pair.pinion_teeth,
            gear_teeth=pair.gear_teeth,
            offset=pair.offset_mm * MILLIMETRE,
            shaft_angle=SHAFT_ANGLE,
            gear_face_width=width,
            cutter=_cutter(file),
        )
        outer = (pair.outer_pitch_diameter_mm or 0.0) * MILLIMETRE
        spiral = (pair.gear_spiral_angle_deg or 0.0) * DEGREE
        if method == 1:
            angle = (pair.pinion_spiral_angle_deg or 0.0) * DEGREE
            return method_1(design, outer_pitch_diameter=outer, pinion_spiral_angle=angle)
        if method == 2:
            mean = (pair.mean_pitch_diameter_mm or 0.0) * MILLIMETRE
            return method_2(design, mean_pitch_diameter=mean, gear_spiral_angle=spiral)
        return method_3(design, outer_pitch_diameter=outer, gear_spiral_angle=spiral)
    except (ParameterError, ConvergenceError) as reason:
        _check_face(file, math.atan2(pair.gear_teeth, pair.pinion_teeth))  # without offset
        raise _no_blank(file, str(reason)) from None


def _check_face(file: BlankFile, gear_pitch_angle: float) -> None:
    """Refuse a face that is too wide for the gear's cone."""
    pair = file.pair
    outer, mean = pair.outer_pitch_diameter_mm, pair.mean_pitch_diameter_mm
    cone = 0.5 * (outer or mean or 0.0) / math.sin(gear_pitch_angle)
    widest = WIDEST * cone if outer else WIDEST * cone / (1.0 - 0.5 * WIDEST)
    if pair.face_width_mm > widest:
        raise ParameterError(
            f"pair.face_width_mm must be at most {widest:.4g} mm, {WIDEST:g} of the gear's outer "
            f"cone distance, got {pair.face_width_mm:g} mm. Reduce it, or enlarge "
            f"pair.{'outer' if outer else 'mean'}_pitch_diameter_mm."
        )


def _no_blank(file: BlankFile, reason: str) -> ParameterError:
    pair = file.pair
    spiral = pair.pinion_spiral_angle_deg or pair.gear_spiral_angle_deg or 0.0
    return ParameterError(
        f"No blank of method {file.design_method} has pair.offset_mm {pair.offset_mm:g} mm, "
        f"pair.face_width_mm {pair.face_width_mm:g} mm, a spiral angle of {spiral:g} deg and "
        f"cutter.radius_mm {file.cutter.radius_mm:g} mm with {file.cutter.blade_groups} blade "
        f"groups: {reason}"
    )


def _member(cones: PitchCones, face: _FaceWidth, addendum: float, role: str) -> MemberBlank:
    pinion = role == "pinion"
    angle = cones.pinion_pitch_angle if pinion else cones.gear_pitch_angle
    mean = cones.pinion_mean_cone_distance if pinion else cones.gear_mean_cone_distance
    apex = cones.pinion_apex if pinion else cones.gear_apex
    return MemberBlank(
        teeth=cones.pinion_teeth if pinion else cones.gear_teeth,
        face_width=face.total,
        outer_cone_distance=mean + face.outer,
        pitch_angle=angle,
        spiral_angle=cones.pinion_spiral_angle if pinion else cones.gear_spiral_angle,
        pitch_apex=apex,
        face_apex=apex + addendum / math.sin(angle),
    )


def _angle(name: str, value: float) -> InputNote:
    return InputNote(name, round(value / DEGREE, 9) + 0.0, "deg", "inferred", _FROM)


def _length(name: str, value: float) -> InputNote:
    return InputNote(name, round(value / MILLIMETRE, 9) + 0.0, "mm", "inferred", _FROM)


def pinion_face(
    cones: PitchCones, gear: _FaceWidth, working_depth: float, method: int
) -> _FaceWidth:
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
        return _FaceWidth(gear.outer * stretch + more, gear.inner * stretch + more)
    if method == 2:
        stretch = 1.0 + math.tan(offset) ** 2
        return _FaceWidth(gear.outer * stretch, gear.inner * stretch)
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
    return _FaceWidth(outer + spare, inner + spare)
