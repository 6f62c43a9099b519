"""March what docs/rough_line_contact.md compares: other seeds, cases, speeds, grids and tolerances.

python -m docs.rough_line_contact.variants [FOLDER [NAME ...]]: hours of one processor. Each march
is kept in a folder of its own, by default below build/rough_line_contact; a stopped one goes on, a
finished one is only read. Writes variants.csv from all that are finished.
"""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import Any

import xarray as xr

from docs.rough_line_contact.make import GRID, ROOT
from gearlube.output.csv_text import csv_text
from gearlube.studies.films.rough.files import summary_rows
from gearlube.studies.films.rough.run import run_rough
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.storage.atomic_file import write_text

NUMBERS = Path(__file__).parent / "variants.csv"
STRAIGHT: dict[str, Any] = {"surface_1.turns": 0, "surface_2.turns": 0, "solver.rows": 16}
SPEEDS = (7.9285, 5.4915)  # of case A [m/s]
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
}


def case_of(name: str) -> RoughCase:
    """Return the case of a variant; its tolerances are shares of those of `GRID`."""
    shipped, more = VARIANTS[name]
    case = RoughCase.named(shipped)
    shares = ("solver.tolerance", "solver.load_tolerance")
    scaled = {key: value * GRID[key] if key in shares else value for key, value in more.items()}
    return case.varied(GRID | {"frames.every": 1000} | scaled)


def rows_of(name: str, run: xr.Dataset) -> list[tuple[str, str, float, str]]:
    """Return the numbers of one march: name, quantity, value, unit."""
    rows = [(name, *row) for row in summary_rows(run)]
    rough = run.isel(time=run["time"].values >= run.attrs["rough_time"] * (1.0 - 1e-12))
    for k, limit in enumerate(rough["threshold"].values):
        nodes, share = (rough[what].values[:, k] for what in ("contact_nodes", "contact_share"))
        below = f"below {1e9 * limit:.0f} nm"
        rows.append((name, f"share of steps with a film {below}", float((nodes > 0).mean()), "1"))
        rows.append((name, f"share of the zone {below}, rough", float(share.mean()), "1"))
    for percent in (1.0, 5.0, 50.0):
        film = float(run["film_percentile_all"].sel(percent=percent))
        rows.append((name, f"film that {percent:g} % of the zone is below", film, "m"))
    for percent in (50.0, 99.0, 99.9):
        pressure = float(run["pressure_percentile_all"].sel(percent=percent))
        rows.append((name, f"pressure that {percent:g} % is below", pressure, "Pa"))
    return rows


def main(work: Path, names: list[str]) -> None:
    """March what is asked for, and write the numbers of all that is finished."""
    for name in names:
        done = work / name.replace(", ", "_").replace(" ", "_") / "rough.nc"
        if not done.exists():
            logger.info("%s", name)
            run_rough(case_of(name), folder=done.parent)
    rows = []
    for name in VARIANTS:
        done = work / name.replace(", ", "_").replace(" ", "_") / "rough.nc"
        if done.exists():
            rows += rows_of(name, xr.load_dataset(done, engine="scipy"))
    lines = ((n, q, f"{v:.4g}", u) for n, q, v, u in rows)
    write_text(csv_text(("variant", "quantity", "value", "unit"), lines), NUMBERS)


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    main(
        Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "rough_line_contact",
        sys.argv[2:] or list(VARIANTS),
    )
