"""Which contacts are solved for a film model, and on which grids."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

from gearlube.studies.film_model.samples import (
    DOMAIN,
    TRAINED,
    axle_contacts,
    box_contacts,
    edge_contacts,
    widened_box,
)
from gearlube_core.checks import check_within
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.oil.oil_file import read_oil

COARSE, FINE = (129, 33), (257, 65)
# seeds of the sets, added to that of the plan
_BOX, _AXLE, _FRESH, _CALIBRATION, _EDGE = range(5)
TRAINING = ("box", "axle", "edge")
_FIRST_SHARE = 0.15  # of box and axle, solved before all else: enough for a first fit


class FilmTask(NamedTuple):
    """One film to solve."""

    kind: str  # box, axle, edge: training; calibration, fresh: kept apart
    number: int  # of the contact in its set
    nodes: tuple[int, int]
    contact: FilmContact


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmPlan:
    """Contacts of a training set; the same plan gives the same contacts.

    Parameters
    ----------
    oils
        Shipped oils or oil files, whose ranges the box holds; the axle runs in them.
    mesh_table
        Shipped mesh table of the axle.
    box, axle
        Contacts for training: of the box by a scrambled Sobol sequence, and of the axle.
    edge
        More contacts of the box for training, where films are thick.
    calibration, fresh
        Independent contacts of the box and of the axle that no fit sees.
    fine_box, fine_axle, fine_edge, fine_fresh
        How many of the first contacts of each set are solved on the finer grid as well.
    seed
        Of all draws.

    Examples
    --------
    >>> FilmPlan(box=100, fine_box=10).solves  # calibration, fresh and fine_axle as they are
    1194
    """

    oils: tuple[str, ...] = ("mohammadpour_2015", "karagiannis_2012")
    mesh_table: str = "mohammadpour_2015"
    box: int = 760
    axle: int = 300
    edge: int = 160
    calibration: int = 250
    fresh: int = 304
    fine_box: int = 60
    fine_axle: int = 30
    fine_edge: int = 20
    fine_fresh: int = 20
    seed: int = 20

    def __post_init__(self) -> None:
        for name in ("box", "axle", "edge", "calibration", "fresh"):
            check_within(name, getattr(self, name), 1, 100_000)
        for name, most in (
            ("fine_box", self.box),
            ("fine_axle", self.axle),
            ("fine_edge", self.edge),
            ("fine_fresh", self.fresh),
        ):
            check_within(name, getattr(self, name), 0, most)

    @property
    def solves(self) -> int:
        """Return how many films are solved."""
        return (
            self.box
            + self.axle
            + self.edge
            + self.calibration
            + self.fresh
            + self.fine_box
            + self.fine_axle
            + self.fine_edge
            + self.fine_fresh
        )

    def described(self) -> dict[str, Any]:
        """Return the plan as names and numbers, for a file."""
        return {**asdict(self), "oils": list(self.oils)}

    def tasks(self) -> list[FilmTask]:
        """Return all films to solve; a first share of the training set leads.

        Raises
        ------
        ParameterError
            An oil or the mesh table is not known.
        """
        oils = tuple(read_oil(name).lubricant for name in self.oils)
        mesh = shipped_mesh_table(self.mesh_table)
        box_of = widened_box(oils)
        box = box_contacts(box_of, self.box, self.seed + _BOX)
        axle = axle_contacts(self.axle, self.seed + _AXLE, mesh, oils, TRAINED)
        fresh = axle_contacts(self.fresh, self.seed + _FRESH, mesh, oils, DOMAIN)
        kept = box_contacts(box_of, self.calibration, self.seed + _CALIBRATION, random=True)
        edge = edge_contacts(box_of, self.edge, self.seed + _EDGE)
        first_box = math.ceil(_FIRST_SHARE * len(box))
        first_axle = math.ceil(_FIRST_SHARE * len(axle))
        return [
            *_tasks("box", box[:first_box], COARSE),
            *_tasks("axle", axle[:first_axle], COARSE),
            *_tasks("fresh", fresh, COARSE),
            *_tasks("box", box[first_box:], COARSE, first_box),
            *_tasks("axle", axle[first_axle:], COARSE, first_axle),
            *_tasks("calibration", kept, COARSE),
            *_tasks("box", box[: self.fine_box], FINE),
            *_tasks("axle", axle[: self.fine_axle], FINE),
            *_tasks("edge", edge, COARSE),
            *_tasks("edge", edge[: self.fine_edge], FINE),
            *_tasks("fresh", fresh[: self.fine_fresh], FINE),
        ]


def _tasks(
    kind: str, contacts: Sequence[FilmContact], nodes: tuple[int, int], first: int = 0
) -> list[FilmTask]:
    return [FilmTask(kind, first + n, nodes, one) for n, one in enumerate(contacts)]
