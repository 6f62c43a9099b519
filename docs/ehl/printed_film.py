"""Films in motion as the thesis solved them: first-order wedge on its own spacing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.ehl.claims import UM
from docs.ehl.store import MissingFilmError, Store
from docs.helical.pages import table
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_cycle import march_helical_cycle
from gearlube_core.ehl.gears.helical_film import jamali_2015_film
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.helical_geometry.sample_modifications import jamali_2015
from gearlube_core.storage.atomic_file import write_arrays

NODES = (182, 161)  # the thesis' 182 across; along the line its 857 change nothing
WEDGE = "upwind-1"
SUBSTEPS = (1, 4)
LOOK = 300  # step whose films are printed for two crowns
CROWN = 0.45  # F_o over F
_COLUMNS = ("step", "minimum_film", "failures")


@dataclass(frozen=True, slots=True)
class PrintedRun:
    """A march of a design between two steps; `crown_start` over the face width."""

    design: str
    first: int = 0
    last: int = 575
    crown_start: float = 0.0
    substeps: int = 1

    @property
    def name(self) -> str:
        """Return the run in a file name."""
        return (
            f"printed_film_{self.design}_{self.first}to{self.last}_crown{self.crown_start:g}_"
            f"{self.substeps}"
        )


CYCLES = {design: PrintedRun(design) for design in "ab"}
CROWNED = PrintedRun("a", LOOK - 40, LOOK, CROWN)
SHORT = {n: PrintedRun("a", 470, 490, 0.0, n) for n in SUBSTEPS}


def printed_films(store: Store, run: PrintedRun) -> dict[str, Array]:
    """Return steps and their smallest films [m], marched if they are not in the folder."""
    path = store.folder / f"{run.name}.npz"
    if not path.exists():
        if not store.compute:
            raise MissingFilmError(run.name)
        width = jamali_2015(run.design).pair.face_width
        cycle = march_helical_cycle(
            jamali_2015_film(
                run.design, crown_start=run.crown_start * width, nodes=NODES, solids=None
            ),
            first=run.first,
            last=run.last,
            substeps=run.substeps,
            settings=PointSolverSettings(tolerance=1e-5, wedge=WEDGE),
            throw=False,
        )
        values = (cycle["step"], cycle["minimum_film"], np.asarray(cycle.failures))
        write_arrays(path, dict(zip(_COLUMNS, values, strict=True)), compress=True)
    with np.load(path) as data:
        return {name: data[name] for name in _COLUMNS}


def thinnest_printed(store: Store, design: str) -> float:
    """Return the smallest film of the whole cycle as the thesis solved it [m]."""
    return float(printed_films(store, CYCLES[design])["minimum_film"].min())


def printed_film_table(store: Store) -> str:
    """Return films of the thesis' scheme and spacing beside those it prints."""
    a, b = (printed_films(store, CYCLES[d])["minimum_film"] for d in "ab")
    crowned = printed_films(store, CROWNED)["minimum_film"][-1]
    short = [printed_films(store, SHORT[n])["minimum_film"][-1] for n in SUBSTEPS]
    rows = [
        ["A, smallest of the cycle", f"{UM * a.min():.3f}", "0.16"],
        ["A, step 300", f"{UM * a[LOOK]:.3f}", "0.21"],
        [f"A, F_o = {CROWN:g} F, step 300", f"{UM * crowned:.3f}", "0.14"],
        ["B, smallest of the cycle", f"{UM * b.min():.3f}", "0.16"],
        [
            f"A, step 490, from rest at 470: {SUBSTEPS[0]} / {SUBSTEPS[1]} time steps for one",
            " / ".join(f"{UM * one:.3f}" for one in short),
            "",
        ],
    ]
    heads = ["Film in motion", f"{WEDGE}, {NODES[0]} x {NODES[1]} nodes, um", "Thesis, um"]
    return table(heads, rows)
