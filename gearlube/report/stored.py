"""A report as JSON, as it lies inside report.html: `gearlube compare` reads it back."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

from gearlube.report.parts import Figure, Report
from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError, unread

FORMAT = 1
_LARGEST = 300_000_000  # bytes; pages with charts have some MB
PAGE = "report.html"
_DATA = re.compile(r'<script type="application/json" id="report-data">(.*?)</script>', re.DOTALL)


def as_data(report: Report, made: str) -> dict[str, Any]:
    """Return what a page keeps of its report: key numbers, inputs, findings and charts."""
    return {
        "format": FORMAT,
        "study": report.study,
        "title": report.title,
        "subtitle": report.subtitle,
        "made": made,
        "findings": [[one.level, one.headline, one.detail] for one in report.findings],
        "numbers": [
            [one.name, one.value if math.isfinite(one.value) else None, one.unit, one.digits]
            for one in report.numbers
        ],
        "inputs": [[i.name, i.value, i.unit, i.origin, i.why] for i in report.inputs],
        "charts": {one.name: _chart(one) for one in report.figures if one.chart is not None},
    }


def as_json(data: dict[str, Any]) -> str:
    """Return data as JSON that may stand inside a script element."""
    from plotly.io.json import to_json_plotly

    return str(to_json_plotly(data)).replace("<", "\\u003c")


def _chart(figure: Figure) -> dict[str, Any]:
    whole = figure.chart.to_dict()
    layout = dict(whole["layout"])
    layout.pop("template", None)  # the page has its own, for light, dark and print
    return {
        "title": figure.title,
        "caption": figure.caption,
        "data": list(whole["data"]),
        "layout": layout,
        "frames": list(whole.get("frames", [])),
    }


def read_report(folder: Path | str) -> dict[str, Any]:
    """Return the data of the report in a folder of results, see `as_data`.

    Raises
    ------
    ParameterError
        There is no report, or none that says its numbers.
    """
    path = Path(folder)
    page = path / PAGE if path.is_dir() else path
    cure = "Give a folder of results; run the command of its study again to write the report."
    if not path.exists():
        raise ParameterError(f"{unread('folder', path, FileNotFoundError())}. {cure}")
    if not page.is_file():
        raise ParameterError(f"{path} must hold a {PAGE}, got none. {cure}")
    content = read_content(page, "report", cure=cure, largest=_LARGEST)
    found = _DATA.search(content.decode("utf-8", errors="replace"))
    if found is None:
        raise ParameterError(f"{page} must hold the numbers of a report, got none. {cure}")
    try:
        data: dict[str, Any] = json.loads(found.group(1))
    except (ValueError, RecursionError) as reason:
        raise ParameterError(f"{page} is damaged: {reason}. {cure}") from None
    if not isinstance(data, dict):
        raise ParameterError(f"{page} is damaged: its numbers have no names. {cure}")
    if data.get("format") != FORMAT:
        raise ParameterError(f"{page} must be of format {FORMAT}, got {data.get('format')}. {cure}")
    return data
