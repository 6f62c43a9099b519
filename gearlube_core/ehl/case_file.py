"""Case files of lubricated line and point contacts, in engineers' units."""

from __future__ import annotations

import tomllib
from importlib.resources import files
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlube_core.ehl.case_sections import Body, Modulus, Oil
from gearlube_core.ehl.line_problem import LineProblem, LineSettings
from gearlube_core.ehl.problem import PointContactProblem, elliptical_contact
from gearlube_core.ehl.settings import PointSolverSettings
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.materials.solid import Solid, reduced_modulus
from gearlube_core.units import MILLIMETRE

_GIGA = 1e9

Text = Annotated[str, Field(min_length=1)]
Radius = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False)]
Speed = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False)]
LineLoad = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False)]
Load = Annotated[float, Field(gt=0.0, le=1e8, allow_inf_nan=False)]
Place = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False)]
Reach = Annotated[float, Field(ge=1.05, le=1000.0, allow_inf_nan=False)]
Fill = Annotated[float, Field(gt=0.0, le=1.0, allow_inf_nan=False)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-2, allow_inf_nan=False)]
LineNodes = Annotated[int, Field(ge=17, le=20001)]
PointNodes = Annotated[int, Field(ge=17, le=2049)]
Steps = Annotated[int, Field(ge=1, le=1000)]


class EhlCase(InputFile):
    """What line and point contacts share: names, speeds along x, solids, oil."""

    package: ClassVar[str] = "gearlube_core.ehl"
    kind: ClassVar[str]  # "line" or "point": first word of the shipped files' names

    name: Text = Field(description="What reports and plots call the case")
    source: Text = Field(description="Where the numbers are from")
    speed_1_m_s: Speed = Field(description="Surface speed of body 1, below, along x [m/s]")
    speed_2_m_s: Speed = Field(description="Surface speed of body 2, above, along x [m/s]")
    reduced_modulus_gpa: Modulus | None = Field(
        default=None,
        description="E' = 2 E* [GPa]; left out, that of body_1 and body_2",
    )
    oil: Oil
    body_1: Body = Body()
    body_2: Body = Body()

    @classmethod
    def shipped(cls) -> tuple[str, ...]:
        """Return the names of the cases of this kind that ship with the package."""
        prefix = f"{cls.kind}_"
        return tuple(
            one.removeprefix(prefix) for one in super().shipped() if one.startswith(prefix)
        )

    @classmethod
    def shipped_text(cls, name: str) -> str:
        """Return the file of a shipped case as it is."""
        if name not in cls.shipped():
            raise ParameterError(
                f"No {cls.kind} contact is called {name!r}. Shipped: {', '.join(cls.shipped())}. "
                "A file's name ends in .toml."
            )
        resource = files(cls.package) / "data" / f"{cls.kind}_{name}.toml"
        return resource.read_text(encoding="utf-8")

    @classmethod
    def named(cls, name: str) -> Self:
        """Return a case that ships with the package, by its name."""
        return cls.from_data(tomllib.loads(cls.shipped_text(name)), name)

    @property
    def modulus(self) -> float:
        """E' = 2 E* [Pa]."""
        if self.reduced_modulus_gpa is not None:
            return self.reduced_modulus_gpa * _GIGA
        return reduced_modulus(*self.solids)

    @property
    def solids(self) -> tuple[Solid, Solid]:
        """Body 1 and body 2, in SI units."""
        return self.body_1.solid(), self.body_2.solid()

    def moved(self, entrainment: float | None, slide_roll: float | None) -> Self:
        """Return the case with another mean speed along x or slide-roll ratio.

        Parameters
        ----------
        entrainment
            (u1 + u2)/2 [m/s]; None keeps it.
        slide_roll
            2 (u1 - u2)/(u1 + u2) [1]; None keeps it.

        Raises
        ------
        ParameterError
            When the speeds leave their range, or the case has no mean speed to keep a ratio to.
        """
        if entrainment is None and slide_roll is None:
            return self
        mean = 0.5 * (self.speed_1_m_s + self.speed_2_m_s)
        if mean == 0.0:
            raise ParameterError(
                f"{self.name} has a mean speed of 0 m/s along x, so no slide-roll ratio. "
                "Give both speeds in the case file."
            )
        ratio = (self.speed_1_m_s - self.speed_2_m_s) / mean if slide_roll is None else slide_roll
        u = mean if entrainment is None else entrainment
        speeds = {"speed_1_m_s": u * (1.0 + 0.5 * ratio), "speed_2_m_s": u * (1.0 - 0.5 * ratio)}
        return self.varied(speeds)


class LineDomain(Section):
    """Where the film is computed."""

    first_mm: Place = Field(description="First x [mm]")
    last_mm: Place = Field(description="Last x [mm]")


class LineSolver(Section):
    """How a line contact is solved."""

    nodes: LineNodes = Field(default=1001, description="Of the finest grid")
    stencil: Literal["upwind_2", "central", "upwind_1", "galerkin"] = Field(
        default="upwind_2", description="Of the wedge, or the finite elements of Jamali 2015"
    )
    cavitation: Literal["reynolds", "mass_conserving"] = Field(
        default="reynolds", description="Where the film breaks"
    )
    tolerance: Tolerance = Field(default=1e-8, description="Unbalanced flow and load [1]")
    max_iterations: Steps = Field(default=40, description="Newton steps on each grid")


