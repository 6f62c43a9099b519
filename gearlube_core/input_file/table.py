"""The reader of tables in text files: columns with names, for every command."""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError

TABLES = (".csv", ".txt", ".tsv")  # endings of names of tables
COMMENTS = ("#", "%", "//")  # a line that begins with one of them is no row
LARGEST = 50_000_000  # bytes
_MOST_CELLS = 2_500_000  # a profile of a million heights has two million
_SEPARATORS = ("\t", ";", ",")  # the first that parts the names
_SHOWN = 60  # characters of a wrong row
_NUMBER = re.compile(r"[+-]?([0-9]+[.,]?[0-9]*|[.,][0-9]+)([eE][+-]?[0-9]+)?")
_GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}([.,' ’\u00a0\u2009\u202f][0-9]{3})+([.,][0-9]*)?")
_CONTROL = re.compile("[\x00-\x08\x0e-\x1f]")


class Row(NamedTuple):
    """One row of a table."""

    table: Table
    place: int

    @property
    def where(self) -> str:
        """File and line, for errors."""
        return f"{self.table.path}, line {self.table.lines[self.place]}"

    def text(self, name: str) -> str:
        """Return the cell of a column as it is written."""
        return self.table.cells[self.place][self.table.places[name.casefold()]]

    def whole(self, name: str, low: int, high: int) -> int:
        """Return a whole number of a column, `low` to `high`."""
        given = self.text(name)
        if not re.fullmatch(r"[+-]?[0-9]{1,18}", given) or not low <= int(given) <= high:
            raise ParameterError(
                f"{self.where}: {name} must be a whole number from {low} to {high}, got {given!r}. "
                "Count from 1."
            )
        return int(given)

    def number(
        self,
        name: str,
        low: float = -math.inf,
        high: float = math.inf,
        unit: str = "",
        cure: str = "",
    ) -> float:
        """Return a finite number of a column, `low` to `high` in the column's unit."""
        given = self.text(name).replace("−", "-")
        value = float(given.replace(",", ".")) if _NUMBER.fullmatch(given) else math.nan
        if math.isfinite(value) and low <= value <= high:
            return value
        limits = f" within {low:g} to {high:g} {unit}".rstrip() if math.isfinite(high - low) else ""
        if math.isnan(value):
            if not given or given.strip("+-").lower() in ("nan", "inf", "infinity", "na", "n/a"):
                cure = "Fill the gap from its neighbours, or remove the row."
            elif _GROUPED.fullmatch(given):
                cure = "Leave out the marks between thousands: write 1234.5 or 1234,5."
            cure = cure or "Write digits with one decimal mark, such as 3.5."
        raise ParameterError(
            f"{self.where}: {name} must be a finite number{limits}, got {given[:_SHOWN]!r}. {cure}"
        )


@dataclass(frozen=True)
class Table:
    """A table of a text file.

    Parameters
    ----------
    path : str
    names : list of str
        Of the columns, as they are written; the case of letters does not count in look-ups.
    lines : list of int
        Number of the line of each row.
    cells : list of list of str
        Of each row, as many as names.
    """

    path: str
    names: list[str]
    lines: list[int]
    cells: list[list[str]]

    def __iter__(self) -> Iterator[Row]:
        return (Row(self, place) for place in range(len(self.cells)))

    @cached_property
    def places(self) -> dict[str, int]:
        """Number of each column by its name in small letters, from 0."""
        return {name.casefold(): place for place, name in enumerate(self.names)}

    def column(
        self,
        name: str,
        low: float = -math.inf,
        high: float = math.inf,
        unit: str = "",
        cure: str = "",
    ) -> Array:
        """Return the finite numbers of a column (n,), each within limits in the column's unit."""
        return np.array([row.number(name, low, high, unit, cure) for row in self])


def read_table(
    path: str | Path,
    columns: tuple[str, ...] = (),
    *,
    fewest: int = 1,
    cure: str = "",
    comments: tuple[str, ...] = COMMENTS,
) -> Table:
    r"""Return the table of a text file; its first line holds the names of the columns.

    Parameters
    ----------
    path : path
        Text in UTF-8, UTF-16 with its mark, or cp1252, at most 50 MB. Tab, semicolon or comma part
        the columns: the first of these among the names. The decimal mark is a point, or a comma
        where tab or semicolon part the columns or the number is in quotes; one mark in a file.
        Quoted cells, separators after the last cell and empty lines are allowed. A first line
        such as sep=; names the separator.
    columns : tuple of str
        Names that must be there; the table has others too.
    fewest : int
        Least number of rows.
    cure : str
        What to give, for errors.
    comments : tuple of str
        Beginnings of lines that are left out.

    Raises
    ------
    ParameterError
        The file is missing, too large or no text; a column is missing or there twice; a row is
        cut or has too many cells; the decimal mark is not clear. The message says the line.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "trace.csv"
    ...     _ = file.write_text("time_s;speed_kmh\n0;0\n1;3,5\n")
    ...     read_table(file).column("speed_kmh").tolist()
    [0.0, 3.5]
    """
    found, mark = _rows(path, _text(path, cure), comments, cure)
    names = [" ".join(name.split()) for name in found[0][1]]
    while names and not names[-1]:
        names.pop()
    folded = [name.casefold() for name in names if name]
    twice = sorted({name for name in names if folded.count(name.casefold()) > 1})
    if twice:
        raise ParameterError(
            f"{path} must have each column once, got {', '.join(twice)} in several. Keep one."
        )
    missing = [name for name in columns if name.casefold() not in folded]
    if missing:
        raise ParameterError(
            f"{path} must have the columns {', '.join(columns)}; missing: {', '.join(missing)}; "
            f"got {', '.join(names)[: 4 * _SHOWN]}. {cure}".strip()
        )
    rows = found[1:]
    if len(rows) < fewest:
        raise ParameterError(
            f"{path} must have at least {fewest} row{'s' * (fewest > 1)} of values below the names "
            f"of its columns, got {len(rows)}. {cure}".strip()
        )
    width = len(names)
    for line, cells in rows:
        count = max(len(cells[:width]), *(k for k, cell in enumerate(cells, 1) if cell))
        if count != width:
            raise ParameterError(
                f"{path}, line {line}: has {count} of {width} columns, got "
                f"{mark.join(cells)[:_SHOWN]!r}. "
                + (
                    "Complete the row, or remove it; it may be cut."
                    if count < width
                    else "With commas between columns a number has a decimal point, or quotes."
                )
            )
    _check_decimal_mark(path, rows, mark)
    return Table(str(path), names, [line for line, _ in rows], [cells[:width] for _, cells in rows])


def _text(path: str | Path, cure: str) -> str:
    content = read_content(path, "table", cure=cure, largest=LARGEST)
    wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ("utf-16",) if wide else ("utf-8-sig", "cp1252"):
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if not _CONTROL.search(text):
            return text
    raise ParameterError(
        f"{path} must be text in UTF-8, UTF-16 or cp1252, got bytes that are no text. Save it as "
        "CSV in UTF-8, not as a workbook."
    )


def _rows(
    path: str | Path, text: str, comments: tuple[str, ...], cure: str
) -> tuple[list[tuple[int, list[str]]], str]:
    """Return rows that are not empty, each with its line and cells, and the separator."""

    def lines() -> Iterator[str]:  # one at a time: a list of them takes more than the text
        for line in io.StringIO(text, newline=None):
            yield "\n" if line.lstrip(' \t"').startswith(comments) else line

    first, head = next(((k, one) for k, one in enumerate(lines()) if one.strip()), (None, ""))
    if first is None:
        raise ParameterError(f"{path} must have a line of names and rows, got none. {cure}".strip())
    named = re.fullmatch(r"sep=([,;\t])", head.strip(" \n"))
    if named:
        mark = named[1]
    else:
        bare = re.sub(r"\s*([,;])\s*", r"\1", re.sub('"[^"]*"?', "", head).strip())
        mark = next((one for one in _SEPARATORS if one in bare), ",")
    reader = csv.reader(
        ("\n" if named and k == first else line for k, line in enumerate(lines())),
        delimiter=mark,
        skipinitialspace=True,
        strict=True,
    )
    rows, read, count = [], 0, 0
    try:
        for cells in reader:
            stripped = [cell.strip() for cell in cells]
            if any(stripped):
                rows.append((read + 1, stripped))
            read = reader.line_num
            count += len(cells)
            if count > _MOST_CELLS:
                raise ParameterError(
                    f"{path} must have at most {_MOST_CELLS} cells, got more up to line {read}. "
                    "Leave out rows or columns."
                )
    except csv.Error as reason:
        if reader.line_num > read + 1 or "unexpected end" in str(reason):
            raise ParameterError(
                f"{path}: a quote opened in line {read + 1} is never closed. Close it, or "
                "remove it."
            ) from None
        raise ParameterError(
            f"{path}, line {read + 1}: must be cells of at most {csv.field_size_limit()} "
            f"characters, each quote closed, got: {reason}. Check the quotes of this line."
        ) from None
    return rows, mark


def _check_decimal_mark(path: str | Path, rows: list[tuple[int, list[str]]], mark: str) -> None:
    """Refuse points and commas in numbers of one file, and commas that may part thousands."""
    commas = [(n, c) for n, cells in rows for c in cells if "," in c and _NUMBER.fullmatch(c)]
    if not commas:
        return
    point = next(
        ((n, c) for n, cells in rows for c in cells if "." in c and _NUMBER.fullmatch(c)), None
    )
    if point is not None:
        raise ParameterError(
            f"{path}: numbers must have one decimal mark, got {commas[0][1]!r} in line "
            f"{commas[0][0]} and {point[1]!r} in line {point[0]}. Take one, and no mark between "
            "thousands."
        )
    if mark == "," and all(_GROUPED.fullmatch(cell) for _, cell in commas):
        raise ParameterError(
            f"{path}, line {commas[0][0]}: {commas[0][1]!r} may be a decimal number or thousands. "
            "Write a decimal point, and no mark between thousands."
        )
