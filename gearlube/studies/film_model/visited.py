"""Operating points that a run has visited, and contacts of the teeth there."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.samples import flank_contact_of
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters
from gearlube_core.ehl.gears.hypoid_flank import pair_contact
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.input_file.table import TABLES, read_table
from gearlube_core.storage.atomic_file import DAMAGED, open_dataset
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

COLUMNS = ("pinion_speed_rpm", "pinion_torque_n_m", "oil_temperature_degc")
_FILES = ("map.nc", "drive_cycle.nc")
_CURE = (
    "Give a folder of `gearlube map` or `gearlube cycle`, or a CSV file with the columns "
    f"{', '.join(COLUMNS)}."
)
_LEAST_LOAD = 1.0  # N
_TRIES = 200  # draws for each contact, most of which have no load where a run hardly loads


class OperatingPoints(NamedTuple):
    """What the pinion did, N points."""

    speed: Array  # [rad/s], above zero
    torque: Array  # [N.m], not zero
    temperature: Array  # of the oil [K]


def visited_points(run: Path) -> OperatingPoints:
    """Return the loaded points of a run: a folder of results, or a table (CSV).

    Raises
    ------
    FileError
        There is none, or it cannot be read.
    ParameterError
        The table cannot be read, see `read_table`, or no point turns under load.
    """
    if run.is_dir():
        found = [run / name for name in _FILES if (run / name).exists()]
        if not found:
            raise FileError(f"{run} must hold {' or '.join(_FILES)}, got neither. {_CURE}")
        speed, torque, temperature = _of_dataset(found[0])
    elif run.suffix.lower() in TABLES:
        table = read_table(run, COLUMNS, cure=_CURE)
        speed, torque, temperature = (table.column(name) for name in COLUMNS)
    else:
        raise FileError(f"The run must be a folder or a CSV file, got {run}. {_CURE}")
    held = (speed > 0.0) & (torque != 0.0) & np.isfinite(speed + torque + temperature)
    if not held.any():
        raise ParameterError(f"{run} has no point at which the pinion turns under load. {_CURE}")
    return OperatingPoints(
        rpm_to_rads(1.0) * speed[held], torque[held], celsius_to_kelvin(0.0) + temperature[held]
    )


def _of_dataset(path: Path) -> tuple[Array, Array, Array]:
    """Return speed [rpm], torque [N.m] and oil temperature [degC]."""
    try:
        with open_dataset(path) as dataset:
            if path.name == "map.nc":
                axes = (dataset[name].values for name in ("temperature", "speed", "torque"))
                temperature, speed, torque = np.meshgrid(*axes, indexing="ij")
                return speed.ravel(), torque.ravel(), temperature.ravel()
            speed, torque = dataset["pinion_speed"].values, dataset["pinion_torque"].values
            return speed, torque, dataset["oil_temperature"].values[: speed.size]
    except (*DAMAGED, FileError) as error:
        raise FileError(f"{path} cannot be read: {error}. {_CURE}") from error


def visited_contacts(
    points: OperatingPoints,
    axle: HypoidAxleParameters,
    count: int,
    seed: int,
    tau0: float | None = None,
) -> list[FilmContact]:
    """Return contacts at random points and phases of the engagement.

    Parameters
    ----------
    points
        Of the run.
    axle
        Its mesh table and its oil.
    count, seed
        Number of contacts and what decides them.
    tau0
        Eyring stress [Pa]; None: that of the oil.

    Raises
    ------
    ParameterError
        The teeth carry no load at the points.

    Notes
    -----
    The load is the static one, torque over arm times the pair's share.
    """
    rng = np.random.default_rng(seed)
    mesh, found = axle.mesh, []
    for _ in range(_TRIES * count):
        n = int(rng.integers(points.speed.size))
        speed, torque = float(points.speed[n]), float(points.torque[n])
        contact = pair_contact(mesh, torque, np.array([rng.uniform(-1.5, 1.5)]))
        load = abs(torque) / mesh.mean("R_p", torque) * float(contact.share[0])
        if load < _LEAST_LOAD or not math.isfinite(load):
            continue
        found.append(
            flank_contact_of(
                load,
                (float(contact.R_x[0]), float(contact.R_y[0])),
                contact.entrainment[0] * speed,
                contact.sliding[0] * speed,
                axle.oil,
                float(points.temperature[n]),
                axle.oil.eyring_stress if tau0 is None else tau0,
            )
        )
        if len(found) == count:
            return found
    raise ParameterError(
        f"The run must load the teeth, got load above {_LEAST_LOAD:g} N at {len(found)} of "
        f"{_TRIES * count} random instants; {count} are asked for. Give a run with more torque."
    )
