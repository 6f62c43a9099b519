"""The sections of a case file for the film, its domain, grid and solver."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.storage.file_names import Name

Text = Annotated[str, Field(min_length=1)]
Heat = Literal["isothermal", "thermal"]
Wedge = Literal["upwind-1", "upwind-2", "central", "quick"]
Place = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.0, 50.0)]
Reach = Annotated[float, Field(ge=1.05, le=1000.0, allow_inf_nan=False)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-2, allow_inf_nan=False)]
LineNodes = Annotated[int, Field(ge=17, le=20001)]
PointNodes = Annotated[int, Field(ge=17, le=2049)]
Steps = Annotated[int, Field(ge=1, le=1000)]


class FilmCase(InputFile):
    """A lubricated contact with its name; shipped cases lie in gearlube_core/ehl/case/data."""

    package: ClassVar[str] = "gearlube_core.ehl.case"

    name: Name = Field(description="Name of the case in reports and figures")
    source: Text = Field(description="Where the numbers come from")


@contextmanager
def refused(head: str = "") -> Iterator[None]:
    """Turn a ParameterError into the ValueError that pydantic expects of a validator.

    `head` begins the message.
    """
    try:
        yield
    except ParameterError as reason:
        raise ValueError(f"{head}{str(reason).removesuffix('.')}") from None


class LineDomain(Section):
    """Where the film is computed."""

    first_mm: Place = Field(description="Smallest x at which the film is computed")
    last_mm: Place = Field(description="Largest x at which the film is computed")


class LineSolver(Section):
    """How a line contact is solved."""

    nodes: LineNodes = Field(default=1001, description="Number of nodes of the finest grid")
    stencil: Literal["upwind-2", "central", "upwind-1", "galerkin"] = Field(
        default="upwind-2",
        description="Difference formula for the wedge term of Reynolds' equation; galerkin: "
        "finite elements",
    )
    cavitation: Literal["reynolds", "mass_conserving"] = Field(
        default="reynolds",
        description="How the film breaks. reynolds: pressure and its slope are zero there; "
        "mass_conserving: the oil in the broken film is computed too",
    )
    tolerance: Tolerance = Field(
        default=1e-8,
        description="The solution is accepted when the relative errors of flow and load are "
        "below this",
    )
    max_iterations: Steps = Field(
        default=40, description="Largest number of Newton steps on each grid"
    )


class PointDomain(Section):
    """How far the film is computed, in semi-axes of the dry contact along the same axis."""

    inlet: Reach | None = Field(
        default=None,
        description="Distance upstream, in semi-axes of the dry contact; left out: as far as "
        "load and film need",
    )
    outlet: Reach | None = Field(
        default=None,
        description="Distance downstream, in semi-axes of the dry contact; left out: as far as "
        "load and film need",
    )
    side: Reach | None = Field(
        default=None,
        description="Distance to each side, in semi-axes of the dry contact; left out: as far "
        "as load and film need",
    )
    oil_beyond: bool | None = Field(
        default=None,
        description="true: there is oil beyond the domain too; false: ambient pressure on the "
        "border; left out: true on the default domain if the oil beyond carries more than 0.2 % "
        "of the load",
    )


class PointSolver(Section):
    """How a point contact is solved."""

    nodes_x: PointNodes = Field(default=129, description="Number of nodes along x, with the border")
    nodes_y: PointNodes = Field(
        default=129,
        description="Number of nodes along y, with the border; rows of a part of a line "
        "contact: an even number from 16 on",
    )
    wedge: Wedge = Field(
        default="upwind-2",
        description="Difference formula for the wedge term of Reynolds' equation",
    )
    discretisation: Literal["differences", "elements"] = Field(
        default="differences",
        description="differences: finite volumes; elements: Galerkin finite elements, with "
        "upwinding where pressure hardly moves the oil",
    )
    cavitation: Literal["reynolds", "mass_conserving"] = Field(
        default="reynolds",
        description="How the film breaks. reynolds: pressure and its slope are zero there; "
        "mass_conserving: the oil in the broken film is computed too",
    )
    tolerance: Tolerance = Field(
        default=1e-6,
        description="The solution is accepted when the relative error of the flow balance is "
        "below this",
    )
    load_tolerance: Tolerance = Field(
        default=1e-6,
        description="The solution is accepted when the relative error of the load is below this",
    )
    newton_steps: Steps = Field(
        default=60, description="Largest number of Newton steps on each grid"
    )
