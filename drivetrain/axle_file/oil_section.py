"""The sections of the axle file on its oil, on churning and on seals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from drivetrain.axle_file.section import ModelSection
from gearlube_core.drag import SHAFT_DIAMETER, ChurningLaw, SealMaterial, seal_torque
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.field_units import field_value, unit_of
from gearlube_core.input_file.input_file import InputNote, Origin
from gearlube_core.oil.library import read_library
from gearlube_core.oil.lubricant import Lubricant, lubricant_names
from gearlube_core.oil.oil_file import (
    Alpha,
    AlphaMeaning,
    AlphaPressure,
    AlphaTemperature,
    BoundaryFriction,
    Density,
    DescribedOil,
    EyringStress,
    HighestTemperature,
    LowestTemperature,
    OilConductivity,
    OilHeatCapacity,
    ShearStrength,
    Temperature,
    Text,
    Viscosity,
    ViscosityAt100,
)
from gearlube_core.units import celsius_to_kelvin

_axle, _oil = partial(Declared, HypoidAxleParameters), partial(Declared, Lubricant)
Size = Annotated[float, _axle("ring_diameter_mm"), Usual(50.0, 1000.0)]
Width = Annotated[float, _axle("ring_width_mm"), Usual(5.0, 200.0)]
Depth = Annotated[float, _axle("immersion_mm"), Usual(2.0, 500.0)]
Litres = Annotated[float, _axle("oil_volume_l"), Usual(0.2, 50.0)]
ShaftSize = Annotated[float, Declared(SHAFT_DIAMETER, "pinion_diameter_mm"), Usual(10.0, 200.0)]
Torque = Annotated[float, _axle("pinion_torque_n_m", "pinion_seal_torque"), Usual(0.01, 20.0)]

DEFAULT_CHURNING = "changenet_velex_2007"
_NO_SOURCE = "size found in passenger cars; no source"
_WHEEL_SEALS, _SEAL_DEGC = 2, 70.0
WaltherA = Annotated[float, _oil("walther_a")]
WaltherB = Annotated[float, _oil("walther_b")]
Slope = Annotated[float, _oil("conductivity_slope_w_m_k2"), Usual(-0.001, 0.001)]

OIL = "mohammadpour_2015"
_SHEET = ("viscosity_40_degc_mm2_s", "viscosity_100_degc_mm2_s")
_WALTHER = ("walther_a", "walther_b")
_RHEOLOGY = ("alpha_per_gpa", "eyring_stress_mpa", "conductivity_w_m_k", "heat_capacity_j_kg_k")


class Housing(ModelSection):
    """The gear in its oil."""

    sources: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("ring_diameter_mm", "ring_width_mm", "immersion_mm", "oil_volume_l"), _NO_SOURCE
    )

    churning: ChurningLaw | None = Field(
        default=None,
        description="Law of the gear's churning loss; left out: changenet_velex_2007 if this "
        "section has any field, else none",
    )
    ring_diameter_mm: Size | None = Field(default=None, description="Outside diameter of the gear")
    ring_width_mm: Width | None = Field(default=None, description="Face width of the gear")
    immersion_mm: Depth | None = Field(
        default=None,
        description="Depth of the lowest point of the gear below the oil level at standstill",
    )
    oil_volume_l: Litres | None = Field(default=None, description="Volume of oil in the axle")

    @model_validator(mode="after")
    def _check_depth(self) -> Housing:
        depth, diameter = self.immersion_mm, self.ring_diameter_mm
        if depth is not None and diameter is not None and depth > diameter:
            raise ValueError(
                f"immersion_mm must be at most ring_diameter_mm, {diameter:g} mm, got {depth:g} "
                "mm; a third of it is usual"
            )
        return self

    def housing_changes(self, axle: HypoidAxleParameters) -> dict[str, Any]:
        """Return the given fields in SI units, and the law where it follows from them."""
        given = self.changes(axle)
        return {"churning": DEFAULT_CHURNING} | given if given else given

    def housing_notes(self, prefix: str, axle: HypoidAxleParameters) -> list[InputNote]:
        """Return a note on every field; without churning its numbers play no part."""
        why = "default law" if axle.churning != "none" else "no field of [housing]: not modelled"
        notes = self.notes(prefix, axle, why)
        if axle.churning == "none":
            return [note for note in notes if note.field == f"{prefix}churning"]
        return notes


class Seals(ModelSection):
    """The radial seals of the shafts, and the bearings of the wheel hubs."""

    renamed: ClassVar[Mapping[str, str]] = {
        "pinion_torque_n_m": "pinion_seal_torque",
        "wheel_torque_n_m": "wheel_seal_torque",
        "hub_torque_n_m": "hub_torque",
    }

    pinion_diameter_mm: ShaftSize | None = Field(
        default=None,
        description="Diameter of the pinion shaft under the seal lip; give this or the torque",
    )
    wheel_diameter_mm: ShaftSize | None = Field(
        default=None,
        description="Diameter of each wheel shaft under the seal lip; give this or the torque",
    )
    material: SealMaterial | None = Field(
        default=None,
        description="Material of the lip: fluorocarbon (fkm) or nitrile rubber; any: torque by the "
        "oil's viscosity and temperature, ISO/TR 14179-2; left out: fkm",
    )
    oil_temperature_degc: Temperature | None = Field(
        default=None, description="Temperature of the oil, for material = any; left out: 70"
    )
    wheel_factor: Annotated[float, Field(ge=1.0, le=5.0)] | None = Field(
        default=None,
        description="Factor of the torque of wheel_diameter_mm; 1.5 to 3 with grease or dust lips",
    )
    pinion_torque_n_m: Torque | None = Field(
        default=None, description="Friction torque of the pinion seal"
    )
    wheel_torque_n_m: Torque | None = Field(
        default=None, description="Friction torque of the seals of both wheels together"
    )
    hub_torque_n_m: Torque | None = Field(
        default=None,
        description="Friction torque of the bearings of both wheel hubs together, for their own "
        "load and grease",
    )

    @model_validator(mode="after")
    def _check_seals(self) -> Seals:
        for shaft in ("pinion", "wheel"):
            if self.has(f"{shaft}_diameter_mm") and self.has(f"{shaft}_torque_n_m"):
                raise ValueError(
                    f"{shaft}_diameter_mm and {shaft}_torque_n_m describe the same loss; give one "
                    "of them"
                )
        for given, asked, there in (
            ("wheel_factor", "wheel_diameter_mm", self.has("wheel_diameter_mm")),
            ("oil_temperature_degc", 'material = "any"', self.material == "any"),
        ):
            if self.has(given) and not there:
                raise ValueError(f"{given} is only for {asked}, got it without; leave it out")
        return self

    def seal_changes(self, oil: Lubricant) -> dict[str, float]:
        """Return the torques that the section gives [N.m]."""
        found = {}
        if self.hub_torque_n_m is not None:
            found["hub_torque"] = float(self.hub_torque_n_m)
        nu_40 = oil.dynamic_viscosity(celsius_to_kelvin(40.0)) / oil.density
        degc = _SEAL_DEGC if self.oil_temperature_degc is None else self.oil_temperature_degc
        warm, of_wheels = (celsius_to_kelvin(degc), nu_40), _WHEEL_SEALS * (self.wheel_factor or 1)
        for shaft, factor in (("pinion", 1.0), ("wheel", of_wheels)):
            if self.has(f"{shaft}_torque_n_m"):
                found[f"{shaft}_seal_torque"] = float(self.si(f"{shaft}_torque_n_m"))
            elif self.has(f"{shaft}_diameter_mm"):
                torque = seal_torque(self.si(f"{shaft}_diameter_mm"), self.material or "fkm", *warm)
                found[f"{shaft}_seal_torque"] = factor * torque
        return found

    def seal_notes(self, prefix: str, axle: HypoidAxleParameters) -> list[InputNote]:
        """Return a note on every field."""
        part = 2 if self.material == "any" else 1
        inferred = {
            f"{shaft}_torque_n_m": f"{shaft}_diameter_mm, ISO/TR 14179-{part}"
            for shaft in ("pinion", "wheel")
            if self.has(f"{shaft}_diameter_mm")
        }
        return self.notes(prefix, axle, "no field of [seals]: not modelled", inferred)


class OilSection(ModelSection):
    """A shipped oil, or what differs from it."""

    name: Text | None = Field(
        default=None,
        description="Name of a shipped oil; fields that are left out are taken from it",
    )
    file: Text | None = Field(
        default=None,
        description="Oil file (.toml), its path relative to the axle file; give it alone, "
        "without any other field of this section",
    )
    viscosity_40_degc_mm2_s: Viscosity | None = Field(
        default=None, description="Kinematic viscosity at 40 degC; give also that at 100 degC"
    )
    viscosity_100_degc_mm2_s: ViscosityAt100 = None
    walther_a: WaltherA | None = Field(
        default=None,
        description="A of Walther's equation log log(nu + 0.7) = A - B log T, nu in mm2/s, T in "
        "K; with walther_b, instead of the two viscosities",
    )
    walther_b: WaltherB | None = Field(default=None, description="B of Walther's equation")
    density_kg_m3: Density | None = Field(
        default=None, description="Density, taken as constant at all temperatures"
    )
    alpha_per_gpa: Alpha = None
    alpha_is: AlphaMeaning = None
    alpha_pressure_gpa: AlphaPressure = None
    alpha_temperature_degc: AlphaTemperature = None
    eyring_stress_mpa: EyringStress = None
    limiting_shear_stress_mpa: ShearStrength = None
    boundary_friction: BoundaryFriction = None
    conductivity_w_m_k: OilConductivity = None
    conductivity_temperature_degc: Temperature | None = Field(
        default=None, description="Temperature to which conductivity_w_m_k belongs"
    )
    conductivity_slope_w_m_k2: Slope | None = Field(
        default=None, description="Change of the conductivity with temperature"
    )
    heat_capacity_j_kg_k: OilHeatCapacity = None
    temperature_low_degc: LowestTemperature = None
    temperature_high_degc: HighestTemperature = None

    @model_validator(mode="after")
    def _check_oil(self) -> OilSection:
        problems = []
        if self.file is not None:
            others = [key for key in type(self).model_fields if key != "file" and self.has(key)]
            if others:
                raise ValueError(
                    f"file must be the only field of this section, got also {', '.join(others)}; "
                    "write these into the oil file"
                )
            return self
        if self.name is not None and self.name not in lubricant_names():
            problems.append(
                f"name must be one of {', '.join(lubricant_names())}, got {self.name!r}; for "
                "another oil give its data in place of the name, or an oil file"
            )
        for pair in (_SHEET, _WALTHER):
            given = [key for key in pair if self.has(key)]
            if len(given) == 1:
                problems.append(
                    f"{pair[0]} and {pair[1]} must be given together, got only {given[0]}"
                )
        if self.has(_SHEET[0]) and self.has(_WALTHER[0]):
            problems.append(
                "the two viscosities and walther_a, walther_b are "
                "two ways to give the viscosity; give one"
            )
        if not problems and not self.is_shipped:
            try:
                self.oil()
            except ParameterError as reason:
                problems = [f"In SI units: {str(reason).removesuffix('.')}"]
        if problems:
            raise ValueError(". ".join(problems))
        return self

    @property
    def is_shipped(self) -> bool:
        """Whether it is a shipped oil as it stands there."""
        return not any(self.has(key) for key in type(self).model_fields if key != "name")

    def oil(self) -> Lubricant:
        """Return the oil; `file` is not read here."""
        base = Lubricant.named(self.name or OIL)
        if self.is_shipped:
            return base
        changes = self.changes(base) | {"name": f"own oil, rest as {base.name}"}
        if self.has(_SHEET[0]):
            # the line alone: other data may not fit together before all are changed
            line = base.with_two_viscosities(
                1e-6 * float(self.viscosity_40_degc_mm2_s or 0.0),
                celsius_to_kelvin(40.0),
                1e-6 * float(self.viscosity_100_degc_mm2_s or 0.0),
                celsius_to_kelvin(100.0),
                name=base.name,
            )
            changes |= {"walther_a": line.walther_a, "walther_b": line.walther_b}
        if self.has("eyring_stress_mpa"):
            changes["eyring_slope"] = 0.0  # the number holds at all pressures
        return replace(base, **changes)

    def rheology_notes(self, prefix: str, made: Lubricant) -> list[InputNote]:
        """Return notes on what solved films take of a shipped oil, which its name alone hides.

        Of another oil `oil_notes` has them.
        """
        if self.name is None or not self.is_shipped:
            return []
        data = read_library()[made.name]["data"]
        notes = []
        for key in _RHEOLOGY:
            name = self.attribute(key)
            _, tag, source = data[name]
            origin: Origin = "assumed" if tag == "assumed" else "inferred"
            value = field_value(key, getattr(made, name))
            why = f"shipped oil {made.name}, {tag}: {source}"
            notes.append(InputNote(prefix + key, value, unit_of(key), origin, why))
        return notes

    def oil_notes(
        self, prefix: str, made: Lubricant, of_file: DescribedOil | None = None
    ) -> list[InputNote]:
        """Return a note on every field; `made` is what `oil` returned, or that of the file."""
        if of_file is not None:
            named = InputNote(f"{prefix}file", self.file, "", "given", "")
            return [named, *(n._replace(field=f"{prefix}{n.field}") for n in of_file.inputs)]
        inferred = dict.fromkeys(_WALTHER, "the two viscosities") if self.has(_SHEET[0]) else {}
        if self.is_shipped and self.name is not None:
            return [InputNote(f"{prefix}name", self.name, "", "given", "")]
        notes = self.notes(prefix, made, f"shipped oil {self.name or OIL}", inferred)
        if self.name is None:
            assumed = InputNote(f"{prefix}name", OIL, "", "assumed", "oil of the paper's axle")
            notes = [assumed, *(note for note in notes if note.field != f"{prefix}name")]
        return notes
