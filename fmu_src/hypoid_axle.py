"""HypoidAxle.fmu: the axle model of `gearlube_core` under FMI names."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

from drivetrain.axle_file.axle_file import AxleFile, CarAxle, parsed_axle_file
from drivetrain.axle_file.axle_sections import OwnFilmModels
from fmu_src.axle_arguments import (
    CUSTOM_OIL,
    OF_BEARINGS,
    axle_parameters,
    bearing_arguments,
    start_arguments,
)
from fmu_src.definition import Definition, Value
from fmu_src.slave_base import CoSimulationSlave
from fmu_src.variable import MEMBERS, Variable, declared, started, taken_holder, with_own_oil
from fmu_src.variables import FRICTION_VARIANTS, HYPOID_AXLE, SHARED_PRELOAD
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.checks import read_content
from gearlube_core.dynamics import hypoid_axle
from gearlube_core.dynamics.hypoid_axle.loss_band import loss_sensitivities
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import GearLubeError, ParameterError, TableError
from gearlube_core.film_model.chosen_model import file_of_model, model_in
from gearlube_core.film_model.model import FLANK, ROLLER, read_model_content
from gearlube_core.mesh_table.netcdf import (
    FILE_IN_FMU,
    mesh_table_from_bytes,
    read_table_content,
    shipped_mesh_table,
)
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.number import numbers_of
from gearlube_core.oil.oil_file import FILE_IN_FMU as OIL_IN_FMU
from gearlube_core.oil.oil_file import described_oil_of, read_oil_content
from gearlube_core.part import files_of
from gearlube_core.rough_patch.asperity_file import FILE_IN_FMU as ASPERITIES_IN_FMU
from gearlube_core.rough_patch.asperity_file import asperities_from_bytes, read_asperity_content

AXLE_FILE = "axle.toml"  # among the FMU's resources
FILMS_IN_FMU = ("flank_film_model.json", "roller_film_model.json")  # likewise
NAMED_FILES = (ASPERITIES_IN_FMU, OIL_IN_FMU, *FILMS_IN_FMU)  # that an axle file names, likewise
PAPER = "mohammadpour_2015"  # the axle of an FMU without a file of its own


def start_axle(
    arguments: Mapping[str, Value],
    inputs: Sequence[float],
    base: hypoid_axle.HypoidAxleParameters | None = None,
) -> hypoid_axle.HypoidAxle:
    """Return an initialised axle.

    Parameters
    ----------
    arguments : mapping
        `pinion_speed`, those of `SpeedHolder`, and those of `axle_parameters`.
    inputs : sequence of float
        See `started`.
    base : HypoidAxleParameters, optional
        What the arguments change; by default the paper's axle. The sensitivities of its losses
        stay, whatever the arguments.
    """
    given = dict(arguments)
    speed = float(given.pop("pinion_speed"))
    band = loss_sensitivities(base or hypoid_axle.mohammadpour_2015_axle())
    holder = taken_holder(given)
    return started(
        hypoid_axle.HypoidAxle(axle_parameters(given, base), band, holder), speed, inputs
    )


DEFINITION = Definition(
    name="HypoidAxle",
    description="Lubricated hypoid gear pair on preloaded tapered roller bearings: "
    "film, friction, losses, transmission error and bearing forces",
    variables=HYPOID_AXLE,
    output_names=tuple(hypoid_axle.OUTPUT_NAMES),
    start=start_axle,
    stop_time=0.1,
    step_size=1e-3,
    slave="hypoid_axle_slave",
    shipped_data=(
        "gearlube_core/mesh_table/data/mohammadpour_2015.nc",
        "gearlube_core/oil/lubricants.toml",
        "gearlube_core/film_model/data/hypoid_flank.json",
        "gearlube_core/film_model/data/roller_race.json",
    ),
)


def definition_with_table(path: str | Path) -> Definition:
    """Return the definition of the FMU with the mesh table at `path`."""
    content = read_table_content(path)
    try:
        return _definition_with(None, content)
    except TableError as error:
        raise TableError(f"{path}: {error}") from None


def definition_with_axle(
    path: str | Path, mesh_table: str | Path | None = None, named: Path | None = None
) -> Definition:
    """Return the definition of the FMU with an axle file.

    Parameters
    ----------
    path : path
        Axle file, or the name of a shipped one.
    mesh_table : path, optional
        Where the table of the gears is that the file names as a file; by default where the file
        says. It must be given where the file names a gear file.
    named : path, optional
        Folder of an FMU's resources, where the other files that it names are called as in
        NAMED_FILES; by default they are where the file says.

    Raises
    ------
    ParameterError
        The file is missing or wrong, or the table of its gear file is not given.
    TableError
        Its mesh table or its asperity table is missing or wrong.
    FileError
        A film model is missing or damaged.
    """
    content = _axle_content(path)
    try:
        file = parsed_axle_file(content)
        table = None
        if file.has_own_table:
            table = mesh_table or file.own_table(Path(path).parent)
        others = tuple(
            (name, read(Path(path).parent / text if named is None else named / name))
            for name, read, text in _named_files(file)
        )
        of_gears = None if table is None else read_table_content(table)
        return _definition_with(content, of_gears, others)
    except GearLubeError as error:
        raise type(error)(f"{path}: {error}") from None


def _named_files(file: AxleFile) -> list[tuple[str, Callable[[Path], bytes], str]]:
    """Return the files that an axle file names beside its table: name in FMUs, reader, path."""
    film = file.film
    found = (
        (ASPERITIES_IN_FMU, read_asperity_content, file.gear_set.asperity_table),
        (OIL_IN_FMU, read_oil_content, file.oil.file),
        *(
            (name, read_model_content, text if text and file_of_model(text) else None)
            for name, text in zip(FILMS_IN_FMU, (film.flank_model, film.roller_model), strict=True)
        ),
    )
    return [(name, read, text) for name, read, text in found if text is not None]


def check_one_table(mesh_table: str | Path | None) -> None:
    """Raise ParameterError if there is a mesh table beside an axle file."""
    if mesh_table is not None:
        raise ParameterError(
            "--mesh-table cannot be combined with an axle file, which names its own table, got "
            f"{mesh_table}. Write it into the file as gear_set.mesh_table."
        )


def _axle_content(path: str | Path) -> bytes:
    if not str(path).endswith(".toml") and not Path(path).is_file():
        return AxleFile.shipped_text(str(path)).encode()
    return read_content(path, "axle file").replace(b"\r\n", b"\n")


def mesh_table_in(resources: Mapping[str, bytes]) -> MeshTable:
    """Return the mesh table among the resources of an FMU, or the one that ships."""
    content = resources.get(FILE_IN_FMU)
    return mesh_table_from_bytes(content, FILE_IN_FMU) if content else shipped_mesh_table(PAPER)


def car_axle_in(resources: Mapping[str, bytes]) -> CarAxle:
    """Return axle and car among the resources of an FMU, or the paper's with its mesh table."""
    content = resources.get(AXLE_FILE)
    file = AxleFile.named(PAPER) if content is None else parsed_axle_file(content)
    own = FILE_IN_FMU in resources
    patches, oil = resources.get(ASPERITIES_IN_FMU), resources.get(OIL_IN_FMU)
    film = file.film
    films = [
        None if text is None else model_in(text, resources.get(name), kind, what, name)
        for name, text, kind, what in (
            (FILMS_IN_FMU[0], film.flank_model, FLANK, "film.flank_model"),
            (FILMS_IN_FMU[1], film.roller_model, ROLLER, "film.roller_model"),
        )
    ]
    return file.car_axle(
        mesh_table_in(resources) if own else None,
        asperities_from_bytes(patches, ASPERITIES_IN_FMU) if patches else None,
        described_oil_of(oil, OIL_IN_FMU) if oil else None,
        OwnFilmModels(*films),
    )


