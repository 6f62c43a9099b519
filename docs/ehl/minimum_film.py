"""Smallest film behind the moving relief: how it depends on stencil, grid and time step."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from docs.ehl.claims import MISSING, MM, UM
from docs.ehl.printed_film import printed_film_table
from docs.ehl.store import MissingFilmError, Store
from docs.helical.pages import table
from gearlube_core.ehl.gears.helical_cycle import march_helical_cycle
from gearlube_core.ehl.gears.helical_film import jamali_2015_film
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.storage.atomic_file import write_arrays

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
    Variant((97, 81), "upwind-2"),
    Variant((97, 81), "quick"),
    Variant((97, 81), "quick", 2),
    Variant((97, 81), "quick", 4),
    Variant((97, 161), "quick"),
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
    path = store.folder / f"{variant.name}.npz"
    if not path.exists():
        if not store.compute:
            raise MissingFilmError(variant.name)
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
        write_arrays(path, dict(zip(_COLUMNS, map(np.asarray, values), strict=True)), compress=True)
    with np.load(path) as data:
        steady, moving, x, y, failures = (float(data[name]) for name in _COLUMNS)
    return Thinnest(steady, moving, x, y, int(failures))


def extrapolated(store: Store) -> tuple[float, float]:
    """Return the smallest film in motion that shorter time steps go to, and its error [m].

    Between the first and the second order of the last halving, on the finest grid; its error is
    what that halving changes.
    """
    before, last = (thinnest(store, one).moving for one in VARIANTS[-2:])
    return last + (last - before) * 2.0 / 3.0, abs(last - before)


def _in_words(store: Store) -> str:
    film, error = extrapolated(store)
    whole = thinnest(store, VARIANTS[-4]).moving
    nodes = VARIANTS[-1].nodes
    return (
        f"\nOn {nodes[0]} x {nodes[1]} nodes the films of shorter steps approach {UM * film:.3f} "
        f"um, with an error of {UM * error:.3f} um; the thesis' own steps give a film that is "
        f"{100.0 * (whole / film - 1.0):.0f} % too thick.\n\n**The printed film is probably too "
        "thick because of numerical errors.** The thesis names three wedges (sec. 3.7.1),\none of "
        "first order, and does not say which was used for these films. The one of first order on "
        "the thesis' own\nspacing gives the same films in motion as the thesis. It also gives its "
        "result that more time steps change little,\nbecause the wedge smooths out what passes.\n"
    )


def minimum_film_section(store: Store) -> str:
    """Return the section with its table; a variant that is missing is said to be."""
    text = (Path(__file__).parent / "text" / "minimum_film.md").read_text(encoding="utf-8")
    rows = []
    for variant in VARIANTS:
        row = [f"{variant.nodes[0]} x {variant.nodes[1]}", variant.wedge, f"{variant.substeps}"]
        try:
            film = thinnest(store, variant)
        except MissingFilmError:
            rows.append([*row, MISSING, "", "", ""])
            continue
        rows.append(
            [*row, f"{UM * film.steady:.3f}", f"{UM * film.moving:.3f}",
             f"{MM * film.x:.2f}, {MM * film.y:.1f}", f"{film.failures}"]
        )  # fmt: skip
    heads = ["Nodes", "Wedge", "Time steps for one", f"At rest, step {FIRST}, um"]
    heads += [f"In motion, step {LAST}, um", "There at x, y, mm", "Steps not converged"]
    try:
        more = _in_words(store) + printed_film_table(store)
    except MissingFilmError as error:
        more = f"\nThe films of the thesis' scheme: {MISSING} (`{error}`).\n"
    return text + table(heads, rows) + more
