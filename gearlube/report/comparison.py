"""Two reports of one study side by side: key numbers, curves, inputs, findings."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from gearlube.report.numbers import MISSING, number_text
from gearlube.report.parts import GOOD, NOTE, Column, Figure, Finding, Report, Table
from gearlube_core.errors import ParameterError

_NAMED = 5  # changes that are named one by one
_SAME = 1e-9  # relative difference of numbers that are equal but for roundings
_DRAWN = "scatter"

Data = Mapping[str, Any]  # of a report, see `gearlube.report.stored.read_report`


class Change(NamedTuple):
    """A key number in both reports; NaN where one has none."""

    name: str
    unit: str
    digits: int
    first: float
    second: float

    @property
    def difference(self) -> float:
        """The second less the first."""
        return self.second - self.first

    @property
    def percent(self) -> float:
        """The difference over the size of the first [%]; NaN where the first is 0."""
        return 100.0 * self.difference / abs(self.first) if self.first else math.nan

    @property
    def is_equal(self) -> bool:
        """Whether the numbers differ by roundings only."""
        return math.isclose(self.first, self.second, rel_tol=_SAME)


def comparison(first: Data, second: Data, names: tuple[str, str]) -> Report:
    """Return a report on two reports of one study.

    Parameters
    ----------
    first, second : mapping
        Of `read_report`.
    names : (str, str)
        What they are called.

    Raises
    ------
    ParameterError
        The reports are of different studies.
    """
    if first["study"] != second["study"]:
        raise ParameterError(
            f"Both folders must be of one study, got `gearlube {first['study']}` in {names[0]} and "
            f"`gearlube {second['study']}` in {names[1]}. Give two folders of the same command."
        )
    changes = changes_of(first, second)
    differing = differing_inputs(first, second)
    return Report(
        study="compare",
        title=f"{names[0]} and {names[1]}: {first['study']}",
        subtitle=f"{first['title']} (A: {names[0]}, of {first['made']}) compared with "
        f"{second['title']} (B: {names[1]}, of {second['made']}).",
        findings=_findings(changes, differing, names),
        figures=_figures(first, second),
        tables=[_numbers(changes), _inputs(differing), _said(first, "A"), _said(second, "B")],
        limits=(
            "A largest or smallest number may occur at another place in the other run.",
            "The limits of the study hold for both; see their reports.",
        ),
        facts=[("A", names[0]), ("B", names[1])],
    )


def changes_of(first: Data, second: Data) -> list[Change]:
    """Return the key numbers of both reports, in the order of the first."""
    tables = [{row[0]: row for row in one["numbers"]} for one in (first, second)]
    names = [*tables[0], *(name for name in tables[1] if name not in tables[0])]
    found = []
    for name in names:
        _, _, unit, digits = tables[0].get(name) or tables[1][name]
        values = [
            math.nan if name not in one or one[name][1] is None else float(one[name][1])
            for one in tables
        ]
        found.append(Change(name, unit, digits, *values))
    return found


def differing_inputs(first: Data, second: Data) -> list[tuple[str, str, str]]:
    """Return name and both values of each input that is not the same in both."""
    tables = [
        {row[0]: f"{row[1]} {row[2]}".strip() for row in one["inputs"]} for one in (first, second)
    ]
    names = [*tables[0], *(name for name in tables[1] if name not in tables[0])]
    both = [(name, tables[0].get(name, MISSING), tables[1].get(name, MISSING)) for name in names]
    return [row for row in both if row[1] != row[2]]


def _findings(
    changes: Sequence[Change], differing: Sequence[tuple[str, str, str]], names: tuple[str, str]
) -> list[Finding]:
    moved = [one for one in changes if math.isfinite(one.difference) and not one.is_equal]
    moved.sort(key=lambda one: -abs(one.percent) if math.isfinite(one.percent) else -math.inf)
    found = [
        Finding(
            NOTE,
            f"{one.name[0].upper()}{one.name[1:]}: {_quantity(one, one.first)} in A, "
            f"{_quantity(one, one.second)} in B{_percent_words(one)}.",
        )
        for one in moved[:_NAMED]
    ]
    if not moved:
        found.append(Finding(GOOD, "All key numbers are the same."))
    elif len(moved) > _NAMED:
        found.append(
            Finding(
                NOTE, f"{len(moved)} of {len(changes)} key numbers differ; the table lists all."
            )
        )
    words = "; ".join(f"{name}: {a} in A, {b} in B" for name, a, b in differing[:_NAMED])
    more = f"; and {len(differing) - _NAMED} more" if len(differing) > _NAMED else ""
    if differing:
        count = "1 input differs" if len(differing) == 1 else f"{len(differing)} inputs differ"
        found.append(Finding(NOTE, f"{count}.", f"{words}{more}."))
    elif moved:
        found.append(
            Finding(
                NOTE,
                "No input that the reports list differs.",
                "The difference comes from files that they name, or from the version.",
            )
        )
    return found


def _number(one: Change, value: float) -> str:
    """Return a value with so many digits that the difference shows."""
    size, needed = max(abs(one.first), abs(one.second)), 0
    if one.difference and math.isfinite(one.difference):
        needed = 1 + math.ceil(math.log10(size / abs(one.difference)))
    return number_text(value, max(one.digits, min(needed, 6)))


def _quantity(one: Change, value: float) -> str:
    return f"{_number(one, value)} {one.unit}".strip()


def _percent_words(one: Change) -> str:
    if not math.isfinite(one.percent):
        return ""
    return f" ({_signed(one.percent)} %)"


def _signed(value: float) -> str:
    return f"{'+' if value > 0.0 else ''}{number_text(value)}"


def _numbers(changes: Sequence[Change]) -> Table:
    return Table(
        title="Key numbers",
        columns=[
            Column(name) for name in ("number", "unit", "A", "B", "difference", "difference in %")
        ],
        rows=[
            [
                one.name,
                one.unit,
                _number(one, one.first),
                _number(one, one.second),
                "0" if one.is_equal else _signed(one.difference),
                "0" if one.is_equal else _signed(one.percent),
            ]
            for one in changes
        ],
        caption="The difference is B minus A.",
    )


def _inputs(differing: Sequence[tuple[str, str, str]]) -> Table:
    return Table(
        title="Inputs that differ",
        columns=[Column("input"), Column("A"), Column("B")],
        rows=[list(row) for row in differing],
        caption="" if differing else "None.",
    )


def _said(data: Data, name: str) -> Table:
    return Table(
        title=f"Findings of {name}",
        columns=[Column("level"), Column("finding")],
        rows=[[level, headline] for level, headline, _ in data["findings"]],
        folded=True,
    )


def _figures(first: Data, second: Data) -> list[Figure]:
    """Return the charts of both: lines in one chart, all others one after the other."""
    found = []
    for name, a in first["charts"].items():
        b = second["charts"].get(name)
        if b is None:
            continue
        moving = a.get("frames") or b.get("frames")
        if not moving and all(_is_line(trace) for trace in [*a["data"], *b["data"]]):
            traces = [
                *(_marked(trace, "A", second=False) for trace in a["data"]),
                *(_marked(trace, "B", second=True) for trace in b["data"]),
            ]
            chart = _chart(traces, a["layout"] | {"showlegend": True})
            words = (
                f"{a['caption']} A: as in its report, with the titles of its panels; B: thin and "
                "dotted, with crosses."
            )
            found.append(Figure(name=name, title=a["title"], caption=words, chart=chart))
            continue
        for mark, one in (("A", a), ("B", b)):
            found.append(
                Figure(
                    name=f"{name}_{mark}",
                    title=f"{one['title']}, {mark}",
                    caption=one["caption"],
                    chart=_chart(one["data"], one["layout"], one.get("frames", ())),
                )
            )
    return found


def _is_line(trace: Mapping[str, Any]) -> bool:
    lines = "lines" in str(trace.get("mode", ""))
    return trace.get("type", _DRAWN) == _DRAWN and lines and "stackgroup" not in trace


def _marked(trace: Mapping[str, Any], mark: str, *, second: bool) -> dict[str, Any]:
    name = f"{mark}: {trace.get('name', '')}".strip(": ")
    found = {**trace, "name": name}
    found.pop("legendgroup", None)
    if second:
        line = trace.get("line", {})
        found["line"] = {**line, "dash": "dot", "width": 1.4}
        found["marker"] = {**trace.get("marker", {}), "symbol": "x-thin-open", "size": 7}
    return found


def _chart(
    data: Sequence[Mapping[str, Any]],
    layout: Mapping[str, Any],
    frames: Sequence[Mapping[str, Any]] = (),
) -> Any:
    import plotly.graph_objects as go

    return go.Figure(data=list(data), layout={**layout, "template": None}, frames=list(frames))
