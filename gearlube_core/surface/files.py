"""Files of surfaces: tables, npz and NetCDF as case files take them, and those of instruments."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_file
from gearlube_core.errors import ParameterError, why
from gearlube_core.extras import extra_package
from gearlube_core.input_file.table import TABLES
from gearlube_core.storage.atomic_file import DAMAGED, check_unpacked, write_arrays, write_text
from gearlube_core.surface.heights import MICROMETRE, HeightMap, Profile, Surface, evenly_spaced
from gearlube_core.surface.measured_heights import LARGEST, filled, read_map, read_profile
from gearlube_core.units import MILLIMETRE

SUFFIXES = (*TABLES, ".npz", ".nc", ".sdf", ".x3p", ".sur", ".al3d")


def read_surface(path: str | Path) -> Surface:
    """Return a surface profile or map from a file; the ending of its name gives its kind.

    .csv, .txt, .tsv: a profile, columns x_mm and height_um; .npz, .nc: a map, x and y in mm and
    height in um; .sdf: [iso_25178_71], .x3p: [iso_25178_72], .sur: Digital Surf, .al3d: Alicona,
    which need the extra `gearlube[surfaces]`. A file of an instrument with one row gives a profile.
    Points that were not measured are filled, see `measured_heights.filled`.

    Raises
    ------
    ParameterError
        The file is missing, damaged or of another kind, too many points were not measured, or the
        package that reads it is not installed.

    Examples
    --------
    >>> try:
    ...     read_surface("disc.xyz")
    ... except ParameterError as error:
    ...     print(str(error)[:60])
    A surface must be a file that ends in one of .csv, .txt, .ts
    """
    where = Path(path)
    kind = where.suffix.lower()
    if kind in TABLES:
        return evenly_spaced(read_profile(where))
    if kind in (".npz", ".nc"):
        return evenly_spaced(read_map(where))
    if kind == ".sdf":
        return _read_sdf(where)
    if kind == ".x3p":
        return _read_x3p(where)
    if kind in SUFFIXES:
        return _read_topography(where)
    raise ParameterError(
        f"A surface must be a file that ends in one of {', '.join(SUFFIXES)}, got {where.name}. "
        "Export it from the instrument's software as X3P, SDF, SUR or CSV."
    )


def write_surface(surface: Surface, path: str | Path) -> None:
    """Write a profile as CSV or a map as npz, so that `read_surface` and case files can read it.

    Raises
    ------
    ParameterError
        The name has another ending.

    Examples
    --------
    >>> import tempfile
    >>> profile = Profile(height=1e-7 * np.sin(np.arange(50.0)), spacing=1e-6)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_surface(profile, Path(folder) / "profile.csv")
    ...     read_surface(Path(folder) / "profile.csv").height.size
    50
    """
    where = Path(path)
    kind = ".csv" if isinstance(surface, Profile) else ".npz"
    if where.suffix.lower() != kind:
        raise ParameterError(f"{surface.name} is written to a file {kind}, got {where.name}.")
    if isinstance(surface, Profile):
        write_text(profile_csv(surface), where)
        return
    arrays = {
        "x": surface.x / MILLIMETRE,
        "y": surface.y / MILLIMETRE,
        "height": surface.height / MICROMETRE,
    }
    write_arrays(where, arrays, compress=True)


def profile_csv(profile: Profile) -> str:
    """Return a profile as the text of a CSV file, columns x_mm and height_um."""
    rows = zip(profile.x / MILLIMETRE, profile.height / MICROMETRE, strict=True)
    return "x_mm,height_um\n" + "".join(f"{x:.9g},{z:.9g}\n" for x, z in rows)


def _read_sdf(path: Path) -> Surface:
    sdfio = extra_package("sdfio", "surfaces", f"{path} is read")
    found = _read(path, "SDF", sdfio.read, sdfio.SdfError)
    header = found.header
    return _from_rows(path, found.data, (header.x_scale, header.y_scale))


def _read_x3p(path: Path) -> Surface:
    x3pio = extra_package("x3pio", "surfaces", f"{path} is read")
    found = _read(path, "X3P", x3pio.read, x3pio.X3pError)
    kinds = x3pio.Profile | x3pio.Surface
    if not isinstance(found, kinds) or len(found.layers) != 1 or not found.is_regular_grid:
        raise ParameterError(
            f"{path} must hold one profile or surface at even points, got a "
            f"{type(found).__name__} with {len(found.layers)} layers. Export one layer of heights "
            "on a regular grid."
        )
    layer = found.layers[0]
    if isinstance(found, x3pio.Profile):
        return _from_rows(path, layer.z[None, :], (layer.spacing, 0.0))
    return _from_rows(path, layer.z, layer.spacing)


def _read_topography(path: Path) -> Surface:
    package = extra_package("SurfaceTopography", "surfaces", f"{path} is read")
    error = import_module("SurfaceTopography.Exceptions").ReadFileError
    kind = path.suffix[1:]

    def read(file: Path) -> Any:
        return package.open_topography(str(file), format=kind).topography().to_unit("m")

    found = _read(path, kind.upper(), read, error)
    return _from_rows(path, np.ma.filled(found.heights(), np.nan).T, found.pixel_size)


def _from_rows(path: Path, rows: Array, steps: tuple[float, float]) -> Surface:
    """Return heights (ny, nx) [m] of an instrument as a surface."""
    height = np.ascontiguousarray(np.asarray(rows, dtype=float).T)
    name = f"surface {path}"
    height = filled(height, name)
    if height.shape[0] == 1:
        raise ParameterError(
            f"{name} must have several points along x, got one. Turn it by 90 deg."
        )
    if height.shape[1] == 1:
        return Profile(height=height[:, 0], spacing=steps[0], name=name)
    return HeightMap(height=height, spacing=steps, name=name)


def _read(path: Path, kind: str, read: Any, error: type[Exception]) -> Any:
    check_file(path, f"{kind} file", largest=LARGEST)
    check_unpacked(path)
    try:
        return read(path)
    except (error, *DAMAGED) as reason:
        raise ParameterError(f"{path} is not a readable {kind} file: {why(reason)}.") from None
