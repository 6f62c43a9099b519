"""Atomic writes: a file is complete or not there.

A checksum at the end of a stored file: a single wrong bit is found when the file is read.

The readers of NetCDF and of npz (ZIP) files pass over what stands behind their data, so the files
stay what they are for every other program.
"""

from __future__ import annotations

import hashlib
import math
import os
import secrets
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tokenize import TokenError
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from gearlube_core.checks import check_file
from gearlube_core.errors import FileError, ParameterError

if TYPE_CHECKING:
    import xarray as xr

_MARK = b"\ngearlube SHA-256 "
_LENGTH = len(_MARK) + 64 + 1  # of the last line: mark, hexadecimal digits, end of line
_TOGETHER = 1 << 20  # bytes
LARGEST_ARRAYS = 200_000_000  # bytes of one file's arrays in memory
# what NumPy, SciPy, netCDF4 and xarray raise on files that are cut off or have wrong bytes
DAMAGED = (
    OSError,
    ValueError,
    TypeError,
    LookupError,
    AttributeError,
    AssertionError,
    ArithmeticError,
    MemoryError,
    EOFError,
    RuntimeError,
    RecursionError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)
_OVERHEAD = 1 << 24  # [byte] that a file of many small variables may have beside its numbers

Arrays = dict[str, Any]  # ndarrays by name; texts and numbers are arrays of no dimension


def seal(path: Path, *, flush: bool = False) -> None:
    """Write the checksum of a whole file at its end, and flush it to the disk if asked."""
    with path.open("r+b") as stream:
        stream.write(_last_line(stream, stream.seek(0, os.SEEK_END)))
        if flush:
            stream.flush()
            os.fsync(stream.fileno())


