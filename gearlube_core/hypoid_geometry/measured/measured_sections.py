"""The sections of a measured-gear file: every field's unit, meaning and range, stated once."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlube_core.hypoid_geometry.measured.deviation_grid import MOST_POINTS
from gearlube_core.input_file.input_file import Section

Points = Annotated[int, Field(ge=2, le=MOST_POINTS)]
Inset = Annotated[float, Field(ge=0.0, le=200.0, allow_inf_nan=False)]
Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False)]
Eccentricity = Annotated[float, Field(ge=0.0, le=500.0, allow_inf_nan=False)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]


class Grid(Section):
    """The grid of measured points on one member's flanks: even rows and columns."""

    rows: Points = Field(5, description="From root to tip")
    columns: Points = Field(9, description="From toe to heel")
    root_inset_mm: Inset = Field(
        description="First row from the root line, the edge of the root cone: tooth height"
    )
    tip_inset_mm: Inset = Field(description="Last row from the tip edge: tooth height")
    toe_inset_mm: Inset = Field(description="First column from the toe, along the pitch cone")
    heel_inset_mm: Inset = Field(description="Last column from the heel, along the pitch cone")


class MeasuredMember(Section):
    """What was measured of one member."""

    pitch_radius_mm: Length | None = Field(
        None,
        description="Radius at which pitch was measured, from the axis; absent: that of the pitch "
        "cone at mid-face",
    )
    eccentricity_um: Eccentricity = Field(
        0.0, description="Of the teeth from the axis about which the member runs, in the axle"
    )
    eccentricity_phase_deg: Angle = Field(
        0.0, description="Its direction: angle from tooth 1 in the sense of counting"
    )
    wobble_um: Eccentricity = Field(
        0.0,
        description="Axial rise of the teeth over a turn from their mean, at the pitch radius: "
        "half of the axial runout, peak to peak",
    )
    wobble_phase_deg: Angle = Field(
        0.0,
        description="Where the teeth stand farthest from the crossing point, counted likewise",
    )
    grid: Grid | None = None
