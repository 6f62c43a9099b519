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


def solved_rows(rows: Sequence[SolveRow], *kinds: str, second: bool = False) -> list[SolveRow]:
    """Return the rows of some kinds on one grid that did not fail, by kind and index."""

    def on_grid(task: FilmTask) -> bool:
        kind = kind_of(task.contact)
        return task.nodes == (kind.second if second else kind.nodes)

    found = [r for r in rows if r.task.kind in kinds and on_grid(r.task) and not r.failure]
    return sorted(found, key=lambda row: (row.task.kind, row.task.number))


def grid_corrections(rows: Sequence[SolveRow], *kinds: str) -> tuple[Targets, Array]:
    """Return contacts solved on both grids, and what leads from the first to the limit.

    The second is (n, 2): of ln h, and of ln(mu/mu_ref(h)).
    """
    others = {(r.task.kind, r.task.number): r for r in solved_rows(rows, *kinds, second=True)}
    first = [r for r in solved_rows(rows, *kinds) if (r.task.kind, r.task.number) in others]
    other = [others[row.task.kind, row.task.number] for row in first]
    on_first, on_second = targets_of(first), targets_of(other)
    share = np.array([kind_of(one).to_limit for one in on_first.contacts])
    return on_first, share[:, None] * (on_second.values - on_first.values)


def own_steps(rows: Sequence[SolveRow], kind: str) -> Array:
    """Return what leads each solved contact of a kind to the limit, (n, 2), by its second grid.

    NaN where it was not solved on the second grid; order and quantities as of `targets_of` and
    `grid_corrections`.
    """
    both, steps = grid_corrections(rows, kind)
    found = dict(zip(both.contacts, steps, strict=True))
    none = np.full(2, np.nan)
    return np.array([found.get(row.task.contact, none) for row in solved_rows(rows, kind)])
