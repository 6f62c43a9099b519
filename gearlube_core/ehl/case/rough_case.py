"""Case files of rough line contacts, whose roughness varies along the contact as well."""

from __future__ import annotations

import hashlib
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, field_validator, model_validator

from gearlube_core.ehl.case.contact_case import ContactCase, LineLoad, PartLength, Radius
from gearlube_core.ehl.case.sections import Steps, Tolerance, Wedge, refused
from gearlube_core.ehl.case.surfaces import RoughSurface
from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import FEWEST_ROWS, MOST_ROWS, PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.history import check_scheme
from gearlube_core.ehl.transient.problem import MovingFilm, moving_section
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import Section
from gearlube_core.surface.moving import FedFromInlet, GrownInPlace, MovingRoughness, MovingSurface
from gearlube_core.surface.schedule import RoughSchedule
from gearlube_core.units import MILLIMETRE

_MICRO, _GIGA = 1e-6, 1e9
_HIGHEST = 10e9  # Pa, more than steel carries

HalfWidths = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False)]
Growth = Annotated[float, Field(ge=1e-3, le=100.0, allow_inf_nan=False)]
StepCount = Annotated[int, Field(ge=1, le=1_000_000)]
Moment = Annotated[int, Field(ge=0, le=1_000_000)]
Columns = Annotated[int, Field(ge=17, le=2049)]
Rows = Annotated[int, Field(ge=FEWEST_ROWS, le=MOST_ROWS)]
Reach = Annotated[float, Field(ge=1.05, le=100.0, allow_inf_nan=False)]
Layer = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False), Usual(0.0001, 0.2)]
Pressure = Annotated[float, Field(ge=1e-3, le=1000.0, allow_inf_nan=False), Usual(0.05, 50.0)]
Friction = Annotated[float, Field(ge=0.0, le=2.0, allow_inf_nan=False)]


class RoughTimes(Section):
    """Time steps of a contact that becomes rough, in half widths a of the dry contact."""

    steps_per_half_width: StepCount = Field(
        default=400,
        description="Number of time steps in which the faster surface moves by the half width a "
        "of the dry contact",
    )
    until_rough: HalfWidths = Field(
        default=5.0,
        description="Distance that the slower surface moves until the whole contact is rough, "
        "in half widths a",
    )
    rough: HalfWidths = Field(
        default=4.0,
        description="Distance that the faster surface moves after that, in half widths a",
    )
    feed: Literal["inlet", "in_place"] = Field(
        default="inlet",
        description="inlet: each surface carries its roughness in from the inlet; in_place: "
        "roughness grows everywhere at once until the whole contact is rough",
    )
    growth: Growth = Field(
        default=1.0,
        description="With feed = inlet: length over which the roughness grows from zero to its "
        "full height, in half widths a",
    )


class RoughSolids(Section):
    """Layer that carries load where the film vanishes."""

    thickness_um: Layer = Field(
        default=0.01,
        description="Thickness of a thin layer, on both solids together, that carries load "
        "where the film is thinner than it; 0: the oil carries all load",
    )
    pressure_gpa: Pressure = Field(
        default=1.0, description="Pressure at which this layer is pressed to half its thickness"
    )
    friction: Friction = Field(
        default=0.1, description="Friction coefficient where the solids touch"
    )


class RoughDomain(Section):
    """How far the film is computed, in half widths of the dry contact."""

    inlet: Reach = Field(
        default=2.5, description="Distance upstream, in half widths of the dry contact"
    )
    outlet: Reach = Field(
        default=1.5, description="Distance downstream, in half widths of the dry contact"
    )