@cache
def _definition_with(
    axle: bytes | None, table: bytes | None, others: tuple[tuple[str, bytes], ...] = ()
) -> Definition:
    """Return the definition with these files; one object per content, for caches keyed by it."""
    files = {AXLE_FILE: axle, FILE_IN_FMU: table, **dict(others)}
    resources = {name: content for name, content in files.items() if content is not None}
    described = car_axle_in(resources)
    base, mesh = described.axle, described.axle.mesh
    of_axle = f"; axle file {described.name}" if axle is not None else ""
    source = f", from {mesh.source}" if mesh.source else ""
    starts = start_arguments(base)
    return replace(
        DEFINITION,
        description=f"{DEFINITION.description}{of_axle}; mesh table {mesh.name} "
        f"({mesh.pinion_teeth}/{mesh.gear_teeth} teeth){source}",
        variables=(
            *(_starting(variable, starts, base) for variable in HYPOID_AXLE),
            *_own_numbers(base),
        ),
        start=partial(start_axle, base=base),
        resources=resources,
        sources=files_of(base.friction_law, base.bearing, *base.oil.laws),
    )


def _starting(
    variable: Variable, starts: Mapping[str, Value], base: HypoidAxleParameters
) -> Variable:
    """Return a variable with the start value of an axle.

    An oil of its own is a new literal; a law of friction of its own is the only one.
    """
    if variable.name == "wheel.torque":  # balances that of the pinion
        paper = shipped_mesh_table(PAPER).ratio
        return replace(variable, start=(variable.start or 0.0) * (base.mesh.ratio / paper))
    if variable.name == "friction.model" and starts["friction"] not in variable.literals:
        return replace(variable, literals=(str(starts["friction"]),), start=1)
    if variable.option_of == "friction.model" and starts["friction"] not in FRICTION_VARIANTS:
        return replace(variable, maximum=1.0)
    if not isinstance(base.bearing, TaperedRollerBearing):
        if variable.argument in OF_BEARINGS:
            return _of_bearing(variable, base, starts.get(variable.argument, 0.0))
        if variable.option_of == "bearing.approach":
            return replace(variable, maximum=1.0)
    if starts["oil"] == CUSTOM_OIL:
        variable = with_own_oil(variable, base.oil, CUSTOM_OIL)
    value = starts.get(variable.argument)
    if value is None:
        return variable
    if isinstance(value, str):
        value = 1.0 + variable.literals.index(value)
    return replace(variable, start=float(value))


