"""The parts of a report as plain data: findings, numbers, figures, tables, inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

GOOD, NOTE, WARNING = "good", "note", "warning"
LEVELS = (GOOD, NOTE, WARNING)
GIVEN, INFERRED, ASSUMED = "given", "inferred", "assumed"
_OPEN = 8  # figures of a report that are not folded, if the study names none

Cell = str | float | int | None


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that the results say.

    Parameters
    ----------
    level : {"good", "note", "warning"}
        Fine; worth knowing; needs a decision or a second look.
    headline : str
        One short sentence with its number and unit.
    detail : str
        What it means, what it is compared with, what to do.

    Examples
    --------
    >>> Finding("warning", "The least film ratio is 0.4, at 20 km/h.", "Below 1 asperities touch.")
    Finding(level='warning', headline='The least film ratio is 0.4, at 20 km/h.', ...)
    """

    level: str
    headline: str
    detail: str = ""

    def __post_init__(self) -> None:
        check_option("level", self.level, LEVELS)


def ranked(findings: Sequence[Finding]) -> list[Finding]:
    """Return findings as they are read: the answer, which is the first, then warnings, then others.

    Examples
    --------
    >>> found = [Finding("note", "A."), Finding("good", "B."), Finding("warning", "C.")]
    >>> [one.headline for one in ranked(found)]
    ['A.', 'C.', 'B.']
    """
    return [*findings[:1], *sorted(findings[1:], key=lambda one: one.level != WARNING)]


@dataclass(frozen=True, slots=True)
class Number:
    """A key number of the results; `gearlube compare` lays those of two runs side by side.

    Parameters
    ----------
    name : str
        The same words in every run of the study.
    value : float
        In `unit`; NaN where there is none: the page leaves it out.
    unit : str
        Everyday unit; "" for none.
    digits : int
        Significant digits that are shown.
    band : (float, float), optional
        Low and high end of 95 % of what the uncertain inputs make of it, in `unit`.
    """

    name: str
    value: float
    unit: str = ""
    digits: int = 3
    band: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table: its name, unit and significant digits. Texts are shown as they are."""

    name: str
    unit: str = ""
    digits: int = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A table that fits a page: at most 12 columns, or it is split.

    Parameters
    ----------
    title : str
    columns : sequence of Column
    rows : sequence of rows
        Numbers in the unit of the column, texts, or None.
    caption : str
        What a row is, what to see in it.
    folded : bool
        Shown only after a click; printed in any case.
    """

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]
    caption: str = ""
    folded: bool = False

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.columns):
                raise ParameterError(
                    f"A row of the table {self.title!r} must have {len(self.columns)} cells, one "
                    f"for each column, got {len(row)}."
                )


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """A figure: a chart of plotly, or a picture.

    Parameters
    ----------
    name : str
        The same in every run of the study; letters, digits, "_".
    title : str
        Caption of a few words.
    caption : str
        What is drawn, and what to see in it.
    chart : plotly.graph_objects.Figure, optional
        See `gearlube.report.charts`.
    picture : bytes, optional
        PNG; shown where there is no chart.
    """

    name: str
    title: str
    caption: str
    chart: Any = None
    picture: bytes | None = None

    def __post_init__(self) -> None:
        if self.chart is None and self.picture is None:
            raise ParameterError(f"The figure {self.name!r} must have a chart or a picture.")


@dataclass(frozen=True, slots=True)
class Recording:
    """A sound to listen to on the page.

    Parameters
    ----------
    title : str
        Caption of a few words.
    caption : str
        What is heard, and the pressure of its full scale.
    wav : bytes
        Content of a WAV file.
    """

    title: str
    caption: str
    wav: bytes


@dataclass(frozen=True, slots=True)
class Input:
    """An input of the study: what, value, unit, "given", "inferred" or "assumed", and why."""

    name: str
    value: str
    unit: str = ""
    origin: str = GIVEN
    why: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """All of a report, in the order in which it is read.

    Parameters
    ----------
    study : str
        The command as typed after `gearlube`; only reports of one study are compared.
    title, subtitle : str
        What was studied; what was run, in one sentence.
    findings : sequence of Finding
        The first is the answer to the question of the study; it stays first, warnings follow.
    recordings : sequence of Recording
    numbers : sequence of Number
    figures : sequence of Figure
        The most important first.
    main_figures : sequence of str
        Names of the figures that stand open, in this order; by default the first 8. The others are
        folded.
    tables : sequence of Table
    inputs : sequence of Input
    limits : sequence of str
        Where the results hold and where not; what is not modelled.
    facts : sequence of (str, str)
        How it was run: command, time, files and versions that only this study knows.
    files : sequence of str
        Names of the files beside the report.
    """

    study: str
    title: str
    subtitle: str = ""
    findings: Sequence[Finding] = ()
    recordings: Sequence[Recording] = ()
    numbers: Sequence[Number] = ()
    figures: Sequence[Figure] = ()
    main_figures: Sequence[str] = ()
    tables: Sequence[Table] = ()
    inputs: Sequence[Input] = ()
    limits: Sequence[str] = ()
    facts: Sequence[tuple[str, str]] = field(default=())
    files: Sequence[str] = ()


def main_and_rest(report: Report) -> tuple[list[Figure], list[Figure]]:
    """Return the figures of a report that stand open, and those that are folded."""
    by_name = {one.name: one for one in report.figures}
    main = [by_name[name] for name in report.main_figures if name in by_name]
    main = main or list(report.figures[:_OPEN])
    return main, [one for one in report.figures if one not in main]
