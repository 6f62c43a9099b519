"""Results of a variation on disk: one Zarr group, written block by block.

results.zarr has one array over the points for each varied parameter, and over the points

- `results` (point, quantity): what the study gives, NaN where a point failed;
- `status`: 1 finished, 0 failed, -1 not computed or lost to the machine;
- `message`: why a point failed or was lost.

A block of points is one chunk of each. results.zarr.sha256 beside it has the checksum of each
file, as `sha256sum --check` takes them. A block is finished once its three files are listed there;
one whose files have another content is damaged, and the next run computes it again.
"""

from __future__ import annotations

import json
import logging
import secrets
import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr
import zarr

from gearlube.variation.design import Axis, Design
from gearlube.variation.point_study import MISSING, Block, PointStudy, Quantity
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import file_hash, write_text

logger = logging.getLogger(__name__)

FILE = "results.zarr"
_FORMAT: Literal[2] = (
    2  # of Zarr: read by every library, with names of dimensions as xarray writes them
)
_LETTERS = 400  # of a message; what is longer is cut
_AS_WRITTEN: dict[str, Any] = {  # no number is taken for a missing one
    "consolidated": False,
    "chunks": {},
    "zarr_format": _FORMAT,
    "mask_and_scale": False,
}
_DIMENSIONS = "_ARRAY_DIMENSIONS"
_CURE = "Give another --out, or --overwrite to begin again there."


