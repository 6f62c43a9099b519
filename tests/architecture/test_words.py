"""Words that readers of English as a second language stumble over stay out of pages and code."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
_WORDS = re.compile(
    r"\b(comes? on top|hangs? on|anew|ditto|told of|says of|tells of|speaks of|in the place of"
    r"|unless said|errs on)\b",
    re.IGNORECASE,
)
_FOLDERS = (
    "gearlube", "gearlube_core", "drivetrain", "fmu_src", "docs", "examples", "tests", "benchmarks",
)  # fmt: skip
_ENDS = (".py", ".pyi", ".md", ".toml", ".c", ".h")


def test_pages_and_code_use_plain_words():
    """Write: is added, depends on, again, the same, about, instead of, unless stated."""
    files = [
        *(path for one in _FOLDERS for path in (ROOT / one).rglob("*") if path.suffix in _ENDS),
        *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")),
    ]
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word[0]}"
        for path in files
        if path != Path(__file__)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if (word := _WORDS.search(line))
    ]
    assert not found, "\n".join(found)
