"""Finished points as one NetCDF file each, so that an interrupted sweep can go on."""

from __future__ import annotations

import contextlib
import logging
import os
from dataclasses import dataclass
from pathlib import Path

import xarray as xr

logger = logging.getLogger(__name__)

_KEY = "gearlube_point_key"


@dataclass(frozen=True, slots=True)
class PointStore:
    """Folder of finished points, named by the hash of everything that determines them."""

    directory: Path

    def path(self, key: str) -> Path:
        """Return the file of a point."""
        return self.directory / f"{key}.nc"

    def save(self, key: str, dataset: xr.Dataset) -> None:
        """Write a point so that its file appears complete or not at all."""
        self.directory.mkdir(parents=True, exist_ok=True)
        write_atomically(dataset.assign_attrs({_KEY: key}), self.path(key))

    def load(self, key: str) -> xr.Dataset | None:
        """Return a stored point; None when it is missing or damaged."""
        path = self.path(key)
        if not path.is_file():
            return None
        try:
            dataset = xr.load_dataset(path, engine="netcdf4")
        except (OSError, ValueError, RuntimeError, KeyError) as error:
            logger.warning("%s is damaged and will be computed again: %s", path, error)
            return None
        if dataset.attrs.get(_KEY) != key:
            logger.warning("%s is not the point its name says; computing it again.", path)
            return None
        return dataset


def write_atomically(dataset: xr.Dataset, path: Path) -> None:
    """Write NetCDF next to `path`, then rename; readers never see half a file."""
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    encoding = {
        str(name): {"zlib": True, "complevel": 1}
        for name, variable in dataset.data_vars.items()
        if variable.dtype.kind == "f" and variable.ndim > 0
    }
    try:
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)
        os.replace(partial, path)
    finally:
        with contextlib.suppress(FileNotFoundError):
            partial.unlink()
