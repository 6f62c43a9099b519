"""Python source without comments, docstrings and empty lines: the text that affects results."""

from __future__ import annotations

import re

_COMMENT_OR_STRING = re.compile(
    r"#[^\n]*"
    r"|[rRbBuUfF]{0,2}(?:"
    r'"""(?:\\.|[^\\])*?"""'
    r"|'''(?:\\.|[^\\])*?'''"
    r'|"(?:\\.|[^"\\\n])*"'
    r"|'(?:\\.|[^'\\\n])*'"
    r")",
    re.DOTALL,
)


def code_of(text: str) -> str:
    r"""Return Python source without comments, docstrings, empty lines and trailing spaces.

    Equal on all Python versions and whatever the ends of the lines are. A docstring is a string
    that is a statement of its own.

    Examples
    --------
    >>> code_of("'About a.'\r\n\r\na = 1  # number\r\n")
    'a = 1'
    """
    text = text.replace("\r\n", "\n")
    kept: list[str] = []
    depth = position = 0  # of brackets; in the text
    for match in _COMMENT_OR_STRING.finditer(text):
        code = text[position : match.start()]
        depth += sum(map(code.count, "([{")) - sum(map(code.count, ")]}"))
        kept.append(code)
        position = match.end()
        if match[0].startswith("#"):
            continue
        if depth or not _is_statement(text, match.start(), match.end()):
            kept.append(match[0])
    kept.append(text[position:])
    lines = (line.rstrip() for line in "".join(kept).split("\n"))
    return "\n".join(line for line in lines if line)


def _is_statement(text: str, start: int, end: int) -> bool:
    """Return whether the string between two places stands alone in its lines."""
    line = text.rfind("\n", 0, start) + 1
    rest = text[end:].partition("\n")[0].strip()
    return (
        not text[line:start].strip()
        and (not rest or rest.startswith("#"))
        and not text[: max(line - 1, 0)].endswith("\\")
    )
