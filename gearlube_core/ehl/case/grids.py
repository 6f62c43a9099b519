"""The sections of a case file for the domain, the grid and the solver."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlube_core.ehl.case.film_case import Wedge
from gearlube_core.input_file.input_file import Section

Place = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False)]
Reach = Annotated[float, Field(ge=1.05, le=1000.0, allow_inf_nan=False)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-2, allow_inf_nan=False)]
LineNodes = Annotated[int, Field(ge=17, le=20001)]
PointNodes = Annotated[int, Field(ge=17, le=2049)]
Steps = Annotated[int, Field(ge=1, le=1000)]


class LineDomain(Section):
    """Where the film is computed."""

    first_mm: Place = Field(description="First x")
    last_mm: Place = Field(description="Last x")


class LineSolver(Section):
    """How a line contact is solved."""

    nodes: LineNodes = Field(default=1001, description="Of the finest grid")
    stencil: Literal["upwind-2", "central", "upwind-1", "galerkin"] = Field(
        default="upwind-2", description="Of the wedge, or galerkin: finite elements"
    )
    cavitation: Literal["reynolds", "mass_conserving"] = Field(
        default="reynolds", description="Where the film breaks"
    )
    tolerance: Tolerance = Field(default=1e-8, description="Unbalanced flow and load")
    max_iterations: Steps = Field(default=40, description="Newton steps on each grid")


class PointDomain(Section):
    """How far the film is computed, in semi-axes of the dry contact along the same axis."""

    inlet: Reach | None = Field(
        default=None, description="Upstream, in semi-axes of the dry contact"
    )
    outlet: Reach | None = Field(default=None, description="Downstream, in semi-axes")
    side: Reach | None = Field(default=None, description="To the sides, in semi-axes")
    oil_beyond: bool | None = Field(
        default=None,
        description="Oil goes on beyond the domain; false: ambient pressure on its border; left "
        "out: on the default domain where it carries more than 2.5 % of the load",
    )


class PointSolver(Section):
    """How a point contact is solved."""

    nodes_x: PointNodes = Field(default=129, description="Along x, border included")
    nodes_y: PointNodes = Field(default=129, description="Along y, border included")
    wedge: Wedge = Field(default="upwind-2", description="Stencil of the wedge")
    discretisation: Literal["differences", "elements"] = Field(
        default="differences",
        description="Differences of finite volumes, or finite elements: Galerkin's, upwinded where "
        "pressure hardly flows",
    )
    cavitation: Literal["reynolds", "mass_conserving"] = Field(
        default="reynolds", description="Where the film breaks"
    )
    tolerance: Tolerance = Field(default=1e-6, description="Unbalanced flow")
    load_tolerance: Tolerance = Field(default=1e-6, description="Error of the load")
    newton_steps: Steps = Field(default=60, description="Most Newton steps on each grid")
