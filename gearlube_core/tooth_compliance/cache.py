"""Tooth compliances stored on disk under a hash of all their inputs."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from gearlube_core.contact.solid import Solid
from gearlube_core.storage.cache_folder import cache_folder as folder_of_part
from gearlube_core.storage.result_store import ARRAYS, Record, ResultStore
from gearlube_core.tooth_compliance.flank_compliance import (
    SIDES,
    CondensationSettings,
    FlankCompliance,
    tooth_compliance,
)
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry

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
    return folder_of_part("tooth_compliance", folder)


def _flanks(
    stored: Record, settings: CondensationSettings
) -> tuple[FlankCompliance, FlankCompliance] | None:
    """Return the flanks of a record, or None when an array is missing, misshapen or not finite."""
    count = settings.profile_hats * settings.lengthwise_hats
    if not stored.keys() >= {f"{side}_{name}" for side in SIDES for name in _FIELDS}:
        return None
    flanks = tuple(
        FlankCompliance(**{name: stored[f"{side}_{name}"] for name in _FIELDS}) for side in SIDES
    )
    sound = all(
        matrix.shape == (count, count) and bool(np.all(np.isfinite(matrix)))
        for flank in flanks
        for matrix in (flank.image, flank.elastic)
    )
    return (flanks[0], flanks[1]) if sound else None


def cached_tooth_compliance(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None = None,
    keep: bool = True,
) -> tuple[FlankCompliance, FlankCompliance]:
    """Return `tooth_compliance` of these arguments, read from the disk if stored there.

    Parameters
    ----------
    geometry, solid, settings
        As in `tooth_compliance`.
    folder
        Where to keep results; without it the environment variable GEARLUBE_CACHE decides, or
        the user's cache folder.
    keep
        Whether to store what is computed.

    Notes
    -----
    A damaged file is computed and written anew.
    """
    flanks = stored_tooth_compliance(geometry, solid, settings, folder)
    if flanks is None:
        flanks = tooth_compliance(geometry, solid, settings)
        if not keep:
            return flanks
        record = {
            f"{side}_{name}": getattr(flank, name)
            for side, flank in zip(SIDES, flanks, strict=True)
            for name in _FIELDS
        }
        store = ResultStore(cache_folder(folder), ARRAYS)
        store.keep(compliance_key(geometry, solid, settings), record)
    return flanks


def stored_tooth_compliance(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None = None,
) -> tuple[FlankCompliance, FlankCompliance] | None:
    """Return the stored compliance that `cached_tooth_compliance` would read, or None."""
    store = ResultStore(cache_folder(folder), ARRAYS)
    stored = store.read(compliance_key(geometry, solid, settings))
    return None if stored is None else _flanks(stored, settings)
