"""Export of a study's results."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import xarray as xr

from gearlube.output.exports.mat import write_dataset_mat
from gearlube.output.exports.mdf4 import write_mdf4
from gearlube.output.exports.source import Span, chosen, dataset_file, without_unit
from gearlube.output.exports.tables import write_tables
from gearlube.output.exports.uff58 import write_uff58
from gearlube.output.exports.vtk import write_vtk
from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import loaded, open_dataset

logger = logging.getLogger("gearlube")


def _mat(dataset: xr.Dataset, path: Path) -> list[Path]:
    write_dataset_mat(dataset, path)
    return [path]


# format: ending of the file, or of the folder where there are several, and what writes it
FORMATS: dict[str, tuple[str, Callable[[xr.Dataset, Path], list[Path]]]] = {
    "csv": ("_csv", write_tables),
    "mat": (".mat", _mat),
    "uff58": (".uff", write_uff58),
    "mdf4": (".mf4", write_mdf4),
    "vtk": ("_vtk", write_vtk),
}


def export_results(
    run: str | Path,
    to: str,
    out: str | Path | None = None,
    *,
    variables: Iterable[str] = (),
    spans: Mapping[str, Span] | None = None,
    overwrite: bool = False,
) -> list[Path]:
    """Write the dataset of a study in a format for other tools; return the paths.

    Parameters
    ----------
    run : str or Path
        Folder of results with one NetCDF file, or a NetCDF file.
    to : str
        csv, mat, uff58, mdf4 or vtk.
    out : str or Path, optional
        File to write; with csv and vtk a folder. Default: the name of the dataset, in this folder.
    variables : iterable of str
        Names of variables; empty: all.
    spans : mapping
        First and last value as text, both included, for a dimension or a variable over one
        dimension, {"time": ("2", "5")}; in the unit of the dataset.
    overwrite : bool
        True: write even if `out` exists.

    Raises
    ------
    ParameterError
        The format, a variable or a span is not known, the format cannot hold the dataset, or `out`
        exists.
    FileError
        There is no dataset, or a package is missing.

    Examples
    --------
    >>> export_results("gearlube_runup", "mat", variables=["dte"])  # doctest: +SKIP
    [PosixPath('runup.mat')]
    """
    if to not in FORMATS:
        raise ParameterError(f"The format must be one of {', '.join(FORMATS)}, got {to}.")
    ending, write = FORMATS[to]
    file = dataset_file(Path(run))
    path = Path(f"{file.stem}{ending}") if out is None else Path(out)
    if path.exists() and not overwrite:
        raise ParameterError(f"{path} exists already. Choose another --out, or add --overwrite.")
    if path.exists() and path.is_dir() != ending.startswith("_"):
        wanted = "a folder" if ending.startswith("_") else "a file"
        raise ParameterError(f"--out must be {wanted} for {to}, got {path}. Choose another.")
    with open_dataset(file, decode_times=False) as dataset:
        part = loaded(chosen(dataset, variables, spans), file)
        if unknown := without_unit(part):
            logger.warning("These variables have no unit: %s", ", ".join(unknown))
        if not path.parent.is_dir():
            path.parent.mkdir(parents=True)
        return write(part, path)
