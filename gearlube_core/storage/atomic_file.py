"""Atomic writes: a file is complete or not there."""

from __future__ import annotations

import os
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tokenize import TokenError
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlube_core.errors import FileError

if TYPE_CHECKING:  # not every user of this module has datasets
    import xarray as xr

_OVERHEAD = 1 << 24  # [byte] that a file of many small variables may have beside its numbers

Arrays = dict[str, Any]  # ndarrays by name; texts and numbers are arrays of no dimension


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Give the path of a neighbouring file to write; move it to `path` if all went well.

    Until then an older file at `path` stays as it is. If anything fails, the neighbouring file is
    removed.

    Raises
    ------
    FileError
        The folder of `path` is not there.
    """
    if not path.parent.is_dir():
        raise FileError(
            f"{path.name} must be written into a folder that is there, got {path.parent}. Make the "
            "folder, or choose another one."
        )
    partial = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        yield partial
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def write_text(text: str, path: Path) -> None:
    """Write a text in UTF-8."""
    with atomic_write(path) as partial:
        partial.write_text(text, encoding="utf-8")


def write_arrays(path: Path, arrays: Mapping[str, Any], *, compress: bool = False) -> None:
    """Write arrays as an npz file, flushed to the disk."""
    save = np.savez_compressed if compress else np.savez
    with atomic_write(path) as partial, partial.open("wb") as stream:
        save(stream, **arrays)
        stream.flush()
        os.fsync(stream.fileno())


def read_arrays(path: Path) -> Arrays:
    """Return the arrays of an npz file.

    Raises
    ------
    FileError
        The file is missing, damaged or of another kind.
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except (
        OSError,
        ValueError,
        KeyError,
        AttributeError,
        EOFError,
        zipfile.BadZipFile,
        zlib.error,
        TokenError,
    ) as error:
        raise FileError(f"{path} must be an npz file, got {error}. Remove it.") from error


def write_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 3, which needs no library beside scipy."""
    with atomic_write(path) as partial:
        dataset.to_netcdf(partial, engine="scipy", format="NETCDF3_64BIT")


def write_compressed_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 4 with compressed floats; texts may have any length.

    Raises
    ------
    OSError
        The disk is full, or the file system refuses in another way.
    FileError
        The library cannot write for another reason.
    """
    encoding = {
        str(name): {"zlib": True, "complevel": 1}
        for name, variable in dataset.data_vars.items()
        if variable.dtype.kind == "f" and variable.ndim > 0
    }
    with atomic_write(path) as partial:
        try:
            dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)
        except RuntimeError as error:  # the library does not say that the disk is full: this does
            partial.write_bytes(bytes(dataset.nbytes + _OVERHEAD))
            raise FileError(f"{path} cannot be written: {error}. Check the disk.") from error


def read_compressed_dataset(path: Path) -> xr.Dataset:
    """Return the dataset in a NetCDF 4 file.

    Raises
    ------
    FileError
        The file is missing, damaged or of another kind.
    """
    import xarray as xr

    try:
        return xr.load_dataset(path, engine="netcdf4")
    except (OSError, ValueError, RuntimeError, KeyError) as error:
        raise FileError(f"{path} must be a NetCDF file, got {error}. Remove it.") from error
