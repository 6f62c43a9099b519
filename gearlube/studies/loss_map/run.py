"""Compute the loss map of an axle: from settings to a dataset and its files."""

from __future__ import annotations

from pathlib import Path

from drivetrain.steady_temperature import steady_temperatures
from gearlube.report.result import Result
from gearlube.studies.loss_map.datasets import loss_map_dataset, with_steady_temperature
from gearlube.studies.loss_map.exports import write_exports
from gearlube.studies.loss_map.figures import save_loss_map_figures
from gearlube.studies.loss_map.sampling import check_draws, spread_of
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset

_OF_MAP = 0.1  # share of the work


def run_loss_map(
    settings: LossMapSettings, *, folder: Path | None = None, progress: Progress = no_progress
) -> Result:
    """Return the loss torque of an axle over torque, speed and oil temperature, with error bars.

    Parameters
    ----------
    settings
        Axle, grid, uncertain data.
    folder
        Folder for map.nc, map.csv, figures and the files for other tools; None: nothing is written.
    progress
        Called with the share that is done and a sentence.

    Returns
    -------
    xr.Dataset
        `loss_torque` [N.m], `loss` by source [W], efficiency, error bars and the other variables of
        `loss_map_dataset`. A point that failed is NaN, and its status gives the reason.

    Raises
    ------
    ParameterError
        Torque, speed or temperature is out of range, or a sample of the uncertain data is; nothing
        has been computed then.

    Examples
    --------
    >>> import numpy as np
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> settings = LossMapSettings(
    ...     axle=mohammadpour_2015_axle(), torques=np.array([-50.0, 0.0, 50.0]),
    ...     speeds=np.array([209.4]), temperatures=np.array([333.15]), draws=0,
    ... )
    >>> found = run_loss_map(settings)
    >>> found["loss_torque"].sel(torque=50.0).values.round(2)  # N.m
    array([[2.34]])
    """
    check_draws(settings)
    torques, speeds, temperatures = settings.grid
    losses = axle_losses(
        settings.axle,
        torques=torques,
        speeds=speeds,
        temperatures=temperatures,
        progress=part_of(progress, 0.0, _OF_MAP),
    )
    spread = None
    if settings.draws:
        spread = spread_of(settings, part_of(progress, _OF_MAP, 1.0))
    dataset = loss_map_dataset(settings, losses, spread)
    if settings.cooling is not None:
        steady = steady_temperatures(
            settings.axle,
            settings.cooling,
            torques=torques,
            speeds=speeds,
            progress=lambda _, words: progress(1.0, f"steady temperature, {words}"),
        )
        dataset = with_steady_temperature(dataset, settings.cooling, *steady)
    dataset = Result.of(dataset, "map")
    if folder is not None:
        progress(1.0, "writing files and figures")
        folder.mkdir(parents=True, exist_ok=True)
        write_dataset(dataset, folder / "map.nc")
        write_exports(dataset, folder)
        save_loss_map_figures(dataset, folder / "figures")
    return dataset
