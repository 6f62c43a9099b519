"""Plain words in pages and code, and descriptions that say what a thing is."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import click
import typer

from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.variables import HYPOID_AXLE
from gearlube.command import app

ROOT = Path(__file__).parents[2]
_WORDS = re.compile(
    r"\b(comes? on top|hangs? on|anew|ditto|told of|says of|tells of|speaks of|in the place of"
    r"|unless said|errs on)\b",
    re.IGNORECASE,
)
_OF_PEOPLE = re.compile(r"\b(told|tells|errs|erred)\b")  # not of numbers and files; tests may
_PACKAGES = ("gearlube", "gearlube_core", "drivetrain", "fmu_src")
_FOLDERS = (*_PACKAGES, "docs", "examples", "tests", "benchmarks")
_ENDS = (".py", ".pyi", ".md", ".toml", ".c", ".h")


def _is_read(path: Path) -> bool:
    return path.relative_to(ROOT).parts[0] not in ("tests", "benchmarks", "examples")


def test_pages_and_code_use_plain_words():
    """Write: is added, depends on, again, the same, about, instead of, unless stated, reports."""
    files = [
        *(path for one in _FOLDERS for path in (ROOT / one).rglob("*") if path.suffix in _ENDS),
        *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")),
    ]
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word[0]}"
        for path in files
        if path != Path(__file__)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if (word := _WORDS.search(line) or (_is_read(path) and _OF_PEOPLE.search(line)))
    ]
    assert not found, "\n".join(found)


def _riddle(text: str) -> bool:
    """Return whether a description has under four words, no [unit], and no name to look up."""
    return len(text.split()) < 4 and "[" not in text and "`" not in text


def _described(docstring: str) -> Iterator[tuple[str, str]]:
    """Return heads and descriptions of the entries of numpydoc sections, such as Parameters."""
    for section in re.split(r"^(?=[A-Z][\w ]+\n-+$)", docstring, flags=re.MULTILINE):
        if section.startswith(("Parameters\n", "Attributes\n", "Returns\n")):
            for entry in re.split(r"^(?=\S)", section, flags=re.MULTILINE)[3:]:
                head, _, text = entry.partition("\n")
                yield head, " ".join(text.split("\n\n")[0].split())


def test_a_description_has_four_words_or_a_unit():
    """In all docstrings; a type that is a class may stand without words.

    Where a description is missing altogether, the name and its type have to do.
    """
    found = []
    for folder in _PACKAGES:
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.FunctionDef | ast.ClassDef):
                    found += [
                        f"{path.relative_to(ROOT)}: {node.name}: {head}: {text}"
                        for head, text in _described(ast.get_docstring(node) or "")
                        if text and _riddle(text) and not re.search(r": .*[A-Z][a-z]|\[", head)
                    ]
    assert not found, "\n".join(found)


def test_an_option_of_a_command_has_four_words_or_a_unit():
    found, commands = [], [("gearlube", typer.main.get_command(app))]
    while commands:
        path, command = commands.pop()
        context = click.Context(command)
        found += [
            f"{path} {one.name}: {one.help}"
            for one in command.get_params(context)
            if one.name != "help" and _riddle(one.help or "")
        ]
        if hasattr(command, "list_commands"):
            commands += [
                (f"{path} {name}", command.get_command(context, name))
                for name in command.list_commands(context)
            ]
    assert not found, "\n".join(found)


def test_a_variable_of_an_fmu_has_four_words_or_a_unit():
    assert not [
        f"{one.name}: {one.description}"
        for one in (*HYPOID_AXLE, *HELICAL_PAIR)
        if one.unit in ("", "1") and _riddle(one.description)
    ]
