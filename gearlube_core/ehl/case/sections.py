"""The sections of a case file of line and point contacts: every field's unit and range."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.input_file.input_file import Section
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_heat import OilHeat
from gearlube_core.units import celsius_to_kelvin

_GIGA, _MEGA = 1e9, 1e6
_STEEL = STEEL_MOHAMMADPOUR_2015

Viscosity = Annotated[float, Field(ge=1e-4, le=1e4, allow_inf_nan=False)]
PressureViscosity = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False)]
Stress = Annotated[float, Field(ge=0.01, le=1e6, allow_inf_nan=False)]
Slope = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Density = Annotated[float, Field(ge=100.0, le=30000.0, allow_inf_nan=False)]
OilDensity = Annotated[float, Field(ge=100.0, le=3000.0, allow_inf_nan=False)]
Temperature = Annotated[float, Field(ge=-60.0, le=500.0, allow_inf_nan=False)]
TemperatureExponent = Annotated[float, Field(ge=0.0, le=5.0, allow_inf_nan=False)]
Expansion = Annotated[float, Field(ge=0.0, le=1e-2, allow_inf_nan=False)]
Conductivity = Annotated[float, Field(ge=0.01, le=3000.0, allow_inf_nan=False)]
HeatCapacity = Annotated[float, Field(ge=50.0, le=10000.0, allow_inf_nan=False)]
Modulus = Annotated[float, Field(ge=1e-3, le=2000.0, allow_inf_nan=False)]
PoissonRatio = Annotated[float, Field(ge=0.0, le=0.5, allow_inf_nan=False)]

# what an oil of the library brings along
_OWN_DATA = (
    "viscosity_pa_s",
    "pressure_viscosity_per_gpa",
    "eyring_stress_mpa",
    "limiting_stress_mpa",
)


class Oil(Section):
    """The oil, by its numbers or as one of the library at a temperature."""

    library: str | None = Field(
        default=None,
        description="Oil of the library; leave out its numbers then",
    )
    shear: Literal["eyring", "newtonian", "limited"] = Field(
        default="eyring",
        description="Of an oil of the library: Eyring, Newtonian, or Eyring up to a limit",
    )
    viscosity_pa_s: Viscosity | None = Field(
        default=None, description="At ambient pressure and the inlet's temperature"
    )
    pressure_viscosity_per_gpa: PressureViscosity | None = Field(
        default=None, description="alpha, slope of ln(viscosity) at ambient pressure"
    )
    law: Literal["barus", "roelands", "houpert"] = Field(
        default="roelands", description="Viscosity against pressure; houpert also temperature"
    )
    density_law: Literal["dowson_higginson", "incompressible"] = Field(
        default="dowson_higginson", description="Density against pressure"
    )
    eyring_stress_mpa: Stress | None = Field(default=None, description="Left out: Newtonian")
    limiting_stress_mpa: Stress | None = Field(
        default=None, description="Limiting shear stress at ambient pressure"
    )
    limiting_stress_slope: Slope = Field(
        default=0.0, description="Slope of the limiting shear stress with pressure"
    )
    density_kg_m3: OilDensity = Field(default=870.0, description="At ambient pressure")
    temperature_degc: Temperature = Field(default=40.0, description="At the inlet")
    temperature_exponent: TemperatureExponent = Field(
        default=0.0, description="S0 of Houpert's law, for thermal solutions"
    )
    expansion_per_k: Expansion = Field(
        default=0.0, description="Thermal expansion of volume, for thermal solutions"
    )
    conductivity_w_m_k: Conductivity = Field(
        default=0.14, description="Heat conduction, for thermal solutions"
    )
    heat_capacity_j_kg_k: HeatCapacity = Field(
        default=2000.0, description="Heat capacity, for thermal solutions"
    )

    @model_validator(mode="after")
    def _numbers_or_library(self) -> Oil:
        numbers = [name for name in _OWN_DATA if getattr(self, name) is not None]
        if self.library is not None and numbers:
            raise ValueError(
                f"{', '.join(numbers)} must be left out beside library = {self.library!r}, "
                "which has its own"
            )
        if self.library is None:
            for name in _OWN_DATA[:2]:
                if getattr(self, name) is None:
                    raise ValueError(f"{name} is missing; give it, or the name of a library oil")
        if self.limiting_stress_mpa is None and self.limiting_stress_slope > 0.0:
            raise ValueError("limiting_stress_slope needs limiting_stress_mpa")
        return self

    def film_oil(self) -> FilmOil:
        """Return the film's data of the oil, in SI units."""
        temperature = celsius_to_kelvin(self.temperature_degc)
        if self.library is not None:
            return film_oil_of(
                Lubricant.named(self.library),
                temperature,
                law=self.law,
                density_law=self.density_law,
                newtonian=self.shear == "newtonian",
                limiting_shear=self.shear == "limited",
            )
        eyring, limit = self.eyring_stress_mpa, self.limiting_stress_mpa
        return film_oil(
            eta0=self.viscosity_pa_s or 0.0,
            alpha=(self.pressure_viscosity_per_gpa or 0.0) / _GIGA,
            law=self.law,
            density_law=self.density_law,
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
    density_kg_m3: Density = Field(default=_STEEL.density, description="For thermal solutions")
    conductivity_w_m_k: Conductivity = Field(
        default=_STEEL.conductivity, description="For thermal solutions"
    )
    heat_capacity_j_kg_k: HeatCapacity = Field(
        default=_STEEL.heat_capacity, description="For thermal solutions"
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
