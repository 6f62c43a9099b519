"""Audit of a film model: contacts that a run has visited, solved again on the full grid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.stats import binom

from gearlube.output.csv_text import csv_text
from gearlube.studies.film_model.calibration import CONFIDENCE, Misses
from gearlube.studies.film_model.kinds import Contact, kind_of
from gearlube.studies.film_model.samples import flank_contact_of
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters
from gearlube_core.ehl.gears.hypoid_film import pair_contact
from gearlube_core.errors import FileError, GearLubeError, ParameterError
from gearlube_core.film_model.groups import FilmContact, FilmGroups
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import SolvedFilm
from gearlube_core.input_file.table import TABLES, read_table
from gearlube_core.progress import Progress, no_progress
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
_LIMIT = 0.05  # chance of as many violations, below which the bound does not hold


class OperatingPoints(NamedTuple):
    """Operating points of the pinion, N of them."""

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
    eyring: tuple[float, float] | None = None,
) -> list[FilmContact]:
    """Return contacts at random points and phases of the engagement.

    Parameters
    ----------
    points
        Speeds and torques of the pinion.
    axle
        Its mesh table and its oil.
    count, seed
        Number of contacts and what decides them.
    eyring
        As of `oil_of_library`.

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
                eyring,
            )
        )
        if len(found) == count:
            return found
    raise ParameterError(
        f"The run must load the teeth, got load above {_LEAST_LOAD:g} N at {len(found)} of "
        f"{_TRIES * count} random instants; {count} are asked for. Give a run with more torque."
    )


class AuditRow(NamedTuple):
    """One contact of an audit; films [m], frictions [-]."""

    contact: Contact
    model: SolvedFilm
    film: float  # solved, led to the limit of fine grids; nan: not solved
    friction: float
    failure: str


class Audit(NamedTuple):
    """Result of an audit."""

    rows: tuple[AuditRow, ...]
    outside: int  # contacts drawn that lie outside the domain, not solved
    outside_load: float  # their share of the load drawn [-]
    bounds: tuple[float, float]  # of film and friction [-]

    @property
    def judged(self) -> list[AuditRow]:
        """Return the rows that were solved."""
        return [row for row in self.rows if not row.failure]

    @property
    def misses(self) -> Misses:
        """Return the errors of the model at the rows that were solved."""
        errors = [
            (
                row.model.central_film / row.film - 1.0,
                row.model.friction_coefficient / row.friction - 1.0,
            )
            for row in self.judged
        ]
        return Misses(np.array(errors).reshape(-1, 2))

    @property
    def chances(self) -> tuple[float, float]:
        """Return the chance of as many violations or more, if the bounds held exactly."""
        count = len(self.judged)
        over = self.misses.violations(self.bounds)
        first, second = (float(binom.sf(k - 1, count, 1.0 - CONFIDENCE)) for k in over)
        return first, second

    @property
    def holds(self) -> bool:
        """Tell whether the violations speak against no bound."""
        return min(self.chances) >= _LIMIT


def audit(
    model: FilmModel, contacts: Sequence[Contact], *, progress: Progress = no_progress
) -> Audit:
    """Return how a model agrees with contacts solved again.

    Parameters
    ----------
    model
        The film model to judge.
    contacts
        Those outside its domain are counted and left out.
    progress
        Called with the share done and a sentence.

    Raises
    ------
    ParameterError
        No contact lies in the domain.

    Notes
    -----
    Each contact is solved on both grids of its kind, with oil beyond them, and led to the limit of
    fine grids. The error of coarser solutions alone would exceed the model's.
    """
    numbers = model.copied_numbers()
    films = [kind_of(one).predict(numbers, one) for one in contacts]
    inside = [n for n, film in enumerate(films) if film.outside == 0.0]
    if not inside:
        raise ParameterError(
            f"The run must visit the domain of the model, got {len(contacts)} contacts outside. "
            "`gearlube film-model show` prints the domain."
        )
    rows = []
    for done, n in enumerate(inside, start=1):
        rows.append(_row(contacts[n], films[n]))
        progress(done / len(inside), "contacts solved")
    load = np.array([one[0] for one in contacts])  # load, or load per length of a line
    share = 1.0 - float(load[inside].sum() / load.sum())
    bounds = (model.film_bound, model.friction_bound)
    return Audit(tuple(rows), len(contacts) - len(inside), share, bounds)


def _row(contact: Contact, film: SolvedFilm) -> AuditRow:
    kind = kind_of(contact)
    try:
        one, other = (kind.solve(contact, nodes) for nodes in (kind.nodes, kind.second))
    except GearLubeError as error:
        return AuditRow(contact, film, math.nan, math.nan, str(error))
    if not (one.converged and other.converged):
        return AuditRow(contact, film, math.nan, math.nan, "not converged")
    h, mu = (
        first * (second / first) ** kind.to_limit
        for first, second in (
            (one.central_film, other.central_film),
            (one.friction, other.friction),
        )
    )
    return AuditRow(contact, film, h, mu, "")


def audit_lines(found: Audit) -> list[str]:
    """Return the verdict in words."""
    drawn = len(found.rows) + found.outside
    failed = len(found.rows) - len(found.judged)
    lines = [
        f"Contacts drawn: {drawn}; outside the domain: {found.outside}, with "
        f"{100.0 * found.outside_load:.2g} % of the load; solved again: {len(found.judged)}, "
        f"failed: {failed}"
    ]
    if not found.judged:
        return [*lines, "No contact was solved: no verdict."]
    errors = np.abs(found.misses.values)
    over = found.misses.violations(found.bounds)
    for n, name in enumerate(("central film", "friction")):
        rms = math.sqrt(float((errors[:, n] ** 2).mean()))
        lines.append(
            f"{name}: error {100.0 * rms:.2f} % rms, {100.0 * errors[:, n].max():.2f} % at most; "
            f"above the bound of {100.0 * found.bounds[n]:.2f} %: {over[n]} "
            f"(5 % would be {0.05 * len(errors):.1f})"
        )
    if found.holds:
        lines.append("The bounds hold: no more contacts exceed them than 5 % explain.")
    else:
        lines.append(
            "The bounds do not hold here: more contacts exceed them than 5 % explain. Train a "
            "model with the oils and loads of this run."
        )
    return lines


def audit_table(found: Audit) -> str:
    """Return the contacts of an audit as CSV: groups, films [m], frictions, errors [%]."""
    head = (
        *FilmGroups._fields,
        "film_model_m",
        "film_solved_m",
        "friction_model",
        "friction_solved",
        "failure",
    )
    rows = (
        (
            *(f"{value:.6g}" for value in kind_of(row.contact).groups(row.contact)),
            f"{row.model.central_film:.6g}",
            f"{row.film:.6g}",
            f"{row.model.friction_coefficient:.6g}",
            f"{row.friction:.6g}",
            row.failure,
        )
        for row in found.rows
    )
    return csv_text(head, rows)
