"""Readable tables of the variables: in docs/fmu.md and inside the FMU."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from pathlib import Path

from fmu_src.definition import Definition
from fmu_src.model_description import UNITS
from fmu_src.variable import Variable
from gearlube_core.dynamics.ranges import Range
from gearlube_core.errors import ParameterError

HEADINGS = ("Name", "Unit", "Shown in", "Start", "Range", "Description")
_PAGES = Path(__file__).parent / "pages"
_TITLES = {
    "input": "Inputs",
    "parameter": "Parameters",
    "output": "Outputs",
    "local": "Locals: what model exchange needs besides",
}


def _shown(variable: Variable, value: float) -> str:
    if variable.literals:
        return variable.literals[int(value) - 1]
    for display in UNITS[variable.unit].display if variable.unit in UNITS else ():
        if display.name == variable.display_unit:
            return f"{display.factor * value + display.offset:.6g} {display.name}"
    return f"{value:.6g}"


def row(variable: Variable) -> tuple[str, ...]:
    """Return the cells of `variable` under `HEADINGS`; start and range in the display unit."""
    limits = ""
    if variable.literals:
        limits = ", ".join(variable.literals)
    elif variable.minimum is not None and variable.maximum is not None:
        limits = f"{_shown(variable, variable.minimum)} to {_shown(variable, variable.maximum)}"
    return (
        variable.name,
        variable.unit or variable.type,
        variable.display_unit,
        "" if variable.start is None else _shown(variable, variable.start),
        limits,
        variable.description,
    )


def _sections(definition: Definition) -> Iterable[tuple[str, list[tuple[str, ...]]]]:
    for causality, title in _TITLES.items():
        yield title, [row(v) for v in definition.variables if v.causality == causality]


def _together(rows: Iterable[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Return rows in which those that differ by an index or an axis alone are one."""
    merged: dict[tuple[str, ...], list[tuple[str, ...]]] = {}
    for cells in rows:
        name, text = cells[0], cells[-1]
        if index := re.search(r"\[(\d+)\]", name):
            name = name.replace(index[0], "[i]", 1)
            text = re.sub(rf"\b{index[1]}\b", "i", text)
        if axis := re.search(r"(?<=\.)[xyz](?=\)?$)", name):
            name = f"{name[: axis.start()]}a{name[axis.end() :]}"
            text = re.sub(rf"\b{axis[0]}\b", "a", text)
        merged.setdefault((name, *cells[1:-1], text), []).append(cells)
    shown = []
    for (name, *between, text), members in merged.items():
        if len(members) == 1:
            shown += members
            continue
        if "[i]" in name:
            text += f"; i = 1 to {len({cells[0].split(']')[0] for cells in members})}"
        if re.search(r"\.a\)?$", name):
            text += "; a = x, y, z" if any(".z" in cells[0] for cells in members) else "; a = x, y"
        shown.append((name, *between, text))
    return shown


def variables_markdown(definition: Definition) -> str:
    """Return the variables as Markdown tables, one for each causality."""
    lines: list[str] = []
    for title, rows in _sections(definition):
        rates = [cells for cells in rows if cells[0].startswith("der(")]
        named = {cells[0] for cells in rows}
        numbers = [
            cells for cells in rows if cells[0].removesuffix(".number") in named - {cells[0]}
        ]
        shown = [
            (f"`{name}`", f"{unit} ({display})" if display else unit, *others)
            for name, unit, display, *others in _together(
                cells for cells in rows if cells not in (*rates, *numbers)
            )
        ]
        heads = (HEADINGS[0], f"{HEADINGS[1]} (shown in)", *HEADINGS[3:])
        used = [k for k in range(len(heads)) if any(cells[k] for cells in shown)]
        lines += [f"### {title}", "", "| " + " | ".join(heads[k] for k in used) + " |"]
        lines += ["|" + "---|" * len(used)]
        lines += ["| " + " | ".join(cells[k] for k in used) + " |" for cells in shown]
        lines += [""]
        if numbers:
            lines += [
                "Each enumeration `X` has an Integer parameter `X.number`: the number of the "
                "value, from 1 on. Its start value 0 keeps the value of `X`.",
                "",
            ]
        if rates:
            names = ", ".join(f"`{cells[0]}`" for cells in _together(rates))
            lines += [f"Time derivatives, for the same i and a: {names}.", ""]
    return "\n".join(lines)


_NEEDS = {
    True: "This FMU needs nothing but its own library.",
    False: "This FMU computes in the Python package gearlube, which must be installed where it "
    "runs. A host that is not Python itself preloads libpython and sets PYTHONPATH.",
}


def _table(headings: Iterable[str], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table of HTML; its cells are text."""
    head = "".join(f"<th>{heading}</th>" for heading in headings)
    cells = "\n".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row_) + "</tr>" for row_ in rows
    )
    return f"<table>\n<tr>{head}</tr>\n{cells}\n</table>"


def _page(name: str) -> list[str]:
    """Return the written part of a page, if there is one."""
    path = _PAGES / f"{name}.html"
    return [path.read_text("utf-8")] if path.is_file() else []


def index_html(
    definition: Definition, ranges: Iterable[Range] = (), *, native: bool = False
) -> str:
    """Return documentation/index.html of the FMU.

    Parameters
    ----------
    definition : Definition
    ranges : iterable of Range
        Outside of which the FMU warns; for a native FMU.
    native : bool
        Whether the FMU computes by itself.
    """
    body = [
        f"<h1>{escape(definition.name)}</h1>",
        f"<p>{escape(definition.description)}.</p>",
        f"<p>{_NEEDS[native]} Communication steps are above 0 and at most 0.1 s; outputs hold the "
        "end of the last step.</p>",
        *_page(definition.name),
    ]
    if native:
        body += _page("native")
    rows = [
        (one.output, one.what, f"{one.low:g} to {one.high:g}", one.unit, one.beyond)
        for one in ranges
    ]
    if rows:
        headings = ("Output", "Quantity", "Range", "Unit", "Beyond")
        body.append(f"<h2>Ranges</h2>\n{_table(headings, rows)}")
    for title, cells in _sections(definition):
        body.append(f"<h2>{title}</h2>\n{_table(HEADINGS, cells)}")
    style = (
        "body{font-family:sans-serif;max-width:70em;margin:auto;padding:1em}"
        "td,th{text-align:left;vertical-align:top;padding:0 1em 0 0}pre{overflow-x:auto}"
    )
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{escape(definition.name)}</title><style>{style}</style></head>\n<body>\n"
        + "\n".join(body)
        + "\n</body></html>\n"
    )


def update_page(path: Path, definition: Definition) -> None:
    """Rewrite the tables between the definition's two markers on the Markdown page at `path`."""
    begin, end = (f"<!-- variables of {definition.name}: {what} -->" for what in ("begin", "end"))
    head, found, rest = path.read_text(encoding="utf-8").partition(begin)
    _, found_end, tail = rest.partition(end)
    if not (found and found_end):
        raise ParameterError(f"{path} must hold the lines {begin} and {end}. Add them.")
    page = f"{head}{begin}\n\n{variables_markdown(definition).strip()}\n\n{end}{tail}"
    path.write_text(page, encoding="utf-8")
