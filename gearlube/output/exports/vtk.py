"""Fields as VTK files: pressure on the gear's flank, pressure and film over a contact."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.units import heading, is_text
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.storage.file_names import file_stem, told_apart

FILE_LIMIT = 1000
_PLANES = (("x", "y"), ("map_s", "map_t"))


def write_vtk(dataset: xr.Dataset, folder: Path) -> list[Path]:
    """Write a .vtu file for each place of the other dimensions; return the paths.

    Fields over `x` and `y` lie at the points of a plane, those over `map_s` and `map_t` in the
    cells of the gear's flank, in its own coordinates. Places are in m.

    Raises
    ------
    ParameterError
        The package meshio is missing. The dataset has no such fields, or too many places.
    """
    meshio = extra_package("meshio", "export", "A VTK file is written")
    groups = _groups(dataset)
    if not groups:
        raise ParameterError(
            "A VTK file must hold fields over x and y or over map_s and map_t, got "
            f"{', '.join(map(str, dataset.data_vars)) or 'none'}. Fields are in the results of "
            "gearlube contact and gearlube ehl; choose csv or mat for others."
        )
    files = [
        (plane, names, place)
        for (plane, others), names in groups.items()
        for place in _places(dataset, others)
    ]
    if len(files) > FILE_LIMIT:
        raise ParameterError(
            f"At most {FILE_LIMIT} VTK files are written, got {len(files)}. Choose variables with "
            "--variable, or a part of them with --span."
        )
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    stems = told_apart(
        file_stem("_".join([names[0], *_words(dataset, place)])) for _, names, place in files
    )
    for stem, (plane, names, place) in zip(stems, files, strict=True):
        on_flank = plane == _PLANES[1]
        points, cells = _flank(dataset, place) if on_flank else _plane(dataset, plane)
        fields = {heading(n, dataset[n]): _field(dataset[n], plane, place) for n in names}
        held: dict[str, Any] = (
            {"cell_data": {name: [values] for name, values in fields.items()}}
            if on_flank
            else {"point_data": fields}
        )
        path = folder / f"{stem}.vtu"
        with atomic_write(path) as partial:
            meshio.write(partial, meshio.Mesh(points, [("quad", cells)], **held), "vtu")
        paths.append(path)
    return paths


def _groups(dataset: xr.Dataset) -> dict[tuple[tuple[str, str], tuple[str, ...]], list[str]]:
    """Return the fields by plane and other dimensions."""
    groups: dict[tuple[tuple[str, str], tuple[str, ...]], list[str]] = {}
    for name, variable in dataset.data_vars.items():
        for plane in _PLANES:
            if set(plane) <= set(variable.dims) and not is_text(variable):
                others = tuple(str(d) for d in variable.dims if d not in plane)
                groups.setdefault((plane, others), []).append(str(name))
    return groups


def _places(dataset: xr.Dataset, dims: tuple[str, ...]) -> Iterator[dict[str, int]]:
    for index in itertools.product(*(range(dataset.sizes[d]) for d in dims)):
        yield dict(zip(dims, index, strict=True))


def _words(dataset: xr.Dataset, place: Mapping[str, int]) -> Iterator[str]:
    for dim, k in place.items():
        value = dataset[dim].values[k] if dim in dataset.coords else k
        yield str(value) if isinstance(value, str) else f"{dim}_{value:.6g}"


def _field(variable: xr.DataArray, plane: tuple[str, str], place: Mapping[str, int]) -> Array:
    values = variable.isel(place).transpose(*plane).values
    return np.asarray(values, dtype=np.float64).reshape(-1)


def _plane(dataset: xr.Dataset, plane: tuple[str, str]) -> tuple[Array, np.ndarray[Any, Any]]:
    x, y = np.meshgrid(*(dataset[dim].values for dim in plane), indexing="ij")
    return np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3), _quads(x.shape)


def _flank(dataset: xr.Dataset, place: Mapping[str, int]) -> tuple[Array, np.ndarray[Any, Any]]:
    """Return corners of the cells on the gear's flank [m], in its own coordinates."""
    s, t = (_borders(dataset[dim].values) for dim in _PLANES[1])
    whole_s, whole_t = np.meshgrid(s, t, indexing="ij")
    file = HypoidGearFile.model_validate_json(dataset.attrs["gear_file"])
    side = str(dataset["side"].values[place["side"]])
    pair = FlankPair.from_file(file, side)  # type: ignore[arg-type]
    return pair.gear.sample(whole_s.ravel(), whole_t.ravel()).r, _quads(whole_s.shape)


def _borders(middles: Array) -> Array:
    """Return the borders of cells of one width."""
    half = 0.5 * (middles[1] - middles[0])
    return np.append(middles - half, middles[-1] + half).clip(0.0, 1.0)


def _quads(shape: tuple[int, ...]) -> np.ndarray[Any, Any]:
    """Return the corners of all cells of a grid of points, row by row."""
    at = np.arange(shape[0] * shape[1]).reshape(shape)
    corners = [at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]]
    return np.stack(corners, axis=-1).reshape(-1, 4)
