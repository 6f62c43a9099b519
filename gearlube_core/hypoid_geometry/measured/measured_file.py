"""The measured-gear file: which gears were measured, in which layout, and the CSV files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.flank import Role, Side, tooth_region
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import (
    MOST_POINTS,
    GridPlaces,
    role_of,
    side_of,
)
from gearlube_core.hypoid_geometry.measured.tooth_errors import MemberErrors, ToothErrors, Wave
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.input_file.table import read_table
from gearlube_core.storage.file_names import Name
from gearlube_core.units import DEGREE, MILLIMETRE

PITCH_COLUMNS = ("member", "flank", "tooth", "deviation_um")

WAVE_COLUMNS = ("member", "flank", "waves", "amplitude_um", "phase_deg")

_PitchKind = Literal["cumulative", "single"]
_MOST = 500.0  # um
_LEAST = 0.1  # um, largest deviation of a flank that can be meant
_CLOSED = 2.0  # um, sum of single deviations over a turn
_NAMED = 5  # missing teeth in an error

Points = Annotated[int, Field(ge=2, le=MOST_POINTS)]

_Inset = Annotated[float, Field(ge=0.0, le=200.0, allow_inf_nan=False), Usual(0.05, 20.0)]

Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(5.0, 500.0)]

Eccentricity = Annotated[float, Field(ge=0.0, le=500.0, allow_inf_nan=False), Usual(0.5, 200.0)]

Angle = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]


class Grid(Section):
    """The grid of measured points on one member's flanks: even rows and columns."""

    rows: Points = Field(5, description="Number of rows from root to tip")
    columns: Points = Field(9, description="Number of columns from toe to heel")
    root_inset_mm: _Inset = Field(
        description="Tooth height between the root line (the edge of the root cone) and the "
        "first row"
    )
    tip_inset_mm: _Inset = Field(description="Tooth height between the last row and the tip edge")
    toe_inset_mm: _Inset = Field(
        description="Distance of the first column from the toe, along the pitch cone"
    )
    heel_inset_mm: _Inset = Field(
        description="Distance of the last column from the heel, along the pitch cone"
    )


class _MeasuredMember(Section):
    """Measurements of one member."""

    pitch_radius_mm: Length | None = Field(
        None,
        description="Distance from the axis at which the pitch was measured; left out: that of "
        "the pitch cone at mid-face",
    )
    eccentricity_um: Eccentricity = Field(
        0.0,
        description="Eccentricity of the teeth: distance of their axis from the axis about "
        "which the member runs in the axle",
    )
    eccentricity_phase_deg: Angle = Field(
        0.0,
        description="Direction of the eccentricity: angle from tooth 1 in the sense in which "
        "teeth are counted",
    )
    wobble_um: Eccentricity = Field(
        0.0,
        description="Wobble: how far the teeth move axially from their mean over a turn, at the "
        "pitch radius; half of the peak-to-peak axial runout",
    )
    wobble_phase_deg: Angle = Field(
        0.0,
        description="Direction in which the teeth are farthest from the crossing point, counted "
        "in the same way",
    )
    grid: Grid | None = None


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
    pitch_kind: _PitchKind = Field(
        "cumulative", description="Kind of the pitch deviations: cumulative or single"
    )
    waviness: Text | None = Field(
        None, description="CSV file of waves; its path is relative to this file"
    )
    pinion: _MeasuredMember = Field(default_factory=_MeasuredMember.model_construct)
    gear: _MeasuredMember = Field(default_factory=_MeasuredMember.model_construct)

    def nominal(self) -> HypoidGearFile:
        """Return the gear file of the nominal flanks."""
        return HypoidGearFile.given(self.gear_file)

    def places(self, blank: HypoidBlank) -> dict[tuple[Role, Side], GridPlaces]:
        """Return where the grid points of each described grid lie on its flanks."""
        found: dict[tuple[Role, Side], GridPlaces] = {}
        members: tuple[tuple[Role, _MeasuredMember], ...] = (
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


def read_pitch(
    path: str | Path, teeth: Mapping[Role, int], kind: _PitchKind
) -> dict[tuple[Role, Side], Array]:
    """Return the cumulative pitch deviations of each flank in the file [m], (z,).

    Parameters
    ----------
    path
        CSV file with the columns of `PITCH_COLUMNS`; one line for each tooth of a flank.
    teeth : mapping of role to int
    kind
        "cumulative": how far the flank of a tooth lies further on in the sense of counting than it
        should, along the pitch circle. "single": the change of that from the tooth before, tooth 1
        from the last.

    Raises
    ------
    ParameterError
        A tooth is missing or given twice, a number is out of range or in another unit, or single
        deviations do not sum to zero.
    """
    values: dict[tuple[Role, Side], Array] = {}
    for row in read_table(path, PITCH_COLUMNS):
        role = role_of(row)
        side = side_of(row, role)
        tooth = row.whole("tooth", 1, teeth[role]) - 1
        found = values.setdefault((role, side), np.full(teeth[role], np.nan))
        if np.isfinite(found[tooth]):
            raise ParameterError(
                f"{row.where}: tooth {tooth + 1} of the {role}, {side} flank, occurs twice. Keep "
                "one, or check the flank."
            )
        found[tooth] = row.number("deviation_um", -_MOST, _MOST, "um")
    result = {}
    for (role, side), found in sorted(values.items()):
        where = f"{path}: {role}, {side} flank"
        missing = (np.flatnonzero(np.isnan(found)) + 1).tolist()
        if missing:
            more = f" and {len(missing) - _NAMED} more" if len(missing) > _NAMED else ""
            raise ParameterError(
                f"{where}: all {teeth[role]} teeth must be in the file, but these are missing: "
                f"{', '.join(map(str, missing[:_NAMED]))}{more}."
            )
        largest = float(np.max(np.abs(found)))
        if 0.0 < largest < _LEAST:
            raise ParameterError(
                f"{where}: the largest deviation must be 0 or at least {_LEAST:g} um, got "
                f"{largest:g} um. Is it in mm? {largest:g} mm is {1e3 * largest:g} um."
            )
        if kind == "single":
            rest = float(found.sum())
            if abs(rest) > _CLOSED:
                raise ParameterError(
                    f"{where}: single pitch deviations must sum to 0 within {_CLOSED:g} um over "
                    f"the turn, got {rest:.3g} um. Are they cumulative? Set pitch_kind = "
                    '"cumulative".'
                )
            found = np.cumsum(found - rest / found.size)
        result[role, side] = 1e-6 * (found - found.mean())
    return result


def read_waves(path: str | Path) -> dict[tuple[Role, Side], tuple[Wave, ...]]:
    """Return the waves of each flank in a CSV file with the columns of `WAVE_COLUMNS`.

    Raises
    ------
    ParameterError
        A number is out of range, or a number of waves is given twice.
    """
    values: dict[tuple[Role, Side], dict[int, Wave]] = {}
    for row in read_table(path, WAVE_COLUMNS):
        role = role_of(row)
        side = side_of(row, role)
        count = row.whole("waves", 1, 10_000)
        wave = Wave(
            count,
            1e-6 * row.number("amplitude_um", 0.0, 50.0, "um", "Half of peak to peak."),
            DEGREE * row.number("phase_deg", -360.0, 360.0, "deg"),
        )
        found = values.setdefault((role, side), {})
        if count in found:
            raise ParameterError(
                f"{row.where}: {count} waves of the {role}'s {side} flank occur twice. Add them up."
            )
        found[count] = wave
    return {key: tuple(waves.values()) for key, waves in sorted(values.items())}
