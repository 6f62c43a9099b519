"""The sections of a case file of contacts: oil, solids, film, domain, grid and solver."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, OneOf, Usual
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import LIMITING_SLOPE
from gearlube_core.oil.named_laws import DensityLaw, ShearLaw, ViscosityLaw, chosen_laws
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.oil.oil_heat import OilHeat
from gearlube_core.storage.file_names import Name
from gearlube_core.units import celsius_to_kelvin

Text = Annotated[str, Field(min_length=1)]
Heat = Annotated[
    Literal["isothermal", "thermal"],
    Field(
        description="isothermal: the oil stays at its inlet temperature; thermal: the energy "
        "balance of oil and bodies is solved too"
    ),
]
Wedge = Annotated[
    Literal["upwind-1", "upwind-2", "central", "quick"],
    Field(description="Difference formula for the wedge term of Reynolds' equation"),
]
Cavitation = Annotated[
    Literal["reynolds", "mass_conserving"],
    Field(
        description="How the film breaks. reynolds: pressure and its slope are zero there; "
        "mass_conserving: the oil in the broken film is computed too"
    ),
]
Place = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.0, 50.0)]
Reach = Annotated[float, Field(ge=1.05, le=1000.0, allow_inf_nan=False)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-2, allow_inf_nan=False)]
LineNodes = Annotated[int, Field(ge=17, le=20001)]
PointNodes = Annotated[int, Field(ge=17, le=2049)]
Steps = Annotated[int, Field(ge=1, le=1000)]
_GIGA, _MEGA = 1e9, 1e6
_STEEL = STEEL_MOHAMMADPOUR_2015

Viscosity = Annotated[float, Field(ge=1e-4, le=1e4, allow_inf_nan=False), Usual(0.001, 10.0)]
PressureViscosity = Annotated[
    float, Field(ge=0.0, le=1000.0, allow_inf_nan=False), Usual(1.0, 60.0)
]
Stress = Annotated[float, Field(ge=0.01, le=1e6, allow_inf_nan=False), Usual(0.5, 1000.0)]
Slope = Annotated[float, Declared(LIMITING_SLOPE, "limiting_stress_slope")]
_solid = partial(Declared, Solid)
Density = Annotated[float, _solid("density_kg_m3"), Usual(900.0, 20000.0)]
OilDensity = Annotated[float, Field(ge=100.0, le=3000.0, allow_inf_nan=False), Usual(700.0, 1300.0)]
Temperature = Annotated[float, Field(ge=-60.0, le=500.0, allow_inf_nan=False), Usual(-55.0, 250.0)]
TemperatureExponent = Annotated[float, Field(ge=0.0, le=5.0, allow_inf_nan=False)]
Expansion = Annotated[float, Field(ge=0.0, le=1e-2, allow_inf_nan=False), Usual(0.0003, 0.0012)]
Conductivity = Annotated[float, _solid("conductivity_w_m_k"), Usual(0.1, 500.0)]
OilConductivity = Annotated[Conductivity, Usual(0.08, 0.3)]
HeatCapacity = Annotated[
    float, Field(ge=50.0, le=10000.0, allow_inf_nan=False), Usual(300.0, 4500.0)
]
Modulus = Annotated[float, _solid("youngs_modulus_gpa"), Usual(0.5, 1300.0)]
PoissonRatio = Annotated[float, _solid("poisson_ratio")]

# what an oil of the library brings along
_OWN_DATA = (
    "viscosity_pa_s",
    "pressure_viscosity_per_gpa",
    "eyring_stress_mpa",
    "limiting_stress_mpa",
)


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
    cavitation: Cavitation = "reynolds"
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
    wedge: Wedge = "upwind-2"
    discretisation: Literal["differences", "elements"] = Field(
        default="differences",
        description="differences: finite volumes; elements: Galerkin finite elements, with "
        "upwinding where pressure hardly moves the oil",
    )
    cavitation: Cavitation = "reynolds"
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


class Oil(Section):
    """The oil, by its numbers or as one of the library or an oil file at a temperature."""

    library: str | None = Field(
        default=None,
        description="Name of an oil of the library, or an oil file (.toml), its path relative to "
        "the case file; if given, leave out the four values that it brings: viscosity, "
        "pressure-viscosity coefficient, Eyring stress and limiting stress",
    )
    shear: Literal["eyring", "newtonian", "limited"] = Field(
        default="eyring",
        description="Only with an oil of the library: how it shears. eyring: it thins with "
        "shear; newtonian: it does not; limited: eyring up to a limiting shear stress",
    )
    viscosity_pa_s: Viscosity | None = Field(
        default=None,
        description="Dynamic viscosity at ambient pressure and at the inlet temperature. "
        "Example: oils of ISO VG 100 have 0.08 at 40 degC and 0.007 to 0.011 at 100 degC "
        "[arana_2019 Table 2]",
    )
    pressure_viscosity_per_gpa: PressureViscosity | None = Field(
        default=None,
        description="Pressure-viscosity coefficient alpha: slope of ln(viscosity) over pressure "
        "at ambient pressure. Measured at 40 degC: polyalphaolefin 15, paraffinic mineral oil 21, "
        "naphthenic mineral oil 27 [arana_2019 Table 3]",
    )
    law: Annotated[str, OneOf(ViscosityLaw.kind.known)] | None = Field(
        default=None,
        description="Law of viscosity over pressure; houpert also over temperature. Left out: "
        "houpert with a temperature exponent and for thermal solutions with an oil of the library, "
        "which has its own exponent; else roelands",
    )
    density_law: Annotated[str, OneOf(DensityLaw.kind.known)] | None = Field(
        default=None,
        description="Law of density over pressure; left out: that of an oil file, else "
        "dowson_higginson",
    )
    shear_law: Annotated[str, OneOf(ShearLaw.kind.known)] | None = Field(
        default=None,
        description="Law of shear with the Eyring stress; left out: that of an oil file, else "
        "eyring with an Eyring stress and newtonian without",
    )
    law_numbers: dict[str, float] | None = Field(
        default=None, description="Numbers of the laws, by name, in SI units"
    )
    eyring_stress_mpa: Stress | None = Field(
        default=None,
        description="Eyring stress, above which the oil shears thin. Oils of ISO VG 100 have 3.9 "
        "to 4.5 by their measured limiting stress [arana_2019 (12)]; left out: Newtonian",
    )
    limiting_stress_mpa: Stress | None = Field(
        default=None,
        description="Limiting shear stress at ambient pressure, the largest shear stress the "
        "oil can carry; left out: no limit",
    )
    limiting_stress_slope: Slope = Field(
        default=0.0, description="How much the limiting shear stress rises per pressure"
    )
    density_kg_m3: OilDensity = Field(default=870.0, description="Density at ambient pressure")
    temperature_degc: Temperature = Field(
        default=40.0, description="Temperature of the oil at the inlet"
    )
    temperature_exponent: TemperatureExponent = Field(
        default=0.0,
        description="Exponent S0 of Houpert's law, how fast viscosity falls with temperature; "
        "only for thermal solutions. FVA 3, a mineral oil, has 1.2 by its measured viscosities "
        "[wingertszahn_2023]",
    )
    expansion_per_k: Expansion = Field(
        default=0.0,
        description="Thermal expansion of the oil's volume; only for thermal solutions. FVA 3, a "
        "mineral oil, has 7e-4 [wingertszahn_2023]",
    )
    conductivity_w_m_k: OilConductivity = Field(
        default=0.14, description="Thermal conductivity of the oil; only for thermal solutions"
    )
    heat_capacity_j_kg_k: HeatCapacity = Field(
        default=2000.0, description="Specific heat capacity of the oil; only for thermal solutions"
    )

    @model_validator(mode="after")
    def _numbers_or_library(self) -> Oil:
        numbers = [name for name in _OWN_DATA if getattr(self, name) is not None]
        if self.library is not None and numbers:
            raise ValueError(
                f"{', '.join(numbers)} must be left out if library is given, because library = "
                f"{self.library!r} has its own values"
            )
        if self.library is not None and self.temperature_exponent > 0.0:
            raise ValueError(
                "temperature_exponent must be left out if library is given: the exponent of such "
                "an oil follows from its viscosities"
            )
        if self.library is None:
            for name in _OWN_DATA[:2]:
                if getattr(self, name) is None:
                    raise ValueError(
                        f"{name} is missing; give it, or library = an oil or an oil file"
                    )
        if self.limiting_stress_mpa is None and self.limiting_stress_slope > 0.0:
            raise ValueError("limiting_stress_slope needs limiting_stress_mpa")
        try:
            self._laws()
        except ParameterError as reason:
            raise ValueError(str(reason).removesuffix(".")) from None
        return self

    def _laws(self) -> dict[str, Any]:
        return chosen_laws(
            self.law_numbers,
            law=(ViscosityLaw, self.law),
            density_law=(DensityLaw, self.density_law),
            shear_law=(ShearLaw, self.shear_law),
        )

    @property
    def from_file(self) -> bool:
        """Whether the values come from an oil file."""
        return self.library is not None and self.library.endswith(".toml")

    def film_oil(self, thermal: bool = False) -> FilmOil:
        """Return the film's data of the oil, in SI units, for a solution with heat or without."""
        temperature = celsius_to_kelvin(self.temperature_degc)
        warms = self.temperature_exponent > 0.0 or (thermal and self.library is not None)
        laws = self._laws()
        oil = None if self.library is None else read_oil(self.library).lubricant
        law = laws.get("law", "houpert" if warms else "roelands")
        if oil is not None:
            return film_oil_of(
                replace(oil, shear_law=laws.get("shear_law", oil.shear_law)),
                temperature,
                law=laws.get("law", oil.viscosity_law or law),
                density_law=laws.get("density_law"),
                newtonian=self.shear == "newtonian",
                limiting_shear=self.shear == "limited",
            )._replace(expansion=self.expansion_per_k)
        eyring, limit = self.eyring_stress_mpa, self.limiting_stress_mpa
        return film_oil(
            eta0=self.viscosity_pa_s or 0.0,
            alpha=(self.pressure_viscosity_per_gpa or 0.0) / _GIGA,
            law=law,
            density_law=laws.get("density_law", "dowson_higginson"),
            shear_law=laws.get("shear_law"),
            rho0=self.density_kg_m3,
            eyring_stress=None if eyring is None else eyring * _MEGA,
            limiting_shear=None if limit is None else (limit * _MEGA, self.limiting_stress_slope),
            temperature=temperature,
            temperature_exponent=self.temperature_exponent,
            heat=OilHeat(
                expansion=self.expansion_per_k,
                conductivity=self.conductivity_w_m_k,
                heat_capacity=self.heat_capacity_j_kg_k,
            ),
        )


class Body(Section):
    """One of the two solids; steel by default."""

    youngs_modulus_gpa: Modulus = Field(
        default=_STEEL.youngs_modulus / _GIGA, description="Young's modulus"
    )
    poisson_ratio: PoissonRatio = Field(default=_STEEL.poisson_ratio, description="Poisson's ratio")
    density_kg_m3: Density = Field(
        default=_STEEL.density, description="Density; only for thermal solutions"
    )
    conductivity_w_m_k: Conductivity = Field(
        default=_STEEL.conductivity, description="Thermal conductivity; only for thermal solutions"
    )
    heat_capacity_j_kg_k: HeatCapacity = Field(
        default=_STEEL.heat_capacity,
        description="Specific heat capacity; only for thermal solutions",
    )

    def solid(self) -> Solid:
        """Return the solid, in SI units."""
        return Solid(
            youngs_modulus=self.youngs_modulus_gpa * _GIGA,
            poisson_ratio=self.poisson_ratio,
            density=self.density_kg_m3,
            conductivity=self.conductivity_w_m_k,
            heat_capacity=self.heat_capacity_j_kg_k,
        )
