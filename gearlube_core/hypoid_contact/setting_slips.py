"""Slips of the pen in a gear file: a sign, a unit, a decimal point, one tooth, an exchange."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from operator import attrgetter
from typing import Any

from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

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
