"""The loss map as files for other tools."""

from __future__ import annotations

import logging
from pathlib import Path

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.loss_map.exports.gem import gem_text
from gearlube.studies.loss_map.exports.lossy_gear import lossy_gear_text
from gearlube.studies.loss_map.exports.mat import write_map_mat
from gearlube.studies.loss_map.exports.table import table_rows
from gearlube.studies.loss_map.exports.vtlm import regulation_text, vtlm_text
from gearlube.studies.loss_map.regulation import OIL_DEGC, regulation_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_text

logger = logging.getLogger("gearlube")


_OF_A_TEMPERATURE = {
    "vecto_{}.vtlm": vtlm_text,
    "gem_{}.csv": gem_text,
    "lossy_gear_{}.mo": lossy_gear_text,
}


def write_exports(dataset: xr.Dataset, folder: Path) -> None:
    """Write map.csv, map.mat, and for each temperature the files of VECTO, GEM and Modelica.

    A file that has too few points is left out with a warning; those of an earlier map are removed.
    """
    for pattern in _OF_A_TEMPERATURE:
        for old in folder.glob(pattern.format("*degC")):
            old.unlink()
    head, rows = table_rows(dataset)
    write_text(csv_text(head, rows), folder / "map.csv")
    write_map_mat(dataset, folder / "map.mat")
    for temperature in dataset["temperature"].values:
        one = dataset.sel(temperature=temperature)
        name = f"{temperature:g}degC"
        for pattern, text_of in _OF_A_TEMPERATURE.items():
            try:
                write_text(text_of(one), folder / pattern.format(name))
            except ParameterError as reason:
                logger.warning("No %s: %s", pattern.format(name), reason)


def write_regulation_map(
    settings: LossMapSettings,
    folder: Path,
    *,
    raised: bool = False,
    progress: Progress = no_progress,
) -> Path:
    """Write the map on the grid of heavy-duty axle tests for VECTO; return its path."""
    kind = "raised_" if raised else ""
    path = folder / f"vecto_regulation_{kind}{OIL_DEGC:g}degC.vtlm"
    write_text(regulation_text(regulation_map(settings, raised=raised, progress=progress)), path)
    return path
