"""Table of solved films: one row a solve in a CSV file, failures kept and named."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from gearlube.studies.film_model.kinds import HYPOID_FLANK, ContactKind
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solve import Solved
from gearlube_core.errors import FileError


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

    def __post_init__(self) -> None:
        if not self.path.exists():
            return
        with self.path.open(newline="", encoding="utf-8") as stream:
            reader = csv.reader(stream)
            if tuple(next(reader, ())) != head(self.kind):
                raise FileError(
                    f"{self.path} must be a table of solved films of this version, got other "
                    "columns. Give another folder, or remove the file to solve anew."
                )
            for cells in reader:
                # a run that was killed may leave half a row at the end: it is solved again
                row = self._row(cells)
                if row is not None:
                    self.rows[row_key(row.task)] = row

    def read(self, key: str) -> SolveRow | None:
        """Return a row; None when it is absent."""
        return self.rows.get(key)

    def keep(self, key: str, result: SolveRow) -> None:
        """Append a row to the file."""
        self.rows[key] = result
        self.path.parent.mkdir(parents=True, exist_ok=True)
        new = not self.path.exists()
        with self.path.open("a", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            if new:
                writer.writerow(head(self.kind))
            task = result.task
            numbers = (*task.contact, *result.solved)
            texts = (repr(float(value)) for value in numbers)
            writer.writerow([task.kind, task.number, *task.nodes, *texts, result.failure])

    def _row(self, cells: list[str]) -> SolveRow | None:
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
