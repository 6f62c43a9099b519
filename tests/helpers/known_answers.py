"""Results against known answers: all key numbers, findings, tables and variables at once.

Each function compares the whole: a key number, finding, row or variable that has no expected value
fails, as does one that is missing.
"""

from __future__ import annotations

import math
import re
import zlib
from collections.abc import Iterable, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray as xr

from gearlube.report.numbers import number_text
from gearlube.report.parts import Finding, Number, Table

ROUNDING = 1e-9  # relative, of sums and products of some ten numbers
SINGLE = 3e-7  # relative, of numbers kept in single precision
_UNITS = (
    "N/µm", "µm rms", "N rms", "km/h", "dB(A)", "N·m", "µrad", "µm", "GPa", "rpm", "kHz", "Hz",
    "kJ", "Wh", "°C", "°", "mm", "km", "sone", "dB", "ppm", "%", "W", "N", "K", "s",
)  # fmt: skip
_QUANTITY = re.compile(
    r"(?<![\w.])[+−-]?\d+(?:\.\d+)?(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?(?: ?(?:"
    + "|".join(map(re.escape, _UNITS))
    + r")(?!\w))?"
)


def quantities(text: str) -> list[str]:
    """Return all numbers of a text with their units, in order.

    >>> quantities("order 1: 2.00 µm at 60 km/h, −5.0 % below")
    ['1', '2.00 µm', '60 km/h', '−5.0 %']
    """
    return _QUANTITY.findall(text)


def assert_numbers(found: Iterable[Number], expected: Sequence[tuple[Any, ...]]) -> None:
    """Assert the table of key numbers: rows of name, value, unit and the text on the page."""
    found = list(found)
    assert [one.name for one in found] == [row[0] for row in expected]
    for one, (name, value, unit, text) in zip(found, expected, strict=True):
        assert one.value == pytest.approx(value, rel=ROUNDING, nan_ok=True), name
        assert (one.unit, number_text(one.value, one.digits)) == (unit, text), name


def assert_findings(found: Iterable[Finding], expected: Sequence[tuple[str, str, str]]) -> None:
    """Assert all findings: rows of level, words and numbers.

    The words, parted by " … ", stand in headline and detail in this order. The numbers, with units
    and parted by ", ", are all that headline and detail have.
    """
    found = list(found)
    said = [f"{one.headline} {one.detail}".strip() for one in found]
    assert len(said) == len(expected), said
    for one, text, (level, words, numbers) in zip(found, said, expected, strict=True):
        assert re.search(".*".join(map(re.escape, words.split(" … "))), text), (words, text)
        assert one.level == level, text
        assert quantities(text) == (numbers.split(", ") if numbers else []), text


def assert_tables(found: Iterable[Table], expected: Mapping[str, Sequence[Sequence[Any]]]) -> None:
    """Assert all tables: by title the heads, "name [unit]", and the rows."""
    tables = {one.title: one for one in found}
    assert list(tables) == list(expected)
    for title, (heads, *rows) in expected.items():
        columns = tables[title].columns
        named = [f"{one.name} [{one.unit}]" if one.unit else one.name for one in columns]
        assert named == list(heads), title
        assert len(tables[title].rows) == len(rows), title
        for got, row in zip(tables[title].rows, rows, strict=True):
            assert_cells(got, row, title)


def assert_cells(found: Sequence[Any], expected: Sequence[Any], where: str) -> None:
    """Assert the cells of a row: texts as they are, numbers to rounding."""
    assert len(found) == len(expected), where
    for got, cell in zip(found, expected, strict=True):
        if isinstance(cell, str) or cell is None:
            assert got == cell, (where, list(found))
        else:
            assert got == pytest.approx(cell, rel=ROUNDING, nan_ok=True), (where, list(found))


def named(**values: Any) -> SimpleNamespace:
    """Return values by name, for a function that reads some attributes of an object."""
    return SimpleNamespace(**values)


def made_up(name: str, *shape: int) -> Any:
    """Return numbers within 1 to 2 that only this name has, in one order or shape."""
    drawn = 1.0 + np.random.default_rng(zlib.crc32(name.encode())).random(math.prod(shape))
    return drawn.reshape(shape) if shape else float(drawn[0])


def assert_variables(
    dataset: xr.Dataset,
    expected: Mapping[str, tuple[str, Any]],
    tolerance: float = ROUNDING,
    zero: Sequence[str] = (),
) -> None:
    """Assert every variable and coordinate of a dataset: unit and values of each, by name.

    Numbers that are all zero or missing would be the same times any factor: only those of `zero`
    may be so.
    """
    assert sorted(map(str, dataset.variables)) == sorted(expected)
    for name, (unit, values) in expected.items():
        one = dataset[name]
        assert one.attrs.get("units", "") == unit, name
        wanted = np.asarray(values)
        assert one.shape == wanted.shape, name
        if one.dtype.kind in "fiub":
            scale = float(np.nanmax(np.abs(wanted)))
            assert scale > 0.0 or name in zero, name
            np.testing.assert_allclose(
                one.values, wanted, rtol=tolerance, atol=tolerance * scale, err_msg=name
            )
        else:
            assert one.values.tolist() == wanted.tolist(), name


def assert_attributes(dataset: xr.Dataset, expected: Mapping[str, Any]) -> None:
    """Assert some attributes of a dataset."""
    found = [dataset.attrs[name] for name in expected]
    assert_cells(found, list(expected.values()), ", ".join(expected))


def units_of(dataset: xr.Dataset) -> dict[str, str]:
    """Return the unit of every variable and coordinate by name, "" where it has none."""
    return {str(name): one.attrs.get("units", "") for name, one in dataset.variables.items()}
