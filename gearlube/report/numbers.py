"""Numbers as text, with sensible digits."""

from __future__ import annotations

import math
from collections.abc import Sequence

_LEAST, _MOST = 1e-5, 1e7  # outside, powers of ten are written
_DECIMALS = 6
MISSING = "–"
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_UNITS = {"um": "µm", "urad": "µrad", "deg": "°", "degC": "°C"}


def unit_words(unit: str) -> str:
    """Return the unit of an input file's field as reports write it.

    Examples
    --------
    >>> unit_words("um"), unit_words("N.m.s/rad"), unit_words("kg/m3"), unit_words("mm")
    ('µm', 'N·m·s/rad', 'kg/m³', 'mm')
    """
    text = unit.replace(".", "·").replace("m2", "m²").replace("m3", "m³").replace("K2", "K²")
    return _UNITS.get(text, text)


def number_text(value: float, digits: int = 3) -> str:
    """Return a number with `digits` significant digits; digits before the point are all kept.

    Examples
    --------
    >>> number_text(0.012345), number_text(12345.6), number_text(2.5e-9, 2), number_text(math.nan)
    ('0.0123', '12346', '2.5·10⁻⁹', '–')
    """
    value = float(value)
    if not math.isfinite(value):
        return MISSING if math.isnan(value) else ("∞" if value > 0.0 else "−∞")
    if value == 0.0:
        return "0"
    if not _LEAST <= abs(value) < _MOST:
        mantissa, _, power = f"{value:.{max(digits - 1, 0)}e}".partition("e")
        return _signed(f"{mantissa}·10{str(int(power)).translate(_RAISED)}")
    return _signed(f"{value:.{_decimals(value, digits)}f}")


def quantity_text(value: float, unit: str, digits: int = 3) -> str:
    """Return a number with its unit.

    Examples
    --------
    >>> quantity_text(0.4217, "µm"), quantity_text(3.0, ""), quantity_text(97.123, "%")
    ('0.422 µm', '3.00', '97.1 %')
    """
    return f"{number_text(value, digits)} {unit}".strip()


def column_texts(values: Sequence[str | float | int | None], digits: int = 3) -> list[str]:
    """Return the cells of a column; its numbers have the same decimals.

    Examples
    --------
    >>> column_texts([1.0, 12.345, None, "none"])
    ['1.00', '12.35', '–', 'none']
    >>> column_texts([20, 40])
    ['20', '40']
    """
    sizes = sorted(
        abs(float(one))
        for one in values
        if isinstance(one, int | float) and math.isfinite(one) and one != 0.0
    )
    whole = all(isinstance(one, str | int) or one is None for one in values)
    middle = sizes[(len(sizes) - 1) // 2] if sizes else 1.0
    decimals = 0 if whole else _decimals(middle, digits)
    wide = bool(sizes) and (sizes[0] < _LEAST or sizes[-1] >= _MOST)
    return [_cell(one, digits, decimals, wide=wide) for one in values]


def _cell(value: str | float | int | None, digits: int, decimals: int, *, wide: bool) -> str:
    if value is None:
        return MISSING
    if isinstance(value, str):
        return value
    if wide or not math.isfinite(value):
        return number_text(value, digits)
    return _signed(f"{value:.{decimals}f}")


def _decimals(value: float, digits: int) -> int:
    return min(_DECIMALS + 2, max(0, digits - 1 - math.floor(math.log10(abs(value)) + 1e-12)))


def _signed(text: str) -> str:
    """Return the text with a true minus, and none before zero."""
    if text.startswith("-"):
        return text[1:] if not text.strip("-0.") else f"−{text[1:]}"
    return text
