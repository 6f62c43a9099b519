"""Numbers of scripts in the pages of the documentation.

All words stand in the page and are edited there: text, heads of tables, captions, the statements
of a source. A script puts its results in their places: rows of a table, value and verdict of a
statement, numbers in a sentence. A place must be there exactly once.
"""

from __future__ import annotations

import logging
import math
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from gearlube_core.storage.atomic_file import write_text

DOCS = Path(__file__).resolve().parent
IMAGES = DOCS / "images"
ROOT = DOCS.parent
HOLDS, PARTLY, FAILS = "holds", "holds in part", "does not hold"
_OF_SEVERAL = {HOLDS: "hold", PARTLY: "hold in part", FAILS: "do not hold"}
Judge = TypeVar("Judge", bound=Callable[[Any], Any])
_STATEMENTS = "# | What"  # head of a table of statements
_NUMBER = r"((?:.|\n(?!\n))+?)"  # within a paragraph


class Verdict(NamedTuple):
    """What was found for a statement; without a reason that of the page stays."""

    value: str
    verdict: str
    reason: str | None = None


class Claims(dict[str, Callable[[Any], Any]]):
    """Statements by the name that they have on the page; `@CLAIMS("7")` adds what judges one."""

    def __call__(self, name: str) -> Callable[[Judge], Judge]:
        """Return what adds a function under a name."""

        def add(judge: Judge) -> Judge:
            self[name] = judge
            return judge

        return add


def judge(ok: bool, partly: bool = False) -> str:
    """Return the word for a statement that holds, or holds in part."""
    return HOLDS if ok else PARTLY if partly else FAILS


def judge_parts(*parts: bool) -> str:
    """Return the word for a statement of several parts: all hold, none does, or some."""
    return judge(all(parts), any(parts))


def border(
    holds: Callable[[float], bool], good: float, bad: float, within: float, ratio: bool = False
) -> float:
    """Return where a condition begins to hold, by bisection between where it does and does not.

    `within` is the largest distance of both ends at last; with `ratio` that of their logarithms.

    Examples
    --------
    >>> round(border(lambda x: x > 2.0, 16.0, 1.0, 1e-6), 5)
    2.0
    """

    def middle() -> float:
        return math.sqrt(good * bad) if ratio else 0.5 * (good + bad)

    while (abs(math.log(good / bad)) if ratio else abs(good - bad)) > within:
        good, bad = (middle(), bad) if holds(middle()) else (good, middle())
    return middle()


def tally(verdicts: Iterable[str]) -> str:
    """Return verdicts with their numbers, the most frequent first.

    Examples
    --------
    >>> tally(["holds", "does not hold", "holds"])
    '2 statements hold, 1 does not hold'
    """
    parts = []
    for word, count in Counter(verdicts).most_common():
        said = word if count == 1 else _OF_SEVERAL.get(word, word)
        said = said if word in _OF_SEVERAL else f"{'is' if count == 1 else 'are'} {said}"
        noun = "" if parts else " statement" if count == 1 else " statements"
        parts.append(f"{count}{noun} {said}")
    return ", ".join(parts)


