"""Source text without words: what is left decides results, what is left out does not."""

from __future__ import annotations

import ast
from pathlib import Path

import gearlube_core
from gearlube_core.kernels.source_code import code_of

WITH_WORDS = '''
"""About the module."""  # and a comment
NAMES = [
    "one",  # kept, it is an element
    "two # not a comment"
]
JOINED = \\
    "kept"


class A:  # a comment
    r"""Text with "quotes" and \\\\ in it.

    More."""

    x = 1
    """What x is."""

    def f(self, text='a"b'):
        """Return f."""
        return f"{text}#" + ("a"
            "b")
'''
WITHOUT = """NAMES = [
    "one",
    "two # not a comment"
]
JOINED = \\
    "kept"
class A:
    x = 1
    def f(self, text='a"b'):
        return f"{text}#" + ("a"
            "b")"""


def test_only_words_are_left_out() -> None:
    assert code_of(WITH_WORDS) == WITHOUT
    assert code_of(WITH_WORDS.replace("\n", "\r\n")) == WITHOUT


def _statements(text: str) -> str:
    """Return the syntax tree without docstrings, by Python's own parser."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        for name, value in ast.iter_fields(node):
            if isinstance(value, list) and name != "values":
                value[:] = [one for one in value if not _is_text(one)] or [ast.Pass()] * (
                    name == "body"
                )
    return ast.dump(tree)


def _is_text(node: object) -> bool:
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return is_text and isinstance(node.value.value, str)  # type: ignore[attr-defined]


def _with_pass(code: str) -> str:
    """Give bodies that were only a docstring a `pass`, so that the text can be parsed."""
    lines = code.split("\n")
    kept = []
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        kept.append(line)
        indent = len(line) - len(line.lstrip())
        opens = line.endswith(":") and line.lstrip().startswith(("class ", "def ", ")"))
        if opens and len(after) - len(after.lstrip()) <= indent:
            kept.append(" " * (indent + 4) + "pass")
    return "\n".join(kept)


def test_the_code_of_the_core_is_complete() -> None:
    folder = Path(str(gearlube_core.__file__)).parent
    for path in [*folder.glob("kernels/*.py"), *folder.glob("*/h*.py"), *folder.glob("oil/*.py")]:
        text = path.read_text(encoding="utf-8")
        assert _statements(_with_pass(code_of(text))) == _statements(text), path
