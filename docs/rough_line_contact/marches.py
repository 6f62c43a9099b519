"""March what docs/rough_line_contact.md compares: seeds, cases, speeds, grids and tolerances.

python -m docs.rough_line_contact.marches variants|cases [FOLDER [NAME ...]]: hours of one processor
for `variants`, ten minutes for `cases`, which are cases A, B and C with five seeds each on a coarse
grid. Those on its finer grid, whose names end in ", fine", take one to eight minutes each and are
marched only if named. Each march is kept in a folder of its own, by default below
build/rough_line_contact; a stopped one goes on, a finished one is only read. Writes variants.csv or
cases.csv; numbers of marches that are not in the folder stay. `tables` puts them into the page.
"""

from __future__ import annotations

import csv
import logging
import sys
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from docs.page import ROOT
from docs.rough_line_contact.make import GRID, distribution_rows
from gearlube.output.csv_text import csv_text
from gearlube.studies.films.rough.files import summary_rows
from gearlube.studies.films.rough.run import run_rough
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.storage.atomic_file import write_text

HERE = Path(__file__).parent
SEEDS = (1, 2, 4, 5, 6)
Rows = list[tuple[str, str, float, str]]  # march, quantity, value, unit
STRAIGHT: dict[str, Any] = {"surface_1.turns": 0, "surface_2.turns": 0, "solver.rows": 16}
SPEEDS = (7.9285, 5.4915)  # of case A [m/s]
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
THIN = 100e-9  # m
THIN_SHARE = "share of the zone below 100 nm, rough"
logger = logging.getLogger("docs.rough_line_contact")


def seeded(seed: int) -> dict[str, Any]:
    """Return the change to the stand-in profiles of a seed."""
    return {"surface_1.seed": seed, "surface_2.seed": seed}


def faster(factor: float) -> dict[str, Any]:
    """Return the change to a multiple of both speeds."""
    return {f"speed_{k}_m_s": factor * speed for k, speed in enumerate(SPEEDS, start=1)}


def filtered(micrometres: float | None) -> dict[str, Any]:
    """Return the change to another shortest wave; None: no filter."""
    return {"surface_1.cutoff_um": micrometres, "surface_2.cutoff_um": micrometres}


A = "jamali_2015_a"
WIDER: dict[str, Any] = {"solver.nodes_x": 281}  # the waves of case C fit no fewer columns
FINER: dict[str, Any] = {
    "solver.nodes_x": 385,
    "solver.rows": 60,
    "times.steps_per_half_width": 120,
}
HIS_COLUMNS: dict[str, Any] = {
    "solver.nodes_x": 801,
    "times.steps_per_half_width": 400,
    "solver.tolerance": 10.0,  # times that of `GRID`: the default
    "frames.every": 0,
    "frames.steps": [2500, 4000, 4480],
}
VARIANTS: dict[str, tuple[str, dict[str, Any]]] = {
    "crossed": (A, {}),
    "straight": (A, STRAIGHT),
    **{
        f"{lay}, seed {seed}": (A, seeded(seed) | more)
        for seed in (2, 4, 5, 6)
        for lay, more in (("straight", STRAIGHT), ("crossed", {}))
    },
    "case B, crossed": ("jamali_2015_b", {}),
    "case B, straight": ("jamali_2015_b", STRAIGHT),
    "case C, crossed": ("jamali_2015_c", WIDER),
    "case C, straight": ("jamali_2015_c", STRAIGHT | WIDER),
    "crossed, 2 u": (A, faster(2.0)),
    "straight, 2 u": (A, STRAIGHT | faster(2.0)),
    "crossed, 5 u": ("jamali_2015_d", {}),
    "straight, 5 u": ("jamali_2015_d", STRAIGHT),
    "crossed, tolerances a tenth": (A, {"solver.tolerance": 0.1, "solver.load_tolerance": 0.1}),
    "crossed, half time step": (A, {"times.steps_per_half_width": 160}),
    "crossed, Crank-Nicolson": (A, {"solver.scheme": "crank_nicolson"}),
    "crossed, layer 5 nm": (A, {"touching.thickness_um": 0.005}),
    "crossed, layer 20 nm": (A, {"touching.thickness_um": 0.02}),
    "crossed, 64 rows": (A, {"solver.rows": 64}),
    "crossed, 1.5 u": (A, faster(1.5)),
    "straight, 1.5 u": (A, STRAIGHT | faster(1.5)),
    "crossed, 3 u": (A, faster(3.0)),
    "crossed, finer grid": (A, FINER),
    "crossed, finer grid, waves from 28 um": (A, FINER | filtered(28.0)),
    # the columns, the time step and the schedule of the thesis, 4488 steps
    "his columns, 32 rows": (A, HIS_COLUMNS | {"solver.rows": 32} | filtered(54.0)),
    "his columns, 64 rows": (A, HIS_COLUMNS | {"solver.rows": 64} | filtered(27.0)),
    "his columns, 128 rows": (A, HIS_COLUMNS | {"solver.rows": 128} | filtered(13.5)),
    "his columns, 256 rows": (A, HIS_COLUMNS | {"solver.rows": 256} | filtered(6.75)),
}


