"""Which contacts are solved for a film model, and on which grids."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

from gearlube.studies.film_model.draws import widened
from gearlube.studies.film_model.kinds import Contact, ContactKind, kind_named
from gearlube.studies.film_model.line_samples import AXLE_BEARING
from gearlube_core.checks import check_within
from gearlube_core.film_model.model import FLANK, LINE, ROLLER
from gearlube_core.oil.lubricant import lubricant_names
from gearlube_core.oil.oil_file import read_oil

# seeds of the sets, added to that of the plan
_BOX, _VISITED, _FRESH, _CALIBRATION, _EDGE = range(5)
_LISTS = ("oils", "pairs", "bearings")
_FIRST_SHARE = 0.15  # of box and visited contacts, solved before all else: enough for a first fit


class FilmTask(NamedTuple):
    """One film to solve."""

    kind: str  # box, visited, edge: training; calibration, fresh: kept apart
    number: int  # of the contact in its set
    nodes: tuple[int, int]
    contact: Contact


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmPlan:
    """Contacts of a training set; the same plan gives the same contacts.

    Parameters
    ----------
    contact
        Kind of contact: "flank" of a hypoid axle, "line" of helical pairs, "roller" of bearings.
    oils
        Shipped oils or oil files, whose ranges the box holds; the machine runs in them.
    mesh_table
        Shipped mesh table of the axle, for flanks.
    pairs
        Shipped gear files, for lines.
    bearings
        Shipped bearings, for rollers; see `roller_samples.roller_contacts`.
    box, visited
        Contacts for training: of the box by a scrambled Sobol sequence, and what the axle or the
        pairs visit.
    edge
        More contacts of the box for training, where films are thick.
    calibration, fresh
        Independent contacts of the box and of the machine that no fit sees.
    fine_box, fine_visited, fine_edge, fine_fresh, fine_calibration
        How many of the first contacts of each set are solved on the second grid as well. It shows
        the error of the first.
    seed
        Seed of all random draws.

    Examples
    --------
    >>> FilmPlan(box=100, fine_box=10).solves  # calibration, fresh and fine_visited as they are
    1194
    """

    contact: str = FLANK
    oils: tuple[str, ...] = lubricant_names()
    mesh_table: str = "mohammadpour_2015"
    pairs: tuple[str, ...] = ("he_2007", "jamali_2015_a", "jamali_2015_b")
    bearings: tuple[str, ...] = (AXLE_BEARING, "wingertszahn_2023")
    box: int = 760
    visited: int = 300
    edge: int = 160
    calibration: int = 250
    fresh: int = 304
    fine_box: int = 60
    fine_visited: int = 30
    fine_edge: int = 20
    fine_fresh: int = 20
    fine_calibration: int = 0
    seed: int = 20

    def __post_init__(self) -> None:
        kind_named(self.contact)
        for name in ("box", "visited", "edge", "calibration", "fresh"):
            check_within(name, getattr(self, name), 1, 100_000)
        for name, most in (
            ("fine_box", self.box),
            ("fine_visited", self.visited),
            ("fine_edge", self.edge),
            ("fine_fresh", self.fresh),
            ("fine_calibration", self.calibration),
        ):
            check_within(name, getattr(self, name), 0, most)

    @property
    def solves(self) -> int:
        """Return how many films are solved."""
        return (
            self.box
            + self.visited
            + self.edge
            + self.calibration
            + self.fresh
            + self.fine_box
            + self.fine_visited
            + self.fine_edge
            + self.fine_fresh
            + self.fine_calibration
        )

    def described(self) -> dict[str, Any]:
        """Return the plan as names and numbers, for a file."""
        return {**asdict(self), **{name: list(getattr(self, name)) for name in _LISTS}}

    @classmethod
    def of(cls, described: dict[str, Any]) -> FilmPlan:
        """Return the plan that was described so.

        Raises
        ------
        ParameterError, TypeError
        """
        lists = {name: tuple(described[name]) for name in _LISTS if name in described}
        return cls(**{**described, **lists})

    @property
    def kind(self) -> ContactKind:
        """Return the kind of contact."""
        return kind_named(self.contact)

    @property
    def machines(self) -> tuple[str, ...]:
        """Return the names of what visits the contacts."""
        of_kind = {FLANK: (self.mesh_table,), LINE: self.pairs, ROLLER: self.bearings}
        return of_kind[self.contact]

    def tasks(self) -> list[FilmTask]:
        """Return all films to solve; a first share of the training set leads.

        Raises
        ------
        ParameterError
            An oil or the mesh table is not known.
        """
        oils = tuple(read_oil(name).lubricant for name in self.oils)
        kind, machines = self.kind, self.machines
        box_of = widened(kind.box, oils)
        box = kind.box_contacts(box_of, self.box, self.seed + _BOX)
        visited = kind.visits(self.visited, self.seed + _VISITED, machines, oils, kind.trained)
        fresh = kind.visits(self.fresh, self.seed + _FRESH, machines, oils, kind.domain)
        kept = kind.box_contacts(box_of, self.calibration, self.seed + _CALIBRATION, random=True)
        edge = kind.edge_contacts(box_of, self.edge, self.seed + _EDGE)
        first_box = math.ceil(_FIRST_SHARE * len(box))
        first_visited = math.ceil(_FIRST_SHARE * len(visited))
        nodes, second, name = kind.nodes, kind.second, kind.visited
        return [
            *_tasks("box", box[:first_box], nodes),
            *_tasks(name, visited[:first_visited], nodes),
            *_tasks("fresh", fresh, nodes),
            *_tasks("box", box[first_box:], nodes, first_box),
            *_tasks(name, visited[first_visited:], nodes, first_visited),
            *_tasks("calibration", kept, nodes),
            *_tasks("box", box[: self.fine_box], second),
            *_tasks(name, visited[: self.fine_visited], second),
            *_tasks("edge", edge, nodes),
            *_tasks("edge", edge[: self.fine_edge], second),
            *_tasks("fresh", fresh[: self.fine_fresh], second),
            *_tasks("calibration", kept[: self.fine_calibration], second),
        ]


def _tasks(
    kind: str, contacts: Sequence[Contact], nodes: tuple[int, int], first: int = 0
) -> list[FilmTask]:
    return [FilmTask(kind, first + n, nodes, one) for n, one in enumerate(contacts)]
