"""Solved films as targets of a fit: logarithms over what the kernel's references give."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.kinds import Contact, kind_of
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core.arrays import Array

# of second order in the spacing: the finer grid's distance to the limit is a third of that between
# the grids, and the coarser one's four thirds
TO_LIMIT = 4.0 / 3.0


class Targets(NamedTuple):
    """Solved contacts, n of them, all on one grid."""

    contacts: tuple[Contact, ...]
    groups: Array  # (n, N_GROUPS)
    values: Array  # (n, 2): ln(h/h_ref), ln(mu/mu_ref(h))
    film: Array  # (n,) [m]
    friction: Array  # (n,) [-]


def film_targets(contact: Contact, film: float, friction: float) -> tuple[float, float]:
    """Return ln(h/h_ref) and ln(mu/mu_ref(h))."""
    first = kind_of(contact).reference_film(contact)
    return math.log(film / first), math.log(friction / expected_friction(contact, film))


def expected_friction(contact: Contact, film: float) -> float:
    """Return the reference of the friction [-] for a film [m]."""
    return kind_of(contact).reference_friction(contact, film)


def targets_of(rows: Sequence[SolveRow]) -> Targets:
    """Return the targets of rows that were solved."""
    contacts = tuple(row.task.contact for row in rows)
    return Targets(
        contacts,
        np.array([kind_of(one).groups(one) for one in contacts]),
        np.array([film_targets(row.task.contact, *_numbers(row)) for row in rows]),
        np.array([row.solved.central_film for row in rows]),
        np.array([row.solved.friction for row in rows]),
    )


def _numbers(row: SolveRow) -> tuple[float, float]:
    return row.solved.central_film, row.solved.friction


def solved_rows(rows: Sequence[SolveRow], *kinds: str, fine: bool = False) -> list[SolveRow]:
    """Return the rows of some kinds on one grid that did not fail, by kind and index."""

    def on_grid(task: FilmTask) -> bool:
        kind = kind_of(task.contact)
        return task.nodes == (kind.fine if fine else kind.coarse)

    found = [r for r in rows if r.task.kind in kinds and on_grid(r.task) and not r.failure]
    return sorted(found, key=lambda row: (row.task.kind, row.task.number))


def grid_corrections(rows: Sequence[SolveRow], *kinds: str) -> tuple[Targets, Array]:
    """Return contacts solved on both grids, and what leads from the coarse grid to the limit.

    The second is (n, 2): of ln h, and of ln(mu/mu_ref(h)).
    """
    fine = {(r.task.kind, r.task.number): r for r in solved_rows(rows, *kinds, fine=True)}
    coarse = [r for r in solved_rows(rows, *kinds) if (r.task.kind, r.task.number) in fine]
    finer = [fine[row.task.kind, row.task.number] for row in coarse]
    on_coarse, on_fine = targets_of(coarse), targets_of(finer)
    return on_coarse, TO_LIMIT * (on_fine.values - on_coarse.values)
