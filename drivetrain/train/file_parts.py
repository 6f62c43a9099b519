"""Parts of a train that are read from other files, such as the gears of a mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Generic, TypeVar

from pydantic import Field

from drivetrain.axle_file.bearing_section import BearingSection
from drivetrain.axle_file.read_axle import read_axle
from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.parameters import (
    Film,
    Friction,
    HelicalMarchParameters,
)
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.contact_stations import contact_fields
from gearlube_core.dynamics.train.ripple_table import RippleTable
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import chosen_model
from gearlube_core.film_model.model import ROLLER, FilmModel
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.housings.model_files import read_reduced_model
from gearlube_core.housings.reduced_model import Length, Mass, ReducedModel
from gearlube_core.input_file.field_notes import Declared
from gearlube_core.input_file.input_file import Section, read_toml
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh, read_line_mesh
from gearlube_core.shafts.beam import Beam
from gearlube_core.shafts.rotor_matrices import read_rotor

Text = Annotated[str, Field(min_length=1)]
_Value = TypeVar("_Value")


class HelicalGears(Section):
    """Gears of a helical mesh."""

    files: ClassVar[tuple[str, ...]] = ("gear_file", "line_mesh")

    gear_file: Text = Field(
        description="Gear file (.toml) of the pair, or the name of a shipped one"
    )
    line_mesh: Text | None = Field(
        default=None,
        description="Line mesh (.nc) of `gearlube helical`, or the name of a shipped pair that has "
        "one; left out: the stiffness of ISO 6336-1",
    )
    friction: Friction | None = Field(default=None, description="Friction of the flanks; film")
    boundary_friction: (
        Annotated[float, Declared(HelicalMarchParameters, "boundary_friction")] | None
    ) = Field(
        default=None,
        description="Friction coefficient of asperities, of the friction arana_2019; 0.07",
    )
    film: Film | None = Field(
        default=None, description="Films by formulas or solved films; left out: as in the gear file"
    )

    def read(self) -> HelicalMarchParameters:
        """Return gears, stiffness and friction."""
        mesh = None if self.line_mesh is None else _line_mesh(self.line_mesh)
        options = self.model_dump(
            include={"friction", "boundary_friction", "film"}, exclude_none=True
        )
        found = helical_march_parameters(HelicalGearFile.given(self.gear_file), line_mesh=mesh)
        return replace(found, **options)


class ContactGears(Section):
    """Gears of a mesh with stations, and what their loaded contact gives."""

    files: ClassVar[tuple[str, ...]] = ("gear_file", "line_mesh")

    gear_file: Text = Field(
        description="Gear file (.toml) of a helical or spur pair, or the name of a shipped one"
    )
    line_mesh: Text = Field(
        description="Its line mesh (.nc) of `gearlube helical`, or the name of a shipped pair that "
        "has one"
    )
    contact_torque_n_m: Annotated[float, Field(allow_inf_nan=False)] = Field(
        description="Torque of the pinion for which stiffness and gaps are taken, within those of "
        "the line mesh"
    )
    stations: Annotated[int, Field(ge=1, le=99)] = Field(
        default=9, description="Stations across the face"
    )
    right_hand: bool = Field(
        default=False, description="Whether the teeth of the pinion, gear 1, are right-handed"
    )
    drives_forward: bool = Field(
        default=True, description="Whether the pinion drives about +z; else about -z"
    )

    def read(self) -> dict[str, Any]:
        """Return the fields of the mesh that follow from its gears."""
        return contact_fields(
            _cylindrical(self.gear_file).helical_pair(),
            _line_mesh(self.line_mesh),
            self.contact_torque_n_m,
            stations=self.stations,
            right_hand=self.right_hand,
            drives_forward=self.drives_forward,
        )


def _cylindrical(name: str) -> HelicalGearFile:
    data = read_toml(name, "gear file") if name.endswith(".toml") else {}
    pinion = data.get("pinion")
    if isinstance(pinion, dict) and "machine" in pinion:
        raise ParameterError(
            f"gear_file must be of gears on parallel axes, got {name} of a hypoid pair, whose "
            "contact is no line along the face. Take a hypoid_mesh, or give the numbers of a "
            "gear_mesh."
        )
    return HelicalGearFile.given(name)


def _line_mesh(name: str) -> LineMesh:
    path = Path(name)
    return read_line_mesh(path) if path.suffix else named_line_mesh(name)


class HypoidGears(Section):
    """Gears of a hypoid mesh."""

    files: ClassVar[tuple[str, ...]] = ("axle_file",)

    axle_file: Text = Field(
        description="Axle file (.toml) whose mesh, friction and films are taken, or the name of a "
        "shipped one"
    )

    def read(self) -> HypoidAxleParameters:
        """Return mesh table, damping, friction and films."""
        return read_axle(self.axle_file).axle


class RollerFilmModel(Section):
    """Film model of the rollers of a bearing."""

    files: ClassVar[tuple[str, ...]] = ("film_model",)

    film_model: Text | None = Field(
        default=None,
        description="Film model of rollers (.json) for torque_loss solved_films, or its name in "
        "the package; left out: that of the package",
    )

    def read(self) -> FilmModel | None:
        """Return the model, or None."""
        if self.film_model is None:
            return None
        return chosen_model(self.film_model, ROLLER, "film_model")


class HousingModel(Section):
    """Reduced model of a housing."""

    files: ClassVar[tuple[str, ...]] = ("model_file", "mass_file", "damping_file", "node_table")

    model_file: Text = Field(
        description="Reduced model: arrays (.npz), a punch file of Nastran (.pch), a substructure "
        "of Abaqus (.mtx), the stiffness alone as a Matrix Market file (.mtx), or the shipped "
        "e_axle_case"
    )
    mass_file: Text | None = Field(
        default=None, description="Mass matrix, where model_file has the stiffness alone"
    )
    damping_file: Text | None = Field(default=None, description="Damping matrix, beside mass_file")
    node_table: Text | None = Field(
        default=None,
        description="Table of nodes (.csv): node, name, x, y, z; not for .npz",
    )
    length_unit: Length = Field(default="m", description="Length unit of matrices and node_table")
    mass_unit: Mass = Field(default="kg", description="Mass unit of matrices; t with N/mm")

    def read(self) -> ReducedModel:
        """Return the model."""
        return read_reduced_model(**{key: getattr(self, key) for key in HousingModel.model_fields})


class RotorMatrices(Section):
    """Matrices of a shaft from another program."""

    files: ClassVar[tuple[str, ...]] = ("matrices_file",)

    matrices_file: Text | None = Field(
        default=None,
        description="Matrices of another program (.npz) instead of sections and discs",
    )

    def read(self) -> Beam | None:
        """Return the rotor, or None."""
        return None if self.matrices_file is None else read_rotor(self.matrices_file)


@dataclass(frozen=True)
class _Reader(Generic[_Value]):
    """How a field that is a part is read.

    Its fields stand in the section of the element itself, or, `nested`, in one of their own.
    """

    section: type[Section]
    read: Callable[[Any], _Value]
    nested: bool = False


class Ripple(Section):
    """Torque ripple and pull of a motor."""

    files: ClassVar[tuple[str, ...]] = ("ripple_table",)

    ripple_table: Text | None = Field(
        default=None,
        description="Table (.csv) of ripple and pull by order, speed and torque, or the name of a "
        "shipped one; left out: none",
    )

    def read(self) -> RippleTable | None:
        """Return the table, or None."""
        return None if self.ripple_table is None else RippleTable.given(self.ripple_table)


READERS: Mapping[Any, _Reader[Any]] = {
    HelicalMarchParameters: _Reader(HelicalGears, HelicalGears.read),
    HypoidAxleParameters: _Reader(HypoidGears, HypoidGears.read),
    ReducedModel: _Reader(HousingModel, HousingModel.read),
    FilmModel | None: _Reader(RollerFilmModel, RollerFilmModel.read),
    Beam | None: _Reader(RotorMatrices, RotorMatrices.read),
    RippleTable | None: _Reader(Ripple, Ripple.read),
    Bearing: _Reader(BearingSection, BearingSection.bearing, nested=True),
}