class RoughSolver(Section):
    """How the film is solved."""

    nodes_x: Columns = Field(default=401, description="Number of nodes along x, with the border")
    rows: Rows = Field(default=64, description="Number of rows along y, an even number from 16 on")
    wedge: Wedge = "quick"
    discretisation: Literal["differences", "elements"] = Field(
        default="differences",
        description="differences: finite volumes; elements: Galerkin finite elements, with "
        "upwinding where pressure hardly moves the oil, `wedge` does not matter then",
    )
    scheme: Literal["bdf2", "crank_nicolson"] = Field(
        default="bdf2",
        description="Formula for the change of oil mass over time; crank_nicolson has a quarter "
        "of the error of bdf2",
    )
    tolerance: Tolerance = Field(
        default=1e-4,
        description="A time step is accepted when the relative error of the flow balance is "
        "below this",
    )
    load_tolerance: Tolerance = Field(
        default=1e-4,
        description="A time step is accepted when the relative error of the load is below this",
    )
    newton_steps: Steps = Field(
        default=60, description="Largest number of Newton steps in a time step"
    )
    krylov_steps: Steps = Field(
        default=60, description="Largest number of iterations in a linear solution"
    )

    @field_validator("rows")
    @classmethod
    def _even(cls, rows: int) -> int:
        if rows % 2:
            raise ValueError(f"the number of rows must be even, got {rows}. Take {rows + 1}")
        return rows


class RoughFrames(Section):
    """Which films are kept."""

    every: Moment = Field(default=0, description="Keep every n-th film; 0: only those of `steps`")
    steps: list[Moment] = Field(
        default=[], description="Numbers of the time steps whose films are kept"
    )
    record_every: StepCount = Field(
        default=25,
        description="Number of time steps between two records; an interrupted run goes on from "
        "the last record",
    )


