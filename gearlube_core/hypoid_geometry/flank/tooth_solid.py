"""Closed triangulated surfaces of a tooth and of a whole member, and their files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array, Indices
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.units import MILLIMETRE

_ACROSS = 9  # points across a topland, over a foot and along a slot: 0.01 % of the volume
FORMATS = ("stl", "glb")
_COLUMNS = (
    "s,t,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,gauss_curvature_per_mm2,mean_curvature_per_mm"
)


MIRROR = np.array([1.0, -1.0, 1.0])  # from a right-handed pinion's pair to a left-handed one's


class Solid(NamedTuple):
    """A closed surface: `vertices` (v, 3) [m]; `faces` (f, 3), outward by the right hand."""

    vertices: Array
    faces: Indices


def tooth_solid(tooth: Tooth, m: int = 24, n: int = 48) -> Solid:
    """Return one tooth over the root cone as a closed surface.

    Flanks with m rows (root to tip) and n columns (toe to heel), topland on the face cone, foot on
    the root cone, ends on the back cones at toe and heel. Root fillets are not cut.
    """
    rows, columns = _counts(m, n)
    s, t = np.linspace(0.0, 1.0, rows), np.linspace(0.0, 1.0, columns)
    drive, coast = _flank_angles(tooth, s, t)
    share = np.linspace(0.0, 1.0, _ACROSS)
    # one block of points: height, across, along; the skin of the block is the tooth
    angle = drive[:, None] + share[:, None] * (coast - drive)[:, None]
    vertices = np.stack([tooth.points(angle[:, k], s, t) for k in range(_ACROSS)], axis=1)
    number = np.arange(vertices[..., 0].size).reshape(vertices.shape[:3])
    faces = [
        _patch(number[:, 0, :]),
        _patch(number[:, -1, :])[:, ::-1],
        _patch(number[0, :, :])[:, ::-1],
        _patch(number[-1, :, :]),
        _patch(number[:, :, 0])[:, ::-1],
        _patch(number[:, :, -1]),
    ]
    return _closed(vertices.reshape(-1, 3), np.concatenate(faces))


def gear_solid(tooth: Tooth, m: int = 16, n: int = 32, rim: float | None = None) -> Solid:
    """Return a whole member as a closed surface: all teeth on a conical rim.

    Parameters
    ----------
    tooth : Tooth
    m, n : int
        Rows (root to tip) and columns (toe to heel) of each flank.
    rim : float, optional
        Thickness of the rim under the root cone [m]; absent: the whole depth of the teeth.
    """
    rows, columns = _counts(m, n)
    region = tooth.drive.region
    depth = region.root_depth + region.addendum
    thick = depth if rim is None else rim
    # the inner radius at the toe, where the rim is narrowest, stays positive
    toe = region.section(np.array(0.0), np.array(0.0))[0]
    limit = 0.9 * float(toe) / float(np.cos(region.pitch_angle))
    check_within("rim", thick, 1e-4, limit, "m", "The rim must not cross the axis at the toe.")
    s, t = np.linspace(0.0, 1.0, rows), np.linspace(0.0, 1.0, columns)
    drive, coast = _flank_angles(tooth, s, t)
    over = np.linspace(0.0, 1.0, _ACROSS)[1:-1, None]
    next_drive = drive[0] + tooth.towards * tooth.pitch
    # one turn of the contour per tooth: up the drive flank, over the top, down, along the slot
    angle = np.concatenate(
        [
            drive,
            drive[-1] + over * (coast[-1] - drive[-1]),
            coast[::-1],
            coast[0] + over * (next_drive - coast[0]),
        ]
    )
    height = np.concatenate([s, np.ones(over.size), s[::-1], np.zeros(over.size)])
    per_tooth, teeth = len(height), tooth.drive.teeth
    pitches = tooth.towards * tooth.pitch * np.arange(teeth)
    skin = np.concatenate([tooth.points(angle + turn, height, t) for turn in pitches])
    below = np.full(per_tooth, -thick / depth)
    spread = np.linspace(0.0, 1.0, per_tooth, endpoint=False)[:, None]
    inner_angle = drive[0] + tooth.towards * tooth.pitch * spread
    bore = np.concatenate([tooth.points(inner_angle + turn, below, t) for turn in pitches])

    count = teeth * per_tooth
    number = np.arange(count * columns).reshape(count, columns)
    number = np.concatenate([number, number[:1]])
    inside = number + count * columns
    ends = _ends(per_tooth, rows, teeth)
    faces = [_patch(number), _patch(inside)[:, ::-1]]
    for column, flip in ((0, True), (columns - 1, False)):
        corner = np.concatenate([number[:-1, column], inside[:-1, column]])
        end = corner[ends]
        faces.append(end[:, ::-1] if flip else end)
    return _closed(np.concatenate([skin, bore]).reshape(-1, 3), np.concatenate(faces))


def _counts(m: int, n: int) -> tuple[int, int]:
    return int(check_within("m", m, 2, 2000)), int(check_within("n", n, 2, 2000))


def _flank_angles(tooth: Tooth, s: Array, t: Array) -> tuple[Array, Array]:
    """Return the polar angles of both flanks; a pointed tooth or closed slot has no surface."""
    drive, coast = tooth.angles("drive", s, t)[0], tooth.angles("coast", s, t)[0]
    filled = tooth.towards * (coast - drive)
    if np.any(filled <= 0.0) or np.any(filled >= tooth.pitch):
        width = float(np.min(filled[-1]))
        radius = float(tooth.drive.region.section(np.array(1.0), np.array(0.0))[0])
        raise ParameterError(
            f"The {tooth.drive.role} tooth is pointed or its slot is closed (topland down to "
            f"{width * radius / MILLIMETRE:.3f} mm): no closed surface. See tooth_form(...)."
            "report()."
        )
    return drive, coast


def _patch(number: Indices) -> Indices:
    """Return the triangles of a grid of vertex numbers, (f, 3)."""
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    return np.concatenate(
        [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, c, b), (a, d, c))]
    )


def _ends(per_tooth: int, rows: int, teeth: int) -> Indices:
    """Return the triangles of an end face: contour numbers first, then those of the bore.

    Each tooth: strips across it between equal heights, its topland as a fan, and quadrilaterals
    from its foot and its slot to the bore.
    """
    total = per_tooth * teeth
    tip = rows - 1
    far_tip = tip + _ACROSS - 1
    foot = far_tip + tip  # last point of the coast flank, on the root
    one: list[tuple[int, int, int]] = []
    for k in range(tip):
        left, right = (k, k + 1), (foot - k, foot - k - 1)
        one += [(left[0], right[1], left[1]), (left[0], right[0], right[1])]
    one += [(tip, j + 1, j) for j in range(tip + 1, far_tip)]
    # under the tooth the bore's points belong to the two corners of its foot
    half = foot // 2
    one += [(0, total + j, total + j + 1) for j in range(half)]
    one += [(foot, total + j, total + j + 1) for j in range(half, foot)]
    one += [(0, total + half, foot)]
    for j in range(foot, per_tooth):
        one += [(j, total + j, total + j + 1), (j, total + j + 1, j + 1)]
    local = np.array(one)
    bore = local >= total
    shifted = [
        np.where(
            bore, total + (local - total + k * per_tooth) % total, (local + k * per_tooth) % total
        )
        for k in range(teeth)
    ]
    return np.concatenate(shifted)


def _closed(vertices: Array, faces: Indices) -> Solid:
    """Return the surface with all triangles turned outward: its volume counts positive."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    volume = float(np.sum(a * np.cross(b, c)))
    return Solid(vertices, faces if volume > 0.0 else faces[:, ::-1])


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
    """Give a file to write; rename it to `path` when all went well."""
    target = Path(path)
    if not target.parent.is_dir():
        raise ParameterError(f"The folder {target.parent} of {target.name} does not exist.")
    with atomic_write(target) as partial:
        yield partial
