"""Solve the contacts outside a film model's domain that a table does not hold yet."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gearlube.studies.film_model.kinds import ContactKind
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solves import SolveRow, SolveTable, row_key
from gearlube.studies.film_model.train import failed_row, solve_task
from gearlube_core.errors import GearLubeError


def outside_solves(table: Path, kind: ContactKind, contacts: Sequence[tuple]) -> list[SolveRow]:
    """Return all contacts solved; those in the table are not solved again."""
    kept = SolveTable(table, kind)
    for n, one in enumerate(contacts):
        task = FilmTask("outside", n, kind.nodes, one)
        if kept.read(row_key(task)) is None:
            try:
                kept.keep(row_key(task), solve_task(task))
            except GearLubeError as error:
                kept.keep(row_key(task), failed_row(task, error))
    return list(kept.rows.values())
