"""Tables as comma-separated text."""

from __future__ import annotations

import csv
import io
import itertools
from collections.abc import Iterable, Sequence


def number_text(value: float, digits: int = 7) -> str:
    """Return a number with so many digits; nothing for one that is not there (nan)."""
    return "" if value != value else f"{value:.{digits}g}"


def csv_text(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    r"""Return a header and rows as lines of comma-separated text.

    A text that a spreadsheet would take for a formula gets an apostrophe before it.

    Examples
    --------
    >>> csv_text(["name", "value"], [["=1+2", "-1.5"]])
    "name,value\n'=1+2,-1.5\n"
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([_plain(cell) for cell in row] for row in itertools.chain([head], rows))
    return text.getvalue()


def _plain(cell: object) -> object:
    if not isinstance(cell, str) or not cell.startswith(("=", "+", "-", "@", "\t", "\r")):
        return cell
    try:
        float(cell)
    except ValueError:
        return f"'{cell}"
    return cell
