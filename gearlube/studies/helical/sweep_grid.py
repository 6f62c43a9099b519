"""Harmonics over friction and speed, in parallel and resumable."""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.helical.operating_point import (
    FORCES,
    HARMONIC_LABEL,
    LENGTHS,
    MOMENTS,
    MU_LABEL,
    TILTS,
    Variables,
    description_of,
)
from gearlube.studies.helical.settings import HARMONICS
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    RELATIVE,
    linear_system,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    COMPOSITES,
    harmonics,
    periodic_response,
    with_friction,
)
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore, resumable_results
from gearlube_core.units import labelled

QUANTITIES = (*RELATIVE, *COMPOSITES)
_FORMAT = 1  # raise with every change of the model that changes results


def parameters_key(parameters: HelicalPairParameters) -> str:
    """Return a digest of all numbers of a pair and its mesh."""
    digest = hashlib.sha256()
    for entry in dataclasses.fields(parameters):
        if entry.name != "mesh":
            digest.update(f"{entry.name}={getattr(parameters, entry.name)!r};".encode())
    mesh = parameters.mesh
    for name in ("torque", "phase", "station", "density", "offset"):
        digest.update(np.ascontiguousarray(getattr(mesh, name)).tobytes())
    return digest.hexdigest()


def friction_column(parameters: HelicalPairParameters, mu: Array, speed: float) -> Record:
    """Return harmonics 1 to HARMONICS of the mesh frequency over friction, at one speed.

    Parameters
    ----------
    parameters
        The pair; its own friction is replaced.
    mu : ndarray of shape (M,)
        Coefficients of friction [-].
    speed
        Of the pinion [rad/s].

    Returns
    -------
    dict of str to ndarray
        `displacement` (M, 14, HARMONICS) of `QUANTITIES` [m, rad], `bearing_force` (M, 12,
        HARMONICS) of `BEARING_FORCES` and `mean_bearing_force` (M, 12) [N, N.m],
        `friction_torque` [N.m] and `stability_margin` [-], (M,): one less the largest modulus of a
        Floquet multiplier. Rows of unstable pairs hold NaN.
    """
    record = {
        "displacement": np.empty((mu.size, len(QUANTITIES), HARMONICS)),
        "bearing_force": np.empty((mu.size, 12, HARMONICS)),
        "mean_bearing_force": np.empty((mu.size, 12)),
        "friction_torque": np.empty(mu.size),
    }
    margin = np.empty(mu.size)
    for i, value in enumerate(mu):
        response = periodic_response(with_friction(parameters, float(value)), speed, throw=False)
        histories = np.column_stack([response.signal(name) for name in QUANTITIES])
        record["displacement"][i] = harmonics(histories, HARMONICS).T
        record["bearing_force"][i] = harmonics(response.bearing_force, HARMONICS).T
        record["mean_bearing_force"][i] = response.bearing_force.mean(axis=0)
        record["friction_torque"][i] = response.friction_torque
        margin[i] = 1.0 - abs(response.multipliers[0])
        if margin[i] <= 0.0:
            for values in record.values():
                values[i] = np.nan
    return record | {"stability_margin": margin}


def speed_column(parameters: HelicalPairParameters, mu: Array, speed: float) -> Record:
    """Return `friction_column` and, of a pair with a film, the same with its friction."""
    record = friction_column(parameters, mu, speed)
    if parameters.film is not None:
        film = periodic_response(replace(parameters, friction="film"), speed, throw=False)
        histories = np.column_stack([film.signal(name) for name in QUANTITIES])
        record["film_displacement"] = harmonics(histories, HARMONICS).T
        record["film_bearing_force"] = harmonics(film.bearing_force, HARMONICS).T
        record["film_friction_torque"] = np.array(film.friction_torque)
        if abs(film.multipliers[0]) >= 1.0:
            for name in [key for key in record if key.startswith("film")]:
                record[name] = np.full_like(record[name], np.nan)
    return record