def _of_bearing(variable: Variable, base: HypoidAxleParameters, start: Value) -> Variable:
    """Return a released variable of bearings in the FMU of an axle with another type of them."""
    for role, bearing in zip(("pinion", "gear"), base.bearings, strict=True):
        name = bearing_arguments(bearing, role).get(variable.argument)
        if name is not None:
            one = numbers_of(type(bearing))[name]
            low = SHARED_PRELOAD if variable.minimum == SHARED_PRELOAD else one.low
            return replace(variable, start=float(start), minimum=low, maximum=one.high)
    text = f"Without effect with bearings of the type {base.bearing.name}"
    if variable.literals:
        return replace(variable, description=text, literals=(str(start),), start=1)
    fixed = float(start)
    return replace(variable, description=text, start=fixed, minimum=fixed, maximum=fixed)


def _own_numbers(base: HypoidAxleParameters) -> Iterator[Variable]:
    """Yield the parameters of a friction law and of bearings that the released ones lack."""
    law = base.friction_law
    for name, value in law.numbers.items():
        number = declared(type(law), name, f"friction.{name}", start=value)
        yield replace(number, argument=f"friction_{name}")
    for (member, role), bearing in zip(MEMBERS, base.bearings, strict=True):
        kind = type(bearing)
        for argument, name in bearing_arguments(bearing, role).items():
            if argument not in OF_BEARINGS:
                one, start = numbers_of(kind)[name], getattr(bearing, name)
                text = f"{one.text}, bearings of the {role} shaft"
                number = declared(kind, name, f"{member}.bearing.{one.fmi}", text, start=start)
                yield replace(number, argument=argument)


class HypoidAxle(CoSimulationSlave):
    """FMI 2.0 co-simulation slave of the hypoid axle of Mohammadpour et al. (2015)."""

    @staticmethod
    def definition_of(resources: Path) -> Definition:
        """Return the definition with the files in `resources`, else with those that ship."""
        axle, table = resources / AXLE_FILE, resources / FILE_IN_FMU
        if axle.is_file():
            return definition_with_axle(axle, table, resources)
        return definition_with_table(table) if table.is_file() else DEFINITION
