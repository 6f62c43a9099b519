"""Solve the training set of a film model: resumable, on local processors or a Dask cluster."""

from __future__ import annotations

import json
import logging
import math
from pathlib import Path

from gearlube.studies.film_model.kinds import kind_of
from gearlube.studies.film_model.plan import FilmPlan, FilmTask
from gearlube.studies.film_model.solve import Solved
from gearlube.studies.film_model.solves import SolveRow, SolveTable, row_key
from gearlube_core.checks import check_address, read_content
from gearlube_core.errors import InterruptedRunError, ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.storage.process_pool import Pool, ProcessPool
from gearlube_core.storage.resumable import resumable_results

logger = logging.getLogger("gearlube")

PLAN, SOLVES = "plan.json", "solves.csv"
_NAN = math.nan
_NOTHING = Solved(_NAN, _NAN, _NAN, _NAN, _NAN, _NAN, 0.0, 0.0)


def train(
    plan: FilmPlan,
    folder: Path,
    *,
    pool: Pool | None = None,
    progress: Progress = no_progress,
) -> SolveTable:
    """Return the solved films of a plan; those that are in the folder are not solved again.

    Parameters
    ----------
    plan
        What to solve.
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
