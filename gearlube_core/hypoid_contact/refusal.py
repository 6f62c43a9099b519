"""The answer to a gear file: nothing, warnings, or a refusal that names what is likely wrong."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from operator import attrgetter
from typing import Any, NamedTuple

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
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile, Misfit

_INCH = 25.4  # mm
_RADIAN = math.degrees(1.0)  # deg
_MISCOUNT = 10  # teeth or blade groups, to both sides
_SWAPS = (
    ("concave_flank_blade_angle_deg", "convex_flank_blade_angle_deg"),
    ("horizontal_setting_mm", "vertical_setting_mm"),
    ("sliding_base_mm", "machine_center_to_back_mm"),
)
_GROUPS = ("pinion.cutter.blade_groups", "gear.cutter.blade_groups")
_MOST_GROUPS = 30
_MEMBER_SWAPS = ("teeth", "cutter.blade_groups", "spiral_angle_deg", "pitch_angle_deg")
_OFFERED = 3
_TRIED = 6  # changes whose unloaded contact is tried
_ITERATIONS = 8
_CLOSED = 0.02  # of a limit: a solved misfit
_STEP = 1e-3  # mm or deg, of a derivative
_LONGEST = 10.0  # mm or deg, step of the search for a value
_STARTS = 16  # steps to both sides in which a cutter is looked for that reaches the tooth
_SEARCHED = ("_mm", "_deg", "ratio_of_roll")


@dataclass(frozen=True, slots=True)
class Change:
    """A change of one setting, or of two that were exchanged.

    Parameters
    ----------
    values : dict of str to float
        New value of each dotted field, as `HypoidGearFile.varied` takes it.
    now : dict of str to float
        The values of the file.
    slip : str
        What went wrong, in words; empty for any other value.
    """

    values: dict[str, float]
    now: dict[str, float]
    slip: str = ""

    @property
    def fields(self) -> tuple[str, ...]:
        """Dotted names of the settings."""
        return tuple(self.values)

    def __str__(self) -> str:
        parts = [
            f"{field} from {_text(self.now[field])} to {_text(value)}{_unit(field)}"
            for field, value in self.values.items()
        ]
        return " and ".join(parts) + (f" ({self.slip})" if self.slip else "")


def setting(file: HypoidGearFile, field: str) -> float | None:
    """Return the value of a dotted field; None where it is absent."""
    value: Any = file
    for part in field.split("."):
        value = getattr(value, part, None)  # a section may be left out
    return None if value is None else float(value)


def slips(file: HypoidGearFile, fields: tuple[str, ...]) -> Iterator[Change]:
    """Return the changes that would take one slip back, for each of the fields."""
    for field in fields:
        now = setting(file, field)
        if now is None:
            continue
        whole = field.rsplit(".", 1)[1] in ("teeth", "blade_groups")
        for value, slip in _whole(file, field, int(now)) if whole else _real(file, field, now):
            if value != now:
                yield Change({field: value}, {field: now}, slip)
    yield from _exchanges(file, fields)


def _whole(file: HypoidGearFile, field: str, now: int) -> Iterator[tuple[int, str]]:
    for step in range(1, _MISCOUNT + 1):
        yield now + step, "a miscount"
        if now > step:
            yield now - step, "a miscount"
    yield now * 10, "a digit is missing"
    if now >= 10:
        yield now // 10, "a digit too many"
    if field.endswith("blade_groups"):
        role = "gear" if field.startswith("pinion") else "pinion"
        yield attrgetter(f"{role}.cutter.blade_groups")(file), "the groups of the mate"


def _real(file: HypoidGearFile, field: str, now: float) -> Iterator[tuple[float, str]]:
    yield -now, "the sign"
    yield now * 10.0, "the decimal point"
    yield now / 10.0, "the decimal point"
    if field.endswith("_mm"):
        yield now * _INCH, "inches for millimetres"
        yield now / _INCH, "millimetres converted twice"
    elif field.endswith("_deg"):
        yield now * _RADIAN, "radians for degrees"
        yield now / _RADIAN, "degrees converted twice"
        yield math.copysign(90.0, now) - now, "the angle to the other axis"
    elif field.endswith("ratio_of_roll"):
        yield 1.0 / now if now else now, "the inverse ratio"
        yield file.gear.teeth / file.pinion.teeth, "the teeth ratio"


def _exchanges(file: HypoidGearFile, fields: tuple[str, ...]) -> Iterator[Change]:
    pairs = [(f"pinion.{name}", f"gear.{name}") for name in _MEMBER_SWAPS]
    for section in ("pinion.cutter", "gear.cutter", "pinion.machine", "gear.machine"):
        pairs += [(f"{section}.{a}", f"{section}.{b}") for a, b in _SWAPS]
    for first, second in pairs:
        if first in fields and second in fields:
            a, b = (float(attrgetter(field)(file)) for field in (first, second))  # never absent
            if a != b:
                yield Change({first: b, second: a}, {first: a, second: b}, "exchanged")
    groups: dict[str, float] = {field: attrgetter(field)(file) for field in _GROUPS}
    if any(field in fields for field in _GROUPS) and all(groups.values()):
        for count in (k for k in range(_MOST_GROUPS) if k not in groups.values()):
            yield Change(dict.fromkeys(_GROUPS, count), dict(groups), "both heads")


def _text(value: float) -> str:
    return f"{value:d}" if isinstance(value, int) else f"{value:.4f}".rstrip("0").rstrip(".")


def _unit(field: str) -> str:
    if field.endswith("_mm"):
        return " mm"
    return " deg" if field.endswith("_deg") else ""


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
    """Return warnings about a gear file whose flanks meet, one sentence each.

    Misfits that only shift the contact, edge contact without load, and a large transmission error.

    Examples
    --------
    >>> pair_warnings(HypoidGearFile.named("mohammadpour_2015"))  # doctest: +SKIP
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
