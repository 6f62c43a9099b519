"""Numbers read off a sweep for the table of claims."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import xarray as xr

from docs.page import border
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle

PINION_TEETH = 13
OIL_TEMPERATURE = 368.15  # K
LOWEST_LINE = 60.0  # Hz; below are shaft rotation, driveline and controller


def split_rms(sweep: xr.Dataset, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the rms of `name` at mesh orders and at all other lines, shape (preload, speed)."""
    order = sweep["order"].values
    power = 0.5 * sweep[f"{name}_spectrum"].values ** 2
    counted = sweep["frequency"].values > LOWEST_LINE
    at_mesh = np.abs(order / PINION_TEETH - np.round(order / PINION_TEETH)) < 1e-6
    mesh = np.sqrt(np.nansum(np.where(counted & at_mesh, power, 0.0), axis=-1))
    other = np.sqrt(np.nansum(np.where(counted & ~at_mesh, power, 0.0), axis=-1))
    return mesh, other


def strongest_other_line(sweep: xr.Dataset, name: str) -> np.ndarray:
    """Return the frequency [Hz] of the strongest line off the mesh orders, (preload, speed)."""
    order = sweep["order"].values
    amplitude = np.nan_to_num(sweep[f"{name}_spectrum"].values)
    frequency = sweep["frequency"].values
    at_mesh = np.abs(order / PINION_TEETH - np.round(order / PINION_TEETH)) < 1e-6
    amplitude = np.where(at_mesh | ~(frequency > LOWEST_LINE), 0.0, amplitude)
    return np.take_along_axis(frequency, amplitude.argmax(axis=-1)[..., None], axis=-1)[..., 0]


def amplitude_at(sweep: xr.Dataset, name: str, frequency: str) -> np.ndarray:
    """Return the amplitude of `name` in the bin nearest to a frequency variable."""
    bins = sweep["frequency"].values
    target = sweep[frequency].values[..., None]
    nearest = np.nanargmin(np.abs(np.where(np.isfinite(bins), bins, np.inf) - target), axis=-1)
    values = sweep[f"{name}_spectrum"].values
    return np.take_along_axis(values, nearest[..., None], axis=-1)[..., 0]


def smallest_roller_load(preload: float, speed: float, torques: tuple[float, float]) -> float:
    """Return the smallest load [N] of any roller over 0.2 s after settling at a preload [N]."""
    axle = HypoidAxle(mohammadpour_2015_axle(bearing_preload=preload))
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torques[0],
        wheel_torque=torques[1],
        oil_temperature=OIL_TEMPERATURE,
    )
    columns = [OUTPUT_INDEX[f"bearing[{j}].roller_load_min"] for j in (1, 2, 3, 4)]
    smallest = np.inf
    for step in range(3000):
        axle.step(1e-4, *torques, OIL_TEMPERATURE)
        if step >= 1000:
            smallest = min(smallest, float(axle.outputs[columns].min()))
    return smallest


@cache
def unloading_preload(speed: float, pinion_torque: float, wheel_torque: float) -> float:
    """Return the preload [N] below which some roller loses its load, to 25 N by bisection."""
    torques = (pinion_torque, wheel_torque)

    def loaded(preload: float) -> bool:
        return smallest_roller_load(preload, speed, torques) > 0.0

    return border(loaded, 3000.0, 100.0, 25.0)


def range_text(values: np.ndarray, form: str = "{:.3g}", scale: float = 1.0) -> str:
    """Return 'smallest to largest' of the finite values times `scale`."""
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)] * scale
    return f"{form.format(finite.min())} to {form.format(finite.max())}"


def log_slope(function: Callable[[float], float], at: float) -> float:
    """Return d ln f / d ln x at `at` by a central difference."""
    high, low = function(at * 1.001), function(at / 1.001)
    return float((np.log(high) - np.log(low)) / (2.0 * np.log(1.001)))
