"""The sections of a measured-gear file: every field's unit, meaning and range, stated once."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlube_core.hypoid_geometry.measured.deviation_grid import MOST_POINTS
from gearlube_core.input_file.input_file import Section

Points = Annotated[int, Field(ge=2, le=MOST_POINTS)]
Inset = Annotated[float, Field(ge=0.0, le=200.0, allow_inf_nan=False)]


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

    grid: Grid | None = None
