"""Write a report as one HTML file that opens without a network."""

from __future__ import annotations

import base64
import gzip
import platform
import shlex
import sys
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from math import isnan
from pathlib import Path
from typing import Any

from gearlube.report.numbers import column_texts, number_text, unit_words
from gearlube.report.parts import GIVEN, Input, Report, Table, main_and_rest, ranked
from gearlube.report.stored import PAGE, as_data, as_json
from gearlube_core import __version__

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib", "plotly")
_SIZE = "@@@@ kB"  # replaced by the size of the page
_HERE = "gearlube.report"


def write_report(report: Report, folder: Path | str) -> Path:
    """Write FOLDER/report.html, with the command that runs, and return its path.

    Parameters
    ----------
    report : Report
    folder : path
        Made if need be.

    Examples
    --------
    >>> from gearlube.report.parts import Finding, Report
    >>> found = Report(study="map", title="Loss map", findings=[Finding("good", "It runs.")])
    >>> write_report(found, "gearlube_map")  # doctest: +SKIP
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / PAGE
    if (typed := command_line()) and "command" not in dict(report.facts):
        report = replace(report, facts=[("command", typed), *report.facts])
    from gearlube_core.storage.atomic_file import write_text  # imports numpy

    write_text(report_html(report), path)
    return path


def command_line() -> str:
    """Return the command as it was typed, empty outside a command."""
    from gearlube.report.inputs import get_current_context  # help does without input files

    return shlex.join(["gearlube", *sys.argv[1:]]) if get_current_context(silent=True) else ""


def report_html(report: Report, made: str = "") -> str:
    """Return a report as HTML: style, script, charts and pictures are all inside.

    Parameters
    ----------
    report : Report
    made : str
        Date and time; by default now.
    """
    from jinja2 import Environment, PackageLoader

    environment = Environment(
        loader=PackageLoader(_HERE, "."), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    made = made or _today()
    drawn = any(figure.chart is not None for figure in report.figures)
    main, rest = main_and_rest(report)
    figures = [_figure(number, one) for number, one in enumerate([*main, *rest], 1)]
    html = environment.get_template("page.html.j2").render(
        report=report,
        findings=ranked(report.findings),
        made=made,
        size=_SIZE,
        style=_text("page.css"),
        script=_text("page.js") if drawn else "",
        data=as_json(as_data(report, made)) if drawn or report.numbers else "",
        plotly=_plotly() if drawn else "",
        plotly_size=f"{len(_plotly()) / 1e6:.1f} MB" if drawn else "",
        recordings=[
            {"title": r.title, "caption": r.caption, "wav": base64.b64encode(r.wav).decode("ascii")}
            for r in report.recordings
        ],
        figures=figures[: len(main)],
        folded=figures[len(main) :],
        numbers=[
            (
                one.name,
                number_text(one.value, one.digits),
                one.unit,
                " to ".join(number_text(end, one.digits) for end in one.band or ()),
            )
            for one in report.numbers
            if not isnan(one.value)
        ],
        tables=[_table(one) for one in report.tables],
        groups=_groups(report),
        versions=versions(),
    )
    return html.replace(_SIZE, f"{len(html.encode()) / 1e6:.1f} MB")


def _text(name: str) -> str:
    return (files(_HERE) / name).read_text(encoding="utf-8")


@cache
def _plotly() -> str:
    """Return plotly.min.js, compressed, as base64; the browser unpacks it."""
    from plotly.offline import get_plotlyjs

    packed = gzip.compress(get_plotlyjs().encode(), compresslevel=9, mtime=0)
    return base64.b64encode(packed).decode("ascii")


def _figure(number: int, figure: Any) -> dict[str, Any]:
    picture = "" if figure.picture is None else base64.b64encode(figure.picture).decode("ascii")
    height = 0
    if figure.chart is not None:
        height = int(figure.chart.layout.height or 420)
    return {
        "number": number,
        "name": figure.name,
        "title": figure.title,
        "caption": figure.caption,
        "picture": picture,
        "height": height,
    }


def _table(table: Table) -> dict[str, Any]:
    cells = [[row[i] for row in table.rows] for i in range(len(table.columns))]
    shown = [
        (column, values)
        for column, values in zip(table.columns, cells, strict=True)
        if any(one not in (None, "") for one in values)  # an empty column answers nothing
    ]
    return {
        "title": table.title,
        "caption": table.caption,
        "folded": table.folded,
        "heads": [(column.name, column.unit) for column, _ in shown],
        "words": [any(isinstance(one, str) for one in values) for _, values in shown],
        "rows": list(
            zip(*(column_texts(values, column.digits) for column, values in shown), strict=True)
        ),
    }


def _groups(report: Report) -> list[tuple[str, list[Input]]]:
    """Return the inputs as given, and as inferred or assumed."""
    inputs = [replace(one, unit=unit_words(one.unit)) for one in report.inputs]
    given = [one for one in inputs if one.origin == GIVEN]
    others = [one for one in inputs if one.origin != GIVEN]
    groups = (("Given", given), ("Inferred or assumed: give the values that you know", others))
    return [(name, group) for name, group in groups if group]


def versions() -> list[tuple[str, str]]:
    """Return the versions of gearlube, of Python and of the packages that results rest on."""
    found = [("gearlube", __version__), ("Python", platform.python_version())]
    found.append(("system", f"{platform.system()} {platform.machine()}"))
    for package in _PACKAGES:
        try:
            found.append((package, version(package)))
        except PackageNotFoundError:  # an installation without it
            continue
    return found


def _today() -> str:
    """Return date and time of now, UTC, as "2026-03-01 12:30 UTC"."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
