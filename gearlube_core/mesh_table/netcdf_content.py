"""NetCDF 3 from bytes, with one error for whatever is wrong with them."""

from __future__ import annotations

import io
import logging
import warnings

import xarray as xr

from gearlube_core.errors import FileError, TableError
from gearlube_core.storage.atomic_file import DAMAGED
from gearlube_core.storage.checksums import check_seal

logger = logging.getLogger(__name__)


def dataset_from_bytes(content: bytes, name: str, writer: str) -> xr.Dataset:
    """Return the dataset in the content of a file.

    Parameters
    ----------
    content : bytes
    name : str
        What errors call the file.
    writer : str
        The function that writes such files.

    Raises
    ------
    TableError
        The content is cut off, damaged or of another format, or has a wrong checksum. One without
        a checksum is read with a warning.
    """
    try:
        if not check_seal(io.BytesIO(content), name):
            logger.warning(
                "%s has no checksum, so damage to it would not be seen. %s writes one.",
                name,
                writer,
            )
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            return xr.load_dataset(io.BytesIO(content), engine="scipy")
    except FileError as reason:
        raise TableError(str(reason)) from None
    except (*DAMAGED, RuntimeWarning) as reason:
        lines = str(reason).strip().splitlines() or [type(reason).__name__]
        raise TableError(
            f"{name} is not a readable NetCDF 3 file: {lines[0].rstrip('.')}. It may be cut off. "
            f"Write it with {writer}, or from xarray with to_netcdf(path, engine='scipy')."
        ) from None