@dataclass(frozen=True, slots=True)
class BlockStore:
    """The results of one variation.

    Parameters
    ----------
    path : Path
        Of the Zarr group.
    size, block : int
        Points in all, and in a block.
    """

    path: Path
    size: int
    block: int

    @classmethod
    def found(
        cls, folder: Path, design: Design, *, key: str, overwrite: bool = False
    ) -> BlockStore | None:
        """Return the store in `folder`; None if there is none, or one that is to be overwritten.

        Raises
        ------
        ParameterError
            The folder has the results of another variation, and `overwrite` is false.
        """
        path = folder / FILE
        if not path.exists():
            return None
        attributes = _attributes(path)
        if attributes.get("key") == key:
            if lost := [name for name in _damaged(path) if not _is_of_block(name)]:
                logger.warning("%s is damaged. All is computed again.", path / lost[0])
                return None
            return cls(path, design.size, int(attributes["block"]))
        if overwrite:
            return None
        raise ParameterError(
            f"--out must be a folder for this variation, got {folder}, which holds another one or "
            f"one by another version: {attributes.get('title', 'unknown')}. {_CURE}"
        )

    @classmethod
    def made(
        cls, folder: Path, study: PointStudy, design: Design, *, key: str, block: int
    ) -> BlockStore:
        """Return a new, empty store in `folder`, instead of any that is there."""
        store = cls(folder / FILE, design.size, block)
        store._make(study, design, key)
        return store

    def _make(self, study: PointStudy, design: Design, key: str) -> None:
        """Write the group under another name first, so that it is complete or not there."""
        for old in self.path.parent.glob(f"{self.path.name}.*part"):  # of runs that were killed
            shutil.rmtree(old, ignore_errors=True)
        partial = self.path.with_name(f"{self.path.name}.{secrets.token_hex(8)}.part")
        group = zarr.open_group(str(partial), mode="w", zarr_format=_FORMAT)
        quantities = study.quantities
        group.attrs.update(
            title=f"{study.name} of {study.subject}, {', '.join(design.keys)} varied",
            study=study.name,
            key=key,
            block=self.block,
            shown=list(study.shown),
            quantities=[list(one) for one in quantities],
            inputs=[
                {
                    "key": name,
                    "unit": study.keys[name].unit,
                    "meaning": study.keys[name].meaning,
                    "sampled": name in {one.key for one in design.spreads},
                }
                for name in design.keys
            ],
            shape=[*design.shape, design.samples],
        )
        for axis in design.axes:
            self._input(group, study, design, axis.key, axis)
        for spread in design.spreads:
            self._input(group, study, design, spread.key, None)
        point = {"chunks": (self.block,), "shape": (self.size,)}
        _array(group, "status", ["point"], dtype="i1", fill_value=MISSING, **point)
        _array(group, "message", ["point"], dtype=f"S{_LETTERS}", fill_value=b"", **point)
        _array(
            group,
            "results",
            ["point", "quantity"],
            shape=(self.size, len(quantities)),
            chunks=(self.block, len(quantities)),
            dtype="f8",
            fill_value=np.nan,
        )
        shutil.rmtree(self.path, ignore_errors=True)
        files = (one.relative_to(partial) for one in partial.rglob("*") if one.is_file())
        write_text(_lines(partial, map(Path.as_posix, files)), _checksums(self.path))
        partial.rename(self.path)

    def _input(
        self, group: Any, study: PointStudy, design: Design, name: str, axis: Axis | None
    ) -> None:
        values = design.column(name)
        texts = axis is not None and isinstance(axis.values[0], str)
        values = values.astype("i4") if texts else values.astype("f8")
        array = _array(
            group, name, ["point"], shape=values.shape, chunks=values.shape, dtype=values.dtype
        )
        array[:] = values
        about = study.keys[name]
        array.attrs.update(units=about.unit, long_name=about.meaning)
        if texts and axis is not None:
            array.attrs["texts"] = list(axis.values)

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return -(-self.size // self.block)

    def points(self, number: int) -> range:
        """Return the numbers of the points of a block."""
        return range(number * self.block, min((number + 1) * self.block, self.size))

    def finished(self) -> set[int]:
        """Return the blocks that are computed and whose files are as they were written.

        Damaged blocks are logged.
        """
        listed, damaged = _listed(self.path), set(_damaged(self.path))
        there = {n for n in range(self.blocks) if listed.keys() >= set(_files(n))}
        good = {n for n in there if damaged.isdisjoint(_files(n))}
        if there - good:
            logger.warning(
                "%d of %d blocks in %s are damaged or missing. They are computed again.",
                len(there - good),
                self.blocks,
                self.path,
            )
        status: Any = zarr.open_array(str(self.path / "status"), mode="r")
        at = {n: self.points(n) for n in good}
        return {n for n, one in at.items() if MISSING not in status[one.start : one.stop]}

    def write(self, number: int, block: Block) -> None:
        """Write a block; it counts once the last of its files is there."""
        group = zarr.open_group(str(self.path), mode="r+")
        at = self.points(number)
        where = slice(at.start, at.stop)
        texts = [text.encode()[:_LETTERS] for text in block.messages]
        with zarr.config.set({"array.write_empty_chunks": True}):  # a missing file is a lost one
            arrays: dict[str, Any] = {
                name: group[name] for name in ("results", "message", "status")
            }
            arrays["results"][where] = block.values
            arrays["message"][where] = np.array(texts, dtype=f"S{_LETTERS}")
            arrays["status"][where] = block.status
        with _checksums(self.path).open("a", encoding="utf-8") as stream:
            stream.write(_lines(self.path, _files(number)))


def _array(group: Any, name: str, dimensions: list[str], **options: Any) -> Any:
    array = group.create_array(
        name, attributes={_DIMENSIONS: dimensions}, config={"write_empty_chunks": True}, **options
    )
    return array


def _checksums(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _files(number: int) -> tuple[str, ...]:
    """Return the files of a block, from the folder of the group."""
    return f"results/{number}.0", f"message/{number}", f"status/{number}"


def _is_of_block(name: str) -> bool:
    folder, _, file = name.partition("/")
    return folder in ("results", "message", "status") and not file.startswith(".")


def _lines(path: Path, names: Iterable[str]) -> str:
    return "".join(f"{file_hash(path / name)}  {name}\n" for name in names)


def _listed(path: Path) -> dict[str, str]:
    """Return the checksums of the files of a group by their names; the last of a name counts."""
    try:
        text = _checksums(path).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return {}
    rows = (line.partition("  ") for line in text.splitlines())
    return {name: digest for digest, _, name in rows}


def _damaged(path: Path) -> list[str]:
    """Return the files that lack, or have another content than was written, in rising order."""
    listed = _listed(path)
    return sorted(name for name, one in listed.items() if file_hash(path / name) != one)


def _attributes(path: Path) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads((path / ".zattrs").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found


def open_variation(folder: Path | str) -> xr.Dataset:
    """Open the results of a variation as a dataset; data are read only when they are used.

    Parameters
    ----------
    folder : path
        Folder given as --out to `gearlube vary`, also while it still computes.

    Returns
    -------
    xarray.Dataset
        Over `point`: every quantity, `status` (1 finished, 0 failed, -1 not computed), `message`,
        and the varied parameters as coordinates. NaN where a point failed or was not computed.

    Raises
    ------
    FileError
        There are no such results, or a file of them is damaged.

    Examples
    --------
    >>> results = open_variation("gearlube_vary")  # doctest: +SKIP
    >>> float(results["loss"].quantile(0.95).compute())  # doctest: +SKIP
    """
    folder = Path(folder)
    path = folder if folder.name.endswith(".zarr") else folder / FILE
    attributes = _attributes(path)
    if "quantities" not in attributes:
        raise FileError(
            f"{folder} must be a folder of `gearlube vary`, got none with {FILE}. Run it first."
        )
    if damaged := _damaged(path):
        raise FileError(
            f"{path / damaged[0]} is damaged or missing, and {len(damaged) - 1} other files "
            "with it. Run the same command again: it computes these points again."
        )
    if not _listed(path):
        logger.warning("%s has no checksums, so damage to it would not be seen.", path)
    raw = xr.open_zarr(str(path), **_AS_WRITTEN)
    found = raw.drop_vars("results")
    for column, row in enumerate(attributes["quantities"]):
        name, unit, meaning = Quantity(*row)
        found[name] = raw["results"][:, column]
        found[name].attrs = {"units": unit, "long_name": meaning}
    keys = [one["key"] for one in attributes["inputs"]]
    for key in keys:
        texts = found[key].attrs.pop("texts", None)
        if texts is not None:
            found[key] = ("point", np.array(texts)[found[key].values], found[key].attrs)
    found = found.set_coords(keys)
    found.attrs.pop("quantities")
    return found.assign_attrs(inputs=json.dumps(attributes["inputs"]))


def read_points(folder: Path, points: slice, columns: slice = slice(None)) -> dict[str, Any]:
    """Return the arrays of the store at some points, `results` with some of its columns."""
    group: Any = zarr.open_group(str(folder / FILE), mode="r")
    found = {name: array[points] for name, array in group.arrays() if name != "results"}
    return found | {"results": group["results"][points, columns]}


def gridded(results: xr.Dataset) -> xr.Dataset:
    """Return the results of a variation over its axes and `sample`, instead of over `point`.

    Examples
    --------
    >>> gridded(open_variation("gearlube_vary"))["loss"].dims  # doctest: +SKIP
    ('oil.temperature_degc', 'sample')
    """
    inputs = json.loads(results.attrs["inputs"])
    axes = [one["key"] for one in inputs if not one["sampled"]]
    shape = [int(n) for n in results.attrs["shape"]]
    dims = (*axes, "sample")
    variables = {
        str(name): (dims, one.data.reshape(shape), one.attrs)
        for name, one in results.variables.items()
        if name not in axes and one.dims == ("point",)
    }
    coords = {}
    for place, axis in enumerate(axes):
        first = [0] * len(shape)
        column = results[axis].values.reshape(shape)
        where: tuple[Any, ...] = tuple(
            slice(None) if i == place else one for i, one in enumerate(first)
        )
        coords[axis] = (axis, column[where], results[axis].attrs)
    found = xr.Dataset(variables, coords=coords, attrs=results.attrs)
    return found.set_coords([one["key"] for one in inputs if one["sampled"]])
