"""The sections of a measured-gear file: every field's unit, meaning and range, stated once."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlube_core.hypoid_geometry.measured.deviation_grid import MOST_POINTS
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import Section

Points = Annotated[int, Field(ge=2, le=MOST_POINTS)]
Inset = Annotated[float, Field(ge=0.0, le=200.0, allow_inf_nan=False), Usual(0.05, 20.0)]
Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(5.0, 500.0)]
Eccentricity = Annotated[float, Field(ge=0.0, le=500.0, allow_inf_nan=False), Usual(0.5, 200.0)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]


class Grid(Section):
    """The grid of measured points on one member's flanks: even rows and columns."""

    rows: Points = Field(5, description="Number of rows from root to tip")
    columns: Points = Field(9, description="Number of columns from toe to heel")
    root_inset_mm: Inset = Field(
        description="Tooth height between the root line (the edge of the root cone) and the "
        "first row"
    )
    tip_inset_mm: Inset = Field(description="Tooth height between the last row and the tip edge")
    toe_inset_mm: Inset = Field(
        description="Distance of the first column from the toe, along the pitch cone"
    )
    heel_inset_mm: Inset = Field(
        description="Distance of the last column from the heel, along the pitch cone"
    )


class MeasuredMember(Section):
    """What was measured of one member."""

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
