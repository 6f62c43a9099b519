"""Flanks and gears for other programs: point grids as CSV, closed surfaces as STL and GLB."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.tooth_solid import Solid
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.units import MILLIMETRE

FORMATS = ("stl", "glb")
_COLUMNS = (
    "s,t,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,gauss_curvature_per_mm2,mean_curvature_per_mm"
)


MIRROR = np.array([1.0, -1.0, 1.0])  # from a right-handed pinion's pair to a left-handed one's


def write_flank_csv(
    flank: Flank, path: str | Path, m: int = 21, n: int = 41, *, mirrored: bool = False
) -> Path:
    """Write a flank's points, outward normals and curvatures to a CSV file; return the path.

    m rows from root to tip times n columns from toe to heel, one line each, the face position
    running fastest. Lengths in millimetres, fixed frame of the pair, member at rotation zero.
    Lines of places without a flank (undercut) are left out. Comment lines start with #.
    `mirrored` gives the flank of the pair of the other hand, y -> -y.
    """
    rows, columns = int(check_within("m", m, 2, 2000)), int(check_within("n", n, 2, 2000))
    s, t = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    sample = flank.sample(s, t)
    sound = sample.regularity > 0.0
    curvature = sample.curvature[sound]
    gauss = np.linalg.det(curvature) * MILLIMETRE**2
    mean = 0.5 * np.trace(curvature, axis1=-2, axis2=-1) * MILLIMETRE
    sign = MIRROR if mirrored else np.ones(3)
    points, normals = sign * sample.r[sound] / MILLIMETRE, sign * sample.normal[sound]
    place = [s[sound], t[sound], *points.T, *normals.T]
    table = np.stack([*place, gauss, mean], axis=-1)
    header = (
        f"# {flank.role} {flank.side} flank, {rows} rows (s: 0 root cone, 1 tip) by {columns} "
        "columns (t: 0 toe, 1 heel)\n"
        "# fixed frame of the pair, member at rotation zero; normals point out of the tooth; "
        "curvature positive where the centre lies on the side of the normal\n"
        f"{_COLUMNS}\n"
    )
    with _in_one_move(path) as partial, partial.open("w", encoding="utf-8", newline="\n") as file:
        file.write(header)
        np.savetxt(file, table, fmt="%.9g", delimiter=",")
    return Path(path)


def mirror_image(solid: Solid) -> Solid:
    """Return a solid of the pair of the other hand, y -> -y; its faces still look outward."""
    return Solid(solid.vertices * MIRROR, solid.faces[:, ::-1])


def write_solid(solid: Solid, path: str | Path) -> Path:
    """Write a closed surface to `path`; return it. The suffix says how: .stl or .glb.

    STL in millimetres, as printers and CAD programs read it; GLB in metres, as glTF 2.0 asks.

    Raises
    ------
    ParameterError
        For another suffix, and when trimesh, which writes both, is not installed.
    """
    kind = check_option("suffix", Path(path).suffix.lstrip(".").lower(), FORMATS)
    trimesh = extra_package("trimesh", "export", "An STL or GLB file is written")
    scale = 1.0 / MILLIMETRE if kind == "stl" else 1.0
    mesh = trimesh.Trimesh(solid.vertices * scale, solid.faces, process=False)
    with _in_one_move(path) as partial:
        mesh.export(partial, file_type=kind)
    return Path(path)


@contextmanager
def _in_one_move(path: str | Path) -> Iterator[Path]:
    """Give a file to write; put it in the place of `path` when all went well."""
    target = Path(path)
    if not target.parent.is_dir():
        raise ParameterError(f"The folder {target.parent} of {target.name} does not exist.")
    with atomic_write(target) as partial:
        yield partial
