"""The largest mesh orders of a sweep, and its key numbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.parts import Number
from gearlube.studies.sweep.crossings import ORDERS
from gearlube.studies.sweep.figures.order_cuts import harmonic_amplitude
from gearlube_core.units import kelvin_to_celsius


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
