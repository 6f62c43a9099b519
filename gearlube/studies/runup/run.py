"""Run a run-up or coast-down: from settings to a dataset and its file."""

from __future__ import annotations

import shutil
from pathlib import Path

from gearlube.report.result import Result
from gearlube.studies.runup.dataset import described, runup_dataset
from gearlube.studies.runup.record import record_ramp
from gearlube.studies.runup.settings import VEHICLE, RunupSettings
from gearlube.studies.runup.without_car import HELD, force_without_car
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import read_dataset, write_compressed_dataset

FILES = {"run-up": "runup.nc", "coast-down": "coastdown.nc"}
_OF_MARCH = 0.9  # share of the work


def run_runup(
    settings: RunupSettings, *, folder: Path | str | None = None, progress: Progress = no_progress
) -> Result:
    """Run an axle through a continuous speed ramp; return its record, orders and spectra.

    Parameters
    ----------
    settings : RunupSettings
        Axle, ramp, torque, oil temperature.
    folder : path, optional
        Folder for runup.nc or coastdown.nc. Parts of the ramp are kept in its folder parts/ until
        the ramp is finished, so that a stopped run continues from there. None: no files.
    progress : callable
        Called with the share that is done and a sentence.

    Returns
    -------
    xarray.Dataset
        At the constant rate `setting_sample_rate`: `bearing_force` [N] over (time, bearing,
        direction), `pinion_speed`, `wheel_speed`, `dte`, `mesh_force`; `loss` by source over
        slow_time. Over the blocks of the order analysis: `bearing_force_track`, `dte_track`, their
        overall levels and order maps. Over slices of time: `bearing_force_waterfall`,
        `dte_waterfall` over frequency.

    Raises
    ------
    GearLubeError
        The axle model failed; nothing has been written then.
    InterruptedRunError
        After Ctrl-C.

    Examples
    --------
    A ramp of 20 s takes about half a minute:

    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> settings = RunupSettings(
    ...     car_axle=read_axle("mohammadpour_2015"), start_speed=100.0, end_speed=300.0,
    ...     duration=20.0, pinion_torque=80.0,
    ... )
    >>> dataset = run_runup(settings, folder="my_runup")  # doctest: +SKIP
    """
    out = None if folder is None else Path(folder)
    parts = None if out is None else out / "parts"
    record = record_ramp(settings, folder=parts, progress=part_of(progress, 0.0, _OF_MARCH))
    progress(_OF_MARCH, "orders and spectra")
    dataset = runup_dataset(settings, record)
    if settings.driver == VEHICLE:
        dataset[HELD] = force_without_car(settings, dataset, folder=parts)
    dataset = Result.of(described(dataset), "runup")
    if out is not None:
        progress(1.0, "writing the file")
        out.mkdir(parents=True, exist_ok=True)
        write_compressed_dataset(dataset, out / FILES[settings.name])
        shutil.rmtree(out / "parts", ignore_errors=True)
    return dataset


def load_runup(path: Path | str) -> Result:
    """Read the results of a run-up or coast-down: runup.nc, coastdown.nc, or the folder it is in.

    Examples
    --------
    >>> load_runup("gearlube_runup")["bearing_force"]  # doctest: +SKIP
    """
    path = Path(path)
    return Result.of(read_dataset(path / FILES["run-up"] if path.is_dir() else path), "runup")