def sweep_dataset(
    parameters: HelicalPairParameters,
    mu: Array,
    speeds: Array,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    observe: Callable[[float], None] = lambda share: None,
) -> xr.Dataset:
    """Return harmonics of motions and bearing forces over friction and speed.

    Parameters
    ----------
    parameters : HelicalPairParameters
        Their own friction is replaced; with `film`, that of the oil film is run beside it.
    mu, speeds : ndarray
        [-] and [rad/s], rising.
    store : Path, optional
        Folder that keeps finished speeds.
    jobs : int, optional
        Processes; all processors by default.
    observe : callable
        Called with the share that is done [-].

    Returns
    -------
    xarray.Dataset
        Dimensions `mu`, `speed`, `harmonic`; NaN where the pair is unstable. Names that begin with
        `film_` have no `mu`.
    """
    digest = hashlib.sha256(f"{_FORMAT} {parameters_key(parameters)}".encode())
    digest.update(np.ascontiguousarray(mu).tobytes())
    key = digest.hexdigest()[:16]
    tasks = [float(speed) for speed in speeds]
    found: dict[float, Record] = {}
    for speed, record, _ in resumable_results(
        tasks,
        lambda speed: f"{key}_speed_{speed:.9g}",
        partial(speed_column, parameters, mu),
        ResultStore(store, ARRAYS),
        ProcessPool(jobs=jobs),
    ):
        found[speed] = record
        observe(len(found) / len(tasks))
    columns = [found[speed] for speed in tasks]
    constant = {
        name: np.stack([column[name] for column in columns], axis=1)
        for name in columns[0]
        if not name.startswith("film_")
    }
    speed_first = ("mu", "speed")
    variables = _harmonics(constant, (*speed_first, "harmonic"), "")
    for name in (*FORCES, *MOMENTS):
        variables[f"{name}_mean"] = (
            speed_first,
            constant["mean_bearing_force"][:, :, BEARING_FORCES.index(name)],
            {
                "units": "N" if name in FORCES else "N.m",
                "long_name": f"mean {description_of(name)}",
            },
        )
    for name, unit, words in (
        ("friction_torque", "N.m", "friction torque at the pinion"),
        ("stability_margin", "1", "one less the largest modulus of a Floquet multiplier"),
    ):
        variables[name] = (speed_first, constant[name], {"units": unit, "long_name": words})
    if parameters.film is not None:
        film = {
            name.removeprefix("film_"): np.stack([column[name] for column in columns])
            for name in columns[0]
            if name.startswith("film_")
        }
        variables |= _harmonics(film, ("speed", "harmonic"), "film_")
        variables["film_friction_torque"] = labelled(
            ("speed",), film["friction_torque"], "N.m", "friction torque at the pinion, oil film"
        )
    frequency = np.array([parameters.pair.mesh_frequency(speed) for speed in tasks])
    orders = np.arange(1, HARMONICS + 1) * 2.0 * np.pi * frequency[:, None]
    words = f"amplitude of a mesh order: rate of {description_of('delta_z')}"
    for prefix in ("", "film_"):
        if f"{prefix}delta_z_harmonic" in variables:
            dimensions, amplitude, _ = variables[f"{prefix}delta_z_harmonic"]
            label = {"units": "m/s", "long_name": words}
            variables[f"{prefix}delta_z_rate_harmonic"] = dimensions, amplitude * orders, label
    variables["mesh_frequency"] = labelled(("speed",), frequency, "Hz", "mesh frequency")
    variables["natural_frequency"] = (
        ("mode",),
        natural_frequencies(linear_system(parameters)) / (2.0 * np.pi),
        {"units": "Hz", "long_name": "natural frequency with the mean mesh, without damping"},
    )
    return xr.Dataset(
        variables,
        coords={
            "mu": ("mu", np.array(mu), MU_LABEL),
            "speed": ("speed", np.array(tasks), {"units": "rad/s", "long_name": "pinion speed"}),
            "harmonic": ("harmonic", np.arange(1, HARMONICS + 1), HARMONIC_LABEL),
        },
    )


def _harmonics(record: Record, dimensions: tuple[str, ...], prefix: str) -> Variables:
    """Return amplitudes of motions and bearing forces by name."""
    what = "amplitude of a mesh order, oil film" if prefix else "amplitude of a mesh order"
    groups = (
        (LENGTHS, "m", "displacement", QUANTITIES),
        (TILTS, "rad", "displacement", QUANTITIES),
        (FORCES, "N", "bearing_force", BEARING_FORCES),
        (MOMENTS, "N.m", "bearing_force", BEARING_FORCES),
    )
    return {
        f"{prefix}{name}_harmonic": (
            dimensions,
            record[kind][..., columns.index(name), :],
            {"units": unit, "long_name": f"{what}: {description_of(name)}"},
        )
        for names, unit, kind, columns in groups
        for name in names
    }
