"""Files that are whole or not there: written beside their place, then moved into it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # not every user of this module has datasets
    import xarray as xr


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a file to write; it takes the place of `path` when all went well.

    An older file at `path` stays as it is until then; the one to write is gone if anything fails.
    """
    partial = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        yield partial
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def write_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 3, which needs no library beside scipy."""
    with whole_file(path) as partial:
        dataset.to_netcdf(partial, engine="scipy", format="NETCDF3_64BIT")


def write_text(text: str, path: Path) -> None:
    """Write a text in UTF-8."""
    with whole_file(path) as partial:
        partial.write_text(text, encoding="utf-8")
