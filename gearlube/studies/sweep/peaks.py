"""Largest mesh orders of a sweep, the natural modes near them, and its key numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import xarray as xr

from drivetrain.driveline.modes import AXLE_SPRINGS
from gearlube.report.parts import Number
from gearlube.studies.sweep.datasets import merge
from gearlube_core.arrays import Array
from gearlube_core.units import kelvin_to_celsius

ORDERS = (1, 2, 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Crossing:
    """A mesh order and a natural frequency.

    Parameters
    ----------
    order : int
        Multiple of the mesh frequency.
    mode : str
    preload : float
        [N].
    frequency : float
        Of the mode [Hz].
    speed_kmh : float
        Vehicle speed at which they are equal [km/h].
    margin : float
        By what share of that speed it lies outside the swept speeds [-]; 0 inside.
    """

    order: int
    mode: str
    preload: float
    frequency: float
    speed_kmh: float
    margin: float

    def __str__(self) -> str:
        return (
            f"order {self.order} with '{self.mode}' ({self.frequency:.0f} Hz) at "
            f"{self.speed_kmh:.0f} km/h"
        )


def crossings(dataset: xr.Dataset) -> list[Crossing]:
    """Return every mesh order of `ORDERS` with every natural frequency, by rising speed.

    The mesh frequency grows in proportion to the speed. Without natural frequencies, or without a
    finished point, there are none.
    """
    if "mode_frequency" not in dataset or "mesh_frequency" not in dataset:
        return []
    speeds = dataset["speed_kmh"].values
    per_kmh = dataset["mesh_frequency"].values / speeds  # Hz
    if not np.any(np.isfinite(per_kmh)):
        return []
    slope = float(np.nanmean(per_kmh))
    found = []
    for row, preload in enumerate(dataset["preload"].values):
        frequencies = dataset["mode_frequency"].values[row]
        for mode, frequency in zip(dataset["mode"].values, frequencies, strict=True):
            if not np.isfinite(frequency):
                continue
            for order in ORDERS:
                speed = float(frequency) / (order * slope)
                outside = max(speeds[0] - speed, speed - speeds[-1], 0.0)
                found.append(
                    Crossing(
                        order=order,
                        mode=str(mode),
                        preload=float(preload),
                        frequency=float(frequency),
                        speed_kmh=speed,
                        margin=float(outside) / speed,
                    )
                )
    return sorted(found, key=lambda one: one.speed_kmh)


class Peak(NamedTuple):
    """The largest amplitude of a mesh order, and where it is."""

    order: int
    amplitude: float
    speed_kmh: float
    preload: float
    frequency: float


def peak_orders(dataset: xr.Dataset, variable: str = "dte_spectrum") -> list[Peak]:
    """Return the largest amplitude of each mesh order of a spectrum over speeds and preloads."""
    peaks = []
    for order in ORDERS:
        amplitude = np.array(
            [
                harmonic_amplitude(dataset.isel(preload=row), order, variable)
                for row in range(dataset.sizes["preload"])
            ]
        )
        if not np.any(np.isfinite(amplitude)):
            continue
        row, column = np.unravel_index(int(np.nanargmax(amplitude)), amplitude.shape)
        peaks.append(
            Peak(
                order,
                float(amplitude[row, column]),
                float(dataset["speed_kmh"].values[column]),
                float(dataset["preload"].values[row]),
                order * float(dataset["mesh_frequency"].values[row, column]),
            )
        )
    return peaks


_NOTABLE = 0.1  # of the largest order, from which on the place of an order is sought
# spectra whose largest mesh orders are in the findings, and their amplitude without the car
PEAKS = {"dte_spectrum": "dte_order_held", "bearing_force_spectrum": "bearing_force_order_held"}


def largest_peaks(dataset: xr.Dataset) -> dict[str, Peak]:
    """Return the largest mesh order of each spectrum of `PEAKS`."""
    found = {}
    for variable in (one for one in PEAKS if one in dataset and "mesh_frequency" in dataset):
        if peaks := peak_orders(dataset, variable):
            found[variable] = max(peaks, key=lambda one: one.amplitude)
    return found


def held_amplitudes(
    dataset: xr.Dataset, held: Mapping[tuple[float, float], xr.Dataset]
) -> dict[str, float]:
    """Return the amplitude of the largest mesh orders without the car, by the names in `PEAKS`.

    Parameters
    ----------
    dataset : Dataset
        Of the sweep.
    held : mapping
        Points by (speed [km/h], preload [N]) with the driver "hold".
    """
    found = {}
    for variable, top in largest_peaks(dataset).items():
        place = (top.speed_kmh, top.preload)
        if variable in held.get(place, ()):
            point = merge([top.preload], [top.speed_kmh], held).isel(preload=0)
            found[PEAKS[variable]] = float(harmonic_amplitude(point, top.order, variable)[0])
    return found


def speeds_at_peaks(dataset: xr.Dataset, step_kmh: float) -> list[float]:
    """Return speeds [km/h] to add around the largest mesh orders of each spectrum of `PEAKS`.

    These are the orders of at least a tenth of the largest one. The speeds are multiples of
    `step_kmh` around the top of the parabola through the logarithms of the three largest
    neighbours. None are returned once the largest amplitudes have their neighbours within
    `step_kmh`.

    Notes
    -----
    Near a lightly damped resonance the logarithm has one maximum between the neighbours.
    """
    added: set[float] = set()
    speeds = dataset["speed_kmh"].values
    tops = [
        (variable, one)
        for variable, largest in largest_peaks(dataset).items()
        for one in peak_orders(dataset, variable)
        if one.amplitude > _NOTABLE * largest.amplitude
    ]
    for variable, top in tops:
        row = dataset.sel(preload=top.preload)
        amplitude = harmonic_amplitude(row, top.order, variable)
        at = int(np.argmin(np.abs(speeds - top.speed_kmh)))
        low, high = max(at - 1, 0), min(at + 1, speeds.size - 1)
        if max(speeds[high] - speeds[at], speeds[at] - speeds[low]) <= step_kmh:
            continue
        place = _top_of_parabola(speeds[low : high + 1], np.log(amplitude[low : high + 1]))
        around = step_kmh * (round(place / step_kmh) + np.array([-1.0, 0.0, 1.0]))
        inside = around[(around > speeds[low]) & (around < speeds[high])]
        if not set(inside) - set(speeds):  # the parabola has its top at a known speed
            inside = np.array([0.5 * (a + b) for a, b in pairwise(speeds[low : high + 1])])
        added |= {float(one) for one in inside}
    return sorted(added - set(speeds))


def _top_of_parabola(x: Array, y: Array) -> float:
    """Return where the parabola through three points is largest, or the middle of two points.

    >>> round(_top_of_parabola(np.array([1.0, 2.0, 3.0]), np.array([0.0, 3.0, 2.0])), 6)
    2.25
    """
    if x.size < 3 or not np.all(np.isfinite(y)):
        return float(np.mean(x[[0, -1]]))
    left, right = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    bend = (right - left) / (x[2] - x[0])
    if bend >= 0.0:
        return float(x[1])
    return float(np.clip(0.5 * (x[0] + x[1] - left / bend), x[0], x[2]))


class NearMode(NamedTuple):
    """The natural mode nearest to a peak."""

    name: str
    frequency: float  # Hz
    car_strain: float  # share of the strain energy in springs of the car
    spring: str  # of the car that is strained most


def nearest_mode(dataset: xr.Dataset, peak: Peak) -> NearMode | None:
    """Return the natural mode nearest to the frequency of a peak; None without modes."""
    if "mode_frequency" not in dataset:
        return None
    row = dataset["mode_frequency"].sel(preload=peak.preload)
    if not np.any(np.isfinite(row.values)):
        return None
    at = int(np.nanargmin(np.abs(row.values - peak.frequency)))
    share, spring = 0.0, ""
    if "mode_strain" in dataset:
        strain = dataset["mode_strain"].isel(mode=at)
        in_car = strain.where(~strain["spring"].isin(AXLE_SPRINGS), drop=True)
        if in_car.size:
            share = float(in_car.sum())
            spring = str(in_car["spring"].values[int(np.argmax(in_car.values))])
    return NearMode(str(dataset["mode"].values[at]), float(row.values[at]), share, spring)


_OF_ORDERS = (
    ("dte_spectrum", "transmission error", 1e6, "µm"),
    ("bearing_force_spectrum", "bearing forces", 1.0, "N"),
)


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a sweep with a finished point."""
    if "dte_pp" not in dataset:
        return []
    found = []
    tops = largest_peaks(dataset)
    for variable, words, factor, unit in _OF_ORDERS:
        if top := tops.get(variable):
            name = f"largest mesh order of the {words}"
            found += [
                Number(f"{name}, amplitude", factor * top.amplitude, unit),
                Number(f"{name}, order", top.order, "", 1),
                Number(f"{name}, at", top.speed_kmh, "km/h", 2),
            ]
    loss = largest_loss(dataset)
    warmest = kelvin_to_celsius(_most(dataset["flank_temperature_max"]))
    return [
        *found,
        Number("largest transmission error, peak to peak", 1e6 * _most(dataset["dte_pp"]), "µm"),
        Number("least efficiency of the axle", 100.0 * _least(dataset["efficiency_axle"]), "%", 4),
        Number("best efficiency of the axle", 100.0 * _most(dataset["efficiency_axle"]), "%", 4),
        Number("largest loss", float(loss["loss"].sum()), "W", band=loss_band(loss)),
        Number("least film on a flank", 1e6 * _least(dataset["film_thickness_min"]), "µm"),
        Number("least film ratio", _least(dataset["film_ratio_min"]), "", 2),
        Number("largest roller load", _most(dataset["bearing_roller_load_max"]), "N"),
        Number("least roller load", _least(dataset["bearing_roller_load_min"]), "N"),
        Number("warmest flank film", warmest, "°C"),
    ]


def largest_loss(dataset: xr.Dataset) -> xr.Dataset:
    """Return the point of a sweep with the largest loss."""
    total = dataset["loss"].sum("source", skipna=False)
    return dataset.isel(total.argmax(...))


def loss_band(point: xr.Dataset) -> tuple[float, float] | None:
    """Return both ends [W] of the 95 % band of a point's loss; None where it has none."""
    low, high = (float(point.get(f"loss_{end}", np.nan)) for end in ("low", "high"))
    return (low, high) if high > low else None


def _least(values: xr.DataArray) -> float:
    return float(values.min())


def _most(values: xr.DataArray) -> float:
    return float(values.max())


def harmonic_amplitude(row: xr.Dataset, harmonic: int, variable: str = "dte_spectrum") -> Array:
    """Return the amplitude of mesh order `harmonic` of a spectrum at every speed of one preload."""
    result = np.full(row.sizes["speed"], np.nan)
    target = harmonic * row["mesh_frequency"].values
    for column in range(result.size):
        frequency = row["frequency"].values[column]
        known = np.isfinite(frequency)
        if np.isfinite(target[column]) and np.any(known):
            nearest = np.argmin(np.abs(frequency[known] - target[column]))
            result[column] = row[variable].values[column][known][nearest]
    return result
