"""Lay measured flanks on a pair: from a measured-gear file to a gear file."""

from __future__ import annotations

from pathlib import Path

from gearlube.output.toml_text import toml_text
from gearlube.studies.measured.figures import measured_flanks
from gearlube_core.hypoid_geometry.measured.measured_flanks import (
    MeasuredFlanks,
    read_measured_flanks,
)
from gearlube_core.storage.atomic_file import write_figure, write_text
from gearlube_core.storage.file_names import pair_stem


def run_measured(path: str | Path, *, folder: Path | None = None) -> MeasuredFlanks:
    """Return the measured flanks of a hypoid pair as a gear file.

    Parameters
    ----------
    path : str or Path
        Measured-gear file (TOML), with its CSV files beside it.
    folder : Path, optional
        Folder for the gear file NAME.toml, which `gearlube contact` takes, and for flanks.png.

    Raises
    ------
    ParameterError
        A file is missing or wrong; the message names the line.

    Examples
    --------
    >>> found = run_measured("axle_17.toml")  # doctest: +SKIP
    >>> found.surfaces["gear", "drive"].residual_rms  # [m]  # doctest: +SKIP
    """
    flanks = read_measured_flanks(path)
    file = flanks.gear_file()
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        text = toml_text(file.model_dump(exclude_defaults=True))
        write_text(text, folder / f"{pair_stem(file.name)}.toml")
        write_figure(measured_flanks(flanks), folder / "flanks.png")
    return flanks