class Page:
    """A page `docs/NAME.md`; `write` stores what was put into it."""

    def __init__(self, name: str) -> None:
        self.path = DOCS / f"{name}.md"
        self.text = self.path.read_text(encoding="utf-8")

    def rows(self, head: str, rows: Iterable[Iterable[str]], after: str = "") -> None:
        """Put rows into the table whose head begins with `head`.

        With `after` it is the first one after these words.
        """
        start, end = self._body(head, after)
        columns = self.text[:start].splitlines()[-1].count("|") - 1
        body = ""
        for row in rows:
            cells = list(row)
            if len(cells) != columns:
                raise ValueError(f"{self.path.name}, {head}: {columns} columns, got {cells}")
            body += "| " + " | ".join(cells) + " |\n"
        self.text = self.text[:start] + body + self.text[end:]

    def cells(
        self, head: str, rows: Sequence[Sequence[str | None]], after: str = "", first: int = 2
    ) -> None:
        """Put cells into the rows of a table from column `first` on; None: as the page has it."""
        start, end = self._body(head, after)
        lines = [line[2:-2].split(" | ") for line in self.text[start:end].splitlines()]
        if len(lines) != len(rows):
            raise ValueError(f"{self.path.name}, {head}: {len(lines)} rows, got {len(rows)}")
        for line, row in zip(lines, rows, strict=True):
            for column, cell in enumerate(row, first):
                line[column] = line[column] if cell is None else cell
        self.rows(head, lines, after)

    def claims(self, found: Mapping[str, Sequence[str | None]], after: str) -> None:
        """Put what was found into the table of statements that follows `after`, in its order."""
        names = self._names(after)
        if set(names) != set(found):
            raise ValueError(f"{self.path.name} has statements {names}, got {list(found)}")
        head = self.text[: self._body(_STATEMENTS, after)[0]].splitlines()[-2]
        first = head[: head.index("| Found")].count("|")
        self.cells(_STATEMENTS, [found[name] for name in names], after, first)

    def judged(self, claims: Claims, evidence: Any, after: str) -> None:
        """Judge statements; put in what was found and how many hold."""
        self.verdicts({name: claims[name](evidence) for name in self._names(after)}, after)

    def verdicts(self, found: Mapping[str, Verdict | None], after: str) -> None:
        """Put in verdicts; if all are known, in the line after `after`, how many hold."""
        rows = {k: v and (v.value, f"**{v.verdict}**", v.reason) for k, v in found.items()}
        self.claims({name: row or () for name, row in rows.items()}, after)
        if all(found.values()):
            self.paragraph(after, f"{tally(one.verdict for one in found.values() if one)}.")

    def paragraph(self, after: str, text: str) -> None:
        """Put a paragraph or a list instead of the one that follows the words `after`."""
        found = self._only(rf"{_words(after)}\n+((?:.+\n)+)", after)
        self.text = (
            self.text[: found.start(1)] + text.strip("\n") + "\n" + self.text[found.end(1) :]
        )

    def fill(self, words: str, *values: object) -> None:
        """Put values in the places {} of a sentence; line breaks of the page stay.

        One at the beginning of `words` is a single word. A full stop at their end is not a point.
        """
        if words.count("{}") != len(values):
            raise ValueError(f"{self.path.name}: {len(values)} values for {words!r}")
        before = r"(?<!\S)" if words.startswith("{}") else ""
        behind = r"(?!\S)" if words.endswith(".") else ""
        pattern = re.compile(before + _NUMBER.join(map(_words, words.split("{}"))) + behind)
        found = self._only(pattern.pattern, words)
        while shorter := pattern.search(self.text, found.start() + 1):
            found = shorter
        for k in range(len(values), 0, -1):
            start, end = found.span(k)
            self.text = self.text[:start] + str(values[k - 1]) + self.text[end:]

    def write(self) -> None:
        """Write the page."""
        write_text(self.text, self.path)

    def _names(self, after: str) -> list[str]:
        """Return the names of the statements in the table that follows `after`."""
        start, end = self._body(_STATEMENTS, after)
        return [line[2:].partition(" | ")[0] for line in self.text[start:end].splitlines()]

    def _body(self, head: str, after: str) -> tuple[int, int]:
        pattern = rf"^\| {re.escape(head)}.*\n\|[-| :]+\|\n((?:\|.*\n)*)"
        if after:
            begin = self._only(_words(after), after).end()
            found = re.compile(pattern, re.MULTILINE).search(self.text, begin)
            if found is None:
                raise ValueError(f"{self.path.name}: no table {head!r} after {after!r}")
            return found.span(1)
        return self._only(pattern, head).span(1)

    def _only(self, pattern: str, what: str) -> re.Match[str]:
        found = list(re.finditer(pattern, self.text, re.MULTILINE))
        if len(found) != 1:
            raise ValueError(f"{self.path.name} must have once, has {len(found)} times: {what!r}")
        return found[0]


def _words(text: str) -> str:
    """Return a pattern for words, wherever lines break."""
    return r"\s+".join(map(re.escape, re.split(r"\s+", text)))


def begin(name: str) -> Path:
    """Start the log of a script; return its work folder, an argument or build/NAME."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logging.getLogger("docs").setLevel(logging.INFO)
    given = [word for word in sys.argv[1:] if not word.startswith("--")]
    work = Path(given[0]) if given else ROOT / "build" / name
    work.mkdir(parents=True, exist_ok=True)
    return work
