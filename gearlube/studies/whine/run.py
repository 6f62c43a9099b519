"""Whine orders over the speed and their derivatives by settings: a library call."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.report.inputs import remark_attributes
from gearlube.report.result import Result
from gearlube.studies.whine.figures import whine_figure
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import (
    KARAGIANNIS_DAMPING_RATIO,
    HypoidTorsionalParameters,
    karagiannis_2012_pair,
)
from gearlube_core.dynamics.hypoid_torsional.whine_rates import WhineRates, whine_rates
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.helical_contact.series_rates import HelicalSeriesSettings, helical_series_rates
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.sensitivity.series_rates import SeriesSettings, series_rates
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_figure, write_text
from gearlube_core.tooth_contact.series_rates import SeriesRates
from gearlube_core.units import labelled

GearFile = HypoidGearFile | HelicalGearFile
POSITIONS = "positions"  # folder of finished positions, in that of the results
QUANTITIES = {
    "transmission_error": ("rad", "rotation of the pinion beyond the teeth ratio"),
    "force": ("N", "mesh force"),
}
_SHIPPED = karagiannis_2012_pair()


@dataclass(frozen=True, slots=True, kw_only=True)
class WhineSettings:
    """Speeds and orders of a whine study, and the parameters by which it differentiates.

    Parameters
    ----------
    series : SeriesSettings
        Torque, parameters, mesh phases.
    speeds : tuple of float
        Mean pinion speeds [rad/s], rising, 1 to 5000.
    orders : tuple of int
        Orders of the mesh frequency.
    pinion_inertia, gear_inertia : float
        Moments of inertia about the members' axes [kg m2]; default: those of the shipped pair.
    damping_ratio : float
        Damping ratio of the mesh mode [-], 0.001 to 0.5.

    Examples
    --------
    >>> WhineSettings(speeds=(100.0, 200.0)).series.torque
    50.0
    """

    series: SeriesSettings = field(default_factory=SeriesSettings)
    speeds: tuple[float, ...] = tuple(np.linspace(50.0, 650.0, 61).tolist())
    orders: tuple[int, ...] = (1, 2, 3)
    pinion_inertia: float | None = None
    gear_inertia: float | None = None
    damping_ratio: float = KARAGIANNIS_DAMPING_RATIO

    def __post_init__(self) -> None:
        if not self.speeds or any(np.diff(self.speeds) <= 0.0):
            raise ParameterError(f"speeds must rise [rad/s], got {self.speeds}. Sort them.")
        check_within("speeds", self.speeds[0], 1.0, 5e3, "rad/s")
        check_within("speeds", self.speeds[-1], 1.0, 5e3, "rad/s")
        for name in ("pinion_inertia", "gear_inertia"):
            if getattr(self, name) is not None:
                check_positive(name, getattr(self, name), "kg m2")
        check_within("damping_ratio", self.damping_ratio, 1e-3, 0.5)
        most = (self.series.positions - 1) // 2
        for order in self.orders:
            check_within(
                "orders", order, 1, most, "", "Twice the order and one position are needed."
            )

    def inertias(self, file: GearFile) -> tuple[float, float]:
        """Return those of pinion and gear [kg m2]: as given, or those of the pair."""
        own = _SHIPPED.pinion_inertia, _SHIPPED.gear_inertia
        if isinstance(file, HelicalGearFile):
            own = file.body("pinion").polar_inertia, file.body("gear").polar_inertia
        return (
            own[0] if self.pinion_inertia is None else self.pinion_inertia,
            own[1] if self.gear_inertia is None else self.gear_inertia,
        )


class WhineRow(NamedTuple):
    """Largest change by the tolerance of one parameter, to first order."""

    parameter: str
    tolerance: float
    unit: str
    transmission_error: float  # largest change of order 1 over the speeds [rad]
    force: float  # the same of the mesh force [N]
    pinion_speed: float  # where the force changes most [rad/s]


def run_whine(
    file: GearFile,
    settings: WhineSettings | None = None,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the whine orders of a hypoid pair over speed, and how each setting changes them.

    The drive flanks' loaded contact and its derivatives become a mesh table with derivatives. The
    periodic motions of the torsional pair on it give the amplitudes of transmission error and mesh
    force.

    Parameters
    ----------
    file : HypoidGearFile or HelicalGearFile
        Of a helical pair the parameters are reliefs, crowns and slopes of its flanks.
    settings : WhineSettings, optional
        Torque, parameters, speeds; default: 50 N.m, all parameters.
    folder : Path, optional
        Folder for whine.nc, whine.csv and figures/whine.png. Finished positions are kept there:
        after a stop the same call continues.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        The flanks do not meet, or a parameter has no derivative.
    ConvergenceError
        A position finds no equilibrium.

    Notes
    -----
    The model has no flank friction, and shafts and bearings are rigid. At a speed without a
    periodic motion of the mesh period the results are NaN; `stable` is 0 if this motion is not
    stable.

    Examples
    --------
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> found = run_whine(file)  # doctest: +SKIP
    >>> found["force_rate"].sel(parameter="misalignment.pinion_axial", order=1)  # doctest: +SKIP
    """
    settings = settings or WhineSettings()
    table = _series(file, settings.series, folder, jobs, progress)
    progress(1.0, "periodic motions")
    pair = _pair(file, table, settings)
    dataset = _dataset(file, settings, table, pair, _motions(pair, table, settings))
    dataset = Result.of(dataset, "whine")
    if folder is not None:
        write_whine(dataset, folder)
    return dataset


