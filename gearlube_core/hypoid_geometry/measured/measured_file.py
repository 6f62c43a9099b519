"""The measured-gear file: which gears were measured, in which layout, and the CSV files."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.flank import Role, Side, tooth_region
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import GridPlaces
from gearlube_core.hypoid_geometry.measured.measured_sections import MeasuredMember
from gearlube_core.hypoid_geometry.measured.tooth_error_files import (
    PitchKind,
    read_pitch,
    read_waves,
)
from gearlube_core.hypoid_geometry.measured.tooth_errors import MemberErrors, ToothErrors, Wave
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.storage.file_names import Name
from gearlube_core.units import DEGREE, MILLIMETRE

Text = Annotated[str, Field(min_length=1)]


class MeasuredFile(InputFile):
    """Measured-gear file: flanks, pitch and waves of a hypoid pair from a measuring machine.

    Examples
    --------
    >>> MeasuredFile.from_toml("axle_17.toml").degree  # doctest: +SKIP
    3
    """

    package: ClassVar[str] = "gearlube_core.hypoid_geometry"
    title: ClassVar[str] = "measured-gear file"
    prefix: ClassVar[str] = "measured_"
    files: ClassVar[tuple[str, ...]] = (
        "gear_file",
        "deviations",
        "nominal_points",
        "pitch",
        "waviness",
    )

    name: Name = Field(description="Name of the measured pair in reports and figures")
    source: Text = Field(description="Who measured what; say so if the data are made up")
    gear_file: Text = Field(
        description="Gear file of the nominal flanks, or the name of a shipped one; its path is "
        "relative to this file"
    )
    deviations: Text | None = Field(
        None,
        description="CSV file of deviations normal to the flank; its path is relative to this file",
    )
    nominal_points: Text | None = Field(
        None,
        description="CSV file with the nominal points of the grids, its path relative to this "
        "file; they are checked against the flanks, and the grid sections can then be left out",
    )
    middle_point: Literal["zero", "measured"] = Field(
        "zero",
        description="Whether the member was turned so that the deviation at the middle point of "
        "each grid is zero",
    )
    degree: int = Field(
        3, ge=0, le=5, description="Degree of the polynomial surface that smooths the deviations"
    )
    pitch: Text | None = Field(
        None, description="CSV file of pitch deviations; its path is relative to this file"
    )
    pitch_kind: PitchKind = Field(
        "cumulative", description="Kind of the pitch deviations: cumulative or single"
    )
    waviness: Text | None = Field(
        None, description="CSV file of waves; its path is relative to this file"
    )
    pinion: MeasuredMember = Field(default_factory=MeasuredMember.model_construct)
    gear: MeasuredMember = Field(default_factory=MeasuredMember.model_construct)

    def nominal(self) -> HypoidGearFile:
        """Return the gear file of the nominal flanks."""
        return HypoidGearFile.given(self.gear_file)

    def places(self, blank: HypoidBlank) -> dict[tuple[Role, Side], GridPlaces]:
        """Return where the grid points of each described grid lie on its flanks."""
        found: dict[tuple[Role, Side], GridPlaces] = {}
        members: tuple[tuple[Role, MeasuredMember], ...] = (
            ("pinion", self.pinion),
            ("gear", self.gear),
        )
        for role, member in members:
            if member.grid is None:
                continue
            region = tooth_region(blank, role)
            try:
                places = GridPlaces.inset(
                    member.grid.rows,
                    member.grid.columns,
                    height=region.whole_height,
                    width=region.face_width,
                    root=member.grid.root_inset_mm * MILLIMETRE,
                    tip=member.grid.tip_inset_mm * MILLIMETRE,
                    toe=member.grid.toe_inset_mm * MILLIMETRE,
                    heel=member.grid.heel_inset_mm * MILLIMETRE,
                )
            except ParameterError as reason:
                raise ParameterError(f"{self.name}, {role}: {reason}") from None
            found[role, "drive"] = found[role, "coast"] = places
        return found

    def tooth_errors(self, blank: HypoidBlank) -> ToothErrors:
        """Return the errors of single teeth."""
        members = {"pinion": (self.pinion, blank.pinion), "gear": (self.gear, blank.gear)}
        pitch: dict[tuple[Role, Side], Array] = {}
        waves: dict[tuple[Role, Side], tuple[Wave, ...]] = {}
        if self.pitch is not None:
            teeth: dict[Role, int] = {"pinion": blank.pinion.teeth, "gear": blank.gear.teeth}
            pitch = read_pitch(self.pitch, teeth, self.pitch_kind)
        if self.waviness is not None:
            waves = read_waves(self.waviness)
        found = {}
        for role, (member, part) in members.items():
            radius = part.mean_pitch_radius
            if member.pitch_radius_mm is not None:
                radius = member.pitch_radius_mm * MILLIMETRE
            found[role] = MemberErrors(
                pitch={side: one / radius for (whose, side), one in pitch.items() if whose == role},
                eccentricity=1e-6 * member.eccentricity_um,
                eccentricity_angle=DEGREE * member.eccentricity_phase_deg,
                wobble=1e-6 * member.wobble_um / part.mean_pitch_radius,
                wobble_angle=DEGREE * member.wobble_phase_deg,
                waves={side: one for (whose, side), one in waves.items() if whose == role},
            )
        return ToothErrors(pinion=found["pinion"], gear=found["gear"])