def case_of(name: str) -> RoughCase:
    """Return the case of a march; tolerances of variants are shares of those of `GRID`."""
    if name in MARCHES:
        case, lay, seed, grid = MARCHES[name]
        named = RoughCase.named(f"jamali_2015_{case.lower()}")
        return named.varied(GRIDS[grid] | LAYS[lay] | seeded(seed))
    shipped, more = VARIANTS[name]
    shares = ("solver.tolerance", "solver.load_tolerance")
    scaled = {key: value * GRID[key] if key in shares else value for key, value in more.items()}
    return RoughCase.named(shipped).varied(GRID | {"frames.every": 1000} | scaled)


def folder_of(work: Path, name: str) -> Path:
    """Return the folder of a march."""
    return work / name.replace(", ", "_").replace(" ", "_")


def rows_of(name: str, run: xr.Dataset) -> Rows:
    """Return the numbers of one march."""
    rows = [(name, *row) for row in summary_rows(run)]
    rough = run.isel(time=run["time"].values >= run.attrs["rough_time"] * (1.0 - 1e-12))
    for k, limit in enumerate(rough["threshold"].values):
        nodes, share = (rough[what].values[:, k] for what in ("contact_nodes", "contact_share"))
        below = f"below {1e9 * limit:.0f} nm"
        rows.append((name, f"share of steps with a film {below}", float((nodes > 0).mean()), "1"))
        rows.append((name, f"share of the zone {below}, rough", float(share.mean()), "1"))
    rows += distribution_rows(name, run)
    if name in MARCHES:
        below = np.interp(THIN, run["film_edge"].values, run["film_function"].values)
        rows.append((name, THIN_SHARE, float(below), "1"))
    return rows


def written(table: str) -> dict[str, Rows]:
    """Return what a table holds: march, and its rows."""
    rows: dict[str, Rows] = {}
    with (HERE / f"{table}.csv").open(newline="") as file:
        for name, quantity, value, unit in list(csv.reader(file))[1:]:
            rows.setdefault(name, []).append((name, quantity, float(value), unit))
    return rows


def main(table: str, work: Path, names: list[str]) -> None:
    """March what is asked for, and write the numbers of all that is finished."""
    rows, before = [], written(table)
    for name in VARIANTS if table == "variants" else MARCHES:
        done = folder_of(work, name) / "rough.nc"
        if name in names and not done.exists():
            logger.info("%s", name)
            run_rough(case_of(name), folder=done.parent)
        if done.exists():
            rows += rows_of(name, xr.load_dataset(done, engine="scipy"))
        else:
            rows += before.get(name, [])
    lines = ((n, q, f"{v:.4g}", u) for n, q, v, u in rows)
    text = csv_text(("variant", "quantity", "value", "unit"), lines)
    write_text(text, HERE / f"{table}.csv")


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    chosen, *rest = sys.argv[1:]
    usual = ROOT / "build" / "rough_line_contact"
    usual /= "cases" if chosen == "cases" else ""
    every = list(VARIANTS) if chosen == "variants" else [n for n, m in MARCHES.items() if not m[-1]]
    main(chosen, Path(rest[0]) if rest else usual, rest[1:] or every)
