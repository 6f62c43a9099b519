"""Films of a map of smooth elliptical contacts and what the published formulas give for them.

Loads and materials are the groups of Moes with the radius along the short axis of the contact.
Every contact is solved on two grids; the finer one counts and both tell the error of the grid.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, astuple, dataclass
from functools import partial
from typing import Any

from docs.kept_films import KeptFilms, MissingFilmError
from gearlube.studies.films.film_formulas import point_film_formulas
from gearlube_core.contact.hertz import log_curvature_ratio
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.film.point_film import regime_films
from gearlube_core.oil.film_oil_data import film_oil

ELLIPTICITIES = (1.0, 2.0, 3.0, 5.0, 8.0)  # those of Hamrock and Dowson 1977: one to eight
LOADS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MATERIALS = (2.5, 5.0, 10.0, 15.0)
ANGLES = (0.0, 30.0, 60.0, 90.0)  # of entrainment against the short axis, degrees
TURNED = tuple((k, M, L) for k in (2.0, 3.0) for M, L in ((20.0, 5.0), (50.0, 10.0), (200.0, 10.0)))
COARSE, FINE = 129, 257

RADIUS = 0.01  # m, along the short axis
REDUCED_MODULUS = 2.26e11  # Pa
ALPHA = 2e-8  # 1/Pa
ETA0 = 0.04  # Pa s
_LIMITED = 0.01  # share of first-order faces from which a film is listed apart
HAMROCK_DOWSON, CHITTENDEN = "Hamrock and Dowson 1977", "Chittenden et al. 1985"
NIJENBANNING = "Nijenbanning et al. 1994"


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact of the map; entrainment at `angle` [degree] to the short axis."""

    ellipticity: float  # a_y/a_x of the dry contact
    M: float
    L: float
    angle: float = 0.0

    @property
    def radius_ratio(self) -> float:
        """Return R_y/R_x."""
        return math.exp(log_curvature_ratio(math.log(self.ellipticity)))

    @property
    def speed_group(self) -> float:
        """Return U."""
        return 0.5 * (self.L / (ALPHA * REDUCED_MODULUS)) ** 4

    @property
    def load_group(self) -> float:
        """Return W."""
        return self.M * (2.0 * self.speed_group) ** 0.75

    @property
    def rigid(self) -> bool:
        """Return whether rigid solids have a thicker film than elastic ones with a thick oil.

        After the regimes of Nijenbanning, Venner and Moes 1994.
        """
        films = regime_films(self.M, self.L, 1.0 / self.radius_ratio)
        piezoviscous = min(films.elastic_piezoviscous, films.rigid_piezoviscous)
        return films.rigid_isoviscous > piezoviscous

    def problem(self, nodes: int) -> PointContactProblem:
        """Return the contact on a square number of nodes."""
        speed = self.speed_group * REDUCED_MODULUS * RADIUS / ETA0
        psi = math.radians(self.angle)
        return elliptical_contact(
            R_x=RADIUS,
            R_y=RADIUS * self.radius_ratio,
            entrainment=(speed * math.cos(psi), speed * math.sin(psi)),
            load=self.load_group * REDUCED_MODULUS * RADIUS**2,
            contact_modulus=0.5 * REDUCED_MODULUS,
            lubricant=film_oil(eta0=ETA0, alpha=ALPHA),
            nodes=(nodes, nodes),
        )

    def formulas(self) -> dict[tuple[str, str], float]:
        """Return films [m] of the formulas by quantity and source."""
        found = point_film_formulas(self.problem(COARSE))
        return {(one.quantity, one.source): one.film for one in found}


@dataclass(frozen=True, slots=True)
class Film:
    """Film of a contact on one grid."""

    contact: Contact
    nodes: int
    converged: bool
    wedge: str  # stencil of the answer
    limited: float  # share of first-order faces
    central: float  # [m]
    minimum: float  # [m]
    seconds: float  # of the processor

    @property
    def sound(self) -> bool:
        """Return whether it converged with the stencil that was asked for, unlimited."""
        return self.converged and self.wedge == "upwind-2" and self.limited <= _LIMITED

    def height(self, quantity: str) -> float:
        """Return the film [m] of a quantity of the formulas."""
        return self.central if quantity == "central film" else self.minimum

    def ratio(self, quantity: str, source: str) -> float:
        """Return this film over that of a formula."""
        return self.height(quantity) / self.contact.formulas()[quantity, source]


def solve(contact: Contact, nodes: int) -> Film:
    """Return the film of a contact, converged or not."""
    began = time.process_time()
    settings = PointSolverSettings(estimate_error=False)  # each contact has two grids here
    found = solve_point_contact(contact.problem(nodes), settings, throw=False)
    return Film(
        contact,
        nodes,
        found.outcome.converged,
        found.outcome.wedge,
        found.outcome.limited,
        found.central_film,
        found.minimum_film,
        time.process_time() - began,
    )


def map_contacts() -> list[Contact]:
    """Return the contacts entrained along their short axes."""
    return [Contact(k, M, L) for k in ELLIPTICITIES for M in LOADS for L in MATERIALS]


def turned_contacts() -> list[Contact]:
    """Return the contacts entrained at an angle; 0 degrees among them."""
    return [Contact(*group, angle) for group in TURNED for angle in ANGLES]


Films = dict[tuple[Contact, int], Film]


def all_films(kept: KeptFilms) -> Films:
    """Return the films of the map; those that are missing and may not be solved are left out."""
    wanted = [(c, n) for c in (*map_contacts(), *turned_contacts()) for n in (COARSE, FINE)]
    films: Films = {}
    for contact, nodes in dict.fromkeys(wanted):
        name = "_".join(f"{one:g}" for one in (*astuple(contact), nodes))
        try:
            data = kept.kept(f"film_map_{name}", partial(_numbers, contact, nodes))
        except MissingFilmError:
            continue
        films[contact, nodes] = Film(contact, **{key: one.item() for key, one in data.items()})
    return films


def _numbers(contact: Contact, nodes: int) -> dict[str, Any]:
    film = asdict(solve(contact, nodes))
    del film["contact"]
    return film


@dataclass(frozen=True, slots=True)
class Spread:
    """How the films of some contacts lie about a formula; what failed lies outside any limit."""

    count: int
    failed: int
    mean: float  # of film over formula, of those that converged
    low: float
    high: float
    within: tuple[float, ...]  # shares of all within the limits asked for


def spread(ratios: Sequence[float], failed: int, limits: Iterable[float]) -> Spread:
    """Return the spread of ratios, with as many failures more."""
    count = len(ratios) + failed
    mean = sum(ratios) / len(ratios) if ratios else math.nan
    return Spread(
        count,
        failed,
        mean,
        min(ratios, default=math.nan),
        max(ratios, default=math.nan),
        tuple(sum(abs(ratio - 1.0) <= limit for ratio in ratios) / count for limit in limits),
    )


def grid_error(films: Films, contact: Contact, quantity: str) -> float:
    """Return the error of the finer grid's film, a third of what halving the spacing changed."""
    coarse, fine = films[contact, COARSE], films[contact, FINE]
    return abs(fine.height(quantity) / coarse.height(quantity) - 1.0) / 3.0
