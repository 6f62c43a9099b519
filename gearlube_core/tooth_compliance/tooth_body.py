"""The elastic body around the flanks of a tooth, and the compliance of a pair's teeth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from gearlube_core.checks import check_within
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.tooth_compliance.cache import cached_tooth_compliance, stored_tooth_compliance
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings, FlankCompliance
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry

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
        By member.
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
        known = stored_tooth_compliance(tooth, solid, condensation, cache)
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
