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
    """Return the smallest film of a design as the thesis may have solved it [m]."""
    return float(printed_films(store, THIN[design])["minimum_film"].min())


def printed_film_table(store: Store) -> str:
    """Return films of a first-order wedge on the thesis' spacing beside those it prints."""
    rows = [
        [
            f"{design.upper()}, smallest of steps {run.first} to {run.last}",
            f"{UM * thinnest_printed(store, design):.3f}",
            "0.16, of the whole cycle",
        ]
        for design, run in THIN.items()
    ]
    for (crown, run), printed in zip(MIDDLE.items(), ("0.21", "0.14"), strict=True):
        film = printed_films(store, run)["minimum_film"][-1]
        rows.append([f"A, F_o = {crown:g} F, step {LOOK}", f"{UM * film:.3f}", printed])
    for run in SHORT.values():
        film = printed_films(store, run)["minimum_film"][-1]
        words = f"A, step {run.last}, from rest at {run.first}, time steps for one: {run.substeps}"
        rows.append([words, f"{UM * film:.3f}", ""])
    heads = ["Film in motion", f"{WEDGE}, {NODES[0]} x {NODES[1]} nodes, um", "Thesis, um"]
    return table(heads, rows)
