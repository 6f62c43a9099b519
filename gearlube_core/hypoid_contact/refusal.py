"""The answer to a gear file: nothing, warnings, or a refusal that names what is likely wrong."""

from __future__ import annotations

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.likely_cause import likely_changes
from gearlube_core.hypoid_contact.pair_check import (
    FLANK_FIELDS,
    first_misfits,
    misfits_by_cost,
    unloaded_refusal,
    unloaded_warnings,
)
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.setting_slips import Change
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile


def check_pair(file: HypoidGearFile, misalignment: Misalignment = ALIGNED) -> None:
    """Raise ParameterError unless the flanks of a gear file meet on both sides.

    Takes a second for a file that is sound, and up to five for one that is not: the checks run in
    the order of their cost, and single changes are tried until one makes the file sound.

    Parameters
    ----------
    file : HypoidGearFile
    misalignment : Misalignment
        With which the flanks must still touch.

    Raises
    ------
    ParameterError
        The sentence says which check failed, by how much, and which setting is likely wrong.

    Examples
    --------
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> check_pair(file)
    """
    misfits = first_misfits(file)
    if misfits:
        said = " ".join(str(one) for one in misfits)
        raise ParameterError(
            f"The flanks cannot mesh. {said} {_cure(likely_changes(file, misfits))}"
        )
    reason = unloaded_refusal(file)
    if reason is not None:
        changes = likely_changes(file, [], FLANK_FIELDS)
        raise ParameterError(f"{reason} {_cure(changes)}".strip())
    if misalignment != ALIGNED:
        reason = unloaded_refusal(file, misalignment)
        if reason is not None:
            raise ParameterError(f"The misalignment is too large. {reason}")


def pair_warnings(file: HypoidGearFile) -> list[str]:
    """Return what speaks against a gear file whose flanks meet, one sentence each.

    Misfits that only shift the contact, edge contact without load, and a large transmission error.
    """
    unsound = [one for group in misfits_by_cost(file) for one in group if not one.is_sound]
    found = [str(one) for one in unsound]
    changes = likely_changes(file, unsound) if unsound else []
    if changes:
        found[-1] += f" {_cure(changes)}"
    return found + unloaded_warnings(file)


def _cure(changes: list[Change]) -> str:
    if not changes:
        return (
            "No change of a single setting makes the flanks meet: two or more are wrong. Check "
            "the settings named here against the sheet."
        )
    first, *others = changes
    rest = f" So they do with {', or with '.join(map(str, others))}." if others else ""
    return f"Most likely wrong: the flanks meet with {first}.{rest}"
