"""HypoidAxle.fmu: the axle model of `gearlube_core` under FMI names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from inspect import signature
from pathlib import Path
from typing import Any

from fmu_src.definition import Definition, Value
from fmu_src.slave_base import CoSimulationSlave
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.dynamics import hypoid_axle
from gearlube_core.errors import TableError
from gearlube_core.mesh_table.netcdf import FILE_IN_FMU, mesh_table_from_bytes, read_content
from gearlube_core.mesh_table.table import MeshTable


def axle_parameters(
    arguments: Mapping[str, Value], mesh: MeshTable | None = None
) -> hypoid_axle.HypoidAxleParameters:
    """Return the paper's axle with changes.

    Parameters
    ----------
    arguments : mapping
        By name: arguments of `mohammadpour_2015_axle` and fields of `HypoidAxleParameters`.
    mesh : MeshTable, optional
        By default the table that ships with gearlube.
    """
    given: dict[str, Any] = dict(arguments)
    named = signature(hypoid_axle.mohammadpour_2015_axle).parameters
    parameters = hypoid_axle.mohammadpour_2015_axle(
        mesh=mesh, **{name: given.pop(name) for name in arguments if name in named}
    )
    return replace(parameters, **given)


def start_axle(
    arguments: Mapping[str, Value], inputs: Sequence[float], mesh: MeshTable | None = None
) -> hypoid_axle.HypoidAxle:
    """Return an initialised axle.

    Parameters
    ----------
    arguments : mapping
        `pinion_speed`, and those of `axle_parameters`.
    inputs : sequence of float
        pinion.torque [N.m], wheel.torque [N.m], oil.temperature [K].
    mesh : MeshTable, optional
        By default the table that ships with gearlube.
    """
    given = dict(arguments)
    speed = float(given.pop("pinion_speed"))
    axle = hypoid_axle.HypoidAxle(axle_parameters(given, mesh))
    pinion_torque, wheel_torque, oil_temperature = inputs
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=pinion_torque,
        wheel_torque=wheel_torque,
        oil_temperature=oil_temperature,
    )
    return axle


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
    ),
)


def definition_with_table(path: str | Path) -> Definition:
    """Return the definition of the FMU with the mesh table at `path`."""
    content = read_content(path)
    try:
        return _definition_with(content)
    except TableError as error:
        raise TableError(f"{path}: {error}") from None


@cache
def _definition_with(content: bytes) -> Definition:
    """Return the definition with this table; one object per content, for caches keyed by it."""
    mesh = mesh_table_from_bytes(content, "the mesh table")
    source = f", from {mesh.source}" if mesh.source else ""
    return replace(
        DEFINITION,
        description=f"{DEFINITION.description}; mesh table {mesh.name} "
        f"({mesh.pinion_teeth}/{mesh.gear_teeth} teeth){source}",
        start=partial(start_axle, mesh=mesh),
        resources={FILE_IN_FMU: content},
    )


class HypoidAxle(CoSimulationSlave):
    """FMI 2.0 co-simulation slave of the hypoid axle of Mohammadpour et al. (2015)."""

    @staticmethod
    def definition_of(resources: Path) -> Definition:
        """Return the definition with the table in `resources`, else with the shipped table."""
        table = resources / FILE_IN_FMU
        return definition_with_table(table) if table.is_file() else DEFINITION
