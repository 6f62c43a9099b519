"""The answer to a gear file: nothing, warnings, or a refusal that names what is likely wrong."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import islice
from typing import NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair_check import (
    FLANK_FIELDS,
    Cuts,
    first_misfits,
    misfits_by_cost,
    reference_cuts,
    unloaded_refusal,
    unloaded_warnings,
)
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.setting_slips import Change, setting, slips
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.misfit import Misfit

_OFFERED = 3
_TRIED = 6  # changes whose unloaded contact is tried
_ITERATIONS = 8
_CLOSED = 0.02  # of a limit: a solved misfit
_STEP = 1e-3  # mm or deg, of a derivative
_LONGEST = 10.0  # mm or deg, step of the search for a value
_STARTS = 16  # steps to both sides in which a cutter is looked for that reaches the tooth
_SEARCHED = ("_mm", "_deg", "ratio_of_roll")


class _Cure(NamedTuple):
    score: float
    change: Change
    file: HypoidGearFile


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


def likely_changes(
    file: HypoidGearFile, misfits: list[Misfit], fields: tuple[str, ...] = ()
) -> list[Change]:
    """Return the changes of one setting that make a refused file sound, the likeliest first.

    Slips (a sign, a unit, a decimal point, a miscount, two settings exchanged) come before other
    values, and what fits best comes first. Each change is offered only if both flanks then touch
    without load.

    Parameters
    ----------
    file : HypoidGearFile
    misfits : list of Misfit
        For which the file is refused.
    fields : tuple of str
        Settings to try; absent, those that decide the misfits.
    """
    tried = fields or tuple(dict.fromkeys(name for one in misfits for name in one.fields))
    known = reference_cuts(file)
    found = _touching(_sound(file, slips(file, tried), known))
    if not found:
        worst = max(
            (one for one in misfits if math.isfinite(one.value)),
            key=lambda one: one.share,
            default=None,
        )
        solved = (_solved(file, field, worst, known) for field in tried)
        found = _touching(_sound(file, (one for one in solved if one), known))
    return found


def _sound(file: HypoidGearFile, changes: Iterable[Change], known: Cuts) -> list[_Cure]:
    """Return the changes after which every check is sound, best fit first, one for each setting."""
    best: dict[tuple[str, ...], _Cure] = {}
    for change in changes:
        try:
            changed = file.varied(dict(change.values))
            score = _score(changed, _kept(known, change.fields))
        except ParameterError:
            continue
        if score is not None and (change.fields not in best or score < best[change.fields].score):
            best[change.fields] = _Cure(score, change, changed)
    return sorted(best.values(), key=lambda one: one.score)


def _touching(cures: list[_Cure]) -> list[Change]:
    touching = (cure.change for cure in cures[:_TRIED] if unloaded_refusal(cure.file) is None)
    return list(islice(touching, _OFFERED))


def _kept(known: Cuts, fields: tuple[str, ...]) -> Cuts:
    """Return the cuts that a change of these settings leaves as they are."""
    if not all(field.count(".") == 2 for field in fields):
        return {}
    changed = {field.split(".", 1)[0] for field in fields}
    return {role: cut for role, cut in known.items() if role not in changed}


def _score(file: HypoidGearFile, known: Cuts) -> float | None:
    """Return the sum of squares of all misfits over their limits; None unless all are sound."""
    total = 0.0
    for group in misfits_by_cost(file, known):
        if not all(one.is_sound for one in group):
            return None
        total += sum(one.share**2 for one in group)
    return total


def _solved(file: HypoidGearFile, field: str, worst: Misfit | None, known: Cuts) -> Change | None:
    """Return the value of `field` that makes a file sound, by the secant method, or None.

    The first misfit that is not sound is brought to zero, the worst of the file first.
    """
    now = setting(file, field)
    if now is None or not field.endswith(_SEARCHED):
        return None
    kept = _kept(known, (field,))
    value = _start(file, field, now, kept) if worst is None else now
    target = None if worst is None else worst.what
    before: tuple[str, float, float] | None = None  # target, value and misfit of the last step
    try:
        for _ in range(_ITERATIONS):
            reached = _reached(file.varied({field: value}), kept)
            unsound = [one for one in reached.values() if not one.is_sound]
            if target is None or target not in reached or reached[target].share <= _CLOSED:
                if not unsound:
                    return Change({field: value}, {field: now})
                target = max(unsound, key=lambda one: one.share).what
            misfit = reached[target].value
            if before is None or before[0] != target or before[1] == value:
                beside = value + _STEP
                before = target, beside, _value(file.varied({field: beside}), target, kept)
            slope = (before[2] - misfit) / (before[1] - value)
            if not abs(slope) > 0.0:
                return None
            before = target, value, misfit
            value -= max(-_LONGEST, min(_LONGEST, misfit / slope))
    except ParameterError:
        return None
    return None


def _value(file: HypoidGearFile, what: str, known: Cuts) -> float:
    """Return the value of one misfit; NaN where the checks do not reach it."""
    for group in misfits_by_cost(file, known):
        for one in group:
            if one.what == what:
                return one.value
    return math.nan


def _start(file: HypoidGearFile, field: str, now: float, known: Cuts) -> float:
    """Return the value of `field` nearest to that of the file at which the cutter cuts a tooth."""
    for k in range(_STARTS):
        for sign in (1.0, -1.0):
            value = now + sign * k * _LONGEST
            try:
                reached = _reached(file.varied({field: value}), known)
            except ParameterError:
                continue
            if all(math.isfinite(one.value) for one in reached.values()):
                return value
    return now


def _reached(file: HypoidGearFile, known: Cuts) -> dict[str, Misfit]:
    """Return the misfits, by what they are, up to the first group that is not sound."""
    found = {}
    for group in misfits_by_cost(file, known):
        found.update({one.what: one for one in group})
        if not all(one.is_sound for one in group):
            break
    return found
