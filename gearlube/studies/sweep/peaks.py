"""Mesh orders that cross natural frequencies, the largest ones, key numbers of a sweep."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.parts import Number
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


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a sweep with a finished point."""
    if "dte_pp" not in dataset:
        return []
    found = []
    if peaks := peak_orders(dataset):
        top = max(peaks, key=lambda one: one.amplitude)
        found += [
            Number(
                "largest mesh order of the transmission error, amplitude", 1e6 * top.amplitude, "µm"
            ),
            Number("largest mesh order of the transmission error, order", top.order, "", 1),
            Number("largest mesh order of the transmission error, at", top.speed_kmh, "km/h", 2),
        ]
    loss = dataset["loss"].sum("source", skipna=False)
    warmest = kelvin_to_celsius(_most(dataset["flank_temperature_max"]))
    return [
        *found,
        Number("largest transmission error, peak to peak", 1e6 * _most(dataset["dte_pp"]), "µm"),
        Number("least efficiency of the axle", 100.0 * _least(dataset["efficiency_axle"]), "%", 4),
        Number("best efficiency of the axle", 100.0 * _most(dataset["efficiency_axle"]), "%", 4),
        Number("largest loss", _most(loss), "W"),
        Number("least film on a flank", 1e6 * _least(dataset["film_thickness_min"]), "µm"),
        Number("least film ratio", _least(dataset["film_ratio_min"]), "", 2),
        Number("largest roller load", _most(dataset["bearing_roller_load_max"]), "N"),
        Number("least roller load", _least(dataset["bearing_roller_load_min"]), "N"),
        Number("warmest flank film", warmest, "°C"),
    ]


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
