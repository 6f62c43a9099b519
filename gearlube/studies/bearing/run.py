"""Friction of a tapered roller bearing over speed, load and temperature: a library call."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.report.films import film_model_attributes
from gearlube.report.result import Result
from gearlube.studies.bearing.figures import BEARING_CATALOGUE
from gearlube_core import __version__
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.geometry import BearingGeometry
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.losses.loss import PARTS, LossModel, bearing_loss, check_condition
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil
from gearlube_core.film_model.model import ROLLER, FilmModel, shipped_model
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.units import (
    celsius_to_kelvin,
    kelvin_to_celsius,
    labelled,
    rads_to_rpm,
    rpm_to_rads,
)

DEFAULT_LAWS = (DEFAULT_LAW, "zhou_hoeprich")  # the second separates rolling and rib
MOST_POINTS = 50_000  # conditions times laws
_CONDITIONS = ("law", "speed", "axial_load", "radial_load", "temperature")

_SCALARS = {
    "torque": ("N.m", "friction torque at the shaft"),
    "power": ("W", "power loss"),
    "factor": ("1", "error bar, k = 2: torque and power within a factor of this, either way"),
    "film_ratio": ("1", "smallest film of the raceways over roughness, flooded"),
    "rib_film_ratio": ("1", "film of the rib over roughness"),
    "rib_friction": ("1", "coefficient of friction at the rib, most loaded roller"),
    "out_of_range": ("1", "share of raceway contacts outside the range of the law"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingSettings:
    """Speeds, loads, temperatures and laws of a bearing study; all are combined.

    Parameters
    ----------
    speeds : tuple of float
        Speeds of the shaft [rad/s].
    axial_loads, radial_loads : tuple of float
        Loads on the bearing [N].
    temperatures : tuple of float
        Temperatures of the oil in the bearing [K].
    models : tuple of LossModel
        Friction laws; figures show the parts of the first one.

    Examples
    --------
    >>> settings = BearingSettings.of_file(BearingFile.named("wingertszahn_2023"))
    >>> settings.points  # conditions times laws
    72
    """

    speeds: tuple[float, ...]
    axial_loads: tuple[float, ...]
    radial_loads: tuple[float, ...]
    temperatures: tuple[float, ...]
    models: tuple[LossModel, ...] = field(
        default_factory=lambda: tuple(LossModel(law=law) for law in DEFAULT_LAWS)
    )

    def __post_init__(self) -> None:
        for name in ("speeds", "axial_loads", "radial_loads", "temperatures", "models"):
            values = getattr(self, name)
            if not values:
                raise ParameterError(f"{name} must have at least one value, got none.")
            if len(set(values)) < len(values):
                raise ParameterError(f"{name} must not have a value twice, got {values}.")
        laws = [model.law for model in self.models]
        if len(set(laws)) < len(laws):
            raise ParameterError(f"models must not have a law twice, got {', '.join(laws)}.")
        check_within("the number of conditions times laws", self.points, 1, MOST_POINTS)

    @classmethod
    def of_file(cls, file: BearingFile) -> BearingSettings:
        """Return the conditions in [operation] of a bearing file, with the usual laws."""
        of = file.operation
        return cls(
            speeds=tuple(rpm_to_rads(n) for n in of.speed_rpm),
            axial_loads=of.axial_load_n,
            radial_loads=of.radial_load_n,
            temperatures=tuple(celsius_to_kelvin(t) for t in of.temperature_degc),
        )

    @property
    def points(self) -> int:
        """Number of conditions times laws."""
        conditions = len(self.speeds) * len(self.axial_loads) * len(self.radial_loads)
        return conditions * len(self.temperatures) * len(self.models)

    def check(self, geometry: BearingGeometry, oil: Lubricant) -> None:
        """Raise ParameterError where a condition is out of range, before anything is computed."""
        for model in self.models:
            if model.film_model is not None:
                check_oil(model.film_model, oil, geometry.solid, "film_model")
            for T in self.temperatures:
                check_condition(
                    geometry, oil, model, max(self.speeds), max(self.axial_loads), 0.0, T
                )
            for axial, radial in product(self.axial_loads, self.radial_loads):
                lowest = min(self.speeds)
                first = self.temperatures[0]
                check_condition(geometry, oil, model, lowest, axial, radial, first)


def run_bearing(
    file: BearingFile,
    settings: BearingSettings | None = None,
    *,
    oil: Lubricant | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return friction torque and power loss of a bearing, in all and by part.

    Parameters
    ----------
    file : BearingFile
    settings : BearingSettings, optional
        Conditions and laws; default: those of the file.
    oil : Lubricant, optional
        Oil; default: that of the file.
    folder : Path, optional
        Folder for bearing.nc, bearing.csv and figures/.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Returns
    -------
    xarray.Dataset
        `torque` and `power` along law, speed, axial_load, radial_load, temperature; `part_torque`
        along part too; `torque_low` and `torque_high` are the ends of the error bar.

    Raises
    ------
    ParameterError
        A condition is outside the range of bearing, law or oil; nothing is computed then.

    Examples
    --------
    >>> found = run_bearing(BearingFile.named("wingertszahn_2023"))
    >>> point = found.sel(law="zhou_hoeprich", radial_load=0.0, temperature=323.15)
    >>> round(float(point["torque"].sel(speed=209.4, method="nearest").item()), 1)  # N m
    3.2
    """
    settings = settings or BearingSettings.of_file(file)
    oil = read_oil(file.oil).lubricant if oil is None else oil
    geometry = file.geometry()
    settings.check(geometry, oil)
    conditions = list(
        product(
            settings.models,
            settings.speeds,
            settings.axial_loads,
            settings.radial_loads,
            settings.temperatures,
        )
    )
    losses = np.empty(len(conditions), dtype=object)
    for i, (model, speed, axial, radial, temperature) in enumerate(conditions):
        losses[i] = bearing_loss(
            geometry,
            oil,
            model,
            speed=speed,
            axial_load=axial,
            radial_load=radial,
            temperature=temperature,
        )
        progress((i + 1) / len(conditions), f"bearing: {model.law}")
    dataset = Result.of(_bearing_dataset(file, oil, settings, losses), "bearing")
    if folder is not None:
        write_bearing(dataset, folder)
    return dataset


