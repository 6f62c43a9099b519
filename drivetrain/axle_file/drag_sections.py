"""The sections of the axle file on oil level and shaft seals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from drivetrain.axle_file.model_section import ModelSection
from gearlube_core.drag.seals import SealMaterial, seal_torque
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_note import InputNote

Size = Annotated[float, Field(ge=10.0, le=3000.0, allow_inf_nan=False), Usual(50.0, 1000.0)]
Width = Annotated[float, Field(ge=1.0, le=1000.0, allow_inf_nan=False), Usual(5.0, 200.0)]
Depth = Annotated[float, Field(ge=0.0, le=3000.0, allow_inf_nan=False), Usual(2.0, 500.0)]
Litres = Annotated[float, Field(ge=0.01, le=1000.0, allow_inf_nan=False), Usual(0.2, 50.0)]
ShaftSize = Annotated[float, Field(ge=5.0, le=500.0, allow_inf_nan=False), Usual(10.0, 200.0)]
Torque = Annotated[float, Field(ge=0.0, le=100.0, allow_inf_nan=False), Usual(0.01, 20.0)]

DEFAULT_CHURNING = "changenet_velex_2007"
_NO_SOURCE = "size found in passenger cars; no source"
_WHEEL_SEALS = 2


class Housing(ModelSection):
    """The gear in its oil."""

    sources: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("ring_diameter_mm", "ring_width_mm", "immersion_mm", "oil_volume_l"), _NO_SOURCE
    )

    churning: Literal["none", "changenet_velex_2007", "boness_1989", "iso_tr_14179_2"] | None = (
        Field(
            default=None,
            description="Law of the gear's churning loss; left out: changenet_velex_2007 if this "
            "section has any field, else none",
        )
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
    """The radial seals of the shafts."""

    renamed: ClassVar[Mapping[str, str]] = {
        "pinion_torque_n_m": "pinion_seal_torque",
        "wheel_torque_n_m": "wheel_seal_torque",
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
        description="Material of the lip: fluorocarbon (fkm) or nitrile rubber; left out: fkm",
    )
    pinion_torque_n_m: Torque | None = Field(
        default=None, description="Friction torque of the pinion seal"
    )
    wheel_torque_n_m: Torque | None = Field(
        default=None, description="Friction torque of the seals of both wheels together"
    )

    @model_validator(mode="after")
    def _check_seals(self) -> Seals:
        for shaft in ("pinion", "wheel"):
            if self.has(f"{shaft}_diameter_mm") and self.has(f"{shaft}_torque_n_m"):
                raise ValueError(
                    f"{shaft}_diameter_mm and {shaft}_torque_n_m describe the same loss; give one "
                    "of them"
                )
        return self

    def seal_changes(self) -> dict[str, float]:
        """Return the torques that the section gives [N.m]."""
        found = {}
        for shaft, count in (("pinion", 1), ("wheel", _WHEEL_SEALS)):
            if self.has(f"{shaft}_torque_n_m"):
                found[f"{shaft}_seal_torque"] = float(self.si(f"{shaft}_torque_n_m"))
            elif self.has(f"{shaft}_diameter_mm"):
                diameter = float(self.si(f"{shaft}_diameter_mm"))
                found[f"{shaft}_seal_torque"] = count * seal_torque(
                    diameter, self.material or "fkm"
                )
        return found

    def seal_notes(self, prefix: str, axle: HypoidAxleParameters) -> list[InputNote]:
        """Return a note on every field."""
        inferred = {
            f"{shaft}_torque_n_m": f"{shaft}_diameter_mm, ISO/TR 14179-1"
            for shaft in ("pinion", "wheel")
            if self.has(f"{shaft}_diameter_mm")
        }
        return self.notes(prefix, axle, "no field of [seals]: not modelled", inferred)
