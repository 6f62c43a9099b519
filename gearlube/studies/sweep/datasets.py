"""All points of a sweep as one dataset: names, units and descriptions of all in its file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.units import heading
from gearlube.report.churning import REGIME, churning_regime
from gearlube.report.result import Result
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.storage.atomic_file import read_dataset, write_compressed_dataset, write_text
from gearlube_core.units import kmh_to_ms

GRID = ("preload", "speed")  # dimensions of a sweep
SEPARATION_MEANINGS = ("none", "single-sided", "double-sided")

# name: (unit, description)
QUANTITIES: Mapping[str, tuple[str, str]] = {
    "speed": ("m s-1", "vehicle speed asked for"),
    "speed_kmh": ("km h-1", "vehicle speed asked for"),
    "preload": ("N", "bearing preload"),
    "status": ("1", "1: finished, 0: failed, see message"),
    "message": ("", "why a point failed"),
    "range_exceeded": ("1", "quantities outside the range of their formula or table; 0: none"),
    "range_message": ("", "which quantities left their range, first where and how far"),
    "vehicle_speed": ("m s-1", "mean vehicle speed over the record"),
    "pinion_speed": ("rad s-1", "mean pinion speed"),
    "pinion_torque": ("N m", "mean torque on the pinion"),
    "wheel_torque": ("N m", "mean load torque on the wheel gear"),
    "mesh_frequency": ("Hz", "mean tooth mesh frequency"),
    "pinion_frequency": ("Hz", "mean rotation frequency of the pinion"),
    "crank_frequency": ("Hz", "rotation frequency of the crankshaft in the gear of this speed"),
    "wheel_frequency": ("Hz", "mean rotation frequency of the wheel gear"),
    "pinion_cage_frequency": ("Hz", "mean rotation frequency of the pinion bearing cage"),
    "wheel_cage_frequency": ("Hz", "mean rotation frequency of the wheel bearing cage"),
    "record_revolutions": ("1", "pinion revolutions analysed"),
    "communication_step": ("s", "communication step, mesh period over an integer"),
    "churning_regime": REGIME,
    "oil_temperature": ("K", "temperature of the oil"),
    "dte_min": ("m", "smallest dynamic transmission error"),
    "dte_max": ("m", "largest dynamic transmission error"),
    "dte_mean": ("m", "mean dynamic transmission error"),
    "dte_pp": ("m", "peak-to-peak dynamic transmission error"),
    "dte_rms": ("m", "rms of the dynamic transmission error about its mean"),
    "separation": ("1", "loss of tooth contact"),
    "separated_fraction": ("1", "share of time without contact on the drive flank"),
    "mesh_force_min": ("N", "smallest mesh force"),
    "mesh_force_max": ("N", "largest mesh force"),
    "mesh_force_mean": ("N", "mean mesh force"),
    "dynamic_factor": ("1", "largest over mean mesh force"),
    "radial_min": ("m", "smallest radial displacement of the pinion, sqrt(y2 + z2)"),
    "radial_max": ("m", "largest radial displacement of the pinion, sqrt(y2 + z2)"),
    "radial_mean": ("m", "mean radial displacement of the pinion, sqrt(y2 + z2)"),
    "radial_pp": ("m", "peak-to-peak radial displacement of the pinion"),
    "axial_pp": ("m", "peak-to-peak axial displacement of the pinion"),
    "wheel_axial_pp": ("m", "peak-to-peak axial displacement of the wheel gear"),
    "roller_load_min": ("N", "smallest load of roller 1 of pinion bearing 1"),
    "roller_load_max": ("N", "largest load of roller 1 of pinion bearing 1"),
    "roller_load_mean": ("N", "mean load of roller 1 of pinion bearing 1"),
    "bearing_roller_load_min": ("N", "smallest load of any roller of the bearing"),
    "bearing_roller_load_max": ("N", "largest load of any roller of the bearing"),
    "bearing_force_mean": ("N", "mean force of the bearing on its shaft"),
    "bearing_force_pp": ("N", "peak-to-peak force of the bearing on its shaft"),
    "power_in": ("W", "mean power into the pinion"),
    "loss": ("W", "mean power lost"),
    "efficiency_mesh": ("1", "efficiency of the gear mesh, eq. (21): flank friction only"),
    "efficiency_axle": ("1", "efficiency with all modelled losses"),
    "friction_loss_bound": (
        "W",
        "bound of flank friction by the film model; 0: formulas, nan: mixed",
    ),
    "efficiency_bound": ("1", "the same of both efficiencies"),
    "share_outside": ("1", "mean share of the flanks' load outside the film model's domain"),
    "drag_bound": ("W", "bound of bearing drag by the film model; 0: other laws, nan: mixed"),
    "rollers_outside": ("1", "mean share of the rollers' load outside their film model's domain"),
    "loss_low": ("W", "2.5 % of the draws of the uncertain data lose less in all"),
    "loss_high": ("W", "97.5 % of the draws lose less in all"),
    "efficiency_axle_low": ("1", "efficiency with the loss of loss_high"),
    "efficiency_axle_high": ("1", "efficiency with the loss of loss_low"),
    "energy_closure_error": ("1", "energy that the balance does not account for, over input"),
    "film_thickness_min": ("m", "smallest central film thickness on a loaded flank"),
    "film_ratio_min": ("1", "smallest film ratio on a loaded flank"),
    "flank_temperature_max": ("K", "largest film temperature on a flank"),
    "frequency": ("Hz", "frequency of the bin at the mean speed"),
    "order": ("1", "cycles per pinion revolution"),
    "dte_spectrum": ("m", "amplitude of the dynamic transmission error"),
    "radial_spectrum": ("m", "amplitude of the radial displacement of the pinion"),
    "axial_spectrum": ("m", "amplitude of the axial displacement of the pinion"),
    "bearing_force_spectrum": ("N", "amplitude of the force of bearing 1 along y"),
    "roller_load_spectrum": ("N", "amplitude of the load of roller 1 of pinion bearing 1"),
    "pinion_angle": ("rad", "pinion angle within one revolution"),
    "dte_wave": ("m", "dynamic transmission error over one pinion revolution"),
    "mesh_force_wave": ("N", "mesh force over one pinion revolution"),
    "pinion_y_wave": ("m", "displacement of the pinion along y over one revolution"),
    "pinion_z_wave": ("m", "displacement of the pinion along z over one revolution"),
    "roller_load_wave": ("N", "load of roller 1 of pinion bearing 1 over one revolution"),
    "mesh_phase": ("1", "mesh cycles since the first flank took over a tooth pair"),
    "flank_load": ("N", "load on the flank, mean over the cycles"),
    "flank_film_thickness": ("m", "central film thickness, mean over the cycles"),
    "flank_film_ratio": ("1", "film ratio, mean over the cycles"),
    "flank_friction_coefficient": ("1", "coefficient of friction, mean over the cycles"),
    "flank_temperature": ("K", "film temperature, mean over the cycles"),
    "flank": ("1", "number of the flank"),
    "bearing": ("1", "number of the bearing"),
    "cage_angle": ("rad", "angle of the pinion bearing cage"),
    "roller_zone_mean": ("N", "mean load of roller 1 at this cage angle"),
    "roller_zone_min": ("N", "smallest load of roller 1 at this cage angle"),
    "roller_zone_max": ("N", "largest load of roller 1 at this cage angle"),
    "dte_order_held": ("m", "largest mesh order of the transmission error, without the car"),
    "bearing_force_order_held": ("N", "largest mesh order of the bearing force, without the car"),
    "mode_frequency": ("Hz", "natural frequency at the mean mesh stiffness"),
    "mode_damping": ("1", "damping ratio of a natural mode"),
    "mode_strain": ("1", "share of a spring in the potential energy of a mode"),
}
_POINT_COORDINATES = ("speed", "speed_kmh", "preload")

Points = Mapping[tuple[float, float], xr.Dataset]


def described(dataset: xr.Dataset) -> xr.Dataset:
    """Return `dataset` with `units` and `long_name` on every known variable."""
    for name in map(str, dataset.variables):
        if name in QUANTITIES:
            unit, text = QUANTITIES[name]
            dataset[name].attrs.update(units=unit, long_name=text)
    if "separation" in dataset:
        dataset["separation"].attrs.update(
            flag_values=np.arange(3, dtype=np.int64),
            flag_meanings=" ".join(SEPARATION_MEANINGS),
        )
    return dataset


def merge(preloads: Sequence[float], speeds_kmh: Sequence[float], points: Points) -> xr.Dataset:
    """Join points into a dataset over (preload, speed).

    Spectra of different length are padded with NaN along `bin`; what a failed or missing point
    lacks is NaN, and its `status` is 0.

    Parameters
    ----------
    preloads : sequence of float
        [N].
    speeds_kmh : sequence of float
        [km/h].
    points : mapping
        Datasets by (speed_kmh, preload).
    """
    variables: dict[str, xr.DataArray] = {}
    for row, preload in enumerate(preloads):
        for column, speed_kmh in enumerate(speeds_kmh):
            point = points.get((speed_kmh, preload))
            if point is None:
                continue
            for name, variable in point.data_vars.items():
                block = _room(variables, str(name), variable, (len(preloads), len(speeds_kmh)))
                inner = tuple(slice(size) for size in variable.shape)
                block[(row, column, *inner)] = variable.values
    dataset = xr.Dataset(variables)
    shared = {
        str(name): coordinate
        for point in points.values()
        for name, coordinate in point.coords.items()
        if name not in _POINT_COORDINATES
    }
    dataset = dataset.assign_coords(
        {
            **shared,
            "preload": list(map(float, preloads)),
            "speed": [kmh_to_ms(v) for v in speeds_kmh],
            "speed_kmh": ("speed", list(map(float, speeds_kmh))),
        }
    )
    if "status" in dataset:
        dataset["status"] = dataset["status"].fillna(0).astype(np.int64)
    return described(dataset)


def with_churning_regime(sweep: xr.Dataset, axle: HypoidAxleParameters) -> xr.Dataset:
    """Return a sweep with `churning_regime`, where its axle has one and its points have run."""
    if "pinion_speed" in sweep and "oil_temperature" in sweep:
        gear_speed = sweep["pinion_speed"] / axle.mesh.ratio
        regime = churning_regime(axle, sweep["oil_temperature"], gear_speed)
        if regime is not None:
            sweep["churning_regime"] = (GRID, regime)
    return sweep


def _room(
    variables: dict[str, xr.DataArray], name: str, variable: xr.DataArray, grid: tuple[int, int]
) -> xr.DataArray:
    """Return the array of `name` over the grid, created or grown to hold `variable`."""
    is_text = variable.dtype.kind in "UOS"
    empty: Any = "" if is_text else np.nan
    block = variables.get(name)
    if block is None:
        values = np.full((*grid, *variable.shape), empty, dtype=object if is_text else np.float64)
        block = variables[name] = xr.DataArray(values, dims=(*GRID, *variable.dims))
    shape = tuple(max(a, b) for a, b in zip(block.shape[2:], variable.shape, strict=True))
    if shape != block.shape[2:]:
        grow = {
            dim: (0, new - old)
            for dim, new, old in zip(variable.dims, shape, block.shape[2:], strict=True)
        }
        block = variables[name] = block.pad(grow, constant_values=empty)
    return block


def save(dataset: xr.Dataset, directory: Path) -> Path:
    """Write DIR/sweep.nc and DIR/summary.csv; return the NetCDF path."""
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / "sweep.nc"
    write_compressed_dataset(dataset, path)
    write_text(summary_csv(dataset), directory / "summary.csv")
    return path


def load_sweep(path: Path | str) -> Result:
    """Read the results of a sweep: sweep.nc, or the folder it is in.

    `.sel(speed_kmh=60, preload=2500)` works on the dataset.

    Examples
    --------
    >>> load_sweep("gearlube_sweep").sel(speed_kmh=60.0, preload=2500.0)  # doctest: +SKIP
    """
    path = Path(path)
    dataset = read_dataset(path / "sweep.nc" if path.is_dir() else path)
    if "speed_kmh" not in dataset.xindexes:
        dataset = dataset.set_xindex("speed_kmh")
    return Result.of(dataset, "sweep")


def summary_table(dataset: xr.Dataset) -> Any:
    """Return the scalars of every point as a pandas table, one row a point."""
    columns = _columns(dataset)
    return columns.to_dataframe().reset_index().drop(columns="speed", errors="ignore")


def summary_csv(dataset: xr.Dataset) -> str:
    """Return this table as text: units in the headings, five significant digits."""
    table, columns = summary_table(dataset), _columns(dataset)
    return csv_text(
        [heading(name, columns[name]) for name in table],
        zip(*([_text(value) for value in table[name]] for name in table), strict=True),
    )


def _text(value: Any) -> str:
    return number_text(value, 5) if isinstance(value, float) else str(value)


def _columns(dataset: xr.Dataset) -> xr.Dataset:
    scalars = {
        name: variable
        for name, variable in dataset.data_vars.items()
        if set(variable.dims) == set(GRID)
    }
    columns = xr.Dataset(scalars, coords={k: dataset[k] for k in ("preload", "speed_kmh")})
    for source in dataset["source"].values if "loss" in dataset else ():
        columns[f"loss_{source}"] = dataset["loss"].sel(source=source, drop=True)
    return columns