def write_bearing(dataset: xr.Dataset, folder: Path) -> None:
    """Write bearing.nc, bearing.csv and figures/ into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / "bearing.nc")
    write_text(_bearing_rows(dataset), folder / "bearing.csv")
    drawn = {name: draw(dataset) for name, draw in BEARING_CATALOGUE.items()}
    save_figure_folder(drawn, folder / "figures")


def _bearing_dataset(
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
        variables[name] = (_CONDITIONS, values, {"units": unit, "long_name": words})
    torque, factor = variables["torque"][1], variables["factor"][1]
    for name, values in (("torque_low", torque / factor), ("torque_high", torque * factor)):
        words = f"{name.removeprefix('torque_')} end of the error bar of the torque, k = 2"
        variables[name] = (_CONDITIONS, values, {"units": "N.m", "long_name": words})
    parts = [part for part in PARTS if any(part in one.parts for one in losses)]
    table = np.array([[one.parts.get(part, np.nan) for one in losses] for part in parts])
    words = "torque of one part; nan where the law does not separate it"
    variables["part_torque"] = labelled(
        ("part", *_CONDITIONS), table.reshape(len(parts), *shape), "N.m", words
    )
    coordinates = {
        "part": parts,
        "law": laws,
        "speed": ("speed", list(settings.speeds), {"units": "rad/s", "long_name": "shaft speed"}),
        "axial_load": ("axial_load", list(settings.axial_loads), {"units": "N"}),
        "radial_load": ("radial_load", list(settings.radial_loads), {"units": "N"}),
        "temperature": labelled(
            "temperature", list(settings.temperatures), "K", "oil at the bearing"
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


def _bearing_rows(dataset: xr.Dataset) -> str:
    """Return the table as CSV text: one line for each part and one for the whole."""
    head = (
        "law", "speed_rpm", "axial_load_n", "radial_load_n", "temperature_degc", "part",
        "torque_n_m", "torque_low_n_m", "torque_high_n_m", "power_w", "power_low_w", "power_high_w",
        "out_of_range",
    )  # fmt: skip
    parts = [str(part) for part in dataset["part"].values]
    part_torque = dataset["part_torque"].values
    ends = [dataset[name].values for name in ("torque", "torque_low", "torque_high")]
    axes, outside = [dataset[name].values for name in _CONDITIONS], dataset["out_of_range"].values
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
