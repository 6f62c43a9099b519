"""NetCDF 3 from bytes, with one error for whatever is wrong with them."""

from __future__ import annotations

import io
import struct
import warnings

import xarray as xr

from gearlube_core.errors import TableError

# what SciPy and xarray raise on files that are cut off or have wrong bytes
_DAMAGED = (
    OSError,
    ValueError,
    TypeError,
    LookupError,
    AttributeError,
    AssertionError,
    ArithmeticError,
    MemoryError,
    EOFError,
    struct.error,
)


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
        The content is cut off, damaged or of another format.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            return xr.load_dataset(io.BytesIO(content), engine="scipy")
    except (*_DAMAGED, RuntimeWarning) as reason:
        lines = str(reason).strip().splitlines() or [type(reason).__name__]
        raise TableError(
            f"{name} is not a readable NetCDF 3 file: {lines[0].rstrip('.')}. It may be cut off. "
            f"Write it with {writer}, or from xarray with to_netcdf(path, engine='scipy')."
        ) from None
