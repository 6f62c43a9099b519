"""Natural frequencies of the axle of a sweep, mesh orders that cross them, and key numbers."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.modes import driveline_modes
from drivetrain.steady_temperature import steady_temperature
from drivetrain.sump_heat import SumpHeat
from gearlube.report.parts import Number
from gearlube.studies.sweep.axle_in_fmu import car_axle_at
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube_core.arrays import Array
from gearlube_core.errors import ConvergenceError, GearLubeError
from gearlube_core.units import kelvin_to_celsius, kmh_to_ms

ORDERS = (1, 2, 3)
_ROUNDS, _SETTLED = 20, 1e-4  # K; a round leaves some per cent of the last one's change
logger = logging.getLogger(__name__)

_LOWEST_DRIVELINE_MODE = 100.0  # Hz, lower ones lie below the mesh frequencies of a sweep


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


def oil_at_rest(car: CarAxle, speed_kmh: float, settings: SweepSettings) -> SweepSettings:
    """Return the settings with the oil temperature at which the air takes what the axle loses.

    Parameters
    ----------
    car : CarAxle
        Axle and car of the point, with its preload and oil.
    speed_kmh : float
        Vehicle speed [km/h].
    settings : SweepSettings
        Unless its `oil_state` is "steady" it comes back as it is.

    Raises
    ------
    ParameterError
        The oil would leave the range of its data.

    Notes
    -----
    The pinion's torque is that of the road and that of the loss, which is hA (T - T_air) at rest.
    The loss is that of `axle_losses`, within 1 % of the march that follows.
    """
    if settings.oil_state != STEADY:
        return settings
    road = car.driveline.road_load
    speed = kmh_to_ms(speed_kmh)
    heat = SumpHeat(
        conductance_at_rest=settings.conductance_at_rest,
        conductance_at_100_kmh=settings.conductance_at_100_kmh,
    )
    found = settings.air_temperature
    for _ in range(_ROUNDS):
        lost = heat.conductance(speed) * (found - settings.air_temperature)
        before = found
        found = steady_temperature(
            car,
            torque=road.pinion_torque(speed, lost),
            speed=road.pinion_speed(speed),
            air_temperature=settings.air_temperature,
            heat=heat,
        )
        if abs(found - before) < _SETTLED:
            return replace(settings, oil_temperature=found)
    raise ConvergenceError(
        f"The oil temperature at {speed_kmh:g} km/h must settle within {_ROUNDS} rounds, but it "
        f"changed by {abs(found - before):.3g} K in the last one. Change the speed a little."
    )


def natural_frequencies(
    preloads: Sequence[float], speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> xr.DataArray:
    """Return undamped natural frequencies [Hz] over (preload, mode).

    The axle is linearised about its static state under the road load at `speed_kmh`, with the
    mean mesh stiffness; its modes are named after the coordinate with most of the kinetic energy.
    With the coupled vehicle, the driveline's modes above 100 Hz (rigid axle) follow.

    Notes
    -----
    Modes are matched between preloads by their order, since two modes that share their energy may
    swap names; all take the names that they have at the first preload.
    """
    found = [_modes(preload, speed_kmh, settings, car_axle) for preload in preloads]
    first = next((row for row in found if row), {})
    driveline = _driveline_modes(speed_kmh, settings, car_axle)
    names = [*first, *driveline]
    values = np.full((len(found), len(names)), np.nan)
    for row, frequencies in zip(values, found, strict=True):
        if len(frequencies) == len(first):
            row[: len(first)] = sorted(frequencies.values())
        row[len(first) :] = list(driveline.values())
    return xr.DataArray(values, dims=("preload", "mode"), coords={"mode": names})


def _driveline_modes(
    speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> dict[str, float]:
    if settings.driver != "vehicle":
        return {}
    found = driveline_modes(Driveline(car_axle.driveline, kmh_to_ms(speed_kmh)))
    return {m.name: m.frequency for m in found if m.frequency > _LOWEST_DRIVELINE_MODE}


def _modes(
    preload: float, speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> dict[str, float]:
    # Imported here because it compiles kernels when the machine has none yet.
    from gearlube_core.dynamics.hypoid_axle import HypoidAxle, modes

    speed = kmh_to_ms(speed_kmh)
    road = car_axle.driveline.road_load
    torque = road.pinion_torque(speed)
    try:
        car = car_axle_at(car_axle, settings, preload)
        oil_temperature = oil_at_rest(car, speed_kmh, settings).oil_temperature
        axle = HypoidAxle(car.axle)
        axle.initialise(
            pinion_speed=road.pinion_speed(speed),
            pinion_torque=torque,
            wheel_torque=road.ring_gear_torque(speed),
            oil_temperature=oil_temperature,
        )
        found = modes(axle, oil_temperature, torque)
    except GearLubeError as error:
        logger.warning("No natural frequencies at %g N: %s", preload, error)
        return {}
    return dict(sorted(found.items(), key=lambda item: item[1]))
