"""Solved films as targets of a fit: logarithms over what the kernel's references give."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.plan import COARSE, FINE
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core.arrays import Array
from gearlube_core.film_model.groups import (
    FilmContact,
    contact_groups,
    contact_parts,
    reference_film,
    semi_minor_axis,
)
from gearlube_core.film_model.reference_friction import reference_friction

# of second order in the spacing: the finer grid's distance to the limit is a third of that between
# the grids, and the coarser one's four thirds
TO_LIMIT = 4.0 / 3.0


class Targets(NamedTuple):
    """Solved contacts, n of them, all on one grid."""

    contacts: tuple[FilmContact, ...]
    groups: Array  # (n, N_GROUPS)
    values: Array  # (n, 2): ln(h/h_ref), ln(mu/mu_ref(h))
    film: Array  # (n,) [m]
    friction: Array  # (n,) [-]


def film_targets(contact: FilmContact, film: float, friction: float) -> tuple[float, float]:
    """Return ln(h/h_ref) and ln(mu/mu_ref(h))."""
    place, inlet = contact_parts(contact)
    first = reference_film(contact.load, contact.entrainment_speed, place, inlet)
    return math.log(film / first), math.log(friction / expected_friction(contact, film))


def expected_friction(contact: FilmContact, film: float) -> float:
    """Return the reference of the friction [-] for a film [m]."""
    place, inlet = contact_parts(contact)
    p = place.pressure_coefficient * contact.load ** (1.0 / 3.0)
    across = contact.entrainment_speed * place.cos_psi
    semi_axis = semi_minor_axis(contact.load, p, place)
    return reference_friction(film, p, across, contact.sliding_speed, semi_axis, inlet)


def targets_of(rows: Sequence[SolveRow]) -> Targets:
    """Return the targets of rows that were solved."""
    contacts = tuple(row.task.contact for row in rows)
    return Targets(
        contacts,
        np.array([contact_groups(one) for one in contacts]),
        np.array([film_targets(row.task.contact, *_numbers(row)) for row in rows]),
        np.array([row.solved.central_film for row in rows]),
        np.array([row.solved.friction for row in rows]),
    )


def _numbers(row: SolveRow) -> tuple[float, float]:
    return row.solved.central_film, row.solved.friction


def solved_rows(rows: Sequence[SolveRow], *kinds: str, fine: bool = False) -> list[SolveRow]:
    """Return the rows of some kinds on one grid that did not fail, by kind and index."""
    nodes = FINE if fine else COARSE
    found = [r for r in rows if r.task.kind in kinds and r.task.nodes == nodes and not r.failure]
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
