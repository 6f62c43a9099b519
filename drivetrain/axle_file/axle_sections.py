"""The sections of the axle file on gear set, steel and model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from pydantic import Field, model_validator

from drivetrain.axle_file.section import ModelSection
from gearlube_core.bearings.followed_shaft import TORQUE_LOSSES
from gearlube_core.bearings.tapered_roller_bearing import Approach
from gearlube_core.contact.solid import Solid
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    Equations,
    Film,
    HypoidAxleParameters,
    MeshDamping,
    MeshStiffness,
    Radii,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import chosen_model
from gearlube_core.film_model.model import FLANK, ROLLER, SHIPPED, FilmModel
from gearlube_core.friction.flank_friction import friction_law, friction_laws
from gearlube_core.friction.flank_rolling import FlankRolling
from gearlube_core.input_file.field_notes import Declared, OneOf, Usual
from gearlube_core.input_file.input_file import InputNote

_axle, _solid = partial(Declared, HypoidAxleParameters), partial(Declared, Solid)
Text = Annotated[str, Field(min_length=1)]
Torque = Annotated[float, Field(ge=0.01, le=1e5, allow_inf_nan=False), Usual(1.0, 20000.0)]
Torques = Annotated[tuple[Torque, ...], Field(strict=False, min_length=1)]
# um; the runout of cut gears alone is more than 10 um, so that they would jam
Backlash = Annotated[float, _axle("backlash_um"), Usual(10.0, 1000.0)]
Roughness = Annotated[float, _axle("roughness_rms_um"), Usual(0.02, 5.0)]
LossFactor = Annotated[float, _axle("modal_loss_factor")]
Hysteresis = Annotated[float, _axle("hysteretic_loss")]
Floor = Annotated[float, _axle("frequency_floor_hz"), Usual(1.0, 1000.0)]
Modulus = Annotated[float, _solid("youngs_modulus_gpa"), Usual(50.0, 700.0)]
Poisson = Annotated[float, _solid("poisson_ratio")]
Density = Annotated[float, _solid("density_kg_m3"), Usual(2000.0, 20000.0)]
Conductivity = Annotated[float, _solid("conductivity_w_m_k"), Usual(5.0, 500.0)]
BulkResistance = Annotated[
    float, _axle("bulk_resistance_k_w", "flank_bulk_resistance"), Usual(0.001, 2.0)
]
LimitingSlope = Annotated[float, _axle("limiting_slope", "film_limiting_slope")]
HeatCapacity = Annotated[float, _solid("heat_capacity_j_kg_k"), Usual(100.0, 2000.0)]


class GearSet(ModelSection):
    """The gear pair: its mesh table, and how its force acts."""

    sources: ClassVar[Mapping[str, str]] = {
        "backlash_um": "Karagiannis et al. 2012",
        "roughness_rms_um": "Karagiannis et al. 2012",
        "hysteretic_loss": "Mohammadpour et al. 2015 (4)",
    }

    mesh_table: Text | None = Field(
        default=None,
        description="Name of a shipped mesh table, or a file (.nc) written by `gearlube "
        "contact`, its path relative to the axle file; give this or gear_file",
    )
    gear_file: Text | None = Field(
        default=None,
        description="Gear file (.toml) of a hypoid pair, its path relative to the axle file; "
        "its loaded contact is analysed once and kept beside it",
    )
    contact_torques_n_m: Torques | None = Field(
        default=None,
        description="Pinion torques at which the gears of gear_file are analysed, rising, for "
        "both flanks; left out: 5, 10, 20, 50, 100, 200, 300, 400",
    )
    backlash_um: Backlash | None = Field(
        default=None, description="Total backlash, along the line of action"
    )
    roughness_rms_um: Roughness | None = Field(
        default=None, description="Composite RMS roughness of both flanks"
    )
    asperity_table: Text | None = Field(
        default=None,
        description="File (.nc) written by `gearlube roughness flow-factors`, its path relative "
        "to the axle file; Greenwood and Tripp's law is fitted to it; left out: finished gear "
        "flanks",
    )
    radii: Radii | None = Field(default=None, description="Radii at which the mesh force acts")
    mesh_stiffness: MeshStiffness | None = Field(
        default=None,
        description="Stiffness of the mesh under load: tangent or secant of its force over "
        "deflection",
    )
    mesh_damping: MeshDamping | None = Field(default=None, description="Law of the mesh damping")
    modal_loss_factor: LossFactor | None = Field(
        default=None, description="Only for modal damping: twice the damping ratio of the mesh"
    )
    hysteretic_loss: Hysteresis | None = Field(
        default=None, description="Coefficient of the hysteretic damping"
    )
    frequency_floor_hz: Floor | None = Field(
        default=None, description="Lowest mesh frequency used in the law of the hysteretic damping"
    )

    @model_validator(mode="after")
    def _check_gears(self) -> GearSet:
        if self.mesh_table is None and self.gear_file is None:
            raise ValueError(
                "mesh_table or gear_file must be given, got neither; write "
                'gear_file = "my_gears.toml", or mesh_table = "mohammadpour_2015", which ships'
            )
        if self.mesh_table is not None and self.gear_file is not None:
            raise ValueError(
                f"give mesh_table or gear_file, not both, got {self.mesh_table!r} and "
                f"{self.gear_file!r}; leave out mesh_table if the gear file is to be analysed"
            )
        if self.gear_file is not None and not self.gear_file.endswith(".toml"):
            raise ValueError(
                "gear_file must be a gear file, a name that ends in .toml, got "
                f"{self.gear_file!r}; give a mesh table in the field mesh_table"
            )
        if self.contact_torques_n_m is not None:
            if self.gear_file is None:
                raise ValueError(
                    "contact_torques_n_m is only for gear_file, got mesh_table, which has torques "
                    "of its own; leave it out"
                )
            if any(np.diff(self.contact_torques_n_m) <= 0.0):
                raise ValueError(
                    f"contact_torques_n_m must rise, got {list(self.contact_torques_n_m)} N.m; "
                    "sort them"
                )
        return self

    @property
    def named(self) -> str:
        """Name of the gears: a gear file, the file of a mesh table, or a shipped one."""
        return self.gear_file or self.mesh_table or ""

    @model_validator(mode="after")
    def _check_damping(self) -> GearSet:
        if self.mesh_damping == "modal" and self.modal_loss_factor == 0.0:
            raise ValueError(
                "modal_loss_factor must be above 0 with modal mesh_damping, got 0; give about "
                "0.06, or take hysteretic damping"
            )
        return self


class Steel(ModelSection):
    """The solid of flanks, rollers and races."""

    youngs_modulus_gpa: Modulus | None = Field(default=None, description="Young's modulus E")
    poisson_ratio: Poisson | None = Field(default=None, description="Poisson's ratio nu")
    density_kg_m3: Density | None = Field(default=None, description="Density of the solid")
    conductivity_w_m_k: Conductivity | None = Field(
        default=None, description="Thermal conductivity"
    )
    heat_capacity_j_kg_k: HeatCapacity | None = Field(
        default=None, description="Specific heat capacity"
    )


class SolidOfRevolution(NamedTuple):
    """Mass [kg] and inertia about the axis [kg m2]."""

    mass: float
    inertia: float


def stacked_frusta(
    lengths: tuple[float, ...],
    first: tuple[float, ...],
    last: tuple[float, ...],
    bores: tuple[float, ...],
    density: float,
) -> SolidOfRevolution:
    """Return mass and inertia of frusta of cones on one axis, each with a bore.

    m = rho pi l [(r1^2 + r1 r2 + r2^2)/3 - rb^2]
    I = rho pi l [(r1^4 + r1^3 r2 + r1^2 r2^2 + r1 r2^3 + r2^4)/10 - rb^4/2]

    Parameters
    ----------
    lengths, first, last, bores
        Length along the axis, diameters of the two ends, and of the bore [m], shape (n,).
    density
        [kg/m3]
    """
    mass = inertia = 0.0
    for length, one, two, bore in zip(lengths, first, last, bores, strict=True):
        r1, r2, rb = 0.5 * one, 0.5 * two, 0.5 * bore
        area = (r1**2 + r1 * r2 + r2**2) / 3.0 - rb**2
        mass += density * math.pi * length * area
        fourth = sum(r1 ** (4 - k) * r2**k for k in range(5)) / 10.0 - 0.5 * rb**4
        inertia += density * math.pi * length * fourth
    return SolidOfRevolution(mass, inertia)


class OwnFilmModels(NamedTuple):
    """The film models that an axle file names; None: those in the package."""

    flank: FilmModel | None = None
    roller: FilmModel | None = None


class FilmSection(ModelSection):
    """Film and friction of the oil on the flanks."""

    renamed: ClassVar[Mapping[str, str]] = {
        "model": "film",
        "limiting_slope": "film_limiting_slope",
        "bulk_resistance_k_w": "flank_bulk_resistance",
        # no attributes, but models that are read, see `own_models`
        "flank_model": "file_of_flank_model",
        "roller_model": "file_of_roller_model",
    }

    model: Film | None = Field(
        default=None,
        description="formula: Chittenden 1985 with Evans and Johnson 1986; solved: a model of "
        "solved thermal Eyring films, and the formulas outside its domain",
    )
    flank_model: Text | None = Field(
        default=None,
        description="Film model of flanks for model = solved: file (.json) of `gearlube film-model "
        "fit`, its path relative to the axle file, or the name of a shipped one; left out: "
        "hypoid_flank",
    )
    roller_model: Text | None = Field(
        default=None,
        description="Film model of rollers, likewise, for model.bearing_torque_loss = "
        "solved_films; left out: roller_race",
    )
    limiting_slope: LimitingSlope | None = Field(
        default=None,
        description="Limiting shear stress of the film over pressure, for solved films; 0: none",
    )
    bulk_resistance_k_w: BulkResistance | None = Field(
        default=None,
        description="Temperature of the flanks' bulk over the oil's, for each watt of their mean "
        "friction; for maps and cycles. 0: at the oil's temperature",
    )

    @model_validator(mode="after")
    def _check_flank_model(self) -> FilmSection:
        if self.flank_model is not None and self.model != "solved":
            raise ValueError(
                f"flank_model is only for model = solved, got {self.flank_model!r} with model "
                f'{self.model or "left out"}; write model = "solved", or leave flank_model out'
            )
        return self

    def model_notes(self, axle: HypoidAxleParameters) -> list[InputNote]:
        """Return notes on the shipped film models that an axle takes; those given have theirs."""
        taken = {
            "flank_model": (axle.film == "solved", FLANK),
            "roller_model": (axle.bearing_torque_loss == "solved_films", ROLLER),
        }
        return [
            InputNote(f"film.{key}", SHIPPED[kind], "", "assumed", "model in the package")
            for key, (takes, kind) in taken.items()
            if takes and not self.has(key)
        ]

    def own_models(self, folder: Path = Path()) -> OwnFilmModels:
        """Return the film models that are named; `folder` is that of the file.

        Raises
        ------
        FileError, ParameterError
            A model is missing, damaged or of another kind.
        """
        flank, roller = self.flank_model, self.roller_model
        return OwnFilmModels(
            None if flank is None else chosen_model(flank, FLANK, "film.flank_model", folder),
            None if roller is None else chosen_model(roller, ROLLER, "film.roller_model", folder),
        )


class ModelOptions(ModelSection):
    """How the axle is computed."""

    renamed: ClassVar[Mapping[str, str]] = {"flank_rolling": "rolling"}

    equations: Equations | None = Field(
        default=None,
        description="Equations of motion: consistent with misprints of the paper corrected, or "
        "as printed in it",
    )
    friction: Annotated[str, OneOf(friction_laws)] | None = Field(
        default=None,
        description="Friction law of the flanks, or the name of a law of your own",
    )
    friction_numbers: dict[str, float] | None = Field(
        default=None,
        description="Numbers of a friction law that has some, by name, in SI units",
    )
    flank_rolling: FlankRolling | None = Field(
        default=None, description="Rolling loss of the flanks"
    )
    bearing_torque_loss: Annotated[str, OneOf(lambda _: TORQUE_LOSSES)] | None = Field(
        default=None,
        description="Drag torque of the bearings. palmgren: under the preload; palmgren_loaded, "
        "skf_2013: under the forces on each bearing; others: raceways, ribs and oil, under the "
        "load of each roller; solved_films: the raceways by a model of solved films",
    )
    bearing_approach: Approach | None = Field(
        default=None,
        description="Approach of a roller to the races under a shaft displacement: all of it, "
        "or half",
    )
    steps_per_mesh_period: Annotated[int, _axle("steps_per_mesh_period")] | None = Field(
        default=None, description="Integration steps in one mesh period"
    )
    steps_per_highest_period: Annotated[int, _axle("steps_per_highest_period")] | None = Field(
        default=None, description="Integration steps in one period of the highest natural frequency"
    )

    @model_validator(mode="after")
    def _check_friction(self) -> ModelOptions:
        if self.friction_numbers is not None:
            try:
                friction_law(self.friction or "consistent", **self.friction_numbers)
            except ParameterError as reason:
                raise ValueError(str(reason).removesuffix(".")) from None
        return self

    def changes(self, model: object) -> dict[str, Any]:
        """Return the given fields that are attributes of `model`, in SI units."""
        found = super().changes(model)
        if self.friction is not None and self.friction_numbers:
            found["friction"] = friction_law(self.friction, **self.friction_numbers)
        return found

    def notes(
        self, prefix: str, model: object, why: str, inferred: Mapping[str, str] | None = None
    ) -> list[InputNote]:
        """Return the notes of `ModelSection.notes`, and one on each number of the friction law."""
        given = self.friction_numbers or {}
        notes = super().notes(prefix, model, why, inferred)
        notes = [one for one in notes if one.field != f"{prefix}friction_numbers"]
        law = friction_law(self.friction or "consistent", **given)
        return notes + law.notes(f"{prefix}friction_numbers.", given)
