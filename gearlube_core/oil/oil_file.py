"""The oil file: an oil as its data sheet describes it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from os.path import isfile
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, OneOf, Usual
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.input_file.input_file import InputFile, InputNote, Origin, Section, toml_data
from gearlube_core.oil.base_oils import BASE_OILS
from gearlube_core.oil.library import read_library
from gearlube_core.oil.lubricant import Lubricant, lubricant_names
from gearlube_core.oil.named_laws import DensityLaw, ShearLaw, ViscosityLaw, chosen_laws
from gearlube_core.oil.oil_heat import HeatUnderPressure
from gearlube_core.oil.pressure_coefficients import AlphaIs
from gearlube_core.oil.sheet_values import SheetValues, sheet_values
from gearlube_core.oil.viscometer import measured_law
from gearlube_core.units import celsius_to_kelvin

FILE_IN_FMU = "oil.toml"  # among the resources of an FMU

# shared with the axle file
_oil = partial(Declared, Lubricant)
Text = Annotated[str, Field(min_length=1)]
Viscosity = Annotated[float, Field(ge=2.0, le=1e5, allow_inf_nan=False), Usual(2.0, 3000.0)]
Density = Annotated[float, _oil("density_kg_m3"), Usual(750.0, 1200.0)]
PressureViscosity = Annotated[float, Field(ge=1.0, le=100.0, allow_inf_nan=False), Usual(5.0, 50.0)]
Stress = Annotated[float, Field(ge=0.01, le=1000.0, allow_inf_nan=False), Usual(0.5, 50.0)]
Strength = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False), Usual(0.5, 100.0)]
Share = Annotated[float, _oil("boundary_friction")]
Conductivity = Annotated[float, _oil("conductivity_w_m_k"), Usual(0.08, 0.3)]
HeatCapacity = Annotated[float, _oil("heat_capacity_j_kg_k"), Usual(1300.0, 3500.0)]
Temperature = Annotated[float, Field(ge=-60.0, le=250.0, allow_inf_nan=False), Usual(-55.0, 200.0)]

ViscosityAt100 = Annotated[Viscosity | None, Field(description="Kinematic viscosity at 100 degC")]
Alpha = Annotated[PressureViscosity | None, Field(description="Pressure-viscosity coefficient")]
AlphaMeaning = Annotated[
    AlphaIs | None,
    Field(
        description="What alpha is: from measured films, the slope of ln eta at ambient pressure, "
        "or its mean slope to alpha_pressure_gpa; without a name it is read as from films"
    ),
]
AlphaPressure = Annotated[
    float | None,
    _oil("alpha_pressure_gpa"),
    Usual(0.1, 0.5),
    Field(description="Pressure to which a mean slope goes"),
]
AlphaTemperature = Annotated[
    Temperature | None, Field(description="Temperature to which alpha belongs")
]
EyringStress = Annotated[
    Stress | None, Field(description="Shear stress at which shear thinning begins (Eyring)")
]
ShearStrength = Annotated[
    Strength | None,
    Field(description="Shear strength of the boundary layer between asperities, at zero pressure"),
]
BoundaryFriction = Annotated[
    Share | None,
    Field(
        description="Friction coefficient of the boundary layer: how much its shear strength "
        "rises per pressure"
    ),
]
OilConductivity = Annotated[Conductivity | None, Field(description="Thermal conductivity")]
OilHeatCapacity = Annotated[HeatCapacity | None, Field(description="Specific heat capacity")]
LowestTemperature = Annotated[
    Temperature | None, Field(description="Lowest oil temperature that the data are meant for")
]
HighestTemperature = Annotated[
    Temperature | None, Field(description="Highest oil temperature that the data are meant for")
]

Index = Annotated[float, Field(ge=0.0, le=400.0, allow_inf_nan=False)]
DensitySlope = Annotated[float, Field(ge=-2.0, le=0.0, allow_inf_nan=False), Usual(-1.2, -0.3)]
Factor = Annotated[float, Field(ge=1.0, le=10.0, allow_inf_nan=False)]
PointPressure = Annotated[float, Field(ge=0.0, le=5.0, allow_inf_nan=False), Usual(0.0, 2.0)]
PointViscosity = Annotated[float, Field(ge=1e-4, le=1e12, allow_inf_nan=False), Usual(1e-3, 1e9)]
Limit = Annotated[float, Field(ge=0.005, le=0.3, allow_inf_nan=False)]

_ORIGINS: dict[str, Origin] = {
    "printed": "given",
    "corrected": "inferred",
    "completed": "inferred",
    "assumed": "assumed",
}
_LIBRARY_UNITS = {
    **dict.fromkeys(("dynamic_1", "dynamic_2"), "Pa.s"),
    "density": "kg/m3",
    "alpha": "1/Pa",
    "alpha_is": "",
    **dict.fromkeys(("eyring_stress", "limiting_shear_stress"), "Pa"),
    "conductivity": "W/(m.K)",
    "conductivity_slope": "W/(m.K2)",
    "heat_capacity": "J/(kg.K)",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DescribedOil:
    """An oil and where its numbers come from, as `read_oil` returns it.

    Parameters
    ----------
    name, source : str
    lubricant : Lubricant
        The oil as all computations take it.
    inputs : tuple of InputNote
        Every number with value, unit, and whether it is given, inferred or assumed.
    limiting_coefficient : float
        Limiting shear stress of the film divided by pressure [-]; nan for an oil of the library.
    density_slope : float
        d rho/dT [kg/(m3 K)]; nan for an oil of the library, whose density is constant.

    Examples
    --------
    >>> oil = read_oil("iso_vg_220_pao")
    >>> note = next(note for note in oil.assumed if note.field == "conductivity_w_m_k")
    >>> note.value, note.origin
    (0.15, 'assumed')
    """

    name: str
    source: str
    lubricant: Lubricant
    inputs: tuple[InputNote, ...]
    limiting_coefficient: float
    density_slope: float

    @property
    def assumed(self) -> tuple[InputNote, ...]:
        """The numbers that the file does not give: assumed ones and those inferred from others."""
        return tuple(note for note in self.inputs if note.origin != "given")


class Viscometer(Section):
    """Viscosities that were measured under pressure, one number of each list by point."""

    pressure_gpa: tuple[PointPressure, ...] = Field(
        strict=False, description="Gauge pressure; points at 0 are the viscosity without pressure"
    )
    temperature_degc: tuple[Temperature, ...] = Field(strict=False, description="Temperature")
    viscosity_pa_s: tuple[PointViscosity, ...] = Field(
        strict=False, description="Dynamic viscosity"
    )

    @model_validator(mode="after")
    def _check_lengths(self) -> Viscometer:
        counts = [len(self.pressure_gpa), len(self.temperature_degc), len(self.viscosity_pa_s)]
        if len(set(counts)) > 1:
            raise ValueError(
                "pressure_gpa, temperature_degc and viscosity_pa_s must have one number for each "
                f"point, got {counts[0]}, {counts[1]} and {counts[2]}"
            )
        return self

    def points(self) -> Array:
        """Return pressure [Pa], temperature [K] and viscosity [Pa s] of each point."""
        kelvin = [celsius_to_kelvin(one) for one in self.temperature_degc]
        return np.column_stack([1e9 * np.array(self.pressure_gpa), kelvin, self.viscosity_pa_s])


class OilFile(InputFile):
    """An oil as its data sheet describes it.

    Examples
    --------
    >>> OilFile.shipped()
    ('iso_vg_220_pao',)
    >>> oil = OilFile.named("iso_vg_220_pao").described().lubricant
    >>> round(1e9 * oil.alpha, 1)  # 1/GPa at 40 degC
    15.2
    """

    package: ClassVar[str] = "gearlube_core.oil"
    title: ClassVar[str] = "oil file"

    name: Text = Field(description="Name of the oil in results")
    source: Text | None = Field(default=None, description="Where the numbers come from")
    base_oil: Literal["mineral", "pao", "ester", "pag"] = Field(
        description="Class of the base oil: paraffinic mineral, polyalphaolefin, ester, polyglycol"
    )
    density_kg_m3: Density = Field(description="Density at density_temperature_degc")
    density_temperature_degc: Temperature | None = Field(
        default=None, description="Temperature to which the density belongs"
    )
    density_slope_kg_m3_k: DensitySlope | None = Field(
        default=None, description="Change of the density with temperature"
    )
    viscosity_40_degc_mm2_s: Viscosity | None = Field(
        default=None,
        description="Kinematic viscosity at 40 degC; give two of this field and the next two",
    )
    viscosity_100_degc_mm2_s: ViscosityAt100 = None
    viscosity_index: Index | None = Field(
        default=None, description="Viscosity index after ASTM D2270, instead of one viscosity"
    )
    alpha_per_gpa: Alpha = None
    alpha_is: AlphaMeaning = None
    alpha_pressure_gpa: AlphaPressure = None
    alpha_temperature_degc: AlphaTemperature = None
    viscometer: Viscometer | None = Field(
        default=None,
        description="Viscosities under pressure; alpha and the viscosity law follow from them",
    )
    alpha_factor: Factor | None = Field(
        default=None,
        description="Uncertainty factor of alpha: it lies between alpha / factor and alpha * "
        "factor (k = 2)",
    )
    high_pressure_factor: Factor | None = Field(
        default=None,
        description="Uncertainty factor of the viscosity at 1 GPa with the same alpha of films",
    )
    eyring_stress_mpa: EyringStress = None
    eyring_stress_factor: Factor | None = Field(
        default=None, description="Uncertainty factor of the Eyring stress, as above (k = 2)"
    )
    limiting_coefficient: Limit | None = Field(
        default=None, description="Limiting shear stress of the film divided by the pressure"
    )
    limiting_coefficient_factor: Factor | None = Field(
        default=None,
        description="Uncertainty factor of the limiting coefficient, as above (k = 2)",
    )
    limiting_shear_stress_mpa: ShearStrength = None
    boundary_friction: BoundaryFriction = None
    viscosity_law: Annotated[str, OneOf(ViscosityLaw.kind.known)] | None = Field(
        default=None,
        description="Law of viscosity over pressure; Barus, Roelands and Houpert act in solved "
        "films alone, formulas keep the law of their source",
    )
    density_law: Annotated[str, OneOf(DensityLaw.kind.known)] | None = Field(
        default=None, description="Law of density over pressure in solved films"
    )
    shear_law: Annotated[str, OneOf(ShearLaw.kind.known)] | None = Field(
        default=None,
        description="Law of shear with the Eyring stress in solved films; one of your own also in "
        "formulas",
    )
    law_numbers: dict[str, float] | None = Field(
        default=None, description="Numbers of the laws, by name, in SI units"
    )
    conductivity_w_m_k: OilConductivity = None
    heat_capacity_j_kg_k: OilHeatCapacity = None
    heat_under_pressure: HeatUnderPressure = Field(
        default="none",
        description="Base oil after which films conduct and hold more heat under pressure",
    )
    temperature_low_degc: LowestTemperature = None
    temperature_high_degc: HighestTemperature = None

    @model_validator(mode="after")
    def _check_oil(self) -> OilFile:
        cold, hot = self.viscosity_40_degc_mm2_s, self.viscosity_100_degc_mm2_s
        given = sum(one is not None for one in (cold, hot, self.viscosity_index))
        if given != 2:
            raise ValueError(
                "two of viscosity_40_degc_mm2_s, viscosity_100_degc_mm2_s and viscosity_index "
                f"must be given, got {given}"
            )
        if cold is not None and hot is not None and cold <= hot:
            raise ValueError(
                f"viscosity must fall with temperature, got {cold:g} mm2/s at 40 degC and {hot:g} "
                "mm2/s at 100 degC. Are they swapped?"
            )
        known = {"alpha_per_gpa": self.alpha_per_gpa, "viscosity_law": self.viscosity_law}
        twice = [key for key, value in known.items() if value is not None]
        if self.viscometer is not None and twice:
            raise ValueError(
                f"{' and '.join(twice)} must be left out with viscometer, from which they follow"
            )
        try:
            oil = self.described().lubricant
            if all(law.ships for law in oil.laws):
                oil.own_laws()  # refuses a glass
        except ParameterError as reason:
            raise ValueError(str(reason).removesuffix(".")) from None
        return self

    def described(self) -> DescribedOil:
        """Return the oil in SI units with a note on every number."""
        laws: dict[str, Any] = chosen_laws(
            self.law_numbers,
            viscosity_law=(ViscosityLaw, self.viscosity_law),
            density_law=(DensityLaw, self.density_law),
            shear_law=(ShearLaw, self.shear_law),
        )
        given = self.model_dump(exclude_none=True, exclude={*laws, "law_numbers", "viscometer"})
        own = laws.get("viscosity_law")
        if own is not None and not own.ships:
            given.setdefault("alpha_is", "slope")
        notes = [InputNote(field, law.name, "", "given", "") for field, law in laws.items()]
        if own is None:
            shape, why = BASE_OILS[self.base_oil].viscosity_law
            own = ViscosityLaw.kind.named("viscosity_law", shape, {})
            origin: Origin = "assumed"
            if self.viscometer is not None:
                points = self.viscometer.points()
                own, found, why = measured_law(points, sheet_values(given).data, own)
                given = found | given | {"alpha_is": "film"}
                origin = "inferred"
            laws["viscosity_law"] = own
            notes.append(InputNote("viscosity_law", own.name, "", origin, why))
        values: SheetValues = sheet_values(given)
        for law in laws.values():
            numbers = law.notes("law_numbers.", self.law_numbers or {})
            if law is own and self.viscometer is not None:
                numbers = [one._replace(origin="inferred", why="viscometer") for one in numbers]
            notes += numbers
        return DescribedOil(
            name=self.name,
            source=self.source or "",
            lubricant=Lubricant(
                name=self.name,
                source=self.source or "an oil file",
                **(values.data | laws),
            ),
            inputs=(*values.notes, *notes),
            limiting_coefficient=values.limiting_coefficient,
            density_slope=values.density_slope,
        )


def described_library_oil(name: str) -> DescribedOil:
    """Return an oil of the library with its notes: assumed is what its entry calls so."""
    oil = Lubricant.named(name)
    entry = read_library()[name]
    notes = []
    for section in ("viscosity", "data"):
        for key, (value, tag, source) in entry[section].items():
            unit = _LIBRARY_UNITS.get(key) or field_unit(key)[0]
            why = "" if tag == "printed" else source
            notes.append(InputNote(key, value, unit, _ORIGINS[tag], why))
    return DescribedOil(
        name=name,
        source=oil.source,
        lubricant=oil,
        inputs=tuple(notes),
        limiting_coefficient=float("nan"),
        density_slope=float("nan"),
    )


def read_oil(name: str | Path) -> DescribedOil:
    """Return an oil from an oil file or the library, by the path or the name.

    Raises
    ------
    ParameterError
        The file is missing or wrong (the message names all wrong fields), or there is no oil of
        this name.

    Examples
    --------
    >>> read_oil("fva_3").lubricant.density  # kg/m3
    866.6
    >>> oil = read_oil("iso_vg_220_pao")
    >>> round(1e-6 * oil.lubricant.eyring_stress, 1)  # MPa
    4.6
    """
    text = str(name)
    if text.endswith(".toml") or isfile(text):
        return read_oil_file(Path(text))
    if text in lubricant_names():
        return described_library_oil(text)
    if text in OilFile.shipped():
        return OilFile.named(text).described()
    raise ParameterError(
        f"The oil must be one of {', '.join((*lubricant_names(), *OilFile.shipped()))} or a file, "
        f"got {text!r}. A file's name ends in .toml; docs/oil_file.md lists its fields."
    )


def read_oil_file(path: Path) -> DescribedOil:
    """Return the oil of the oil file at a path."""
    return OilFile.from_toml(path).described()


def read_oil_content(path: str | Path) -> bytes:
    """Return an oil file's bytes, with the ends of lines of all platforms alike."""
    return read_content(path, "oil file").replace(b"\r\n", b"\n")


def described_oil_of(content: bytes, where: str) -> DescribedOil:
    """Return the oil of a file's bytes, e.g. in those of an FMU's resource."""
    return OilFile.from_data(toml_data(content, where), where).described()
