"""Axle and car of a sweep: those that an axle FMU stands for, or of a file with another oil."""

from __future__ import annotations

import logging
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from drivetrain.axle_file.axle_file import AxleFile, CarAxle
from drivetrain.axle_file.read_axle import read_axle, table_file
from fmu_src.axle_arguments import axle_parameters, start_arguments
from fmu_src.hypoid_axle import AXLE_FILE, NAMED_FILES, PAPER, car_axle_in, check_one_table
from fmu_src.variables import FRICTION_VARIANTS
from gearlube.output.toml_text import toml_text
from gearlube.studies.sweep.settings import FMU_PARAMETERS, SweepSettings
from gearlube.studies.sweep.unpack import unpacked
from gearlube_core.checks import check_option
from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_units import attribute_of
from gearlube_core.input_file.input_file import InputNote
from gearlube_core.mesh_table.netcdf import FILE_IN_FMU, read_mesh_table
from gearlube_core.oil.oil_file import read_oil_file
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.units import kmh_to_ms

_TABLES = (("gear_set", "mesh_table"), ("gear_set", "asperity_table"))
_MODELS = (("film", "flank_model"), ("film", "roller_model"))
logger = logging.getLogger(__name__)

_FILES = (AXLE_FILE, FILE_IN_FMU, *NAMED_FILES)
_SWEPT = "pinion.bearing.preload_n"  # the sweep sets it


def axle_with_oil(
    axle: Path | str | None, mesh_table: Path | None, oil: Path | str, folder: Path
) -> Path:
    """Return an axle file in `folder` that has the oil of an oil file; copies lie beside it.

    Parameters
    ----------
    axle : path, optional
        Axle file, or the name of a shipped one; by default the paper's.
    mesh_table : path, optional
        Of the paper's axle with other gears.
    oil : path
    folder : path

    Raises
    ------
    ParameterError, TableError
        A file is missing or wrong, or a mesh table comes with an axle file.
    """
    read_oil_file(Path(oil))
    if axle is not None:
        check_one_table(mesh_table)
    read_axle(axle or PAPER)  # with its tables, before any is copied
    file = AxleFile.given(str(axle or PAPER))
    data = file.model_dump(exclude_none=True)
    data["oil"] = {"file": "oil.toml"}
    gears = data["gear_set"]
    if file.gear_set.gear_file is not None:
        table = table_file(file, Path(axle or "").parent)
        gears["mesh_table"] = str(Path(table or "").resolve())
        del gears["gear_file"]
        gears.pop("contact_torques_n_m", None)
    shutil.copyfile(oil, folder / "oil.toml")
    if mesh_table is not None:
        read_mesh_table(mesh_table)
        gears["mesh_table"] = str(mesh_table.resolve())
    for section, key in (*_TABLES, *_MODELS):
        fields = data.get(section, {})
        suffix = Path(fields.get(key, "")).suffix
        if suffix in (".nc", ".json"):
            shutil.copyfile(Path(axle or "").parent / fields[key], folder / f"{key}{suffix}")
            fields[key] = f"{key}{suffix}"
    path = folder / "axle.toml"
    write_text(toml_text(data), path)
    return path


def car_axle_of(fmu: Path) -> CarAxle:
    """Return axle and car of an FMU, a file or an unzipped folder, by the files that it carries."""
    with unpacked(fmu) as directory:
        resources = directory / "resources"
        found = {name: resources / name for name in _FILES}
        return car_axle_in({name: p.read_bytes() for name, p in found.items() if p.is_file()})