class LineCase(EhlCase):
    """A lubricated line contact."""

    kind: ClassVar[str] = "line"

    radius_mm: Radius = Field(description="Relative radius of curvature along x [mm]")
    load_n_per_mm: LineLoad = Field(description="Load per length of the line [N/mm]")
    inlet_fill: Fill = Field(
        default=1.0, description="Share of the inlet gap that holds oil; 1: flooded"
    )
    temperature: Literal["isothermal", "thermal"] = Field(
        default="isothermal", description="thermal: with the energy balance of oil and bodies"
    )
    domain: LineDomain | None = None
    solver: LineSolver = LineSolver()

    @model_validator(mode="after")
    def _hangs_together(self) -> LineCase:
        _in_si(self.problem, self.settings)
        return self

    def problem(self) -> LineProblem:
        """Return the contact, in SI units."""
        d = self.domain
        return LineProblem(
            lubricant=self.oil.ehl_lubricant(),
            radius=self.radius_mm * MILLIMETRE,
            line_load=self.load_n_per_mm / MILLIMETRE,
            reduced_modulus=self.modulus,
            speed_1=self.speed_1_m_s,
            speed_2=self.speed_2_m_s,
            domain=None if d is None else (d.first_mm * MILLIMETRE, d.last_mm * MILLIMETRE),
            inlet_fill=self.inlet_fill,
        )

    def settings(self) -> LineSettings:
        """Return how it is solved."""
        return LineSettings(**self.solver.model_dump())


class PointDomain(Section):
    """How far the film is computed, in semi-axes of the dry contact along the same axis."""

    inlet: Reach | None = Field(default=None, description="Upstream [semi-axes]")
    outlet: Reach | None = Field(default=None, description="Downstream [semi-axes]")
    side: Reach | None = Field(default=None, description="To the sides [semi-axes]")


class PointSolver(Section):
    """How a point contact is solved."""

    nodes_x: PointNodes = Field(default=129, description="Along x, border included")
    nodes_y: PointNodes = Field(default=129, description="Along y, border included")
    wedge: Literal["upwind-1", "upwind-2", "central", "quick"] = Field(
        default="upwind-2", description="Stencil of the wedge"
    )
    tolerance: Tolerance = Field(default=1e-6, description="Unbalanced flow [1]")
    load_tolerance: Tolerance = Field(default=1e-6, description="Error of the load [1]")
    newton_steps: Steps = Field(default=60, description="Most Newton steps on each grid")


class PointCase(EhlCase):
    """A lubricated point contact with smooth solids."""

    kind: ClassVar[str] = "point"

    radius_x_mm: Radius = Field(description="Relative radius of curvature along x [mm]")
    radius_y_mm: Radius = Field(description="Relative radius of curvature along y [mm]")
    load_n: Load = Field(description="Load [N]")
    side_speed_1_m_s: Speed = Field(default=0.0, description="Of body 1 along y [m/s]")
    side_speed_2_m_s: Speed = Field(default=0.0, description="Of body 2 along y [m/s]")
    domain: PointDomain = PointDomain()
    solver: PointSolver = PointSolver()

    @model_validator(mode="after")
    def _hangs_together(self) -> PointCase:
        _in_si(self.problem, self.settings)
        return self

    @property
    def entrainment(self) -> tuple[float, float]:
        """Mean surface velocity along x and y [m/s]."""
        return (
            0.5 * (self.speed_1_m_s + self.speed_2_m_s),
            0.5 * (self.side_speed_1_m_s + self.side_speed_2_m_s),
        )

    @property
    def sliding(self) -> tuple[float, float]:
        """Velocity of body 2 against body 1 along x and y [m/s]."""
        return (
            self.speed_2_m_s - self.speed_1_m_s,
            self.side_speed_2_m_s - self.side_speed_1_m_s,
        )

    def problem(self) -> PointContactProblem:
        """Return the contact, in SI units."""
        return elliptical_contact(
            R_x=self.radius_x_mm * MILLIMETRE,
            R_y=self.radius_y_mm * MILLIMETRE,
            entrainment=self.entrainment,
            load=self.load_n,
            contact_modulus=0.5 * self.modulus,
            lubricant=self.oil.ehl_lubricant(),
            nodes=(self.solver.nodes_x, self.solver.nodes_y),
            inlet=self.domain.inlet,
            outlet=self.domain.outlet,
            side=self.domain.side,
        )

    def settings(self) -> PointSolverSettings:
        """Return how it is solved."""
        return PointSolverSettings(**self.solver.model_dump(exclude={"nodes_x", "nodes_y"}))


def _in_si(*builders: Any) -> None:
    """Refuse what no field can see alone, as pydantic wants it refused."""
    try:
        for build in builders:
            build()
    except ParameterError as reason:
        raise ValueError(f"In SI units: {str(reason).removesuffix('.')}") from None
