"""Finished results on disk, one file each, under a key that hashes all their inputs."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

from gearlube_core.arrays import Array
from gearlube_core.errors import FileError
from gearlube_core.storage.atomic_file import (
    read_arrays,
    read_dataset,
    write_arrays,
    write_compressed_dataset,
)

if TYPE_CHECKING:
    import xarray as xr

Record = dict[str, Array]  # a result that consists of arrays
Result = TypeVar("Result")

logger = logging.getLogger(__name__)


class FileFormat(Protocol[Result]):
    """Interface of a file format for one kind of result and its key."""

    suffix: str

    def write(self, path: Path, key: str, result: Result) -> None:
        """Write a result and its key, atomically."""
        ...

    def read(self, path: Path) -> tuple[str, Result]:
        """Return key and result; raise FileError when the file cannot be read."""
        ...


class _Arrays:
    suffix = ".npz"
    _KEY = "gearlube_key"

    def write(self, path: Path, key: str, result: Record) -> None:
        write_arrays(path, {**result, self._KEY: key})

    def read(self, path: Path) -> tuple[str, Record]:
        arrays = read_arrays(path, sealed=True)
        return str(arrays.pop(self._KEY, "")), arrays


class _Datasets:
    suffix = ".nc"
    _KEY = "gearlube_point_key"

    def write(self, path: Path, key: str, result: xr.Dataset) -> None:
        write_compressed_dataset(result.assign_attrs({self._KEY: key}), path)

    def read(self, path: Path) -> tuple[str, xr.Dataset]:
        dataset = read_dataset(path, sealed=True)
        return str(dataset.attrs.get(self._KEY, "")), dataset


ARRAYS: FileFormat[Record] = _Arrays()
DATASETS: FileFormat[Any] = _Datasets()


@dataclass(frozen=True, slots=True)
class ResultStore(Generic[Result]):
    """Results in a folder.

    Parameters
    ----------
    folder : Path or None
        Made when the first result is kept. None: nothing is kept.
    format : FileFormat
        `ARRAYS` (dict of ndarrays) or `DATASETS` (xarray.Dataset).
    """

    folder: Path | None
    format: FileFormat[Result]

    def read(self, key: str) -> Result | None:
        """Return a result; None when it is absent, damaged or stored under another key."""
        if self.folder is None or not (path := self._path(self.folder, key)).is_file():
            return None
        try:
            stored, result = self.format.read(path)
        except FileError as error:
            logger.warning("%s It will be computed again.", error)
            return None
        if stored != key:
            logger.warning(
                "%s has another result than its name says. It will be computed again.", path
            )
            return None
        return result

    def keep(self, key: str, result: Result) -> None:
        """Write a result in one atomic step."""
        if self.folder is not None:
            self.folder.mkdir(parents=True, exist_ok=True)
            self.format.write(self._path(self.folder, key), key, result)

    def _path(self, folder: Path, key: str) -> Path:
        return folder / f"{key}{self.format.suffix}"