def chosen_axle(
    fmu: Path | str | None, mesh_table: Path | None, axle: Path | str | None
) -> CarAxle:
    """Return axle and car of a sweep: at most one of an FMU, a mesh table and an axle file.

    Raises
    ------
    ParameterError
        More than one is given, or a file is wrong.
    TableError
        The mesh table is wrong.
    """
    given = {"--mesh-table": mesh_table, "An axle file": axle}
    for name, path in given.items() if fmu is not None else ():
        if path is not None:
            raise ParameterError(
                f"{name} cannot be combined with --fmu, which has its own, got both. Build the "
                "FMU with it by `gearlube build-fmu`, or leave out --fmu."
            )
    if fmu is not None:
        return car_axle_of(Path(fmu))
    if axle is not None:
        check_one_table(mesh_table)
        return read_axle(axle)
    mesh = None if mesh_table is None else read_mesh_table(mesh_table)
    return AxleFile.named(PAPER).car_axle(mesh)


def given_preload(car_axle: CarAxle) -> tuple[float, ...]:
    """Return the preload of the pinion's bearings [N] if the axle file gives it, else nothing."""
    notes = {note.field: note.origin for note in car_axle.inputs}
    given = notes.get(_SWEPT) != "assumed"
    return (float(start_arguments(car_axle.axle)["bearing_preload"]),) if given else ()


def settings_of(axle: HypoidAxleParameters, **changes: Any) -> SweepSettings:
    """Return the settings of a sweep that leave an axle as it is, with changes.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> settings_of(mohammadpour_2015_axle(), friction="off").friction
    'off'
    """
    starts = start_arguments(axle)
    of_axle: dict[str, Any] = {name: starts[name] for name in FMU_PARAMETERS}
    return SweepSettings(**(of_axle | changes))


def car_axle_at(car_axle: CarAxle, settings: SweepSettings, preload: float) -> CarAxle:
    """Return axle and car with the settings of a sweep and a bearing preload [N]."""
    arguments = {name: getattr(settings, name) for name in FMU_PARAMETERS}
    axle = axle_parameters(arguments | {"bearing_preload": preload}, car_axle.axle)
    return replace(car_axle, axle=axle)


def check_operation(
    car_axle: CarAxle, settings: SweepSettings, speeds_kmh: Sequence[float]
) -> None:
    """Check oil temperature and road load of all points before anything is computed.

    Raises
    ------
    ParameterError
        The oil's data do not reach the temperature, or the axle would refuse the torque.
    """
    road, axle = car_axle.driveline.road_load, car_axle.axle
    law = str(axle.friction)  # an FMU has the variants of its axle's law, or one of its own alone
    variants = FRICTION_VARIANTS if law in FRICTION_VARIANTS else (law,)
    check_option("friction", settings.friction, variants)
    if settings.oil == start_arguments(axle)["oil"]:
        name, temperature = settings.lowest_oil_temperature
        axle.oil.check_temperature(temperature, name)
    limits, (low, high) = torque_limits(axle), axle.torque_range
    for speed in speeds_kmh:
        torque = road.pinion_torque(kmh_to_ms(speed))
        if not limits.pinion_low <= torque <= limits.pinion_high:
            raise ParameterError(
                f"The road load must be within {limits.pinion_low:g} to {limits.pinion_high:g} N.m "
                f"at the pinion, got {torque:.4g} N.m at {speed:g} km/h. {limits.cure}"
            )
        if not low <= torque <= high:
            logger.warning(
                "At %g km/h the road takes %.4g N.m at the pinion. The mesh table ends at %g and "
                "%g N.m, and outside the values at its ends are used. Analyse the contact at "
                "higher torques.",
                speed, torque, low, high,
            )  # fmt: skip


def assumed_inputs(car_axle: CarAxle, settings: SweepSettings) -> list[InputNote]:
    """Return the inputs that neither the axle file nor the settings of a sweep give."""
    starts = start_arguments(car_axle.axle)
    set_here = {name for name in FMU_PARAMETERS if getattr(settings, name) != starts[name]}

    def is_set(note: InputNote) -> bool:
        section, _, key = note.field.rpartition(".")
        name = "oil" if section == "oil" else attribute_of(key)
        return note.field == _SWEPT or (
            section in ("gear_set", "model", "oil") and name in set_here
        )

    return [note for note in car_axle.assumed if not is_set(note)]
