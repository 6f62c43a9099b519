"""March cases A, B and C of the thesis with five seeds each, on one coarse grid; compare them.

python -m docs.rough_line_contact.cases [FOLDER [NAME ...]]: ten minutes of one processor. Marches
are kept as those of `variants`. Writes cases.csv and prints a table for each grid; numbers of
marches that are not in the folder stay as they are. Those on the finer grid, whose names end in
", fine", take one to eight minutes each and are marched only if named.
"""

from __future__ import annotations

import csv
import logging
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from docs.rough_line_contact.compare import SEEDS, Found, of
from docs.rough_line_contact.make import GRID, ROOT
from docs.rough_line_contact.variants import rows_of, seeded
from gearlube.output.csv_text import csv_text
from gearlube.studies.films.rough.run import run_rough
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.storage.atomic_file import write_text

NUMBERS = Path(__file__).parent / "cases.csv"
# the waves of every seed of every case fit this grid; roughness grows in place
COARSE: dict[str, Any] = GRID | {
    "solver.nodes_x": 209,
    "solver.rows": 32,
    "surface_1.cutoff_um": 72.0,
    "surface_2.cutoff_um": 72.0,
    "times.steps_per_half_width": 56,
    "times.feed": "in_place",
    "times.until_rough": 0.8,
    "times.rough": 1.2,
    "solver.tolerance": 1e-4,
    "frames.every": 0,
}
LAYS: dict[str, dict[str, Any]] = {
    "crossed": {},
    "straight": {"surface_1.turns": 0, "surface_2.turns": 0, "solver.rows": 16},
}
ANGLES = {"A": 2.8, "B": 2.8, "C": 1.0}  # between both lays [deg]
# waves from 42 um on, so that solids touch; the same schedule
FINE: dict[str, Any] = COARSE | {
    "solver.nodes_x": 309,
    "solver.rows": 48,
    "surface_1.cutoff_um": 42.0,
    "surface_2.cutoff_um": 42.0,
    "times.steps_per_half_width": 80,
}
GRIDS = {"": COARSE, ", fine": FINE}
MARCHES = {
    f"case {case}, {lay}, seed {seed}{grid}": (case, lay, seed, grid)
    for grid in GRIDS
    for seed in SEEDS
    for case in ANGLES
    for lay in LAYS
}
THIN_SHOWN = "zone below 100 nm [%]"
TABLE = (
    "its mean over time [GPa]",
    "pressure that 99.9 % are below [GPa]",
    "film that 1 % are below [nm]",
    "film that 50 % are below [nm]",
    "zone below 10 nm [%]",
    THIN_SHOWN,
)
THIN = 100e-9  # m
THIN_SHARE = "share of the zone below 100 nm, rough"
logger = logging.getLogger("docs.rough_line_contact")


def case_of(name: str) -> RoughCase:
    """Return the case of a march."""
    case, lay, seed, grid = MARCHES[name]
    named = RoughCase.named(f"jamali_2015_{case.lower()}")
    return named.varied(GRIDS[grid] | LAYS[lay] | seeded(seed))


def written() -> dict[str, list[tuple[str, str, float, str]]]:
    """Return what cases.csv holds: march, and its rows."""
    rows: dict[str, list[tuple[str, str, float, str]]] = {}
    with NUMBERS.open(newline="") as file:
        for name, quantity, value, unit in list(csv.reader(file))[1:]:
            rows.setdefault(name, []).append((name, quantity, float(value), unit))
    return rows


def numbers() -> Found:
    """Return what was written: march, quantity, value."""
    return {name: {row[1]: row[2] for row in rows} for name, rows in written().items()}


def of_seeds(found: Found, case: str, lay: str, grid: str, shown: str) -> np.ndarray:
    """Return a number of the seeds that were marched with both lays."""
    names = ([f"case {case}, {one}, seed {seed}{grid}" for one in (lay, *LAYS)] for seed in SEEDS)
    kept = [own for own, *both in names if set(both) <= set(found)]
    if shown == THIN_SHOWN:
        return np.array([100.0 * found[name][THIN_SHARE] for name in kept])
    return np.array([of(found, name, shown) for name in kept])


def ratio(crossed: np.ndarray, straight: np.ndarray) -> str:
    """Return mean, spread, least and largest of the ratios of the seeds."""
    some = straight > 0.0
    each = crossed[some] / straight[some]
    if each.size < 2:
        return "-"
    return f"{each.mean():.2f} +- {each.std(ddof=1):.2f} ({each.min():.2f} to {each.max():.2f})"


def table(found: Found, grid: str) -> Iterable[Sequence[str]]:
    """Crossed and straight, and one over the other: mean, and least to largest, of the seeds."""
    yield ("", *(f"case {case}, {angle} deg" for case, angle in ANGLES.items()))
    for shown in TABLE:
        both = [[of_seeds(found, case, lay, grid, shown) for lay in LAYS] for case in ANGLES]
        for k, lay in enumerate(LAYS):
            values = (pair[k] for pair in both)
            yield (
                f"{shown}, {lay}",
                *(f"{v.mean():.3g} ({v.min():.3g} to {v.max():.3g})" for v in values),
            )
        yield (f"{shown}, crossed over straight", *(ratio(*pair) for pair in both))


def main(work: Path, names: list[str]) -> None:
    """March what is asked for, write the numbers of all that is finished, print the table."""
    rows, before = [], written()
    for name in MARCHES:
        done = work / name.replace(", ", "_").replace(" ", "_") / "rough.nc"
        if name in names and not done.exists():
            logger.info("%s", name)
            run_rough(case_of(name), folder=done.parent)
        if done.exists():
            run = xr.load_dataset(done, engine="scipy")
            below = np.interp(THIN, run["film_edge"].values, run["film_function"].values)
            rows += [*rows_of(name, run), (name, THIN_SHARE, float(below), "1")]
        else:
            rows += before.get(name, [])
    lines = ((n, q, f"{v:.4g}", u) for n, q, v, u in rows)
    write_text(csv_text(("variant", "quantity", "value", "unit"), lines), NUMBERS)
    found = numbers()
    for grid in GRIDS:
        sys.stdout.write("\n")
        for row in table(found, grid):
            sys.stdout.write("| " + " | ".join(row) + " |\n")


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    main(
        Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "rough_line_contact" / "cases",
        sys.argv[2:] or [name for name, march in MARCHES.items() if not march[-1]],
    )
