"""The axle file: an axle and its car in engineers' units, and the parameters that it gives."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, ClassVar

from pydantic import Field, model_validator

from drivetrain.axle_file.axle_sections import (
    FilmSection,
    GearSet,
    ModelOptions,
    OwnFilmModels,
    Steel,
)
from drivetrain.axle_file.bearing_section import BearingSection, Member
from drivetrain.axle_file.car_sections import (
    DrivelineSection,
    EngineSection,
    GearboxSection,
    TyreSection,
    VehicleSection,
)
from drivetrain.axle_file.oil_section import Housing, OilSection, Seals
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import FinalDrive, RoadLoad
from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile, InputNote, toml_data
from gearlube_core.input_file.tolerance import Tolerances, check_tolerances
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import DescribedOil, read_oil_file
from gearlube_core.rough_patch.asperity_file import (
    GreenwoodTrippFit,
    asperities_from_bytes,
    read_asperity_content,
)
from gearlube_core.storage.file_names import Name

Text = Annotated[str, Field(min_length=1)]

_STEEL = STEEL_MOHAMMADPOUR_2015
_TAPERED = TaperedRollerBearing.name
_PAPER = "Mohammadpour et al. 2015"
_BEARING = "Mohammadpour et al. 2015, Table A2"
_MODEL = "default of the model"
_CAR = "size for a 1300 kg car; no source"
_AS_PINION = "as the pinion's"


@dataclass(frozen=True, slots=True, kw_only=True)
class CarAxle:
    """An axle and its car, as `read_axle` returns them from an axle file.

    Parameters
    ----------
    name, source : str
        Name and source in the file.
    axle : HypoidAxleParameters
        Parameters of the axle model.
    driveline : DrivelineParameters
        The car from the crankshaft to the road; its final drive has the teeth of the mesh table.
    inputs : tuple of InputNote
        Every input with value, unit, and whether the file gives it.

    Examples
    --------
    >>> paper = AxleFile.named("mohammadpour_2015").car_axle()
    >>> note = next(note for note in paper.assumed if note.field == "gearbox.ratios")
    >>> note.value_text, note.origin
    ('3.6, 2.1, 1.4, 1, 0.8', 'assumed')
    """

    name: str
    source: str
    axle: HypoidAxleParameters
    driveline: DrivelineParameters
    inputs: tuple[InputNote, ...]

    @property
    def assumed(self) -> tuple[InputNote, ...]:
        """The inputs that the file does not give: assumed ones and those inferred from others."""
        return tuple(note for note in self.inputs if note.origin != "given")


class AxleFile(InputFile):
    """An axle and its car.

    Examples
    --------
    >>> AxleFile.shipped()
    ('mohammadpour_2015',)
    >>> AxleFile.named("mohammadpour_2015").car_axle().axle.gear_mass  # kg
    49.9
    """

    package: ClassVar[str] = "drivetrain.axle_file"
    title: ClassVar[str] = "axle file"
    files: ClassVar[tuple[str, ...]] = (
        "gear_set.mesh_table",
        "gear_set.gear_file",
        "gear_set.asperity_table",
        "oil.file",
        "film.flank_model",
        "film.roller_model",
    )
    absolute_files: ClassVar[bool] = False  # methods that read them take the folder

    name: Name = Field(default="axle", description="Name of the axle in reports")
    source: Text | None = Field(default=None, description="Where the numbers come from")
    gear_set: GearSet = Field(default={}, validate_default=True)  # type: ignore[arg-type]
    pinion: Member = Member()
    gear: Member = Member()
    steel: Steel = Steel()
    oil: OilSection = OilSection()
    housing: Housing = Housing()
    seals: Seals = Seals()
    model: ModelOptions = ModelOptions()
    film: FilmSection = FilmSection()
    vehicle: VehicleSection = VehicleSection()
    tyre: TyreSection = TyreSection()
    gearbox: GearboxSection = GearboxSection()
    engine: EngineSection = EngineSection()
    driveline: DrivelineSection = DrivelineSection()
    tolerances: Tolerances = Field(default={})

    @model_validator(mode="after")
    def _check_tolerances(self) -> AxleFile:
        if self.tolerances:
            check_tolerances(self.tolerances, field_notes(type(self)))
        return self

    @model_validator(mode="after")
    def _check_roller_model(self) -> AxleFile:
        law = self.model.bearing_torque_loss
        if self.film.roller_model is not None and law != "solved_films":
            raise ValueError(
                "film.roller_model is only for model.bearing_torque_loss = solved_films, got "
                f"{self.film.roller_model!r} with {law or 'that left out'}; give that law, or "
                "leave film.roller_model out"
            )
        return self

    @model_validator(mode="after")
    def _check_approach(self) -> AxleFile:
        kind = self.pinion.bearing and self.pinion.bearing.type
        if self.model.bearing_approach is not None and kind not in (None, _TAPERED):
            raise ValueError(
                f"model.bearing_approach is only for bearings of the type {_TAPERED}, got "
                f"{self.model.bearing_approach!r} with {kind}; leave it out"
            )
        return self

    @property
    def has_own_table(self) -> bool:
        """Whether the mesh table is a file, not a shipped one."""
        return self.gear_set.named.endswith((".nc", ".toml"))

    def own_table(self, folder: Path = Path()) -> Path | None:
        """Return the path of the mesh table; None where the file names a shipped one.

        Parameters
        ----------
        folder : Path
            Of the file.

        Raises
        ------
        ParameterError
            The file names a gear file, whose contact is to be analysed first.
        """
        named = self.gear_set.named
        if self.gear_set.gear_file is not None:
            raise ParameterError(
                f"The mesh table of {named} must be given, got none. Read the axle file with "
                "`gearlube.read_axle`, which analyses the gear file."
            )
        return folder / named if self.has_own_table else None

    def mesh(self, folder: Path = Path()) -> MeshTable:
        """Return the mesh table that the file names; errors as in `own_table`, and TableError."""
        path = self.own_table(folder)
        return shipped_mesh_table(self.gear_set.named) if path is None else read_mesh_table(path)

    def asperities(self, folder: Path = Path()) -> GreenwoodTrippFit | None:
        """Return the fit to the asperity table; `folder` is that of the file; None: no table."""
        table = self.gear_set.asperity_table
        if table is None:
            return None
        return asperities_from_bytes(read_asperity_content(folder / table), str(folder / table))

    def described_oil(self, folder: Path = Path()) -> DescribedOil | None:
        """Return the oil of the file's oil file; `folder` is that of the file; None: no such."""
        return None if self.oil.file is None else read_oil_file(folder / self.oil.file)

    def car_axle(
        self,
        mesh: MeshTable | None = None,
        asperities: GreenwoodTrippFit | None = None,
        oil: DescribedOil | None = None,
        films: OwnFilmModels | None = None,
        *,
        notes: bool = True,
    ) -> CarAxle:
        """Return the parameters of axle and car.

        Parameters
        ----------
        mesh : MeshTable, optional
            Of the file's gears; by default the one of `mesh`.
        asperities : GreenwoodTrippFit, optional
            Fit to the file's `asperity_table`; by default read where it names one.
        oil : DescribedOil, optional
            Of the file's `oil.file`; by default read where it names one.
        films : OwnFilmModels, optional
            Those that the file names; by default read where it names any.
        notes : bool
            Whether the result has the notes on its inputs, a third of the work.

        Raises
        ------
        ParameterError, TableError
            The fields contradict each other, the mesh table has no teeth of an axle, the asperity
            table is wrong, or a film model says nothing of the oil.
        FileError
            A film model is missing or damaged.
        """
        mesh = mesh or self.mesh()
        asperities = asperities or self.asperities()
        oil = oil or self.described_oil()
        lubricant = self.oil.oil() if oil is None else oil.lubricant
        axle = self._axle(mesh, asperities, lubricant, films or self.film.own_models())
        driveline = self._driveline(mesh)
        return CarAxle(
            name=self.name,
            source=self.source or "",
            axle=axle,
            driveline=driveline,
            inputs=tuple(self._notes(axle, driveline, asperities, oil)) if notes else (),
        )

    def _bearings(self, steel: Solid) -> tuple[Bearing, Bearing | None]:
        """Return the bearings of the pinion's shaft, and those of the gear's if they differ."""
        of_pinion = (self.pinion.bearing or BearingSection()).bearing()
        section = self.gear.bearing
        of_gear = None if section is None else section.bearing(of_pinion.preload_force())
        common = {"solid": steel, "approach": self.model.bearing_approach}

        def completed(one: Bearing) -> Bearing:
            has = {name: value for name, value in common.items() if value and hasattr(one, name)}
            return replace(one, **has)

        return completed(of_pinion), None if of_gear is None else completed(of_gear)

    def _axle(
        self, mesh: MeshTable, fit: GreenwoodTrippFit | None, oil: Lubricant, films: OwnFilmModels
    ) -> HypoidAxleParameters:
        base = mohammadpour_2015_axle(mesh=mesh)
        if fit is not None:
            base = replace(
                base,
                roughness_rms=fit.surface.sigma,
                xi_beta_sigma=fit.surface.xi_beta_sigma,
                sigma_over_beta=fit.surface.sigma_over_beta,
            )
        steel = replace(_STEEL, **self.steel.changes(_STEEL))
        bearing, gear_bearing = self._bearings(steel)
        density = float(steel.density)
        given = self.gear_set.changes(base) | self.model.changes(base) | self.film.changes(base)
        given |= self.pinion.member_changes("pinion", density)
        given |= self.gear.member_changes("gear", density)
        given |= self.housing.housing_changes(base) | self.seals.seal_changes(oil)
        axle = replace(
            base,
            **given,
            bearing=bearing,
            gear_bearing=gear_bearing,
            solid=steel,
            oil=oil,
            flank_film_model=films.flank,
            roller_film_model=films.roller,
        )
        axle.check_oil_of_models()
        return axle

    def _driveline(self, mesh: MeshTable) -> DrivelineParameters:
        road = RoadLoad(
            vehicle=self.vehicle.vehicle(),
            tyre=self.tyre.tyre(),
            final_drive=FinalDrive(pinion_teeth=mesh.pinion_teeth, gear_teeth=mesh.gear_teeth),
        )
        engine = self.engine.engine()
        base = DrivelineParameters(
            road_load=road, engine=engine, gearbox=self.gearbox.gearbox(engine.kind)
        )
        return replace(base, **self.driveline.changes(base))

    def _gear_file_notes(self, mesh: MeshTable) -> list[InputNote]:
        """Return the notes on the gear file's conversion."""
        notes = [
            InputNote(
                "gear_set.mesh_table", mesh.name, "", "inferred", "loaded contact of gear_file"
            )
        ]
        if self.gear_set.contact_torques_n_m is None:
            drive = tuple(float(one) for one in mesh.torque if one > 0.0)
            name, why = "gear_set.contact_torques_n_m", "default of `gearlube contact`"
            notes.append(InputNote(name, drive, "N.m", "assumed", why))
        return notes

    def _notes(
        self,
        axle: HypoidAxleParameters,
        car: DrivelineParameters,
        fit: GreenwoodTrippFit | None,
        oil: DescribedOil | None,
    ) -> list[InputNote]:
        of_table = {} if fit is None else {"roughness_rms_um": "asperity_table"}
        notes = self.gear_set.notes("gear_set.", axle, _MODEL, of_table)
        if self.gear_set.gear_file is not None:
            notes += self._gear_file_notes(axle.mesh)
        if fit is not None:
            notes += _fit_notes(fit)
        for role, member in (("pinion", self.pinion), ("gear", self.gear)):
            notes += member.member_notes(role, axle, float(axle.solid.density), _PAPER)
            section, prefix = member.bearing, f"{role}.bearing."
            if role == "gear" and section is None:
                notes.append(InputNote("gear.bearing", "", "", "assumed", _AS_PINION))
            else:
                made = axle.bearings[role == "gear"]
                notes += (section or BearingSection()).bearing_notes(prefix, made, _BEARING)
        notes += self.steel.notes("steel.", axle.solid, _PAPER)
        notes += self.oil.oil_notes("oil.", axle.oil, oil)
        notes += self.housing.housing_notes("housing.", axle)
        notes += self.seals.seal_notes("seals.", axle)
        notes += self.model.notes("model.", axle, _MODEL)
        notes += self.film.notes("film.", axle, _MODEL) + self.film.model_notes(axle)
        if axle.film == "solved":
            notes += self.oil.rheology_notes("oil.", axle.oil)
        if self.model.bearing_approach is None and isinstance(axle.bearing, TaperedRollerBearing):
            value = axle.bearing.approach
            notes.append(InputNote("model.bearing_approach", value, "", "assumed", _MODEL))
        road = car.road_load
        notes += self.vehicle.vehicle_notes("vehicle.", road.vehicle)
        notes += self.tyre.tyre_notes("tyre.", road.tyre)
        notes += self.gearbox.gearbox_notes("gearbox.", car.gearbox)
        notes += self.engine.engine_notes("engine.", car.engine)
        notes += self.driveline.notes("driveline.", car, _CAR)
        unusual = self.unusual_numbers()
        return [note._replace(why=unusual.get(note.field, note.why)) for note in notes]


def _fit_notes(fit: GreenwoodTrippFit) -> list[InputNote]:
    """Return the law fitted to the asperity table, and its misfit."""
    why = (
        f"fit to asperity_table; within h/sigma 0.5 to 3 it misses the load by a factor of "
        f"{fit.load_misfit:.3g} at most, the area by {fit.area_misfit:.3g}"
    )
    return [
        InputNote(
            f"gear_set.asperity_table.{name}", getattr(fit.surface, name), "", "inferred", why
        )
        for name in ("xi_beta_sigma", "sigma_over_beta")
    ]


def parsed_axle_file(content: bytes) -> AxleFile:
    """Return the axle file in bytes, e.g. in those of an FMU's resource."""
    return AxleFile.from_data(toml_data(content, "The axle file"), "The axle file")