def write_whine(dataset: xr.Dataset, folder: Path) -> None:
    """Write whine.nc, whine.csv and figures/whine.png into a folder."""
    (folder / "figures").mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / "whine.nc")
    write_text(csv_text(WhineRow._fields, whine_rows(dataset)), folder / "whine.csv")
    write_figure(whine_figure(dataset), folder / "figures" / "whine.png")


def whine_rows(dataset: xr.Dataset) -> list[WhineRow]:
    """Return a row for each parameter, what changes the force of order 1 most on top."""
    rows = []
    first = dataset.isel(order=0)
    for name in dataset["parameter"].values:
        part = first.sel(parameter=name)
        tolerance = float(part["tolerance"])
        error, force = (np.abs(tolerance * part[f"{one}_rate"].values) for one in QUANTITIES)
        highest = int(np.nanargmax(force))
        rows.append(
            WhineRow(
                str(name),
                tolerance,
                str(part["unit"].values),
                float(np.nanmax(error)),
                float(force[highest]),
                float(dataset["pinion_speed"].values[highest]),
            )
        )
    return sorted(rows, key=lambda row: -row.force)


def _series(
    file: GearFile,
    series: SeriesSettings,
    folder: Path | None,
    jobs: int | None,
    progress: Progress,
) -> SeriesRates:
    if isinstance(file, HypoidGearFile):
        store = None if folder is None else folder / POSITIONS
        return series_rates(file, series, store=store, jobs=jobs, progress=progress)
    own = HelicalSeriesSettings(
        parameters=series.parameters, torque=series.torque, positions=series.positions
    )
    return helical_series_rates(file, own, jobs=jobs, progress=progress)


def _pair(file: GearFile, table: SeriesRates, settings: WhineSettings) -> HypoidTorsionalParameters:
    pinion, gear = settings.inertias(file)
    return replace(
        karagiannis_2012_pair(table.table),
        pinion_torque=settings.series.torque,
        pinion_inertia=pinion,
        gear_inertia=gear,
        mesh_damping="modal",
        damping_ratio=settings.damping_ratio,
    )


def _motions(
    pair: HypoidTorsionalParameters, table: SeriesRates, settings: WhineSettings
) -> list[WhineRates | None]:
    found: list[WhineRates | None] = []
    for speed in settings.speeds:
        try:
            one = whine_rates(pair, table.rates, speed, orders=settings.orders)
        except ConvergenceError:
            one = None
        found.append(one)
    if not any(found):
        raise ConvergenceError(
            f"No periodic motion was found at any of the {len(settings.speeds)} speeds. Give "
            "speeds farther from the resonance, or more damping."
        )
    return found


def _dataset(
    file: GearFile,
    settings: WhineSettings,
    table: SeriesRates,
    pair: HypoidTorsionalParameters,
    motions: list[WhineRates | None],
) -> xr.Dataset:
    count, orders = len(table.parameters), len(settings.orders)
    data: dict[str, Any] = {}
    for name, (unit, text) in QUANTITIES.items():
        values = np.full((len(motions), orders), np.nan)
        rates = np.full((len(motions), count, orders), np.nan)
        for k, one in enumerate(motions):
            if one is not None:
                values[k], rates[k] = one.amplitudes(name)
        note = f"amplitude of mesh orders: {text}"
        data[name] = (("pinion_speed", "order"), values, {"units": unit, "long_name": note})
        data[f"{name}_rate"] = (
            ("pinion_speed", "parameter", "order"),
            rates,
            {"units": f"{unit} per unit of the parameter", "long_name": f"rate of: {note}"},
        )
    stable: Array = np.array([one is not None and one.stable for one in motions], float)
    data["stable"] = (("pinion_speed",), stable, {"units": "1", "long_name": "1: stable motion"})
    data["loaded_error"] = labelled(
        ("phase",), table.rotation, "rad", "static transmission error under load"
    )
    data["loaded_error_rate"] = labelled(
        ("parameter", "phase"), table.rotation_rate, "rad per unit of the parameter", "its rate"
    )
    model = HypoidTorsional(pair)
    own = {"units": "unit of the parameter"}
    return xr.Dataset(
        data,
        coords={
            "pinion_speed": labelled(
                "pinion_speed", list(settings.speeds), "rad/s", "mean pinion speed"
            ),
            "order": ("order", list(settings.orders), {"units": "1", "long_name": "mesh order"}),
            "phase": (
                "phase",
                np.arange(settings.series.positions) / settings.series.positions,
                {"units": "1", "long_name": "share of a mesh period"},
            ),
            "parameter": [one.name for one in table.parameters],
            "unit": ("parameter", [one.unit for one in table.parameters]),
            "value": ("parameter", [one.value for one in table.parameters], own),
            "tolerance": ("parameter", [one.tolerance for one in table.parameters], own),
        },
        attrs={
            "name": file.name,
            "torque": settings.series.torque,
            "pinion_teeth": file.pinion.teeth,
            "kind": "hypoid" if isinstance(file, HypoidGearFile) else "helical",
            "natural_frequency": model.natural_frequency,
            "gear_file": file.model_dump_json(exclude_none=True, exclude_unset=True),
            **remark_attributes(file),
        },
    )
