"""Case files of lubricated line and point contacts, in engineers' units."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.contact.solid import Solid, reduced_modulus
from gearlube_core.ehl.case.sections import (
    Body,
    FilmCase,
    Heat,
    LineDomain,
    LineSolver,
    Modulus,
    Oil,
    PointDomain,
    PointSolver,
    refused,
)
from gearlube_core.ehl.case.surfaces import (
    DentShape,
    MapFile,
    ProfileFile,
    RidgeShape,
    WavinessShape,
)
from gearlube_core.ehl.gap import RoughGap
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.point.contact_domain import (
    DOMAIN,
    ContactDomain,
    check_repeats,
    elliptical_contact,
    line_section,
)
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solver import check_cavitation
from gearlube_core.ehl.point.thermal.solver import check_thermal
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.units import MILLIMETRE

_GIGA, _MICRO = 1e9, 1e-6

Radius = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False), Usual(0.5, 10000.0)]
Speed = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.001, 200.0)]
PartLength = Annotated[float, Field(ge=0.01, le=100.0, allow_inf_nan=False), Usual(0.02, 50.0)]
LineLoad = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False), Usual(1.0, 5000.0)]
Load = Annotated[float, Field(gt=0.0, le=1e8, allow_inf_nan=False), Usual(0.1, 100000.0)]
Layer = Annotated[float, Field(ge=1e-4, le=1e6, allow_inf_nan=False), Usual(0.001, 100.0)]
Roughness = Annotated[float, Declared(ROUGHNESS, "roughness_um"), Usual(0.005, 5.0)]
Fill = Annotated[float, Field(gt=0.0, le=1.0, allow_inf_nan=False)]


_ROUGHNESS = (
    "Composite rms roughness of both surfaces, for the film ratio in the report; the film itself "
    "is solved for the surfaces of this case"
)


class ContactCase(FilmCase):
    """Common fields of line and point contacts: speeds along x, solids, oil."""

    files: ClassVar[tuple[str, ...]] = (
        "profile.file",
        "height_map.file",
        "surface_1.file",
        "surface_2.file",
        "oil.library",
    )

    speed_1_m_s: Speed = Field(
        description="Speed of the surface of body 1 (below the film) along x, relative to the "
        "contact"
    )
    speed_2_m_s: Speed = Field(
        description="Speed of the surface of body 2 (above the film) along x, relative to the "
        "contact"
    )
    reduced_modulus_gpa: Modulus | None = Field(
        default=None,
        description="Reduced modulus E' = 2 E*; 231 for the default steels; left out: computed "
        "from body_1 and body_2",
    )
    oil: Oil
    body_1: Body = Body()
    body_2: Body = Body()

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

    @property
    def _both_move(self) -> bool:
        return self.speed_1_m_s != 0.0 and self.speed_2_m_s != 0.0

    def moved(self, entrainment: float | None, slide_roll: float | None) -> Self:
        """Return the case at the speeds of `speeds_at`."""
        speeds = self.speeds_at(entrainment, slide_roll)
        return self.varied(speeds) if speeds else self

    def speeds_at(self, entrainment: float | None, slide_roll: float | None) -> dict[str, float]:
        """Return the fields of another mean speed along x or slide-roll ratio.

        Parameters
        ----------
        entrainment
            (u1 + u2)/2 [m/s]; None keeps it.
        slide_roll
            2 (u1 - u2)/(u1 + u2) [-]; None keeps it.

        Returns
        -------
        dict
            Of both surface speeds [m/s], for `varied`; empty if both arguments are None.

        Raises
        ------
        ParameterError
            The case has no mean speed, so no slide-roll ratio.
        """
        if entrainment is None and slide_roll is None:
            return {}
        mean = 0.5 * (self.speed_1_m_s + self.speed_2_m_s)
        if mean == 0.0:
            raise ParameterError(
                f"{self.name} has a mean speed of 0 m/s along x, so it has no slide-roll ratio. "
                "Give both speeds in the case file."
            )
        ratio = (self.speed_1_m_s - self.speed_2_m_s) / mean if slide_roll is None else slide_roll
        u = mean if entrainment is None else entrainment
        return {"speed_1_m_s": u * (1.0 + 0.5 * ratio), "speed_2_m_s": u * (1.0 - 0.5 * ratio)}


class LineCase(ContactCase):
    """Case of a lubricated line contact, for `run_line`: contact, oil, speeds, load, grid.

    Examples
    --------
    >>> LineCase.shipped()
    ('jamali_2015', 'jamali_2015_thermal')
    >>> case = LineCase.named("jamali_2015").varied({"load_n_per_mm": 100.0})
    >>> case.load_n_per_mm
    100.0
    """

    title: ClassVar[str] = "line contact"
    prefix: ClassVar[str] = "line_"

    radius_mm: Radius = Field(description="Radius of relative curvature along x, 1/R = 1/R1 + 1/R2")
    load_n_per_mm: LineLoad = Field(description="Load per mm of the length of the line")
    inlet_fill: Fill = Field(
        default=1.0,
        description="Share of the gap at the inlet that is filled with oil; 1: flooded; below 1 "
        "needs mass_conserving cavitation",
    )
    temperature: Heat = "isothermal"
    roughness_um: Roughness | None = Field(default=None, description=_ROUGHNESS)
    domain: LineDomain | None = None
    profile: ProfileFile | None = None
    solver: LineSolver = LineSolver()

    @model_validator(mode="after")
    def _consistent(self) -> LineCase:
        with refused("In SI units: "):
            smooth = self._smooth()
            self.settings()
        with refused():
            self._shaped(smooth)
        return self

    def problem(self) -> LineProblem:
        """Return the contact, in SI units."""
        return self._shaped(self._smooth())

    def _shaped(self, smooth: LineProblem) -> LineProblem:
        """Return the contact with the heights of its profile."""
        given = self.profile
        if given is None:
            return smooth
        profile = given.surface()
        profile.check_serves(np.linspace(*smooth.extent(), self.solver.nodes))
        if given.holds == "gap":
            return replace(smooth, gap=profile)
        return replace(smooth, gap=lambda x: smooth.undeformed_gap(x) - profile(x))

    def _smooth(self) -> LineProblem:
        d = self.domain
        return LineProblem(
            lubricant=self.oil.film_oil(self.temperature == "thermal"),
            radius=self.radius_mm * MILLIMETRE,
            line_load=self.load_n_per_mm / MILLIMETRE,
            reduced_modulus=self.modulus,
            speed_1=self.speed_1_m_s,
            speed_2=self.speed_2_m_s,
            domain=None if d is None else (d.first_mm * MILLIMETRE, d.last_mm * MILLIMETRE),
            inlet_fill=self.inlet_fill,
        )

    @property
    def heights_travel(self) -> bool:
        """Tell whether heights would move with a surface, which a steady solution leaves out."""
        return self.profile is not None and self.profile.holds == "heights" and self._both_move

    def settings(self) -> LineSettings:
        """Return how it is solved."""
        return LineSettings(**self.solver.model_dump())


class PointCase(ContactCase):
    """Case of a lubricated point contact, for `run_point`: contact, oil, speeds, load, grid.

    Examples
    --------
    >>> PointCase.named("mourier_2006").varied({"solver.nodes_x": 97}).solver.nodes_x
    97
    """

    title: ClassVar[str] = "point contact"
    prefix: ClassVar[str] = "point_"

    radius_x_mm: Radius = Field(
        description="Radius of relative curvature along x, 1/R = 1/R1 + 1/R2"
    )
    radius_y_mm: Radius | None = Field(
        default=None,
        description="Radius of relative curvature along y; leave it out if length_mm is given",
    )
    length_mm: PartLength | None = Field(
        default=None,
        description="Makes the case a part of a line contact: length of this part along y, "
        "after which everything repeats; load_n is the load on this length",
    )
    side_conditions: Literal["ambient", "cyclic", "no_flow"] = Field(
        default="ambient",
        description="Condition at both ends along y. ambient: ambient pressure. For a part of a "
        "line contact, cyclic: the film repeats; no_flow: no oil passes",
    )
    load_n: Load = Field(description="Load on the contact")
    side_speed_1_m_s: Speed = Field(
        default=0.0, description="Speed of the surface of body 1 along y"
    )
    side_speed_2_m_s: Speed = Field(
        default=0.0, description="Speed of the surface of body 2 along y"
    )
    inlet_layer_um: Layer | None = Field(
        default=None,
        description="Thickness of the oil that both surfaces together carry into the inlet; "
        "needs mass_conserving cavitation; left out: flooded",
    )
    temperature: Heat = "isothermal"
    roughness_um: Roughness | None = Field(default=None, description=_ROUGHNESS)
    domain: PointDomain = PointDomain()
    height_map: MapFile | None = None
    ridge: RidgeShape | None = None
    dent: DentShape | None = None
    waviness: WavinessShape | None = None
    solver: PointSolver = PointSolver()

    @model_validator(mode="after")
    def _consistent(self) -> PointCase:
        wanted, other = "radius_y_mm", "length_mm"
        if self.closed:
            wanted, other = other, wanted
        if getattr(self, wanted) is None or getattr(self, other) is not None:
            raise ValueError(
                f"{wanted} must be given and {other} left out with side_conditions "
                f"{self.side_conditions}"
            )
        with refused("In SI units: "):
            smooth, settings = self._smooth(), self.settings()
            check_cavitation(smooth, settings)
        with refused():
            self._shaped(smooth)
            if self.temperature == "thermal":
                check_thermal(smooth, settings)
        return self

    @property
    def closed(self) -> bool:
        """Tell whether the contact is a part of a line contact between closed sides."""
        return self.side_conditions != "ambient"

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
        return (self.speed_2_m_s - self.speed_1_m_s, self.side_speed_2_m_s - self.side_speed_1_m_s)

    def problem(self) -> PointContactProblem:
        """Return the contact, in SI units."""
        return self._shaped(self._smooth())

    def _shaped(self, smooth: PointContactProblem) -> PointContactProblem:
        """Return the contact with the heights of its surfaces."""
        given = (self.ridge, self.dent, self.waviness, self.height_map)
        shapes = [one.surface() for one in given if one is not None]
        if not shapes:
            return smooth
        for one in shapes:
            one.check_serves(smooth.x, smooth.y)
            if self.closed:
                check_repeats(one, smooth)
        if self.height_map is not None and self.height_map.holds == "gap":
            *heights, whole = shapes
            return replace(smooth, gap=RoughGap(whole, tuple(heights)), oil_beyond=False)
        return replace(smooth, gap=RoughGap(smooth.gap, tuple(shapes)))

    def _section(self) -> PointContactProblem:
        d, length = self.domain, (self.length_mm or 0.0) * MILLIMETRE
        return line_section(
            R_x=self.radius_x_mm * MILLIMETRE,
            length=length,
            line_load=self.load_n / length,
            speed_1=self.speed_1_m_s,
            speed_2=self.speed_2_m_s,
            contact_modulus=0.5 * self.modulus,
            lubricant=self.oil.film_oil(self.temperature == "thermal"),
            nodes=(self.solver.nodes_x, self.solver.nodes_y),
            domain=(
                DOMAIN[0] if d.inlet is None else -d.inlet,
                DOMAIN[1] if d.outlet is None else d.outlet,
            ),
            sides=self.side_conditions,
        )

    def _smooth(self) -> PointContactProblem:
        oil = self.oil.film_oil(self.temperature == "thermal")
        if self.closed:
            beyond = bool(self.domain.oil_beyond) or self.inlet_layer_um is not None
            sides, across = Sides(self.side_conditions), self.entrainment[1]
            sides.check_goes_with(self.solver.nodes_y, across, self.sliding, beyond)
            return replace(self._section(), sliding=self.sliding)
        return elliptical_contact(
            R_x=self.radius_x_mm * MILLIMETRE,
            R_y=(self.radius_y_mm or 0.0) * MILLIMETRE,
            entrainment=self.entrainment,
            load=self.load_n,
            contact_modulus=0.5 * self.modulus,
            lubricant=oil,
            sliding=self.sliding,
            nodes=(self.solver.nodes_x, self.solver.nodes_y),
            domain=ContactDomain(self.domain.inlet, self.domain.outlet, self.domain.side),
            oil_beyond=self.domain.oil_beyond,
            inlet_layer=None if self.inlet_layer_um is None else _MICRO * self.inlet_layer_um,
        )

    @property
    def heights_travel(self) -> bool:
        """Tell whether heights would move with a surface, which a steady solution leaves out."""
        heights = [self.dent, self.waviness, self.ridge, self.height_map]
        whole = self.height_map is not None and self.height_map.holds == "gap"
        return any(one is not None for one in heights[: -1 if whole else None]) and self._both_move

    def settings(self) -> PointSolverSettings:
        """Return how it is solved."""
        return PointSolverSettings(**self.solver.model_dump(exclude={"nodes_x", "nodes_y"}))
