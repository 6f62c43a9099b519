"""One point of a sweep: the axle FMU with its driver at one speed and one preload."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.parameters import DrivelineParameters
from gearlube.studies.sweep.axle_in_fmu import car_axle_at, car_axle_of
from gearlube.studies.sweep.axle_loss import LOSS_CHANNELS, measured_loss
from gearlube.studies.sweep.channels import AXES, BEARINGS, CHANNELS, FLANKS, LOSSES
from gearlube.studies.sweep.curves import mesh_cycle, roller_zone, spectra, waves
from gearlube.studies.sweep.error_bars import with_error_bars
from gearlube.studies.sweep.fmu_axle import FmuAxle
from gearlube.studies.sweep.oil_at_rest import oil_at_rest
from gearlube.studies.sweep.operating_point import operation
from gearlube.studies.sweep.python_axle import PythonAxle
from gearlube.studies.sweep.quantities import described
from gearlube.studies.sweep.range_variables import range_variables
from gearlube.studies.sweep.recording import Recording, record
from gearlube.studies.sweep.scalars import scalars
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube.studies.sweep.unpack import unpacked
from gearlube_core.errors import GearLubeError
from gearlube_core.spectra import angle_window
from gearlube_core.units import kmh_to_ms

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
        return with_error_bars(summarise(recording, speed_kmh, preload, settings), axle)
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
    settings = oil_at_rest(car_axle, speed_kmh, settings)

    @contextmanager
    def started(channels: Sequence[str], pinion_speed: float) -> Iterator[PythonAxle]:
        yield PythonAxle(axle, channels, pinion_speed)

    recording = _recorded(started, car_axle.driveline, speed_kmh, settings)
    preload = float(axle.bearings[0].preload_force())
    return _summary(recording, speed_kmh, preload, axle.backlash)


def _recorded(
    started: Callable[[Sequence[str], float], AbstractContextManager[FmuAxle | PythonAxle]],
    driveline: DrivelineParameters,
    speed_kmh: float,
    settings: SweepSettings,
) -> Recording:
    """Measure what the axle loses, then record it; `started` gives an axle at a speed."""
    held = operation(replace(settings, driver="hold"), speed_kmh, driveline)
    with started(LOSS_CHANNELS, held.pinion_speed) as axle:
        loss = measured_loss(axle, held.driver, settings)
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
            **range_variables(recording.warnings),
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
