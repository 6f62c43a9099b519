"""Compliances kept on disk, found by a hash of everything that decides them."""

from __future__ import annotations

import hashlib
import os
import tempfile
import zipfile
from pathlib import Path

import numpy as np

from gearlube_core.contact.solid import Solid
from gearlube_core.tooth_compliance.flank_compliance import (
    SIDES,
    CondensationSettings,
    FlankCompliance,
    tooth_compliance,
)
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry

FOLDER_VARIABLE = "GEARLUBE_CACHE"
_FORMAT = 1  # raise it with every change of the model that changes results
_FIELDS = ("s", "t", "image", "elastic")


def compliance_key(geometry: ToothGeometry, solid: Solid, settings: CondensationSettings) -> str:
    """Return the hexadecimal hash of all inputs and of the format's version."""
    digest = hashlib.sha256(f"tooth compliance {_FORMAT}".encode())
    for name in geometry.__dataclass_fields__:
        value = np.asarray(getattr(geometry, name), dtype=np.float64)
        digest.update(f"{name} {value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())
    digest.update(repr((solid.youngs_modulus, solid.poisson_ratio, settings)).encode())
    return digest.hexdigest()


def cache_folder(folder: Path | str | None = None) -> Path:
    """Return `folder`, else that of the variable GEARLUBE_CACHE, else the user's cache."""
    chosen = folder if folder is not None else os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen) / "tooth_compliance"
    from platformdirs import user_cache_path

    return user_cache_path("gearlube") / "tooth_compliance"


def _read(
    path: Path, settings: CondensationSettings
) -> tuple[FlankCompliance, FlankCompliance] | None:
    """Return the stored flanks, or None when the file is absent or damaged."""
    count = settings.profile_hats * settings.lengthwise_hats
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays = {side: {name: stored[f"{side}_{name}"] for name in _FIELDS} for side in SIDES}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    flanks = tuple(FlankCompliance(**arrays[side]) for side in SIDES)
    whole = all(
        matrix.shape == (count, count) and bool(np.all(np.isfinite(matrix)))
        for flank in flanks
        for matrix in (flank.image, flank.elastic)
    )
    return (flanks[0], flanks[1]) if whole else None


def _write(path: Path, flanks: tuple[FlankCompliance, ...]) -> None:
    """Write a neighbouring file and rename it, so that no reader sees half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    arrays = {
        f"{side}_{name}": getattr(flank, name)
        for side, flank in zip(SIDES, flanks, strict=True)
        for name in _FIELDS
    }
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            np.savez(file, **arrays)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def cached_tooth_compliance(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None = None,
) -> tuple[FlankCompliance, FlankCompliance]:
    """Return `tooth_compliance` of the same arguments, from the disk where it is known.

    Parameters
    ----------
    geometry, solid, settings
        As in `tooth_compliance`.
    folder
        Where to keep results; without it the environment variable GEARLUBE_CACHE decides, or
        the user's cache folder.

    Notes
    -----
    A damaged file is computed and written anew.
    """
    flanks = stored_tooth_compliance(geometry, solid, settings, folder)
    if flanks is None:
        flanks = tooth_compliance(geometry, solid, settings)
        _write(_path(geometry, solid, settings, folder), flanks)
    return flanks


def stored_tooth_compliance(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None = None,
) -> tuple[FlankCompliance, FlankCompliance] | None:
    """Return what `cached_tooth_compliance` would take from the disk, or None."""
    return _read(_path(geometry, solid, settings, folder), settings)


def _path(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None,
) -> Path:
    return cache_folder(folder) / f"{compliance_key(geometry, solid, settings)}.npz"
