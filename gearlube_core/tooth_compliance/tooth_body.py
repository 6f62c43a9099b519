"""The elastic body around the flanks of a tooth, and the compliance of a pair's teeth."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.storage.folders import cache_folder as folder_of_part
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore
from gearlube_core.tooth_compliance.flank_compliance import (
    SIDES,
    CondensationSettings,
    FlankCompliance,
    tooth_compliance,
)
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry

_FORMAT = 1  # raise it with every change of the model that changes results
_FIELDS = ("s", "t", "image", "elastic")

FLANK_GRID = (13, 33)  # flank points handed to the mesher, root to tip and along the face

_Member = TypeVar("_Member", bound=str)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothBodySettings:
    """The elastic body around a flank.

    Parameters
    ----------
    base_depth_modules : float
        Depth of the base block under the slot [normal modules].
    neighbour_pitches : float
        Plain rim beside the tooth's own pitch, on each side [pitches].
    solid : Solid
        Of both members.
    condensation : CondensationSettings
    """

    base_depth_modules: float = 3.0
    neighbour_pitches: float = 1.0
    solid: Solid = STEEL_MOHAMMADPOUR_2015
    condensation: CondensationSettings = field(default_factory=CondensationSettings)

    def __post_init__(self) -> None:
        check_within("base_depth_modules", self.base_depth_modules, 0.5, 10.0, "modules")
        check_within("neighbour_pitches", self.neighbour_pitches, 0.0, 3.0, "pitches")


def members_compliance(
    teeth: Mapping[_Member, ToothGeometry],
    settings: ToothBodySettings,
    cache: Path | None,
    jobs: int | None,
    keep: bool = True,
) -> dict[_Member, tuple[FlankCompliance, FlankCompliance]]:
    """Return the compliance of the left and the right flank of each member's tooth.

    Parameters
    ----------
    teeth
        Tooth geometry of each member.
    settings
        Solid and condensation are read here.
    cache
        Folder of tooth compliances; None: the user's.
    jobs
        1: in this process. Otherwise teeth that are not in the cache have a process each where
        there are several.
    keep
        Whether new compliances go into the cache.
    """
    solid, condensation = settings.solid, settings.condensation
    found = {}
    for member, tooth in teeth.items():
        known = _stored_tooth_compliance(tooth, solid, condensation, cache)
        if known is not None:
            found[member] = known
    missing = [member for member in teeth if member not in found]
    processes = 1 if jobs == 1 else len(missing)
    with ProcessPool(jobs=processes).open(len(missing)) as executor:
        arguments = [(teeth[member], solid, condensation, cache, keep) for member in missing]
        if executor is None:
            computed = [cached_tooth_compliance(*values) for values in arguments]
        else:
            futures = [executor.submit(cached_tooth_compliance, *values) for values in arguments]
            computed = [future.result() for future in futures]
    return found | dict(zip(missing, computed, strict=True))


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
    A damaged file is computed and written again.
    """
    flanks = _stored_tooth_compliance(geometry, solid, settings, folder)
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


def _stored_tooth_compliance(
    geometry: ToothGeometry,
    solid: Solid,
    settings: CondensationSettings,
    folder: Path | str | None = None,
) -> tuple[FlankCompliance, FlankCompliance] | None:
    """Return the stored compliance that `cached_tooth_compliance` would read, or None."""
    store = ResultStore(cache_folder(folder), ARRAYS)
    stored = store.read(compliance_key(geometry, solid, settings))
    return None if stored is None else _flanks(stored, settings)
