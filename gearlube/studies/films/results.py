"""The files of a film: NetCDF, summary and figures."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.studies.films.figures.catalogue import save_film_figures
from gearlube.studies.films.hypoid.summary import ratio_csv, ratio_rows
from gearlube.studies.films.summary import summary_csv, summary_rows
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import read_dataset, write_dataset, write_text

_NAMES = {
    "line": "line",
    "point": "point",
    "helical": "helical",
    "helical_cycle": "cycle",
    "hypoid": "hypoid",
}


def step_file(folder: Path, step: int) -> Path:
    """Return the file in `folder` for the whole film of one step of a march."""
    return folder / f"step_{step:04d}.nc"


def dataset_file(dataset: xr.Dataset, folder: Path) -> Path:
    """Return the file in `folder` that holds a dataset of this kind."""
    kind = dataset.attrs["contact"]
    if kind == "helical_step":
        return step_file(folder, round(dataset.attrs["step"]))
    return folder / f"{_NAMES[kind]}.nc"


def write_film_results(dataset: xr.Dataset, folder: Path) -> None:
    """Write the dataset of a film as NetCDF, with its summary and its figures.

    Parameters
    ----------
    dataset
        From `gearlube.studies.films.datasets`, or of a run.
    folder
        Made if it is not there. Older results in it are replaced.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = dataset_file(dataset, folder)
    write_dataset(dataset, path)
    kind = dataset.attrs["contact"]
    if kind in ("line", "point", "helical"):
        write_text(summary_csv(summary_rows(dataset)), folder / "summary.csv")
    elif kind == "hypoid":
        write_text(ratio_csv(ratio_rows(dataset)), folder / "summary.csv")
    # several steps of a march share a folder
    prefix = f"{path.stem}_" if kind == "helical_step" else ""
    save_film_figures(dataset, folder / "figures", prefix)


def begin(folder: Path | None, progress: Progress, sentence: str) -> None:
    """Make the folder of a run before any film is solved, so that a wrong path stops it now.

    Without a folder nothing is written; `progress` is told that nothing is done yet.
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    progress(0.0, sentence)


def finished(
    dataset: xr.Dataset, folder: Path | None, progress: Progress = no_progress, share: float = 0.5
) -> xr.Dataset:
    """Write the dataset of a run if `folder` is given, and return the dataset.

    `share` of the run was done before.
    """
    if folder is not None:
        progress(share, "writing files and figures")
        write_film_results(dataset, folder)
    progress(1.0, "done")
    return dataset


def read_march(path: Path) -> xr.Dataset:
    """Return the dataset of a march from its folder or its file.

    Raises
    ------
    ParameterError
        It is not that of a march.
    """
    path = path / "cycle.nc" if path.is_dir() else path
    try:
        dataset = read_dataset(path, engine="scipy")
    except FileError as reason:
        raise ParameterError(
            f"{path} is not the cycle of a march: {reason}. Run gearlube ehl helical --march first."
        ) from None
    if dataset.attrs.get("contact") != "helical_cycle":
        raise ParameterError(f"{path} must be the cycle.nc of a march, got another dataset.")
    return dataset
