"""Targets of a fit from solved films, and errors of a model at them with bounds for most others."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.kinds import Contact, kind_of
from gearlube.studies.film_model.plan import FilmTask
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

CONFIDENCE = 0.95


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


class Misses(NamedTuple):
    """Relative errors of a model at solved contacts, (n, 2) of film and friction [-]."""

    values: Array

    def summary(self) -> dict[str, float | int]:
        """Return number, root mean square and largest of both [%]."""
        rms = 100.0 * np.sqrt((self.values**2).mean(axis=0))
        most = 100.0 * np.abs(self.values).max(axis=0)
        return {
            "contacts": len(self.values),
            "film_rms_percent": round(float(rms[0]), 4),
            "film_max_percent": round(float(most[0]), 4),
            "friction_rms_percent": round(float(rms[1]), 4),
            "friction_max_percent": round(float(most[1]), 4),
        }

    def violations(self, bounds: tuple[float, float]) -> tuple[int, int]:
        """Return how many errors of film and friction are above the bounds."""
        over = (np.abs(self.values) > np.array(bounds)).sum(axis=0)
        return int(over[0]), int(over[1])


def conformal_bounds(errors: Array) -> tuple[float, float]:
    """Return the bounds of split conformal prediction from errors (n, 2).

    The ceil((n + 1) CONFIDENCE)-th smallest amount: the next contact drawn alike exceeds it with
    a probability of at most 1 - CONFIDENCE [vovk_2005].

    Examples
    --------
    >>> import numpy as np
    >>> conformal_bounds(np.arange(1.0, 20.0)[:, None] * np.array([[1.0, -2.0]]))
    (19.0, 38.0)
    """
    rank = math.ceil((len(errors) + 1) * CONFIDENCE)
    if rank > len(errors):
        raise ParameterError(f"Bounds need at least 19 calibration contacts, got {len(errors)}.")
    ordered = np.sort(np.abs(errors), axis=0)
    return float(ordered[rank - 1, 0]), float(ordered[rank - 1, 1])


def tests_table(predicted: Mapping[str, Array], solved: Mapping[str, Array]) -> str:
    """Return films [m] and frictions of a model beside solved ones as CSV, by kind of contact."""
    lines = ["kind,film_model_m,film_solved_m,friction_model,friction_solved"]
    for kind in predicted:
        for own, true in zip(predicted[kind], solved[kind], strict=True):
            numbers = (own[0], true[0], own[1], true[1])
            lines.append(",".join([kind, *(f"{number:.6g}" for number in numbers)]))
    return "\n".join(lines) + "\n"
