"""One point of a sweep: the axle FMU with its driver at one speed and one preload."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.drivers import Driver
from gearlube.studies.sweep.axle_in_fmu import car_axle_at, car_axle_of
from gearlube.studies.sweep.datasets import described
from gearlube.studies.sweep.fmu_axle import FmuAxle
from gearlube.studies.sweep.natural_frequencies import oil_at_rest
from gearlube.studies.sweep.recording import (
    AXES,
    BEARINGS,
    CHANNELS,
    FLANKS,
    LOSSES,
    Recording,
    SteppedAxle,
    operation,
    record,
)
from gearlube.studies.sweep.scalars import mesh_cycle, roller_zone, scalars, spectra, waves
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube.studies.sweep.unpack import unpacked
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.uncertain import drawn_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.spectra import angle_window
from gearlube_core.units import kmh_to_ms


class _PythonAxle:
    """An axle that starts at a speed; the same interface as `FmuAxle`.

    Parameters
    ----------
    parameters : HypoidAxleParameters
    channels : sequence of str
        Outputs that `read` returns, in this order; FMI names.
    pinion_speed : float
        At the start [rad/s].
    """

    def __init__(
        self, parameters: HypoidAxleParameters, channels: Sequence[str], pinion_speed: float
    ) -> None:
        self._axle = HypoidAxle(parameters)
        self._columns = np.array([OUTPUT_NAMES.index(name) for name in channels])
        self._speed, self._temperature, self._time = pinion_speed, 0.0, 0.0
        self._warned: dict[str, str] = {}

    @property
    def warnings(self) -> list[str]:
        """Quantities that left their range since the start, each once."""
        return list(self._warned.values())

    def initialise(self, pinion_torque: float, wheel_torque: float, temperature: float) -> None:
        """Start with these inputs [N.m, N.m, K]."""
        self._temperature, self._time = temperature, 0.0
        self._axle.initialise(
            pinion_speed=self._speed,
            pinion_torque=pinion_torque,
            wheel_torque=wheel_torque,
            oil_temperature=temperature,
        )

    def step(self, h: float, pinion_torque: float, wheel_torque: float) -> None:
        """Advance by `h` [s] with constant torques [N.m]."""
        self._axle.step(h, pinion_torque, wheel_torque, self._temperature)
        self._time += h
        if self._axle.output("range.exceeded"):
            for name, sentence in self._axle.exceeded().items():
                self._warned.setdefault(name, f"{sentence} First at t = {self._time:g} s.")

    def read(self) -> Array:
        """Return the channels."""
        return np.asarray(self._axle.outputs[self._columns])


_LOSS_CHANNELS = (
    "pinion.angle",
    "pinion.speed",
    "wheel.angle",
    "wheel.speed",
    *(f"energy.{loss}" for loss in LOSSES),
)

_SETTLING, _MEASURING = 0.06, 0.06  # s
_BOUNDS = 2.5, 97.5  # percent
_OUTPUTS = "range."  # an FMU's warning of a range begins with its output

FINISHED, FAILED = 1, 0

Place = tuple[float, float]  # speed [km/h], preload [N]
PointFunction = Callable[[Path, float, float, SweepSettings], xr.Dataset]


def run_point(
    fmu: Path | str, speed_kmh: float, preload: float, settings: SweepSettings
) -> xr.Dataset:
    """Simulate one point and return everything the figures need.

    Parameters
    ----------
    fmu : path
        The axle FMU, or the folder into which it was unzipped (faster for many points).
    speed_kmh : float
        Vehicle speed [km/h].
    preload : float
        Bearing preload [N].
    settings : SweepSettings
        Everything else.

    Returns
    -------
    xarray.Dataset
        Scalars, spectra, one revolution of waveforms, mean mesh cycle and roller load zone, with
        units. `status` is 0 and `message` says why when the FMU or its driver refused.
    """
    try:
        with unpacked(Path(fmu)) as directory:
            recording = _simulate(directory, speed_kmh, preload, settings)
            axle = car_axle_at(car_axle_of(directory), settings, preload).axle
        return _with_error_bars(summarise(recording, speed_kmh, preload, settings), axle)
    except GearLubeError as error:
        return failed_point(speed_kmh, preload, str(error))


def _simulate(
    directory: Path, speed_kmh: float, preload: float, settings: SweepSettings
) -> Recording:
    parameters = {**settings.fmu_parameters, "bearing.preload": preload}
    car = car_axle_of(directory)
    if settings.oil_state == STEADY:
        settings = oil_at_rest(car_axle_at(car, settings, preload), speed_kmh, settings)

    @contextmanager
    def started(channels: Sequence[str], pinion_speed: float) -> Iterator[FmuAxle]:
        with FmuAxle(directory, channels) as axle:
            axle.set_parameters({**parameters, "pinion.speed_start": pinion_speed})
            yield axle

    return _recorded(started, car.driveline, speed_kmh, settings)


def march(car_axle: CarAxle, speed_kmh: float, settings: SweepSettings) -> xr.Dataset:
    """Simulate one point of an axle as it is, without an FMU.

    Parameters
    ----------
    car_axle : CarAxle
        Axle and car; the settings' options of the axle, roughness and backlash do not count.
    speed_kmh : float
        Vehicle speed [km/h].
    settings : SweepSettings
        Oil temperature, driver and timing.

    Returns
    -------
    xarray.Dataset
        As of `run_point`.

    Raises
    ------
    GearLubeError
        The axle or its driver refused.
    """
    axle = car_axle.axle
    recording = marched(car_axle, speed_kmh, settings)
    preload = float(axle.bearings[0].preload_force())
    return _summary(recording, speed_kmh, preload, axle.backlash)


def marched(car_axle: CarAxle, speed_kmh: float, settings: SweepSettings) -> Recording:
    """Return the outputs of an axle over time, where `march` returns numbers; alike otherwise."""
    settings = oil_at_rest(car_axle, speed_kmh, settings)

    @contextmanager
    def started(channels: Sequence[str], pinion_speed: float) -> Iterator[_PythonAxle]:
        yield _PythonAxle(car_axle.axle, channels, pinion_speed)

    return _recorded(started, car_axle.driveline, speed_kmh, settings)


def _recorded(
    started: Callable[[Sequence[str], float], AbstractContextManager[FmuAxle | _PythonAxle]],
    driveline: DrivelineParameters,
    speed_kmh: float,
    settings: SweepSettings,
) -> Recording:
    """Measure what the axle loses, then record it; `started` gives an axle at a speed."""
    held = operation(replace(settings, driver="hold"), speed_kmh, driveline)
    with started(_LOSS_CHANNELS, held.pinion_speed) as axle:
        loss = _measured_loss(axle, held.driver, settings)
    where = operation(settings, speed_kmh, driveline, loss)
    with started(CHANNELS, where.pinion_speed) as axle:
        recording = record(axle, where.driver, settings, CHANNELS)
        return replace(recording, warnings=tuple(axle.warnings))


def summarise(
    recording: Recording, speed_kmh: float, preload: float, settings: SweepSettings
) -> xr.Dataset:
    """Turn a recording into the dataset of its point."""
    return _summary(recording, speed_kmh, preload, settings.backlash)


def _summary(recording: Recording, speed_kmh: float, preload: float, backlash: float) -> xr.Dataset:
    window = angle_window(
        recording.time,
        recording["pinion.angle"],
        revolutions=recording.revolutions,
        samples_per_revolution=recording.teeth * recording.steps_per_mesh_period,
    )
    numbers = scalars(recording, window, backlash=backlash)
    dataset = xr.Dataset(
        {
            "status": FINISHED,
            "message": "",
            **_range_variables(recording.warnings),
            **numbers,
            **spectra(recording, window),
            **waves(recording, window),
            **mesh_cycle(recording),
            **roller_zone(recording),
        },
        coords={
            **_operating_point(speed_kmh, preload),
            "bearing": list(BEARINGS),
            "axis": list(AXES),
            "source": list(LOSSES),
            "flank": list(FLANKS),
        },
    )
    return described(dataset)


def failed_point(speed_kmh: float, preload: float, message: str) -> xr.Dataset:
    """Return the row of a point that could not be computed."""
    variables = {"status": FAILED, "message": message}
    return described(xr.Dataset(variables, coords=_operating_point(speed_kmh, preload)))


def _operating_point(speed_kmh: float, preload: float) -> dict[str, np.float64]:
    return {
        "speed": np.float64(kmh_to_ms(speed_kmh)),
        "speed_kmh": np.float64(speed_kmh),
        "preload": np.float64(preload),
    }


def _range_variables(warnings: Sequence[str]) -> dict[str, Any]:
    """Return the flag column of a point and its words.

    Parameters
    ----------
    warnings : sequence of str
        Of the FMU; those of ranges begin with the name of an output `range.*`.

    Examples
    --------
    >>> _range_variables(["range.torque: got 450 N.m.", "built from other sources"])
    {'range_exceeded': 1, 'range_message': 'range.torque: got 450 N.m.'}
    """
    found = [text for text in warnings if text.startswith(_OUTPUTS)]
    return {"range_exceeded": len(found), "range_message": " ".join(found)}


def _with_error_bars(point: xr.Dataset, axle: HypoidAxleParameters) -> xr.Dataset:
    """Return a point with the bounds of 95 % of the draws of its loss and efficiency.

    The loss that was marched is scaled as the loss in steady running at its mean torque, speed and
    oil temperature; see `drawn_losses`. NaN where the axle cannot run steadily there.
    """
    power = point["loss"].sel(source=list(LOSS_SOURCES)).values
    power_in = float(point["power_in"])
    try:
        drawn = drawn_losses(
            axle,
            np.maximum(power, 0.0),
            torque=float(point["pinion_torque"]),
            speed=float(point["pinion_speed"]),
            temperature=float(point["oil_temperature"]),
        )
        low, high = (float(one) for one in np.percentile(drawn, _BOUNDS))
    except ParameterError:
        low = high = np.nan
    whole = float(power.sum())
    # more loss is more input at the same output
    shares = [
        1.0 - lost / (power_in + lost - whole) if power_in + lost > whole else np.nan
        for lost in (high, low)
    ]
    bounds = {
        "loss_low": low,
        "loss_high": high,
        "efficiency_axle_low": shares[0],
        "efficiency_axle_high": shares[1],
    }
    return described(point.assign(bounds))


def _measured_loss(axle: SteppedAxle, driver: Driver, settings: SweepSettings) -> float:
    """Return the mean power that the axle loses in a short run [W].

    The speed controller of the vehicle is slower than the run: without this it would spend
    seconds to find the few per cent of engine torque that the axle takes.

    Parameters
    ----------
    axle : SteppedAxle
        Parameters set, not yet initialised; `read` returns LOSS_CHANNELS.
    driver : Driver
        Holds the speed of the axle.
    settings : SweepSettings
        Temperature and communication step.
    """
    h = settings.communication_step
    axle.initialise(*driver.initial_torques(), settings.oil_temperature)
    now = axle.read()
    lost_before = 0.0
    settling, total = math.ceil(_SETTLING / h), math.ceil((_SETTLING + _MEASURING) / h)
    for step in range(total):
        if step == settling:
            lost_before = float(now[4:].sum())
        axle.step(h, *driver.step(h, now[0], now[1], now[2], now[3]))
        now = axle.read()
    return (float(now[4:].sum()) - lost_before) / (h * (total - settling))
