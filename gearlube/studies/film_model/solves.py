"""Table of solved films: one row a solve in a CSV file, failures kept and named."""

from __future__ import annotations

import csv
import logging
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from gearlube.studies.film_model.kinds import HYPOID_FLANK, ContactKind
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solve import Solved
from gearlube_core.errors import FileError

CHECK = "crc32"  # last column: of the cells before it
logger = logging.getLogger("gearlube")


def _check_of(cells: list[str]) -> str:
    return f"{zlib.crc32(','.join(cells).encode()):08x}"


def head(kind: ContactKind) -> tuple[str, ...]:
    """Return the names of the columns."""
    fields = kind.contact._fields  # type: ignore[attr-defined]
    first = ("kind", "index", "nodes_minor", "nodes_major")
    return (*first, *fields, *Solved._fields, "failure")


class SolveRow(NamedTuple):
    """A film of the table."""

    task: FilmTask
    solved: Solved
    failure: str  # why it failed; empty: solved


def row_key(task: FilmTask) -> str:
    """Return the key of a task in the table."""
    return f"{task.kind}-{task.number}-{task.nodes[0]}x{task.nodes[1]}"


@dataclass(slots=True)
class SolveTable:
    """Rows in a file, to which each solve is appended; the store of a resumable training set.

    Parameters
    ----------
    path
        CSV file; made with the first row.
    kind
        Of the contacts.

    Raises
    ------
    FileError
        The file is no such table.
    """

    path: Path
    kind: ContactKind = HYPOID_FLANK
    rows: dict[str, SolveRow] = field(default_factory=dict)
    names: tuple[str, ...] = ()
    torn: bool = False  # the last row has no end

    def __post_init__(self) -> None:
        own = head(self.kind)
        self.names = (*own, CHECK)
        if not self.path.exists():
            return
        text = self.path.read_text(encoding="utf-8", errors="replace")
        lines, self.torn = text.splitlines(), not text.endswith("\n")
        self.names = tuple(lines[0].split(",")) if lines else ()
        if self.names not in (own, (*own, CHECK)):  # of an earlier version: without checksums
            raise FileError(
                f"{self.path} must be a table of solved films of this version, got other "
                "columns. Give another folder, or remove the file to solve all films again."
            )
        for number, line in enumerate(lines[1:], start=2):
            row = self._row(line)
            if row is not None:
                self.rows[row_key(row.task)] = row
            elif line:  # damaged, or the half row of a run that was killed
                logger.warning(
                    "%s, line %d is damaged. Its film is solved again.", self.path, number
                )

    def read(self, key: str) -> SolveRow | None:
        """Return a row; None when it is absent."""
        return self.rows.get(key)

    def keep(self, key: str, result: SolveRow) -> None:
        """Append a row to the file."""
        self.rows[key] = result
        self.path.parent.mkdir(parents=True, exist_ok=True)
        new = not self.path.exists()
        with self.path.open("a", newline="", encoding="utf-8") as stream:
            if new or self.torn:
                stream.write(",".join(self.names) + "\n" if new else "\n")
            self.torn = False
            task = result.task
            numbers = (*task.contact, *result.solved)
            texts = (repr(float(value)) for value in numbers)
            cells = [task.kind, str(task.number), *map(str, task.nodes), *texts, result.failure]
            checks = [_check_of(cells)] if self.names[-1] == CHECK else []
            csv.writer(stream, lineterminator="\n").writerow([*cells, *checks])

    def _row(self, line: str) -> SolveRow | None:
        try:
            cells = next(csv.reader([line]), [])
        except csv.Error:
            return None
        if self.names[-1] == CHECK and (len(cells) < 2 or cells.pop() != _check_of(cells)):
            return None
        if len(cells) != len(head(self.kind)):
            return None
        try:
            index, nodes = int(cells[1]), (int(cells[2]), int(cells[3]))
            numbers = [float(cell) for cell in cells[4:-1]]
        except ValueError:
            return None
        split = len(numbers) - len(Solved._fields)
        task = FilmTask(cells[0], index, nodes, self.kind.contact(*numbers[:split]))
        return SolveRow(task, Solved(*numbers[split:]), cells[-1])