def check_seal(stream: BinaryIO, where: str) -> bool:
    """Return whether a file has a checksum; raise FileError, naming it `where`, for a wrong one."""
    end = max(stream.seek(0, os.SEEK_END) - _LENGTH, 0)
    stream.seek(end)
    given = stream.read()
    if not given.startswith(_MARK):
        return False
    if given != _last_line(stream, end):
        raise FileError(
            f"{where} is damaged: its content does not belong to the checksum at its end. Write "
            "it again, or take a copy of it."
        )
    return True


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file as hexadecimal digits; "" for none that can be read."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def _last_line(stream: BinaryIO, size: int) -> bytes:
    """Return the last line of a file whose first `size` bytes are its content."""
    digest = hashlib.sha256()
    stream.seek(0)
    while size > 0 and (part := stream.read(min(size, _TOGETHER))):
        digest.update(part)
        size -= len(part)
    return _MARK + digest.hexdigest().encode() + b"\n"


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
    # a name that nobody can foresee, and no link that lies there is followed
    partial = path.with_name(f"{path.name[:200]}.{secrets.token_hex(8)}.part")
    os.close(os.open(partial, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    try:
        yield partial
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def write_text(text: str, path: Path) -> None:
    """Write a text in UTF-8."""
    with atomic_write(path) as partial:
        partial.write_text(text, encoding="utf-8")


def write_figure(figure: Any, path: Path, dpi: int = 150) -> None:
    """Write a figure of matplotlib as PNG; `dpi` [1/inch]."""
    with atomic_write(path) as partial:
        figure.savefig(partial, format="png", dpi=dpi)


def write_arrays(path: Path, arrays: Mapping[str, Any], *, compress: bool = False) -> None:
    """Write arrays as an npz file with a checksum, flushed to the disk."""
    save = np.savez_compressed if compress else np.savez
    with atomic_write(path) as partial:
        with partial.open("wb") as stream:
            save(stream, **arrays)
        seal(partial, flush=True)


def read_arrays(path: Path, *, sealed: bool = False) -> Arrays:
    """Return the arrays of an npz file.

    What it holds is read from its heads before any array is: no file takes more memory than it
    may. `sealed` says that it must have a checksum, see `write_arrays`.

    Raises
    ------
    FileError
        The file is missing, damaged or of another kind, or its arrays are too large.
    """
    check_file(path, "npz file", FileError)
    try:
        with path.open("rb") as stream, np.load(path, allow_pickle=False) as stored:
            _check_sealed(check_seal(stream, str(path)) or not sealed, path)
            _check_claims(path, sum(_claimed(stored.zip, one) for one in stored.zip.infolist()))
            return {name: stored[name] for name in stored.files}
    except (*DAMAGED, TokenError) as error:
        raise FileError(f"{path} must be an npz file, got {_why(error)}. Remove it.") from error


def _claimed(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> int:
    """Return the bytes of an array in memory, at least 8 for each number."""
    with archive.open(entry) as member:
        version = np.lib.format.read_magic(member)
        old = version == (1, 0)
        read = np.lib.format.read_array_header_1_0 if old else np.lib.format.read_array_header_2_0
        shape, _, dtype = read(member)
    count = math.prod(shape)
    if min(shape, default=0) < 0 or count * dtype.itemsize > entry.file_size:
        raise ValueError(f"{entry.filename} with {shape} numbers in {entry.file_size} bytes")
    return count * max(dtype.itemsize, 8)


def _check_claims(path: Path, size: int) -> None:
    """Refuse arrays that are large and much larger than their file: results do not pack so well."""
    if size > max(LARGEST_ARRAYS, 10 * path.stat().st_size):
        raise ValueError(
            f"one that claims arrays of {size / 1e6:.0f} MB, more than {LARGEST_ARRAYS / 1e6:g} MB "
            "and ten times its size"
        )


def check_unpacked(path: Path) -> None:
    """Raise ParameterError for a damaged ZIP file or one that claims too much; others pass."""
    try:
        if zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as archive:
                _check_claims(path, sum(entry.file_size for entry in archive.infolist()))
    except DAMAGED as error:
        kind = path.suffix[1:].upper()
        raise ParameterError(f"{path} is not a readable {kind} file: {_why(error)}.") from error


def _check_sealed(good: bool, path: Path) -> None:
    if not good:
        raise FileError(f"{path} has no checksum at its end, so it may be cut off.")


def _why(error: BaseException) -> str:
    lines = str(error).strip().splitlines() or [type(error).__name__]
    return lines[0][:200].rstrip(".")


def write_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 3 with a checksum; it needs no library beside scipy.

    With a dimension of length 0, which NetCDF 3 would take for an unlimited one, it is NetCDF 4.
    """
    if 0 in dataset.sizes.values():
        write_compressed_dataset(dataset, path)
        return
    with atomic_write(path) as partial:
        dataset.to_netcdf(partial, engine="scipy", format="NETCDF3_64BIT")
        seal(partial)


def write_compressed_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 4 with compressed floats and a checksum; texts have any length.

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
        seal(partial)


def open_dataset(path: Path, *, sealed: bool = False, **options: Any) -> xr.Dataset:
    """Return the dataset in a NetCDF file; values are read when they are used.

    A checksum at its end is checked; `sealed` says that there must be one. Options are those of
    `xarray.open_dataset`.

    Raises
    ------
    FileError
        The file is missing, damaged or of another kind, or its arrays are too large.
    """
    import xarray as xr

    check_file(path, "NetCDF file", FileError)
    try:
        with path.open("rb") as stream:
            _check_sealed(check_seal(stream, str(path)) or not sealed, path)
        dataset = xr.open_dataset(path, **options)
        _check_claims(path, dataset.nbytes)
    except DAMAGED as error:
        raise FileError(f"{path} must be a NetCDF file, got {_why(error)}. Remove it.") from error
    return dataset


def read_dataset(path: Path, *, sealed: bool = False, **options: Any) -> xr.Dataset:
    """Return the dataset in a NetCDF file with its values; options and errors: `open_dataset`."""
    with open_dataset(path, sealed=sealed, **options) as dataset:
        return loaded(dataset, path)


def loaded(dataset: xr.Dataset, path: Path) -> xr.Dataset:
    """Return a dataset, or a part of it, with its values; raise FileError for damaged ones."""
    try:
        return dataset.load()
    except DAMAGED as error:
        raise FileError(f"{path} is damaged: {_why(error)}. Remove it.") from error
