"""Tags of sources in docstrings and comments, such as [he_2007 (10b)], and where they stand."""

from __future__ import annotations

import ast
import csv
import io
import re
import tokenize
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
PACKAGES = ("gearlube_core", "drivetrain", "gearlube", "fmu_src")
_KEY = r"[a-z]+(?:_[a-z]+)*_(?:1[5-9]|20)\d\d|(?:iso|astm|iec|ecma)_[a-z0-9_]*\d"
_TAG = re.compile(rf"\[({_KEY})(?: ([^\]\n]+))?\]")
_ENTRY = re.compile(r"^@\w+\{(\w+),", re.MULTILINE)
_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


class Tag(NamedTuple):
    """One tag: its key, what it points to in the source ("" for all of it), and where it stands."""

    key: str
    place: str
    file: str  # from the root of the repository
    scope: str  # function, method or class; "" for the module


class Equation(NamedTuple):
    """One numbered equation of a paper."""

    paper: str
    number: str
    what: str
    form: str  # printed, corrected, other form, or not implemented
    note: str


def bibliography_keys() -> list[str]:
    """Return the keys of docs/bibliography.bib in their order."""
    return _ENTRY.findall((ROOT / "docs" / "bibliography.bib").read_text(encoding="utf-8"))


def equations() -> list[Equation]:
    """Return the rows of docs/equations.csv."""
    with (ROOT / "docs" / "equations.csv").open(encoding="utf-8", newline="") as file:
        return [Equation(**row) for row in csv.DictReader(file)]


@cache
def package_tags() -> list[Tag]:
    """Return all tags in docstrings and comments of the packages and their data files."""
    found: list[Tag] = []
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            found += _python_tags(path)
        for path in sorted((ROOT / package).rglob("*.toml")):
            text = path.read_text(encoding="utf-8")
            # a line that begins with a bracket is the heading of a table
            lines = "\n".join(line for line in text.splitlines() if not line.startswith("["))
            found += [_tag(match, path, "") for match in _TAG.finditer(lines)]
    return found


def _python_tags(path: Path) -> list[Tag]:
    text = path.read_text(encoding="utf-8")
    if not _TAG.search(text):
        return []
    scopes = _scopes(ast.parse(text), text.splitlines())
    found = []
    for start, words in prose(text):
        for match in _TAG.finditer(words):
            line = start + words.count("\n", 0, match.start())
            inside = [name for first, last, name in scopes if first <= line <= last]
            found.append(_tag(match, path, inside[-1] if inside else ""))
    return found


def prose(text: str) -> list[tuple[int, str]]:
    """Return line and text of every docstring and comment of Python code."""
    return [
        (token.start[0], token.string)
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type == tokenize.COMMENT
        or (token.type == tokenize.STRING and token.string.startswith(('"""', 'r"""')))
    ]


def _tag(match: re.Match[str], path: Path, scope: str) -> Tag:
    return Tag(match[1], match[2] or "", path.relative_to(ROOT).as_posix(), scope)


def _scopes(tree: ast.AST, lines: list[str], outer: str = "") -> list[tuple[int, int, str]]:
    """Return first line, last line and name of all definitions, outer ones first.

    Comments right above a definition count as part of it.
    """
    found: list[tuple[int, int, str]] = []
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, _DEFINITIONS):
            continue
        first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
        while first > 1 and lines[first - 2].lstrip().startswith("#"):
            first -= 1
        name = f"{outer}.{node.name}" if outer else node.name
        found.append((first, node.end_lineno or node.lineno, name))
        found += _scopes(node, lines, name)
    return found