class RoughCase(ContactCase):
    """Case of a line contact between rough surfaces in motion, for `run_rough`; a part of the line.

    Examples
    --------
    >>> RoughCase.shipped()[:2]
    ('jamali_2015_a', 'jamali_2015_a_straight')
    >>> case = RoughCase.named("jamali_2015_a")
    >>> case.schedule().until_rough, case.schedule().rough
    (1444, 800)
    """

    title: ClassVar[str] = "rough line contact"
    prefix: ClassVar[str] = "rough_"

    radius_mm: Radius = Field(description="Radius of relative curvature along x, 1/R = 1/R1 + 1/R2")
    load_n_per_mm: LineLoad = Field(description="Load per mm of the length of the line")
    length_mm: PartLength = Field(
        description="Length of the computed part along y, after which everything repeats"
    )
    side_conditions: Literal["cyclic", "no_flow"] = Field(
        default="cyclic",
        description="Condition at both ends along y. cyclic: the film repeats; no_flow: no oil "
        "passes",
    )
    surface_1: RoughSurface | None = None
    surface_2: RoughSurface | None = None
    times: RoughTimes = RoughTimes()
    touching: RoughSolids = RoughSolids()
    domain: RoughDomain = RoughDomain()
    solver: RoughSolver = RoughSolver()
    frames: RoughFrames = RoughFrames()

    @model_validator(mode="after")
    def _consistent(self) -> RoughCase:
        if self.surface_1 is None and self.surface_2 is None:
            raise ValueError("surface_1 and surface_2 are both missing; give at least one")
        if not min(self.speed_1_m_s, self.speed_2_m_s) > 0.0:
            raise ValueError(
                "speed_1_m_s and speed_2_m_s must be above 0 m/s, so that both surfaces come in "
                f"from the inlet, got {self.speed_1_m_s:g} and {self.speed_2_m_s:g} m/s"
            )
        with refused("In SI units: "):
            section = self.section()
            check_scheme(self.solver.scheme, self.settings().discretisation)
        hertz = section.hertz_contact[2]
        if hertz > _HIGHEST:
            raise ValueError(
                f"the Hertz pressure must be at most {_HIGHEST / _GIGA:g} GPa, got "
                f"{hertz / _GIGA:.4g} GPa by load_n_per_mm, radius_mm and reduced_modulus_gpa; "
                "give them in N/mm, mm and GPa"
            )
        with refused():
            self.roughness()
        return self

    def section(self) -> PointContactProblem:
        """Return the smooth contact, in SI units."""
        return line_section(
            R_x=self.radius_mm * MILLIMETRE,
            length=self.length_mm * MILLIMETRE,
            line_load=self.load_n_per_mm / MILLIMETRE,
            speed_1=self.speed_1_m_s,
            speed_2=self.speed_2_m_s,
            contact_modulus=0.5 * self.modulus,
            lubricant=self.oil.film_oil(),
            nodes=(self.solver.nodes_x, self.solver.rows),
            domain=(-self.domain.inlet, self.domain.outlet),
            sides=self.side_conditions,
        )

    def schedule(self) -> RoughSchedule:
        """Return the time steps, in SI units."""
        speeds = self.speed_1_m_s, self.speed_2_m_s
        return RoughSchedule.by_travel(
            length=self.section().hertz_contact[0],
            fast=max(speeds),
            slow=min(speeds),
            until_rough=self.times.until_rough,
            rough=self.times.rough,
            steps=float(self.times.steps_per_half_width),
        )

    def surfaces(self) -> tuple[MovingSurface, ...]:
        """Return the rough surfaces, in SI units."""
        speeds, length = (self.speed_1_m_s, self.speed_2_m_s), self.length_mm * MILLIMETRE
        fastest = 0 if speeds[0] >= speeds[1] else 1
        pairs = zip((self.surface_1, self.surface_2), speeds, strict=True)
        return tuple(
            one.moving(length, speed, k == fastest)
            for k, (one, speed) in enumerate(pairs)
            if one is not None
        )

    def roughness(self) -> MovingRoughness:
        """Return the heights on the nodes of the film at any time."""
        section, schedule = self.section(), self.schedule()
        half_width, inlet = section.hertz_contact[0], float(section.x[0])
        feed: FedFromInlet | GrownInPlace
        if self.times.feed == "inlet":
            feed = FedFromInlet(inlet=inlet, growth=self.times.growth * half_width)
        else:
            # with no step before the contact is rough it grows within the first
            feed = GrownInPlace(duration=schedule.time(max(schedule.until_rough, 1)))
        return MovingRoughness(
            surfaces=self.surfaces(), x=section.x, y=section.y, schedule=schedule, feed=feed
        )

    def touching_solids(self) -> SolidContact | None:
        """Return the layer that carries load where the film vanishes, in SI units."""
        if self.touching.thickness_um == 0.0:
            return None
        return SolidContact(
            thickness=self.touching.thickness_um * _MICRO,
            pressure=self.touching.pressure_gpa * _GIGA,
        )

    def film(self) -> MovingFilm:
        """Return the film in time, in SI units."""
        return moving_section(self.section(), self.roughness(), self.touching_solids())

    def settings(self) -> PointSolverSettings:
        """Return how each time step is solved."""
        given = self.solver.model_dump(exclude={"nodes_x", "rows", "scheme"})
        return PointSolverSettings(estimate_error=False, **given)

    def kept_steps(self) -> tuple[int, ...]:
        """Return the time steps whose film is kept, rising."""
        last, every = self.schedule().steps, self.frames.every
        regular = range(0, last + 1, every) if every else ()
        return tuple(sorted({*regular, *(k for k in self.frames.steps if k <= last)}))

    def _unsaid(self) -> set[str]:
        """Return a digest of the settings on which kept records depend."""
        return {"discretisation"} if self.solver.discretisation == "differences" else set()

    def key(self) -> str:
        """Return a key of all that the march depends on: not of names and frames."""
        listed = self.model_dump_json(
            exclude={"name": True, "source": True, "frames": True, "solver": self._unsaid()}
        )
        digest = hashlib.sha256(listed.encode())
        if self.oil.from_file:
            digest.update(repr(self.oil.film_oil()).encode())
        for one in self.surfaces():
            digest.update(np.ascontiguousarray(one.heights.height).tobytes())
        return digest.hexdigest()[:12]
