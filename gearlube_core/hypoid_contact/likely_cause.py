"""Which single setting of a gear file is most likely wrong: the changes after which it is sound."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair_check import (
    Cuts,
    misfits_by_cost,
    reference_cuts,
    unloaded_refusal,
)
from gearlube_core.hypoid_contact.setting_slips import Change, setting, slips
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.misfit import Misfit

_OFFERED = 3
_TRIED = 6  # changes whose unloaded contact is tried
_ITERATIONS = 12
_CLOSED = 0.02  # of a limit: a solved misfit
_STEP = 1e-3  # mm or deg, of a derivative
_LONGEST = {"_mm": 10.0, "_deg": 10.0}  # step of the search for a value


class _Cure(NamedTuple):
    score: float
    change: Change
    file: HypoidGearFile


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
        if worst is not None:
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
    found = [cure.change for cure in cures[:_TRIED] if unloaded_refusal(cure.file) is None]
    return found[:_OFFERED]


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


def _solved(file: HypoidGearFile, field: str, worst: Misfit, known: Cuts) -> Change | None:
    """Return the value of `field` at which the misfit vanishes, by Newton's method, or None."""
    now = setting(file, field)
    if now is None or not field.endswith(tuple(_LONGEST)):
        return None
    longest = next(step for end, step in _LONGEST.items() if field.endswith(end))
    kept = _kept(known, (field,))

    def at(value: float) -> float:
        changed = file.varied({field: value})
        for group in misfits_by_cost(changed, kept):
            for one in group:
                if one.what == worst.what:
                    return one.value
        return math.nan

    value = now
    try:
        for _ in range(_ITERATIONS):
            misfit = at(value)
            if abs(misfit) <= _CLOSED * worst.limit:
                return Change({field: value}, {field: now})
            slope = (at(value + _STEP) - misfit) / _STEP
            if not abs(slope) > 0.0:
                return None
            value -= max(-longest, min(longest, misfit / slope))
    except ParameterError:
        return None
    return None
