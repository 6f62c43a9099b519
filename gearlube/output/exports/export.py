"""Export of a study's results."""

from __future__ import annotations

import logging
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.exports.records import Record, record_names, records
from gearlube.output.exports.tables import write_tables
from gearlube.output.exports.uff58 import write_uff58
from gearlube.output.exports.vtk import write_vtk
from gearlube.output.mat_file import write_mat
from gearlube.output.units import is_text, unit_of
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.storage.atomic_file import atomic_write, loaded, open_dataset
from gearlube_core.units import ZERO_CELSIUS

_VERSION = "4.10"
_MAP_AXES = ("speed", "torque", "temperature")
_PLAIN = ("1", "not stated")  # units that are left empty

Span = tuple[str, str]  # first and last value as text; an empty text is no limit

_STRUCTS = ("units", "meanings", "dimensions", "attributes")

logger = logging.getLogger("gearlube")


def _mat(dataset: xr.Dataset, path: Path) -> list[Path]:
    _write_dataset_mat(dataset, path)
    return [path]


def _write_dataset_mat(dataset: xr.Dataset, path: Path) -> None:
    """Write every variable as an array, and the structs units, meanings, dimensions, attributes.

    `units.NAME` is the unit of NAME, "not stated" where the dataset has none; `dimensions.NAME`
    the names of its dimensions in order.
    """
    content: dict[str, Any] = {str(name): v.values for name, v in dataset.variables.items()}
    units = {name: unit_of(dataset[name]) for name in content}
    structs = (
        {name: "not stated" if unit is None else unit for name, unit in units.items()},
        {name: str(dataset[name].attrs.get("long_name", "")) for name in content},
        {name: " ".join(map(str, dataset[name].dims)) for name in content},
        {str(key): value for key, value in dataset.attrs.items()},
    )
    write_mat({**content, **dict(zip(_STRUCTS, structs, strict=True))}, path)


def _channel_name(record: Record) -> str:
    """Return the name of a history: the variable, then names and numbers of its place."""
    places = (
        str(value) if isinstance(value, str) else f"{name}_{value:g}"
        for name, _, value, _ in record.places
    )
    return ".".join((record.name, *places))


def _write_mdf4(dataset: xr.Dataset, path: Path) -> list[Path]:
    """Write a channel for each time history, a group for each time axis; return the path.

    Values keep their type. A value that is not there is marked as invalid.

    Raises
    ------
    ParameterError
        The package asammdf is missing. There is no time history, or a time axis does not rise.
    """
    asammdf = extra_package("asammdf", "export", "A measurement file (MDF 4) is written")
    found = [record for name in record_names(dataset) for record in records(dataset, name)]
    groups: dict[str, list[Record]] = {}
    for record in found:
        if record.axis_unit == "s":
            groups.setdefault(record.axis, []).append(record)
    if not groups:
        raise ParameterError(
            "A measurement file (MDF 4) must hold time histories, got "
            f"{', '.join(map(str, dataset.data_vars)) or 'none'}. Choose another format, such as "
            "csv or mat."
        )
    held = {record.name for group in groups.values() for record in group}
    if others := [str(name) for name in dataset.data_vars if name not in held]:
        logger.info("No time history, left out: %s", ", ".join(others))
    for axis, group in groups.items():
        if np.any(np.diff(group[0].x) <= 0.0):
            raise ParameterError(
                f"The time of a measurement file must rise, got {axis} that does not. Leave out "
                f"{', '.join(sorted({record.name for record in group}))} with --variable."
            )
    with TemporaryDirectory() as folder, asammdf.MDF(version=_VERSION) as file:
        file.header.comment = str(dataset.attrs.get("title") or dataset.attrs.get("name") or "")
        for axis, group in groups.items():
            signals = [_signal(asammdf, dataset, record) for record in group]
            file.append(signals, acq_name=axis, comment=axis, common_timebase=True)
        made = file.save(Path(folder, "made.mf4"), overwrite=True)
        with atomic_write(path) as partial:
            shutil.copyfile(made, partial)
    return [path]


def _signal(asammdf: Any, dataset: xr.Dataset, record: Record) -> Any:
    lacking = np.isnan(record.y)
    return asammdf.Signal(
        samples=record.y.astype(dataset[record.name].dtype),
        timestamps=record.x,
        name=_channel_name(record),
        unit="" if record.unit in _PLAIN else record.unit,
        comment=record.meaning,
        invalidation_bits=lacking if lacking.any() else None,
    )


