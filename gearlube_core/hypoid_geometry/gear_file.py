"""The gear file: blank, cutters and machine settings of a hypoid pair, in workshop units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank, MemberBlank
from gearlube_core.hypoid_geometry.flank.correction import (
    EDGES,
    NO_CORRECTION,
    EdgeRelief,
    FlankCorrection,
    rounding,
)
from gearlube_core.hypoid_geometry.gear_file_sections import (
    RELIEFS,
    UNMODELLED,
    FlankRelief,
    Gear,
    Member,
    Pair,
    Pinion,
)
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.input_file.tolerance import Tolerances, check_tolerances
from gearlube_core.storage.file_names import Name
from gearlube_core.units import DEGREE, MILLIMETRE

_SIZES = {"mm": MILLIMETRE, "deg": DEGREE, "mrad": 1e-3, "%": 1e-2, "": 1.0}
Text = Annotated[str, Field(min_length=1)]
Fields = Annotated[tuple[Text, ...], Field(strict=False)]
Origin = Literal["table", "inferred", "completed"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Misfit:
    """One check of a gear file.

    Parameters
    ----------
    what : str
        What differs, as the subject of a sentence.
    value : float
        By how much, in SI units; NaN where the settings do not even allow the question.
    limit : float
        Largest value of a sound file, in SI units.
    refused : float
        Largest value with which an analysis starts; between both limits a file gets a warning.
    unit : {"mm", "deg", "mrad", "%", ""}
        Of both numbers in the sentence.
    fields : tuple of str
        Dotted names of the settings that decide it.
    reason : str
        Stands for the sentence where the value is NaN.
    """

    what: str
    value: float
    limit: float
    refused: float
    unit: str
    fields: tuple[str, ...]
    reason: str = ""

    @property
    def share(self) -> float:
        """Value over limit [-], without sign; infinite for NaN."""
        return math.inf if math.isnan(self.value) else abs(self.value) / self.limit

    @property
    def is_sound(self) -> bool:
        """Whether the value is within the limit of sound files."""
        return self.share <= 1.0

    @property
    def is_refused(self) -> bool:
        """Whether an analysis must not start."""
        return not abs(self.value) <= self.refused

    def __str__(self) -> str:
        if math.isnan(self.value):
            return self.reason
        size = _SIZES[self.unit]
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"{self.what} must be within {self.limit / size:g}{unit}, got "
            f"{self.value / size:.3g}{unit}."
        )


class HypoidGearFile(InputFile):
    """Gear file of a hypoid pair: blanks, cutters and machine settings as a workshop has them.

    References
    ----------
    [karagiannis_2012 Table 1], for the names of the settings.

    Examples
    --------
    >>> HypoidGearFile.shipped()
    ('mohammadpour_2015',)
    >>> HypoidGearFile.named("mohammadpour_2015").pinion.teeth
    13
    """

    package: ClassVar[str] = "gearlube_core.hypoid_geometry"
    unmodelled: ClassVar[Mapping[str, str]] = UNMODELLED

    name: Name = Field(description="Name of the pair in reports and figures")
    source: Text = Field(description="Where the numbers come from")
    pair: Pair
    pinion: Pinion
    gear: Gear
    inferred: Fields = Field(
        (),
        description="Dotted names of fields that the source does not print but that follow from it",
    )
    completed: Fields = Field(
        (), description="Dotted names of fields that the source lacks and whose values were chosen"
    )
    tolerances: Tolerances = Field(default={})

    @model_validator(mode="after")
    def _check_relations(self) -> HypoidGearFile:
        """Check relations between fields."""
        for role, member in (("pinion", self.pinion), ("gear", self.gear)):
            if not member.face_width_mm < member.outer_cone_distance_mm:
                raise ValueError(
                    f"{role}.face_width_mm must be below {role}.outer_cone_distance_mm, "
                    f"{member.outer_cone_distance_mm:g} mm, got {member.face_width_mm:g} mm"
                )
        heights = {
            role: (member.face_apex_mm - member.pitch_apex_mm)
            * math.sin(member.pitch_angle_deg * DEGREE)
            for role, member in (("pinion", self.pinion), ("gear", self.gear))
        }
        depth = sum(heights.values())
        if not depth > 0.0:
            wrong = " and ".join(
                f"{role}.face_apex_mm or {role}.pitch_apex_mm"
                for role, height in heights.items()
                if not height > 0.0
            )
            raise ValueError(
                f"The working depth, from the face and pitch apexes, must be above 0 mm, got "
                f"{depth:.3g} mm; apexes count positive beyond the crossing point. Most likely "
                f"wrong: the sign or the decimal point of {wrong}"
            )
        known = field_notes(HypoidGearFile)
        for field in (*self.inferred, *self.completed):
            if field not in known:
                raise ValueError(f"inferred or completed names {field!r}, which is not a field")
        if (self.pinion.cutter.blade_groups == 0) != (self.gear.cutter.blade_groups == 0):
            raise ValueError(
                "pinion.cutter.blade_groups and gear.cutter.blade_groups must be both 0 (face "
                f"milling) or both above 0, got {self.pinion.cutter.blade_groups} and "
                f"{self.gear.cutter.blade_groups}"
            )
        self._check_reliefs()
        check_tolerances(self.tolerances, known)
        return self

    def _check_reliefs(self) -> None:
        """Check that the reliefs of a flank fit on it."""
        for name, relief in self._reliefs.items():
            if relief is None:
                continue
            role = name.partition(".")[0]
            height = self.blank().whole_depth / MILLIMETRE
            width = getattr(self, role).face_width_mm
            for ends, whole, what in (
                (("tip", "root"), height, "the whole depth of the tooth"),
                (("toe", "heel"), width, f"{role}.face_width_mm"),
            ):
                word = "depth" if "tip" in ends else "length"
                fields = [f"{end}_relief_{word}_mm" for end in ends]
                reach = [getattr(relief, field) or 0.0 for field in fields]
                if sum(reach) > whole:
                    given = " and ".join(
                        f"{field} {one:g} mm"
                        for field, one in zip(fields, reach, strict=True)
                        if one
                    )
                    raise ValueError(
                        f"{name}: the reliefs must fit on the flank, together at most {what}, "
                        f"{whole:.4g} mm, got {given}. Shorten them; a crown covers the whole flank"
                    )

    @property
    def _reliefs(self) -> dict[str, FlankRelief | None]:
        return {
            f"{role}.{side}_flank": getattr(getattr(self, role), f"{side}_flank")
            for role in ("pinion", "gear")
            for side in ("drive", "coast")
        }

    def correction(self, role: str, side: str) -> FlankCorrection:
        """Return what is taken off the "drive" or "coast" flank of a member, in SI units."""
        found = self._reliefs[f"{role}.{side}_flank"]
        if found is None:
            return NO_CORRECTION
        edges = [
            EdgeRelief(edge=edge, amount=um * 1e-6, extent=mm * MILLIMETRE)
            for edge, (amount, extent) in zip(EDGES, RELIEFS, strict=True)
            if (um := getattr(found, amount)) > 0.0 and (mm := getattr(found, extent)) is not None
        ]
        for edge in EDGES:
            radius = found.end_edge_radius_mm if edge in ("toe", "heel") else 0.0
            radius = found.tip_edge_radius_mm if edge == "tip" else radius
            if radius > 0.0:
                edges.append(rounding(edge, radius * MILLIMETRE))
        return FlankCorrection(
            reliefs=tuple(edges),
            profile_crown=found.profile_crown_um * 1e-6,
            lead_crown=found.lead_crown_um * 1e-6,
            twist=found.twist_um * 1e-6,
            surface=tuple(value * 1e-6 for value in found.surface_um),
            worn=tuple(value * 1e-6 for value in found.worn_um),
        )

    def origin(self, field: str) -> Origin:
        """Return where the value of a dotted field, e.g. "gear.cutter.blade_groups", is from."""
        if field in self.completed:
            return "completed"
        return "inferred" if field in self.inferred else "table"

    def blank(self) -> HypoidBlank:
        """Return the blank of the pair, in SI units."""
        clearance = self.pair.clearance_mm
        return HypoidBlank(
            pinion=_member_blank(self.pinion),
            gear=_member_blank(self.gear),
            offset=self.pair.offset_mm * MILLIMETRE,
            clearance=None if clearance is None else clearance * MILLIMETRE,
            name=self.name,
            source=self.source,
        )


def _member_blank(member: Member) -> MemberBlank:
    return MemberBlank(
        teeth=member.teeth,
        face_width=member.face_width_mm * MILLIMETRE,
        outer_cone_distance=member.outer_cone_distance_mm * MILLIMETRE,
        pitch_angle=member.pitch_angle_deg * DEGREE,
        spiral_angle=member.spiral_angle_deg * DEGREE,
        pitch_apex=member.pitch_apex_mm * MILLIMETRE,
        face_apex=member.face_apex_mm * MILLIMETRE,
    )
