"""Bearing forces over time, read from the NetCDF file of a run and checked."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import open_dataset

FORCE, TIME, SPEED = "bearing_force", "time", "pinion_speed"
_UNITS = {
    FORCE: ("N",),
    TIME: ("s",),
    SPEED: ("rad/s", "rad s-1"),
    "wheel_speed": ("rad/s", "rad s-1"),
    "pinion_angle": ("rad",),
    "vehicle_speed": ("m/s", "m s-1"),
}
LEAST_RATE = 2000.0  # Hz; below, what whines is not in the record
LEAST_TIME = 0.5  # s
_UNEVEN = 1e-3  # of a step; NetCDF files hold time with at least seven digits
_CURE = "Give the NetCDF file, or the folder, that `gearlube runup` writes."


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceRecord:
    """Forces on bearings at a constant rate, with the motion of the pinion.

    Parameters
    ----------
    name : str
        What the run is called in figures and sentences.
    rate : float
        Samples per second [Hz].
    time : array
        [s], shape (n,).
    paths : tuple of str
        "bearing.direction" of every force.
    force : array
        [N], shape (paths, n).
    angle, speed : array
        Of the pinion [rad], [rad/s], shape (n,).
    vehicle_speed : array or None
        [m/s], shape (n,).
    teeth : int or None
        Teeth of the pinion [-].
    """

    name: str
    rate: float
    time: Array
    paths: tuple[str, ...]
    force: Array
    angle: Array
    speed: Array
    vehicle_speed: Array | None = None
    teeth: int | None = None


def read_forces(source: Path | str | xr.Dataset, name: str = "") -> ForceRecord:
    """Return the bearing forces of a run.

    Parameters
    ----------
    source : path or dataset
        NetCDF file with `bearing_force(time, bearing, direction)` [N], `time` [s] and
        `pinion_speed(time)` [rad/s], or a folder with one such file. `pinion_angle(time)` [rad],
        `vehicle_speed(time)` [m/s], or `wheel_speed(time)` [rad/s] with the attribute
        `rolling_radius` [m], and the attribute `pinion_teeth` are used if they are there.
    name : str
        Empty: the name of the folder or file.

    Raises
    ------
    FileError
        There is no such file.
    ParameterError
        A variable or unit is missing, the rate is too low or not constant, a value is not finite.
    """
    if isinstance(source, xr.Dataset):
        return _record(source, name or str(source.attrs.get("name", "run")), "the dataset")
    path = Path(source)
    file = _file_in(path) if path.is_dir() else path
    with _opened(file) as dataset:
        return _record(dataset, name or (path.name if path.is_dir() else path.stem), str(file))


def _opened(file: Path) -> xr.Dataset:
    try:
        return open_dataset(file, decode_times=False)
    except FileError as reason:
        raise FileError(f"{reason} {_CURE}") from None


def _file_in(folder: Path) -> Path:
    files = sorted(folder.glob("*.nc"))
    found = []
    for file in files:
        with _opened(file) as dataset:
            if FORCE in dataset:
                found.append(file)
    if len(found) != 1:
        got = ", ".join(file.name for file in (found or files)) or "no .nc file"
        raise ParameterError(
            f"The folder {folder} must hold one file with {FORCE}(time, bearing, direction), got "
            f"{len(found)} ({got}). {_CURE}"
        )
    return found[0]


def _record(dataset: xr.Dataset, name: str, where: str) -> ForceRecord:
    time = _values(dataset, TIME, where)
    rate = _rate(time, where)
    force = _values(dataset, FORCE, where, extra=("bearing", "direction"))
    speed = _values(dataset, SPEED, where)
    angle = (
        _values(dataset, "pinion_angle", where)
        if "pinion_angle" in dataset
        else np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1])) / rate])
    )
    paths = tuple(
        f"{bearing}.{direction}"
        for bearing in _labels(dataset, "bearing")
        for direction in _labels(dataset, "direction")
    )
    if np.any(speed <= 0.0):
        raise ParameterError(
            f"{SPEED} in {where} must be above 0 rad/s all the time, got {np.min(speed):.4g} "
            "rad/s. Start the record when the pinion already turns."
        )
    teeth = dataset.attrs.get("pinion_teeth")
    return ForceRecord(
        name=name,
        rate=rate,
        time=time,
        paths=paths,
        force=np.ascontiguousarray(force.reshape(time.size, -1).T),
        angle=angle,
        speed=speed,
        vehicle_speed=_vehicle_speed(dataset, where),
        teeth=None if teeth is None else int(teeth),
    )


def _vehicle_speed(dataset: xr.Dataset, where: str) -> Array | None:
    """Return the speed of the car [m/s]: given, or of wheels that roll without slip."""
    if "vehicle_speed" in dataset:
        return _values(dataset, "vehicle_speed", where)
    if "wheel_speed" in dataset and "rolling_radius" in dataset.attrs:
        radius = float(dataset.attrs["rolling_radius"])
        return radius * _values(dataset, "wheel_speed", where)
    return None


def _labels(dataset: xr.Dataset, dimension: str) -> list[str]:
    if dimension in dataset.coords:
        return [str(one) for one in dataset[dimension].values]
    return [str(i + 1) for i in range(dataset.sizes[dimension])]


def _values(dataset: xr.Dataset, name: str, where: str, extra: tuple[str, ...] = ()) -> Array:
    if name not in dataset:
        held = ", ".join(sorted(str(one) for one in dataset.variables)) or "nothing"
        raise ParameterError(f"{where} must hold {name}, got {held}. {_CURE}")
    variable, wanted = dataset[name], (TIME, *extra)
    if set(variable.dims) != set(wanted):
        raise ParameterError(
            f"{name} in {where} must have the dimensions {', '.join(wanted)}, got "
            f"{', '.join(str(one) for one in variable.dims) or 'none'}. {_CURE}"
        )
    unit, allowed = variable.attrs.get("units"), _UNITS[name]
    if unit not in allowed:
        raise ParameterError(
            f"{name} in {where} must have a unit, units = {allowed[0]!r}, got "
            f"{'none' if unit is None else repr(unit)}. Convert it and set the attribute."
        )
    values = variable.transpose(*wanted).values.astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(values.reshape(values.shape[0], -1)).all(axis=1))
    if bad.size:
        raise ParameterError(
            f"{name} in {where} must be finite all the time, got a gap of {bad.size} samples, the "
            f"first at sample {bad[0]}. Cut the record before it, or run the study again."
        )
    return values


def _rate(time: Array, where: str) -> float:
    steps = np.diff(time)
    middle = float(np.median(steps)) if steps.size else 0.0
    if middle <= 0.0:
        raise ParameterError(
            f"time in {where} must rise from sample to sample, got {time.size} samples with a "
            f"median step of {middle:g} s. {_CURE}"
        )
    off = np.abs(steps - middle)
    # single precision loses digits in long records
    allowed = max(_UNEVEN * middle, 2.0 * float(np.spacing(np.float32(np.abs(time).max()))))
    if np.max(off) > allowed:
        at = int(np.argmax(off))
        kind = "a gap" if steps[at] > 1.5 * middle else "an uneven step"
        raise ParameterError(
            f"time in {where} must have a constant step of {middle:.6g} s to within "
            f"{allowed:.2g} s, got {kind} of {steps[at]:.6g} s at {time[at]:.6g} s. Record at a "
            "constant rate, or resample before."
        )
    rate = (time.size - 1) / float(time[-1] - time[0])
    if rate < LEAST_RATE:
        raise ParameterError(
            f"The rate of {where} must be at least {LEAST_RATE:g} Hz, or nothing above "
            f"{0.45 * LEAST_RATE:g} Hz is heard; got {rate:.6g} Hz. Record the run at a higher "
            "rate."
        )
    if time[-1] - time[0] < LEAST_TIME:
        raise ParameterError(
            f"{where} must last at least {LEAST_TIME:g} s, got {time[-1] - time[0]:.3g} s. "
            "Loudness and roughness need time to settle: record for longer."
        )
    return rate
