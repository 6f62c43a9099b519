"""Smallest film behind the moving relief: how it depends on stencil, grid and time step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.ehl.claims import MM, UM
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import Page
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import march_helical_cycle
from gearlube_core.ehl.point.settings import PointSolverSettings
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_film

FIRST, LAST = 470, 490  # steps of design A; the contact is crossed in 17
_COLUMNS = ("steady", "moving", "x", "y", "failures")


@dataclass(frozen=True, slots=True)
class Variant:
    """Nodes across and along the line, stencil, time steps for one of the thesis."""

    nodes: tuple[int, int]
    wedge: str
    substeps: int = 1

    @property
    def name(self) -> str:
        """Return the variant in a file name."""
        return f"minimum_film_{self.nodes[0]}x{self.nodes[1]}_{self.wedge}_{self.substeps}"


VARIANTS = (
    Variant((97, 81), "upwind-1"),
    Variant((97, 81), "upwind-1", 4),
    Variant((97, 81), "quick"),
    *(Variant((193, 161), "quick", n) for n in (1, 2, 4, 8)),
)


@dataclass(frozen=True, slots=True)
class Thinnest:
    """Smallest film at rest at the first step and in motion at the last [m], and its place [m]."""

    steady: float
    moving: float
    x: float
    y: float
    failures: int


def thinnest(store: Store, variant: Variant) -> Thinnest:
    """Return the smallest films of a variant, marched if they are not in the folder."""

    def marched() -> dict[str, Array]:
        cycle = march_helical_cycle(
            jamali_2015_film("a", nodes=variant.nodes, solids=None),
            first=FIRST,
            last=LAST,
            substeps=variant.substeps,
            settings=PointSolverSettings(tolerance=1e-5, wedge=variant.wedge),
            throw=False,
        )
        film, x, y = (cycle[name] for name in ("minimum_film", "minimum_film_x", "minimum_film_y"))
        values = (film[0], film[-1], x[-1], y[-1], cycle.failures)
        return dict(zip(_COLUMNS, map(np.asarray, values), strict=True))

    data = store.kept(variant.name, marched)
    steady, moving, x, y, failures = (float(data[name]) for name in _COLUMNS)
    return Thinnest(steady, moving, x, y, int(failures))


def extrapolated(store: Store) -> tuple[float, float]:
    """Return the smallest film in motion that shorter time steps go to, and its error [m].

    Between the first and the second order of the last halving, on the finest grid; its error is
    what that halving changes.
    """
    before, last = (thinnest(store, one).moving for one in VARIANTS[-2:])
    return last + (last - before) * 2.0 / 3.0, abs(last - before)


def put_minimum_film(page: Page, store: Store) -> None:
    """Put in the smallest films of all variants, and what they lead to."""
    rows = []
    for variant in VARIANTS:
        try:
            film = thinnest(store, variant)
        except MissingFilmError:
            return
        place = f"{MM * film.x:.2f}, {MM * film.y:.1f}"
        films = (f"{UM * film.steady:.3f}", f"{UM * film.moving:.3f}")
        rows.append([*films, place, f"{film.failures}"])
    page.cells("Nodes | Wedge", rows, first=3)
    film, error = extrapolated(store)
    whole = thinnest(store, VARIANTS[-4]).moving
    page.fill(
        "nodes the films of shorter steps approach {} um, with an error of {} um; the thesis' own "
        "steps give a film that is {} % too thick",
        f"{UM * film:.3f}",
        f"{UM * error:.3f}",
        f"{100.0 * (whole / film - 1.0):.0f}",
    )
    try:
        page.cells("Film in motion", printed_film_rows(store), first=1)
    except MissingFilmError:
        return


_NODES = (182, 161)  # the thesis' 182 across; along the line its 857 change nothing
_WEDGE = "upwind-1"
_SUBSTEPS = (1, 4)
LOOK = 300  # step whose films are printed for two crowns
CROWN = 0.45  # F_o over F
_PRINTED = ("step", "minimum_film", "failures")


@dataclass(frozen=True, slots=True)
class PrintedRun:
    """A march of a design between two steps; `crown_start` over the face width."""

    design: str
    first: int
    last: int
    crown_start: float = 0.0
    substeps: int = 1

    @property
    def name(self) -> str:
        """Return the run in a file name."""
        return (
            f"printed_film_{self.design}_{self.first}to{self.last}_crown{self.crown_start:g}_"
            f"{self.substeps}"
        )


# where the films of the cycle are thinnest, as `quick` finds them over the whole of it
THIN = {"a": PrintedRun("a", 460, 515), "b": PrintedRun("b", 0, 60)}
MIDDLE = {crown: PrintedRun("a", LOOK - 40, LOOK, crown) for crown in (0.0, CROWN)}
SHORT = {n: PrintedRun("a", 470, 490, 0.0, n) for n in _SUBSTEPS}


def printed_films(store: Store, run: PrintedRun) -> dict[str, Array]:
    """Return steps and their smallest films [m], marched if they are not in the folder."""

    def marched() -> dict[str, Array]:
        width = jamali_2015(run.design).pair.face_width
        cycle = march_helical_cycle(
            jamali_2015_film(
                run.design, crown_start=run.crown_start * width, nodes=_NODES, solids=None
            ),
            first=run.first,
            last=run.last,
            substeps=run.substeps,
            settings=PointSolverSettings(tolerance=1e-5, wedge=_WEDGE),
            throw=False,
        )
        values = (cycle["step"], cycle["minimum_film"], np.asarray(cycle.failures))
        return dict(zip(_PRINTED, values, strict=True))

    return store.kept(run.name, marched)


def thinnest_printed(store: Store, design: str) -> float:
    """Return the smallest film of a design as the thesis may have solved it [m]."""
    return float(printed_films(store, THIN[design])["minimum_film"].min())


def printed_film_rows(store: Store) -> list[list[str]]:
    """Return films of a first-order wedge on the thesis' spacing."""
    runs = (*MIDDLE.values(), *SHORT.values())
    films = [thinnest_printed(store, design) for design in THIN]
    films += [float(printed_films(store, run)["minimum_film"][-1]) for run in runs]
    return [[f"{UM * film:.3f}"] for film in films]
