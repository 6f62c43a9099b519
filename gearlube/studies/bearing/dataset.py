"""Bearing friction as a dataset with units, and as a table with one part on each line."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.report.solved_films import film_model_attributes
from gearlube.studies.bearing.settings import BearingSettings
from gearlube_core import __version__
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import PARTS
from gearlube_core.film_model.model import ROLLER, FilmModel, shipped_model
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

CONDITIONS = ("law", "speed", "axial_load", "radial_load", "temperature")
_SCALARS = {
    "torque": ("N.m", "friction torque at the shaft"),
    "power": ("W", "power loss"),
    "factor": ("1", "error bar, k = 2: torque and power within a factor of this, either way"),
    "film_ratio": ("1", "smallest film of the raceways over roughness, flooded"),
    "rib_film_ratio": ("1", "film of the rib over roughness"),
    "rib_friction": ("1", "coefficient of friction at the rib, most loaded roller"),
    "out_of_range": ("1", "share of raceway contacts outside the range of the law"),
}


def bearing_dataset(
    file: BearingFile, oil: Lubricant, settings: BearingSettings, losses: Any
) -> xr.Dataset:
    """Return the losses, (n,) in the order of CONDITIONS, as a dataset."""
    laws = [model.law for model in settings.models]
    shape = (
        len(laws),
        len(settings.speeds),
        len(settings.axial_loads),
        len(settings.radial_loads),
        len(settings.temperatures),
    )
    variables: dict[str, Any] = {}
    for name, (unit, words) in _SCALARS.items():
        values = np.array([getattr(one, name) for one in losses], dtype=float).reshape(shape)
        variables[name] = (CONDITIONS, values, {"units": unit, "long_name": words})
    torque, factor = variables["torque"][1], variables["factor"][1]
    for name, values in (("torque_low", torque / factor), ("torque_high", torque * factor)):
        words = f"{name.removeprefix('torque_')} end of the error bar of the torque, k = 2"
        variables[name] = (CONDITIONS, values, {"units": "N.m", "long_name": words})
    parts = [part for part in PARTS if any(part in one.parts for one in losses)]
    table = np.array([[one.parts.get(part, np.nan) for one in losses] for part in parts])
    words = "torque of one part; nan where the law does not tell it apart"
    variables["part_torque"] = (
        ("part", *CONDITIONS),
        table.reshape(len(parts), *shape),
        {"units": "N.m", "long_name": words},
    )
    coordinates = {
        "part": parts,
        "law": laws,
        "speed": ("speed", list(settings.speeds), {"units": "rad/s", "long_name": "shaft speed"}),
        "axial_load": ("axial_load", list(settings.axial_loads), {"units": "N"}),
        "radial_load": ("radial_load", list(settings.radial_loads), {"units": "N"}),
        "temperature": (
            "temperature",
            list(settings.temperatures),
            {"units": "K", "long_name": "oil at the bearing"},
        ),
    }
    attributes = {
        "name": file.name,
        "source": file.source or "",
        "oil": oil.name,
        "calibrated": int(file.bearing.rolling_scale is not None),
        "inlet_layer_m": max(model.inlet_layer for model in settings.models),
        "temperature_rise_k": max(model.temperature_rise for model in settings.models),
        "gearlube_version": __version__,
        **film_model_attributes(_film_models(settings)),
    }
    return xr.Dataset(variables, coordinates, attributes)


def _film_models(settings: BearingSettings) -> dict[str, FilmModel]:
    """Return the film model of the rollers, where a law takes one."""
    for one in settings.models:
        if one.law == "solved_films":
            return {ROLLER: one.film_model or shipped_model(ROLLER)}
    return {}


def bearing_rows(dataset: xr.Dataset) -> str:
    """Return the table as CSV text: one line for each part and one for the whole."""
    head = (
        "law", "speed_rpm", "axial_load_n", "radial_load_n", "temperature_degc", "part",
        "torque_n_m", "torque_low_n_m", "torque_high_n_m", "power_w", "power_low_w", "power_high_w",
        "out_of_range",
    )  # fmt: skip
    parts = [str(part) for part in dataset["part"].values]
    part_torque = dataset["part_torque"].values
    ends = [dataset[name].values for name in ("torque", "torque_low", "torque_high")]
    axes, outside = [dataset[name].values for name in CONDITIONS], dataset["out_of_range"].values
    rows = []
    for place in np.ndindex(*ends[0].shape):
        law, speed, *rest = (axis[i] for axis, i in zip(axes, place, strict=True))
        axial, radial, temperature = (float(one) for one in rest)
        speed = float(speed)
        numbers = (rads_to_rpm(speed), axial, radial, kelvin_to_celsius(temperature))
        where = (str(law), *(f"{one:.9g}" for one in numbers))
        for part, torques in zip(parts, part_torque, strict=True):
            torque = float(torques[place])
            if np.isfinite(torque):
                rows.append(
                    (*where, part, f"{torque:.6g}", "", "", f"{torque * speed:.6g}", "", "", "")
                )
        whole = [float(one[place]) for one in ends]
        both = [*whole, *(t * speed for t in whole), float(outside[place])]
        rows.append((*where, "total", *(f"{t:.6g}" for t in both)))
    return csv_text(head, rows)
