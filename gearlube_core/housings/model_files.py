"""Files of a reduced model: own arrays, Nastran, Abaqus, Matrix Market, and a table of nodes."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from importlib.resources import as_file, files
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy.io

from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError
from gearlube_core.housings.reduced_model import (
    GENERALISED,
    InterfaceNode,
    Length,
    Mass,
    ReducedModel,
)
from gearlube_core.housings.text_formats import Label, Labelled, check_rows, read_abaqus, read_dmig
from gearlube_core.storage.atomic_file import read_arrays

SHIPPED = "e_axle_case"  # made by examples/e_axle_case.py
_LARGEST = 500_000_000  # bytes of a text with matrices
_COLUMNS = ("node", "name", "x", "y", "z")
_ALL = "123456"
_WORDS = {"K": "stiffness", "M": "mass", "C": "damping"}


class _Row(NamedTuple):
    """A row of the table of nodes."""

    name: str
    place: tuple[float, float, float] | None  # None: generalised coordinates
    directions: str


def read_reduced_model(
    model_file: str | Path,
    *,
    mass_file: str | Path | None = None,
    damping_file: str | Path | None = None,
    node_table: str | Path | None = None,
    length_unit: Length = "m",
    mass_unit: Mass = "kg",
) -> ReducedModel:
    """Return the reduced model of files.

    Parameters
    ----------
    model_file : path
        All matrices: arrays `.npz`, a punch file `.pch` with DMIG of Nastran, or `.mtx` of Abaqus.
        Or the stiffness alone, `.mtx` of Matrix Market. Or the name of the shipped e_axle_case.
    mass_file, damping_file : path, optional
        With the other matrices, where they are files of their own.
    node_table : path, optional
        CSV with the columns node (its number), name, x, y, z. Elements act on nodes with a name. A
        row without a place is of generalised coordinates. Rows of a Matrix Market file are those of
        the table's nodes in their order, each with `dofs` (a column, such as 123; 123456 where left
        out), then generalised ones.
    length_unit : {"m", "mm"}
    mass_unit : {"kg", "t"}

    Raises
    ------
    ParameterError, FileError
        A file is missing, damaged, or has nodes that the table lacks; matrices do not fit together.

    Notes
    -----
    The arrays of an `.npz` file are `stiffness`, `mass` and perhaps `damping`, (n, n); `names` and
    `places`, (nodes,) and (nodes, 3); `owner` and `direction`, (n,), as in `ReducedModel`.

    Examples
    --------
    >>> read_reduced_model("case.step")
    Traceback (most recent call last):
    ...
    gearlube_core.errors.ParameterError: model_file must end in .npz, .pch or .mtx, got case.step.
    """
    units = {"length_unit": length_unit, "mass_unit": mass_unit}
    if model_file == SHIPPED:
        with as_file(files("gearlube_core.housings") / "data" / f"{SHIPPED}.npz") as shipped:
            return _from_arrays(shipped, units)
    if Path(model_file).suffix == ".npz":
        return _from_arrays(Path(model_file), units)
    table = {} if node_table is None else _read_table(node_table)
    found = _read_labelled("model_file", model_file, "K", table)
    matrices = dict(found.matrices)
    for field, path, kind in (("mass_file", mass_file, "M"), ("damping_file", damping_file, "C")):
        if path is not None:
            other = _read_labelled(field, path, kind, table)
            matrices[kind] = _reordered(field, other, kind, found.rows)
    for kind in ("K", "M"):
        if kind not in matrices:
            raise ParameterError(
                f"{model_file} must have {_WORDS[kind]}, got {', '.join(matrices) or 'no matrix'}. "
                "Ask for it as the model is reduced, or name its own file."
            )
    listed = table or {n: _Row(f"n{n}", place, _ALL) for n, place in found.places.items()}
    unknown = sorted({n for n, direction in found.rows if direction > 0} - set(listed))
    if unknown:
        raise ParameterError(
            f"node_table must have a row for every node of the matrices, got none for "
            f"{', '.join(map(str, unknown[:10]))}. Without a name no element acts on it; without "
            "x, y, z it is a generalised coordinate."
        )
    placed = [n for n, row in listed.items() if row.place is not None]
    numbers = {n: i for i, n in enumerate(placed)}
    owner = [numbers.get(n, GENERALISED) if d > 0 else GENERALISED for n, d in found.rows]
    return ReducedModel(
        stiffness=matrices["K"],
        mass=matrices["M"],
        damping=matrices.get("C"),
        nodes=tuple(InterfaceNode(listed[n].name, *(listed[n].place or ())) for n in placed),
        owner=np.array(owner),
        direction=np.array([max(direction - 1, 0) for _, direction in found.rows]),
        **units,  # type: ignore[arg-type]
    )


def _from_arrays(path: Path, units: Mapping[str, str]) -> ReducedModel:
    arrays = read_arrays(path)
    wanted = ("stiffness", "mass", "names", "places", "owner", "direction")
    missing = [one for one in wanted if one not in arrays]
    if missing:
        raise ParameterError(
            f"{path} must have the arrays {', '.join(wanted)}, got none of {', '.join(missing)}."
        )
    names, places = arrays["names"].astype(str), np.asarray(arrays["places"], float)
    if places.shape != (names.size, 3):
        raise ParameterError(
            f"places of {path} must have the shape ({names.size}, 3), got {places.shape}."
        )
    return ReducedModel(
        stiffness=arrays["stiffness"],
        mass=arrays["mass"],
        damping=arrays.get("damping"),
        nodes=tuple(
            InterfaceNode(str(name), *at) for name, at in zip(names, places.tolist(), strict=True)
        ),
        owner=arrays["owner"].astype(np.int64),
        direction=arrays["direction"].astype(np.int64),
        **units,  # type: ignore[arg-type]
    )


def _read_labelled(field: str, path: str | Path, kind: str, table: dict[int, _Row]) -> Labelled:
    """Return the matrices of a text; a Matrix Market file has the one of this kind."""
    suffix = Path(path).suffix
    if suffix not in (".pch", ".mtx"):
        own = ".npz, .pch or .mtx" if field == "model_file" else ".pch or .mtx"
        raise ParameterError(f"{field} must end in {own}, got {path}.")
    content = read_content(path, field, largest=_LARGEST)
    try:
        if suffix == ".pch":
            return read_dmig(content.decode("latin-1"))
        if not content.startswith(b"%%MatrixMarket"):
            return read_abaqus(content.decode("latin-1"))
        matrix = _matrix_market(content)
    except ParameterError as reason:
        raise ParameterError(f"{path}: {reason}") from None
    rows = [
        (n, int(one) if row.place is not None else 0)
        for n, row in table.items()
        for one in row.directions
    ]
    if matrix.shape[0] < len(rows) or not rows:
        raise ParameterError(
            f"{path} must have a row for each coordinate of node_table, got {matrix.shape[0]} for "
            f"{len(rows)}. Its columns are {', '.join(_COLUMNS)} and, where a node has less than "
            "six coordinates, dofs."
        )
    rows += [(-1 - i, 0) for i in range(matrix.shape[0] - len(rows))]
    return Labelled(tuple(rows), {kind: matrix}, {})


def _matrix_market(content: bytes) -> Array:
    try:
        check_rows(scipy.io.mminfo(io.BytesIO(content))[0])
        found = scipy.io.mmread(io.BytesIO(content))
    except (ValueError, OverflowError) as reason:
        raise ParameterError(f"must be a Matrix Market file, got {reason}.") from None
    matrix = np.asarray(found if isinstance(found, np.ndarray) else found.toarray())
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or np.iscomplexobj(matrix):
        raise ParameterError(f"must be a square matrix of real numbers, got {matrix.shape}.")
    return matrix.astype(float)


def _reordered(field: str, other: Labelled, kind: str, rows: tuple[Label, ...]) -> Array:
    """Return a matrix in the order of these rows; those it lacks are zero."""
    at = {label: i for i, label in enumerate(rows)}
    strange = [label for label in other.rows if label not in at]
    if strange or kind not in other.matrices:
        got = f"node {strange[0][0]}, {strange[0][1]}" if strange else ", ".join(other.matrices)
        raise ParameterError(
            f"{field} must have {_WORDS[kind]} at the coordinates of the stiffness, got {got}."
        )
    matrix = np.zeros((len(rows), len(rows)))
    places = [at[label] for label in other.rows]
    matrix[np.ix_(places, places)] = other.matrices[kind]
    return matrix


def _read_table(path: str | Path) -> dict[int, _Row]:
    """Return the rows of a table of nodes by their numbers."""
    text = read_content(path, "node_table").decode("utf-8-sig", errors="replace")
    found: dict[int, _Row] = {}
    lines = csv.DictReader(io.StringIO(text))
    if not set(_COLUMNS) <= set(lines.fieldnames or ()):
        raise ParameterError(
            f"{path} must have the columns {', '.join(_COLUMNS)}, got "
            f"{', '.join(lines.fieldnames or ())[:200]}."
        )
    for line in lines:
        given = {key: (value or "").strip() for key, value in line.items() if key}
        try:
            node, xyz = int(given["node"]), [given[one] for one in "xyz"]
            place = None
            if any(xyz):
                x, y, z = map(float, xyz)
                place = x, y, z
            directions = given.get("dofs") or _ALL
            if node in found or not set(directions) <= set(_ALL):
                raise ValueError
        except ValueError:
            raise ParameterError(
                f"line {lines.line_num} of {path} must have a number of a node of its own, its "
                f"name, x, y, z and perhaps dofs among {_ALL}, got "
                f"{', '.join(given.values())[:200]}."
            ) from None
        found[node] = _Row(given["name"], place, directions)
    return found
