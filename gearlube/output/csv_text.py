"""Tables as comma-separated text."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence


def number_text(value: float, digits: int = 7) -> str:
    """Return a number with so many digits; nothing for one that is not there (nan)."""
    return "" if value != value else f"{value:.{digits}g}"


def csv_text(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a header and rows as lines of comma-separated text."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return text.getvalue()
