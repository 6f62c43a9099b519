"""Maps of parametric instability, in parallel and resumable."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal, NamedTuple, get_args

import numpy as np
import xarray as xr

from gearlube.studies.helical.sweep_grid import parameters_key
from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    linear_system,
    moments_at,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.period_march import march_period
from gearlube_core.dynamics.helical_pair.linear.periodic_response import with_friction
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.periodic.floquet import floquet_multipliers
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore, resumable_results
from gearlube_core.units import labelled

Axis = Literal["stiffness_variation", "damping_ratio", "mu"]
_SAMPLES = 16  # the march adds the mesh's own kinks
_STEPS = 20  # of the march, in an oscillation
LIGHT_DAMPING = 0.01  # [-], of welded bodies and rolling bearings, below the paper's 0.05
VARIATION = 8.0  # of the mesh about its mean; spur gears of this size vary five times as much
DAMPING = (0.001, 0.05)
_RANGE = (0.3, 2.2)  # mesh frequency over the lowest, and over the highest natural frequency
_SOFT = 0.95  # of the variation that leaves no stiffness, where instability is of another kind
_PHASES = 64
_FORMAT = 1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InstabilityMap:
    """Floquet multipliers against mesh frequency and a second axis.

    Parameters
    ----------
    axis : {"stiffness_variation", "damping_ratio", "mu"}
        Factor on the mesh's deviation from its mean; one ratio for supports and mesh; friction.
    values : ndarray of shape (V,)
        [-]
    mesh_frequency : ndarray of shape (F,)
        [Hz]
    growth : ndarray of shape (V, F)
        ln of the largest modulus of a multiplier over the period [1/s]; positive where unstable.
    multiplier : ndarray of complex, shape (V, F)
        The largest one: near -1 where a mode grows at half the mesh frequency.
    natural_frequencies : ndarray of shape (n,)
        Of the undamped pair with its mean mesh [Hz].
    """

    axis: Axis
    values: Array
    mesh_frequency: Array
    growth: Array
    multiplier: np.ndarray
    natural_frequencies: Array

    @property
    def unstable(self) -> np.ndarray:
        """Where disturbances grow, (V, F): from 2 f_i/k on [nayfeh_mook_1979 sec. 5.3]."""
        return np.asarray(self.growth > 0.0)


def instability_map(
    parameters: HelicalPairParameters, mesh_frequency: Array, axis: Axis, values: Array
) -> InstabilityMap:
    """Return the map over mesh frequencies [Hz] and values of an axis.

    Parameters
    ----------
    parameters
        The pair, with linear contact.
    mesh_frequency, values
        Both axes of the map.
    axis
        What the values are.
    """
    check_option("axis", axis, get_args(Axis))
    check_option("parameters.friction", parameters.friction, ("off", "constant"))
    mesh_frequency = np.array(mesh_frequency, dtype=np.float64)
    values = np.array(values, dtype=np.float64)
    for frequency in mesh_frequency:
        check_positive("mesh_frequency", frequency, "Hz")
    multiplier = np.empty((values.size, mesh_frequency.size), dtype=np.complex128)
    for i, value in enumerate(values):
        if axis == "stiffness_variation":
            system = linear_system(parameters, variation=float(value))
        else:
            system = linear_system(_changed(parameters, axis, float(value)))
        for j, frequency in enumerate(mesh_frequency):
            march = march_period(system, 1.0 / frequency, _SAMPLES, _STEPS)
            multiplier[i, j] = floquet_multipliers(march.transition[-1])[0]
    return InstabilityMap(
        axis=axis,
        values=values,
        mesh_frequency=mesh_frequency,
        growth=np.log(np.abs(multiplier)) * mesh_frequency,
        multiplier=multiplier,
        natural_frequencies=natural_frequencies(linear_system(parameters)) / (2.0 * math.pi),
    )


def _changed(parameters: HelicalPairParameters, axis: Axis, value: float) -> HelicalPairParameters:
    if axis == "mu":
        return with_friction(parameters, value)
    return replace(parameters, support_damping_ratio=value, mesh_damping_ratio=value)


class _Row(NamedTuple):
    name: str
    axis: Axis
    value: float


def stability_dataset(
    parameters: HelicalPairParameters,
    columns: int,
    rows: int,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    observe: Callable[[float], None] = lambda share: None,
) -> xr.Dataset:
    """Return growth rates of disturbances over mesh frequency and two other axes.

    Parameters
    ----------
    parameters : HelicalPairParameters
    columns, rows : int
        Mesh frequencies, and values of each axis.
    store, jobs, observe
        As of `sweep_dataset`.

    Returns
    -------
    xarray.Dataset
        growth_variation of (variation, mesh_frequency) with the pair's damping,
        growth_variation_light with `LIGHT_DAMPING`, growth_damping of (damping_ratio,
        mesh_frequency) [1/s]; negative where disturbances die away.
    """
    modes = natural_frequencies(linear_system(parameters)) / (2.0 * np.pi)
    frequency = np.linspace(_RANGE[0] * modes[0], _RANGE[1] * modes[-1], columns)
    variation = np.linspace(0.0, min(VARIATION, _SOFT * _without_stiffness(parameters)), rows)
    damping = np.geomspace(*DAMPING, rows)
    tasks = [_Row("variation", "stiffness_variation", float(v)) for v in variation]
    tasks += [_Row("variation_light", "stiffness_variation", float(v)) for v in variation]
    tasks += [_Row("damping", "damping_ratio", float(v)) for v in damping]
    digest = hashlib.sha256(f"{_FORMAT} {parameters_key(parameters)}".encode())
    digest.update(frequency.tobytes())
    key = digest.hexdigest()[:16]
    found: dict[_Row, Array] = {}
    for task, record, _ in resumable_results(
        tasks,
        lambda row: f"{key}_{row.name}_{row.value:.9g}",
        partial(_row, parameters, frequency),
        ResultStore(store, ARRAYS),
        ProcessPool(jobs=jobs),
    ):
        found[task] = record["growth"]
        observe(len(found) / len(tasks))

    def growth(
        name: str, words: str, dimension: str
    ) -> tuple[tuple[str, ...], Array, dict[str, str]]:
        values = np.stack([found[task] for task in tasks if task.name == name])
        return (dimension, "mesh_frequency"), values, {"units": "1/s", "long_name": words}

    return xr.Dataset(
        {
            "growth_variation": growth("variation", "growth of disturbances", "variation"),
            "growth_variation_light": growth(
                "variation_light",
                f"growth of disturbances with damping ratios of {LIGHT_DAMPING:g}",
                "variation",
            ),
            "growth_damping": growth("damping", "growth of disturbances", "damping_ratio"),
            "natural_frequency": labelled(
                ("mode",), modes, "Hz", "natural frequency with the mean mesh"
            ),
        },
        coords={
            "mesh_frequency": labelled("mesh_frequency", frequency, "Hz", "mesh frequency"),
            "variation": labelled(
                "variation", variation, "1", "factor on the mesh's deviation from its mean"
            ),
            "damping_ratio": labelled(
                "damping_ratio", damping, "1", "damping ratio of mesh and supports"
            ),
        },
    )


def _without_stiffness(parameters: HelicalPairParameters) -> float:
    """Return the factor on the mesh variation at which its stiffness passes through zero [-]."""
    system = linear_system(parameters)
    phase = (np.arange(_PHASES) + 0.5) / _PHASES
    mean = abs(system.mean[0, 0])
    least = np.abs(moments_at(system.plane, system.mesh, 0.0, phase)[:, 0, 0]).min()
    return float(mean / max(mean - least, 1e-9 * mean))


def _row(parameters: HelicalPairParameters, frequency: Array, row: _Row) -> Record:
    if row.name == "variation_light":
        parameters = replace(
            parameters, support_damping_ratio=LIGHT_DAMPING, mesh_damping_ratio=LIGHT_DAMPING
        )
    found = instability_map(parameters, frequency, row.axis, np.array([row.value]))
    return {"growth": found.growth[0]}
