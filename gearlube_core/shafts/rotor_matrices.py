"""A shaft from the matrices of another program, such as ROSS: six coordinates at each place."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.shafts.beam import Beam, Bending
from gearlube_core.storage.atomic_file import read_arrays

_ALIKE = 1e-6  # of the own numbers of both coordinates, or of the largest gyroscopic one
_FREE = 1e-5  # of the stiffness, against rigid motions


def rotor_beam(
    *, places: Array, stiffness: Array, mass: Array, gyroscopic: Array | None = None
) -> Beam:
    """Return a free rotor, alike in both planes, from its matrices.

    M q'' + w G q' + K q = f, with x, y, z, rx, ry, rz at each place and z along the rotor

    Parameters
    ----------
    places : ndarray, shape (n,)
        Rising, along z [m].
    stiffness : ndarray, shape (6 n, 6 n)
        K, of shaft and discs without bearings [N/m, N, N m].
    mass : ndarray, shape (6 n, 6 n)
        M [kg, kg m, kg m2].
    gyroscopic : ndarray, shape (6 n, 6 n), optional
        G, of turning about +z; without it no gyroscopic moments act.

    Raises
    ------
    ParameterError
        Sizes do not fit, a matrix is not symmetric (G: antisymmetric), planes differ or are
        coupled, a mass is zero, or the rotor is held.

    Examples
    --------
    Two masses and a spring along the rotor:

    >>> spring = np.zeros((12, 12))
    >>> spring[np.ix_([2, 8], [2, 8])] = [[1e8, -1e8], [-1e8, 1e8]]  # N/m
    >>> rotor = rotor_beam(places=np.array([0.0, 1.0]), stiffness=spring, mass=np.eye(12))
    >>> rotor.axial_stiffness.tolist(), float(rotor.axial_mass.sum())
    ([[100000000.0, -100000000.0], [-100000000.0, 100000000.0]], 2.0)
    """
    z = np.asarray(places, float)
    if z.ndim != 1 or z.size < 2 or not (np.diff(z) > 0.0).all():
        raise ParameterError(f"places of the rotor must be two or more that rise, got {z}.")
    given = {"stiffness": stiffness, "mass": mass}
    if gyroscopic is not None:
        given["gyroscopic"] = gyroscopic
    matrices = {}
    for what, matrix in given.items():
        matrices[what] = np.asarray(matrix, float)
        if matrices[what].shape != (6 * z.size,) * 2 or not np.isfinite(matrices[what]).all():
            raise ParameterError(
                f"{what} of the rotor must be {6 * z.size} x {6 * z.size} finite numbers, six for "
                f"each place, got the shape {matrices[what].shape}."
            )
    first = 6 * np.arange(z.size)
    along_x, along_y = (np.add.outer(first, pair).ravel() for pair in ([0, 4], [1, 3]))
    turned = np.tile([1.0, -1.0], z.size)  # the slope along y is -rx
    parts = {}
    for what in ("stiffness", "mass"):
        matrix, whole = matrices[what], np.zeros_like(matrices[what])
        own = [matrix[np.ix_(at, at)] for at in (along_x, along_y, first + 2, first + 5)]
        own[0] = 0.5 * (own[0] + own[1] * np.outer(turned, turned))
        own[1] = own[0] * np.outer(turned, turned)
        for at, part in zip((along_x, along_y, first + 2, first + 5), own, strict=True):
            whole[np.ix_(at, at)] = 0.5 * (part + part.T)
        scale = np.sqrt(np.abs(np.diag(matrix)))
        _check_alike(what, matrix - whole, np.outer(scale, scale))
        parts[what] = [own[0], own[2], own[3]]
    lightest = min(float(np.linalg.eigvalsh(part)[0]) for part in parts["mass"])
    if lightest <= 0.0:
        raise ParameterError(
            "mass of the rotor must be above zero in every direction at every place, got "
            f"{lightest:.3g}. Give lumped masses a moment of inertia, or leave their places out."
        )
    bent = np.ones(2 * z.size)
    bent[::2] = z - z.mean()
    shifted = np.tile([1.0, 0.0], z.size)
    ones = np.ones(z.size)
    for part, motions in zip(parts["stiffness"], ((shifted, bent), (ones,), (ones,)), strict=True):
        held = max(abs(part @ one).max() / ((abs(part) @ abs(one)).max() or 1.0) for one in motions)
        if held > _FREE:
            raise ParameterError(
                f"stiffness of the rotor must not resist rigid motions by more than {_FREE:g} of "
                f"its numbers, got {held:.3g}. Leave out bearings and seals: they are elements of "
                "the train."
            )
    tilting = np.zeros_like(parts["mass"][0])
    if gyroscopic is not None:
        matrix = matrices["gyroscopic"]
        tilting = 0.5 * matrix[np.ix_(along_x, along_y)] * turned
        tilting = 0.5 * (tilting + tilting.T)
        whole = np.zeros_like(matrix)
        whole[np.ix_(along_x, along_y)] = 2.0 * tilting * turned
        _check_alike("gyroscopic", matrix - whole + whole.T, np.abs(matrix).max() or 1.0)
    return Beam(
        z,
        Bending(parts["stiffness"][0], parts["mass"][0], tilting),
        *(parts[what][k] for k in (1, 2) for what in ("stiffness", "mass")),
    )


def _check_alike(what: str, left: Array, scale: Array | float) -> None:
    """Check that a matrix is what a beam can hold; `left` is what it leaves."""
    off = np.abs(left) / np.where(scale == 0.0, 1.0, scale)
    if off.max() > _ALIKE:
        row, column = np.unravel_index(int(off.argmax()), off.shape)
        raise ParameterError(
            f"{what} of the rotor must be symmetric, alike in both planes, and couple neither them "
            f"nor bending with twist or length, got {off.max():.3g} at row {row + 1}, column "
            f"{column + 1}. Rows are x, y, z, rx, ry, rz at each place; leave out bearings."
        )


def read_rotor(path: str | Path) -> Beam:
    """Return the rotor of an npz file: arrays places, stiffness, mass and perhaps gyroscopic.

    Raises
    ------
    ParameterError, FileError
        The file is missing or damaged, lacks an array, or see `rotor_beam`.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "rotor.npz"
    >>> np.savez(path, places=[0.0, 1.0], stiffness=np.zeros((12, 12)), mass=np.eye(12))
    >>> read_rotor(path).places.tolist()
    [0.0, 1.0]
    """
    arrays = read_arrays(Path(path))
    wanted = ("places", "stiffness", "mass")
    if missing := [one for one in wanted if one not in arrays]:
        raise ParameterError(
            f"{path} must have the arrays {', '.join(wanted)}, got none of {', '.join(missing)}."
        )
    return rotor_beam(**{k: arrays[k] for k in (*wanted, "gyroscopic") if k in arrays})
