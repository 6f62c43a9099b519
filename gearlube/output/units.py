"""One spelling for each unit: `N m` and `rad/s`, whatever the dataset has."""

from __future__ import annotations

import re
from typing import Any

_PART = re.compile(r"([^\d\s^*+()-]+)\s*(?:\^|\*\*)?([+-]?\d+)?$")
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def unit_text(unit: str) -> str:
    """Return a unit in one spelling: factors with spaces, one stroke, powers as `m2`.

    A text that is no product of powers stays as it is.

    Examples
    --------
    >>> [unit_text(unit) for unit in ("N.m", "rad s-1", "kg/(m s)", "m/s^2", "1", "s-1")]
    ['N m', 'rad/s', 'kg/(m s)', 'm/s2', '1', '1/s']
    """
    plain = unit.strip().translate(_SUPERSCRIPTS).replace("·", ".")
    grouped = re.fullmatch(r"([^()]*)/\(([^()/]*)\)", plain)
    above, *below = [grouped[1], grouped[2]] if grouped else plain.split("/")
    powers: dict[str, int] = {}
    for sign, text in ((1, above), *((-1, part) for part in below)):
        for part in re.split(r"[\s.]+|(?<!\*)\*(?!\*)", text):
            if part in ("", "1"):
                continue
            found = _PART.match(part)
            if found is None:
                return unit.strip()
            powers[found[1]] = powers.get(found[1], 0) + sign * int(found[2] or 1)
    over = [_power(name, power) for name, power in powers.items() if power > 0]
    under = [_power(name, -power) for name, power in powers.items() if power < 0]
    if not plain or not under:
        return " ".join(over) or ("1" if plain else "")
    bottom = under[0] if len(under) == 1 else f"({' '.join(under)})"
    return f"{' '.join(over) or '1'}/{bottom}"


def _power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}{power}"


def is_text(variable: Any) -> bool:
    """Whether the values of an array are text."""
    return variable.dtype.kind in "OUS"


def unit_of(variable: Any) -> str | None:
    """Return the unit of a variable in one spelling, "" of a text; None where none is stated."""
    if is_text(variable):
        return ""
    stated = variable.attrs.get("units")
    return unit_text(str(stated)) if stated is not None else None


def heading(name: str, variable: Any) -> str:
    """Return a name with its unit, as in `speed [rad/s]`."""
    unit = unit_of(variable)
    return f"{name} [{unit}]" if unit else name
