"""A resonance study as xarray Datasets, every variable with unit and long name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube.studies.resonance.response import HARMONICS, Response
from gearlube.studies.resonance.settings import SWEPT
from gearlube.studies.resonance.study import DIRECTIONS, ResonanceStudy
from gearlube.studies.resonance.summary import mesh_harmonics
from gearlube_core.arrays import Array
from gearlube_core.units import labelled

MULTIPLIERS = 3  # of the 2-DOF model; the 1-DOF model has two
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, str]]]

# name: unit, long name
_ROW = {
    "relative_frequency": ("1", "mesh frequency over natural frequency"),
    "frequency": ("Hz", "mesh frequency"),
    "peak_to_peak": ("m", "dynamic transmission error, maximum less minimum"),
    "minimum": ("m", "least dynamic transmission error, from first contact of the drive flanks"),
    "maximum": ("m", "largest dynamic transmission error"),
    "mean": ("m", "mean dynamic transmission error over pinion angle"),
    "separation_share": ("1", "share of the period without contact"),
    "multiplier": ("1", "largest modulus of the Floquet multipliers"),
    "stable": ("1", "1 stable, 0 unstable, NaN no row"),
    "segment": ("1", "branch that the row belongs to, counted from 0; rows follow the branch"),
    "periods": ("1", "mesh periods after which the motion repeats"),
}
_SPECIAL = {
    "special_relative_frequency": ("1", "mesh over natural frequency at a special point"),
    "special_peak_to_peak": ("m", "dynamic transmission error at a special point"),
    "special_segment": ("1", "branch that the special point belongs to"),
}


def resonance_dataset(study: ResonanceStudy) -> xr.Dataset:
    """Return response curves, special points and time sweeps.

    Dimensions `model` and `row` (padded with NaN), `harmonic`, `special`, `swept_model`,
    `direction` and `sweep`. Empty where a study was stopped before its first response.
    """
    models = list(study.responses)
    if not models:
        return xr.Dataset(attrs=study_attributes(study))
    tables = [_rows(study.responses[model]) for model in models]
    variables: Variables = {}
    for name, (unit, words) in _ROW.items():
        values = _padded([table[name] for table in tables])
        variables[name] = (("model", "row"), values, {"units": unit, "long_name": words})
    variables["harmonics"] = (
        ("model", "row", "harmonic"),
        _padded([table["harmonics"] for table in tables], (HARMONICS,)),
        {"units": "m", "long_name": "amplitude of a mesh order of the transmission error"},
    )
    variables["multipliers"] = (
        ("model", "row", "multiplier_index"),
        _padded([table["multipliers"] for table in tables], (MULTIPLIERS,)),
        {"units": "1", "long_name": "moduli of the Floquet multipliers, largest first"},
    )
    variables |= _special_points(study.responses)
    variables |= _sweeps(study)
    dataset = xr.Dataset(
        variables,
        coords={
            "model": ("model", np.array(models, dtype="U32"), {"long_name": "model"}),
            "harmonic": labelled("harmonic", np.arange(1, HARMONICS + 1), "1", "mesh order"),
        },
        attrs=study_attributes(study),
    )
    return dataset


def study_attributes(study: ResonanceStudy) -> dict[str, Any]:
    """Return the settings of the study in SI units, and the properties of the pair."""
    settings = study.settings
    attributes: dict[str, Any] = {
        "radii": settings.radii,
        "friction": settings.friction,
        "pinion_torque": settings.pinion_torque,
        "oil_temperature": settings.oil_temperature,
        "roughness_rms": settings.roughness_rms,
        "first": settings.first,
        "last": settings.last,
        "interrupted": int(study.interrupted),
        "source": "Karagiannis et al. 2012, Mech. Mach. Theory 48, 94-120",
    }
    if study.responses:
        response = next(iter(study.responses.values()))
        model = response.segments[0].problem.model
        attributes |= {
            "mesh": model.parameters.mesh.name,
            "mesh_orders": model.parameters.mesh.orders,
            "natural_frequency": model.natural_frequency,
            "damping_ratio": model.damping_ratio,
            "static_deflection": model.static_deflection,
            "mesh_stiffness": model.stiffness,
            "equivalent_mass": model.equivalent_mass,
            "backlash": model.parameters.backlash,
            "pinion_teeth": model.parameters.mesh.pinion_teeth,
        }
    return attributes


def _rows(response: Response) -> dict[str, Array]:
    found: dict[str, list[Any]] = {name: [] for name in (*_ROW, "harmonics", "multipliers")}
    for number, segment in enumerate(response.segments):
        branch, periods = segment.branch, segment.problem.periods
        for row in range(branch.parameter.size):
            orbit = segment.orbit(row)
            relative = float(response.relative(branch.parameter[row]))
            values = {
                "relative_frequency": relative,
                "frequency": relative * response.natural_frequency,
                "peak_to_peak": np.ptp(orbit.x),
                "minimum": orbit.x.min(),
                "maximum": orbit.x.max(),
                "mean": orbit.x.mean(),
                "separation_share": orbit.separation_share,
                "multiplier": np.max(np.abs(branch.multipliers[row])),
                "stable": float(branch.stable[row]),
                "segment": float(number),
                "periods": float(periods),
                "multipliers": _moduli(branch.multipliers[row]),
                "harmonics": mesh_harmonics(orbit.x, periods, HARMONICS),
            }
            for name, value in values.items():
                found[name].append(value)
    return {name: np.array(values) for name, values in found.items()}


def _moduli(multipliers: NDArray[np.complex128]) -> Array:
    moduli = np.full(MULTIPLIERS, np.nan)
    moduli[: multipliers.size] = np.abs(multipliers)
    return moduli


def _padded(tables: list[Array], shape: tuple[int, ...] = ()) -> Array:
    """Stack arrays of different length, filled up with NaN."""
    longest = max([1, *(len(table) for table in tables)])  # NetCDF 3 has no empty dimensions
    padded = np.full((len(tables), longest, *shape), np.nan)
    for row, table in zip(padded, tables, strict=True):
        row[: len(table)] = table
    return padded


def _special_points(responses: dict[str, Response]) -> Variables:
    kinds, numbers = [], []
    for response in responses.values():
        points = [
            (number, segment, point)
            for number, segment in enumerate(response.segments)
            for point in segment.branch.special
        ]
        kinds.append([point.kind for _, _, point in points])
        numbers.append(
            {
                "special_relative_frequency": np.array(
                    [float(response.relative(point.parameter)) for _, _, point in points]
                ),
                "special_peak_to_peak": np.array(
                    [
                        np.ptp(segment.problem.orbit(point.unknowns, point.parameter).x)
                        for _, segment, point in points
                    ]
                ),
                "special_segment": np.array([float(number) for number, _, _ in points]),
            }
        )
    longest = max([1, *(len(row) for row in kinds)])
    names = np.array([[*row, *[""] * (longest - len(row))] for row in kinds], dtype="U32")
    variables: Variables = {
        "special_kind": (
            ("model", "special"),
            names.reshape(len(kinds), longest),
            {"long_name": "fold or bifurcation", "units": ""},
        )
    }
    for name, (unit, words) in _SPECIAL.items():
        values = _padded([row[name] for row in numbers])
        variables[name] = (("model", "special"), values, {"units": unit, "long_name": words})
    return variables


def _sweeps(study: ResonanceStudy) -> Variables:
    models = [model for model in SWEPT if (model, "down") in study.sweeps]
    if not models:
        return {}
    first = study.sweeps[models[0], "up"]
    unit = next(iter(study.responses.values())).natural_frequency
    teeth = study.settings.parameters(models[0]).mesh.pinion_teeth

    def collect(values: Callable[..., Array]) -> Array:
        return np.array([[values(study.sweeps[model, d]) for d in DIRECTIONS] for model in models])

    shape = ("swept_model", "direction", "sweep")
    size = first.frequency.size
    numbers = {
        "sweep_relative_frequency": (
            lambda s: s.mean_speed * teeth / (2.0 * np.pi * unit),
            "1",
            "mesh frequency found over natural frequency",
        ),
        "sweep_peak_to_peak": (
            lambda s: s.peak_to_peak,
            "m",
            "dynamic transmission error, maximum less minimum over a pinion revolution",
        ),
        "sweep_minimum": (lambda s: s.minimum, "m", "least dynamic transmission error"),
        "sweep_separation_share": (
            lambda s: s.separation_share,
            "1",
            "share of a pinion revolution without contact",
        ),
    }
    variables: Variables = {
        name: (shape, collect(values), {"units": unit_, "long_name": words})
        for name, (values, unit_, words) in numbers.items()
    }
    variables["swept_model"] = (
        ("swept_model",),
        np.array(models, dtype="U32"),
        {"long_name": "model"},
    )
    variables["direction"] = (
        ("direction",),
        np.array(DIRECTIONS, dtype="U8"),
        {"long_name": "direction of the time sweep"},
    )
    variables["sweep"] = labelled(
        ("sweep",), np.arange(size), "1", "place in the sweep, in the order it was run"
    )
    return variables
