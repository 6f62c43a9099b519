"""HelicalPair.fmu: the helical pair of `gearlube_core` under FMI names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

from fmu_src.definition import Definition, Value
from fmu_src.helical_variables import CUSTOM, HELICAL_PAIR, LINE_MESH
from fmu_src.slave_base import CoSimulationSlave
from fmu_src.variable import Variable, started, taken_holder, with_own_oil
from gearlube_core.checks import read_content
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import OUTPUT_NAMES
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL, stated_oil
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    ReplacedBearings,
    helical_march_parameters,
)
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.errors import FileError, GearLubeError, ParameterError, TableError
from gearlube_core.film_model.chosen_model import check_oil, file_of_model, model_in
from gearlube_core.film_model.model import LINE, FilmModel, read_model_content, shipped_model
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.input_file.input_file import toml_data
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import (
    line_mesh_from_bytes,
    named_line_mesh,
    read_line_mesh_content,
)
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import FILE_IN_FMU as OIL_IN_FMU
from gearlube_core.oil.oil_file import described_oil_of, read_oil_content
from gearlube_core.part import files_of
from gearlube_core.units import rpm_to_rads

GEAR_FILE, LINE_MESH_FILE = "helical_gear.toml", "line_mesh.nc"  # among the FMU's resources
LINE_MODEL_FILE = "line_film_model.json"  # likewise


@dataclass(frozen=True, slots=True, kw_only=True)
class EmbeddedPair:
    """The gear pair whose files are inside an FMU, with its film model and its oil."""

    gear: HelicalGearFile
    line_mesh: LineMesh | None = None
    line_model: FilmModel | None = None
    oil: Lubricant | None = None


def chosen_pair(
    name: str, stiffness_model: str, embedded: EmbeddedPair | None
) -> tuple[HelicalGearFile, LineMesh | None]:
    """Return gear file and line mesh of gear.name and mesh.stiffness_model.

    Parameters
    ----------
    name, stiffness_model : str
        Literals of the two options.
    embedded : EmbeddedPair, optional
        What gear.name = custom stands for.

    Raises
    ------
    ParameterError, TableError
        The FMU carries no such files.
    """
    if name == CUSTOM and embedded is None:
        raise ParameterError(
            "gear.name must be one of the pairs that ship with gearlube, got custom: this FMU "
            "carries no gear file. Build one with `gearlube build-fmu --gear FILE`."
        )
    own = embedded if name == CUSTOM else None
    gear = own.gear if own else HelicalGearFile.named(name)
    line_mesh = None
    if stiffness_model == LINE_MESH:
        line_mesh = own.line_mesh if own else named_line_mesh(name)
        if line_mesh is None:
            raise ParameterError(
                "mesh.stiffness_model must be uniform, got line_mesh: this FMU carries no line "
                "mesh. Build one with `gearlube build-fmu --gear FILE --line-mesh FILE`."
            )
    return gear, line_mesh


def line_model_of(name: str, embedded: EmbeddedPair | None) -> FilmModel:
    """Return the film model of lines that a gear.name takes; its own only for custom."""
    own = embedded.line_model if embedded is not None and name == CUSTOM else None
    return own or shipped_model(LINE)


def pair_parameters(
    arguments: Mapping[str, Value], embedded: EmbeddedPair | None = None
) -> HelicalMarchParameters:
    """Return the parameters of a pair.

    Parameters
    ----------
    arguments : mapping
        `gear_name`, `stiffness_model`, `stiffness_density`, `oil`, and fields of
        `ReplacedBearings` and `HelicalMarchParameters`.
    embedded : EmbeddedPair, optional
        What gear.name = custom stands for.
    """
    given: dict[str, Any] = dict(arguments)
    name = str(given.pop("gear_name"))
    gear, line_mesh = chosen_pair(name, str(given.pop("stiffness_model")), embedded)
    oil = given.pop("oil")
    parameters = helical_march_parameters(
        gear,
        line_mesh=line_mesh,
        stiffness_density=given.pop("stiffness_density"),
        oil=oil if oil != CUSTOM or embedded is None else embedded.oil,
        bearings=ReplacedBearings(**{f.name: given.pop(f.name) for f in fields(ReplacedBearings)}),
        line_film_model=line_model_of(name, embedded),
    )
    return replace(parameters, **given)


def start_pair(
    arguments: Mapping[str, Value], inputs: Sequence[float], embedded: EmbeddedPair | None = None
) -> HelicalPairModel:
    """Return an initialised pair.

    Parameters
    ----------
    arguments : mapping
        `pinion_speed`, those of `SpeedHolder`, and those of `pair_parameters`.
    inputs : sequence of float
        See `started`.
    embedded : EmbeddedPair, optional
        What gear.name = custom stands for.
    """
    given = dict(arguments)
    speed = float(given.pop("pinion_speed"))
    holder = taken_holder(given)
    return started(HelicalPairModel(pair_parameters(given, embedded), holder), speed, inputs)


DEFINITION = Definition(
    name="HelicalPair",
    description="Lubricated helical or spur gear pair on elastic bearings: "
    "contact lines, film, sliding friction, losses, transmission error and bearing forces",
    variables=HELICAL_PAIR,
    output_names=OUTPUT_NAMES,
    start=start_pair,
    stop_time=0.1,
    step_size=1e-3,
    slave="helical_pair_slave",
    shipped_data=(
        "gearlube_core/helical_geometry/data/*.toml",
        "gearlube_core/film_model/data/helical_line.json",
        "gearlube_core/mesh_table/data/line_mesh_*.nc",
        "gearlube_core/oil/lubricants.toml",
    ),
)


def definition_with(
    gear: str | Path | None, line_mesh: str | Path | None = None, named: Path | None = None
) -> Definition:
    """Return the definition of the FMU with this gear file and, if given, its line mesh.

    `named` is the folder of an FMU's resources, where what the gear file names has names of its
    own; by default these files are where it says.

    Raises
    ------
    ParameterError
        The gear file is missing or wrong, or a line mesh comes without one.
    TableError
        The line mesh is missing, wrong or of another pair.
    FileError
        The film model that the gear file names is missing or damaged.
    """
    if gear is None:
        if line_mesh is not None:
            raise ParameterError(
                "--line-mesh needs --gear: give the gear file of the same pair too."
            )
        return DEFINITION
    content = read_content(gear, "gear file")
    mesh = b"" if line_mesh is None else read_line_mesh_content(line_mesh)
    try:
        found = _definition_with(content, mesh, _named_files(content, Path(gear).parent, named))
    except TableError as error:
        raise TableError(f"{line_mesh}: {error}") from None
    except FileError as error:
        raise FileError(f"{gear}: {error}") from None
    except GearLubeError as error:
        raise ParameterError(f"{gear}: {error}") from None
    if named is None:
        _gear_file(content).warn(gear)
    return found


def _named_files(
    content: bytes, folder: Path, resources: Path | None
) -> tuple[tuple[str, bytes], ...]:
    """Return the oil file and the film model that a gear file names, by their names in FMUs."""
    film = _gear_file(content).film
    model = film.line_model if film.line_model and file_of_model(film.line_model) else None
    return tuple(
        (name, read(folder / text if resources is None else resources / name))
        for name, read, text in (
            (OIL_IN_FMU, read_oil_content, film.oil_file),
            (LINE_MODEL_FILE, read_model_content, model),
        )
        if text is not None
    )


def embedded_pair(resources: Mapping[str, bytes]) -> EmbeddedPair | None:
    """Return the gear pair whose files are among the resources of an FMU, if there is one.

    Raises
    ------
    ParameterError, TableError
        A file is wrong.
    """
    if GEAR_FILE not in resources:
        return None
    return _pair_in(resources[GEAR_FILE], resources.get(LINE_MESH_FILE, b""), resources)


def _gear_file(content: bytes) -> HelicalGearFile:
    """Return the gear file in the content of a file."""
    return HelicalGearFile.from_data(toml_data(content, "The gear file"), "The gear file")


def _pair_in(content: bytes, mesh: bytes, others: Mapping[str, bytes]) -> EmbeddedPair:
    """Return the gear pair in the contents of a gear file, a line mesh (or b"") and others."""
    gear = _gear_file(content)
    oil, text = others.get(OIL_IN_FMU), gear.film.line_model
    model, own = others.get(LINE_MODEL_FILE), None
    if text is not None:
        own = model_in(text, model, LINE, "film.line_model", LINE_MODEL_FILE)
    lubricant = described_oil_of(oil, OIL_IN_FMU).lubricant if oil else stated_oil(gear)
    if own is not None:
        solid = STEEL_MOHAMMADPOUR_2015
        check_oil(own, lubricant or Lubricant.named(USUAL_OIL), solid, "film.line_model")
    return EmbeddedPair(
        gear=gear,
        line_mesh=line_mesh_from_bytes(mesh, "the line mesh") if mesh else None,
        line_model=own,
        oil=lubricant,
    )


@cache
def _definition_with(
    content: bytes, mesh: bytes, others: tuple[tuple[str, bytes], ...] = ()
) -> Definition:
    """Return the definition with these files; one object per content, for caches keyed by it."""
    embedded = _pair_in(content, mesh, dict(others))
    gear, line_mesh = embedded.gear, embedded.line_mesh
    pair = gear.helical_pair()
    model, oil = line_model_of(CUSTOM, embedded), embedded.oil or USUAL_OIL
    try:
        helical_march_parameters(gear, line_mesh=line_mesh, line_film_model=model, oil=oil)
    except ParameterError as error:
        if line_mesh is None:
            raise
        raise TableError(str(error)) from None
    starts = {
        "gear.name": _number_of("gear.name", CUSTOM),
        "mesh.backlash": pair.backlash,
        "film.model": _number_of("film.model", gear.film.model),
    }
    if gear.operation is not None:
        torque = gear.operation.pinion_torque_n_m
        starts["pinion.torque"] = torque
        starts["wheel.torque"] = torque * pair.gear_teeth / pair.pinion_teeth
        speed = rpm_to_rads(gear.operation.pinion_speed_rpm)
        starts |= {"pinion.speed_start": speed, "speed.reference": speed}
    if line_mesh:
        starts["mesh.stiffness_model"] = _number_of("mesh.stiffness_model", LINE_MESH)
    of_mesh = f", line mesh {line_mesh.name}" if line_mesh else ""
    return replace(
        DEFINITION,
        description=f"{DEFINITION.description}; gear file {gear.name} "
        f"({pair.pinion_teeth}/{pair.gear_teeth} teeth){of_mesh}",
        variables=tuple(_starting(v, starts, embedded.oil) for v in HELICAL_PAIR),
        start=partial(start_pair, embedded=embedded),
        resources={GEAR_FILE: content} | ({LINE_MESH_FILE: mesh} if mesh else {}) | dict(others),
        sources=files_of(*embedded.oil.laws) if embedded.oil else (),
    )


def _starting(
    variable: Variable, starts: Mapping[str, float], own_oil: Lubricant | None
) -> Variable:
    """Return a variable with the start value of a pair, see `with_own_oil`."""
    if own_oil is not None:
        variable = with_own_oil(variable, own_oil, CUSTOM)
    return replace(variable, start=starts.get(variable.name, variable.start))


def _number_of(option: str, literal: str) -> float:
    return 1.0 + HELICAL_PAIR[DEFINITION.references[option]].literals.index(literal)


class HelicalPair(CoSimulationSlave):
    """FMI 2.0 co-simulation slave of the helical pair of He et al. (2007)."""

    @staticmethod
    def definition_of(resources: Path) -> Definition:
        """Return the definition with the files in `resources`, or the plain one."""
        gear, mesh = resources / GEAR_FILE, resources / LINE_MESH_FILE
        if not gear.is_file():
            return DEFINITION
        return definition_with(gear, mesh if mesh.is_file() else None, resources)
