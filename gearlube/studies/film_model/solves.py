"""The training set of a film model, solved: resumable, in one table, failures kept and named."""

from __future__ import annotations

import csv
import json
import logging
import math
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from gearlube.studies.film_model.kinds import HYPOID_FLANK, ContactKind, kind_of
from gearlube.studies.film_model.plan import FilmPlan, FilmTask
from gearlube.studies.film_model.solve import Solved
from gearlube_core.checks import check_address, read_content
from gearlube_core.errors import FileError, InterruptedRunError, ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.storage.process_pool import Pool, ProcessPool
from gearlube_core.storage.resumable import resumable_results

CHECK = "crc32"  # last column: of the cells before it
logger = logging.getLogger("gearlube")
PLAN, SOLVES = "plan.json", "solves.csv"
_NAN = math.nan
_NOTHING = Solved(_NAN, _NAN, _NAN, _NAN, _NAN, _NAN, 0.0, 0.0)


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
        Kind of the solved contacts.

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


def train(
    plan: FilmPlan, folder: Path, *, pool: Pool | None = None, progress: Progress = no_progress
) -> SolveTable:
    """Return the solved films of a plan; those that are in the folder are not solved again.

    Parameters
    ----------
    plan
        Contacts and films to solve.
    folder
        Of solves.csv and plan.json.
    pool
        Where films are solved; default: all local processors.
    progress
        Called with the share done and a sentence.

    Raises
    ------
    ParameterError
        The folder belongs to another plan, or an oil is not known.
    InterruptedRunError
        Stopped by Ctrl-C; what was solved is kept.
    """
    check_plan(plan, folder)
    tasks = plan.tasks()
    table = SolveTable(folder / SOLVES, plan.kind)
    folder.mkdir(parents=True, exist_ok=True)
    write_text(json.dumps(plan.described(), indent=1) + "\n", folder / PLAN)
    failed = 0
    try:
        results = resumable_results(
            tasks, row_key, solve_task, table, pool or ProcessPool(), failed=failed_row
        )
        for count, finished in enumerate(results, start=1):
            failed += bool(finished.result.failure)
            progress(count / len(tasks), f"films solved, {failed} failed")
    except KeyboardInterrupt:
        raise InterruptedRunError(
            f"Stopped. {len(table.rows)} of {len(tasks)} films are in {folder}; run the same "
            "command again to go on."
        ) from None
    return table


def check_plan(plan: FilmPlan, folder: Path) -> None:
    """Refuse a folder that holds the films of another plan."""
    path = folder / PLAN
    if not path.exists():
        return
    try:
        # a plan of before has no names that were added since
        stored = FilmPlan().described() | json.loads(read_content(path, "plan"))
    except (ValueError, TypeError, RecursionError) as reason:
        raise ParameterError(
            f"{path} must be the plan of the films in its folder, got {reason}. Give another --out."
        ) from None
    wanted = plan.described()
    other = [name for name in wanted if stored.get(name) != wanted[name]]
    if other:
        words = ", ".join(f"{name} {stored.get(name)} (asked: {wanted[name]})" for name in other)
        raise ParameterError(
            f"--out must be a folder of the same plan, got {folder} with {words}. Give another "
            "--out, or the same options as before."
        )


def stored_plan(folder: Path) -> FilmPlan:
    """Return the plan of a folder.

    Raises
    ------
    ParameterError
        The folder holds no plan.
    """
    path = folder / PLAN
    try:
        stored = json.loads(read_content(path, "plan"))
        return FilmPlan.of(stored)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ParameterError(
            f"The folder must be one of `gearlube film-model train`, got {folder}: {PLAN} is "
            f"missing or damaged ({error}). Train first."
        ) from error


def solve_task(task: FilmTask) -> SolveRow:
    """Return the film of a task; one that does not converge says so."""
    solved = kind_of(task.contact).solve(task.contact, task.nodes)
    return SolveRow(task, solved, "" if solved.converged else "not converged")


def failed_row(task: FilmTask, error: Exception) -> SolveRow:
    """Return the row of a film whose solution raised an error."""
    reason = " ".join(f"{type(error).__name__}: {error}".split())
    logger.debug("%s: %s", row_key(task), reason)
    return SolveRow(task, _NOTHING, reason[:200])


def pool_of(jobs: int | None, scheduler: str | None) -> Pool:
    """Return local processes, or the workers of a Dask cluster.

    Raises
    ------
    ParameterError
        Both are given, or the address is none.
    """
    if scheduler is None:
        return ProcessPool(jobs=jobs)
    if jobs is not None:
        raise ParameterError("--jobs must be left out beside --scheduler. Workers do the work.")
    from gearlube_core.storage.dask_pool import DaskPool, NamedPlugin

    plugin = NamedPlugin()
    plugin.name = "gearlube-film-model"
    return DaskPool(check_address(scheduler), plugin)


def failures_in_words(table: SolveTable) -> list[str]:
    """Return which films failed and why, at most ten."""
    failed = [row for row in table.rows.values() if row.failure]
    lines = [f"{row_key(row.task)}: {row.failure}" for row in failed[:10]]
    return [f"{len(failed)} of {len(table.rows)} films failed.", *lines] if failed else []