def _write_map_fmu(
    dataset: xr.Dataset, path: Path, platforms: Sequence[str] | None = None
) -> list[Path]:
    """Write the loss torque of `gearlube map`, with its error bars, as an FMU of FMI 3.0.

    Raises
    ------
    ParameterError
        The dataset is no loss map, lacks points, or has fewer than two on an axis.
    GearLubeError
        The compiler is missing.
    """
    from fmu_src.native.build import NativeOptions, build_native
    from fmu_src.native.loss_map import loss_map_model
    from fmu_src.native.platforms import PLATFORM_NAMES

    if not {*_MAP_AXES, "loss_torque"} <= set(dataset.variables):
        raise ParameterError(
            "An FMU of a sampled map must hold loss_torque over speed, torque and temperature, got "
            f"{', '.join(map(str, dataset.data_vars)) or 'none'}. Give the results of gearlube "
            "map, or choose csv or mat."
        )
    speed, torque, temperature = (np.asarray(dataset[name].values) for name in _MAP_AXES)
    model = loss_map_model(
        {"speed": speed * (np.pi / 30.0), "torque": torque,
         "temperature": temperature + ZERO_CELSIUS},
        {name: np.asarray(dataset[name].transpose(*_MAP_AXES).values)
         for name in ("loss_torque", "loss_torque_low", "loss_torque_high") if name in dataset},
        f"Loss map of an axle, mesh {dataset.attrs['mesh']}, oil {dataset.attrs['oil']}",
    )  # fmt: skip
    with TemporaryDirectory() as folder:
        options = NativeOptions(platforms=platforms or PLATFORM_NAMES, fmi=["3"])
        (made,) = build_native(model, Path(folder), options)
        with atomic_write(path) as partial:
            shutil.copyfile(made, partial)
    return [path]


# format: ending of the file, or of the folder where there are several, and what writes it
FORMATS: dict[str, tuple[str, Callable[[xr.Dataset, Path], list[Path]]]] = {
    "csv": ("_csv", write_tables),
    "mat": (".mat", _mat),
    "uff58": (".uff", write_uff58),
    "mdf4": (".mf4", _write_mdf4),
    "vtk": ("_vtk", write_vtk),
    "fmu": (".fmu", _write_map_fmu),
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
        csv, mat, uff58, mdf4, vtk or fmu.
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
    FileError, ParameterError
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
        if unknown := _without_unit(part):
            logger.warning("These variables have no unit: %s", ", ".join(unknown))
        if not path.parent.is_dir():
            path.parent.mkdir(parents=True)
        return write(part, path)


def dataset_file(run: Path) -> Path:
    """Return the NetCDF file that `run` is, or the only one in the folder `run`.

    Raises
    ------
    FileError
        There is no such file.
    ParameterError
        The folder holds several.
    """
    if run.is_file():
        return run
    if not run.is_dir():
        raise FileError(
            f"RUN must be a folder of results or a NetCDF file, but {run} does not exist."
        )
    found = sorted(run.glob("*.nc"))
    if not found:
        raise FileError(
            f"The folder {run} must hold a NetCDF file (.nc), got none. Name the folder where a "
            "study wrote its results."
        )
    if len(found) > 1:
        names = ", ".join(path.name for path in found)
        raise ParameterError(
            f"One dataset can be exported at a time, but {run} has {len(found)}: {names}. Give one "
            f"of them, for example {found[0]}."
        )
    return found[0]


def chosen(
    dataset: xr.Dataset, variables: Iterable[str] = (), spans: Mapping[str, Span] | None = None
) -> xr.Dataset:
    """Return the wanted variables within the wanted spans.

    Parameters
    ----------
    dataset : Dataset
    variables : iterable of str
        Names of variables to keep; empty: all.
    spans : mapping
        First and last value, both inside, by the name of a dimension or of a variable over one
        dimension. In the unit of the dataset; a dimension without values counts from 0.

    Raises
    ------
    ParameterError
        An unknown name, or a span in which nothing lies.
    """
    wanted = list(variables)
    for name in wanted:
        if name not in dataset.variables:
            known = ", ".join(map(str, dataset.data_vars))
            raise ParameterError(f"The dataset has no variable {name}. It has: {known}.")
    for name, span in (spans or {}).items():
        dataset = _within(dataset, name, span)
    return dataset[wanted] if wanted else dataset


def _within(dataset: xr.Dataset, name: str, span: Span) -> xr.Dataset:
    known = [str(n) for n, v in dataset.variables.items() if v.ndim == 1]
    known += [str(dim) for dim in dataset.dims if dim not in known]
    if name not in known:
        raise ParameterError(
            f"--span must name a dimension or a variable over one dimension, got {name}. "
            f"Known: {', '.join(known)}."
        )
    values = np.asarray(dataset[name].values)
    inside = np.ones(values.shape, dtype=bool)
    if is_text(dataset[name]):
        inside = np.isin(values.astype(str), [span[0], span[1]])
    else:
        first, last = (_number(name, text) for text in span)
        if first is not None:
            inside &= values >= first
        if last is not None:
            inside &= values <= last
    if not inside.any():
        has = f"{values.min()} to {values.max()}" if values.dtype.kind in "fiu" else list(values)
        raise ParameterError(
            f"--span {name} must hold a value of the dataset, got {' to '.join(span)}; the dataset "
            f"has {has} {unit_of(dataset[name]) or ''}".rstrip()
            + "."
        )
    return dataset.isel({dataset[name].dims[0]: np.flatnonzero(inside)})


def _number(name: str, text: str) -> float | None:
    if not text:
        return None
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"--span {name} must have numbers, got {text!r}.") from None


def _without_unit(dataset: xr.Dataset) -> list[str]:
    """Return the names of all numbers whose unit is not stated."""
    return [str(name) for name, v in dataset.variables.items() if unit_of(v) is None]
