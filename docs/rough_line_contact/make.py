"""March and draw what docs/rough_line_contact.md shows: python -m docs.rough_line_contact.make.

Half an hour of one processor. Marches are kept in the folder given as argument, by default
build/rough_line_contact; a stopped one goes on. Draws docs/images/rough_film.gif and
rough_history.png, and writes numbers.csv.
"""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from docs.page import IMAGES, begin
from gearlube.output.csv_text import csv_text
from gearlube.studies.films.figures.rough import rough_history
from gearlube.studies.films.rough.animation import save_rough_animation
from gearlube.studies.films.rough.files import frame_file, read_frames, summary_rows
from gearlube.studies.films.rough.run import run_rough
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.storage.atomic_file import write_text

NUMBERS = Path(__file__).parent / "numbers.csv"
# an eighth of the nodes and a fifth of the steps of the thesis: waves from 30 um on
GRID: dict[str, Any] = {
    "solver.nodes_x": 257,
    "solver.rows": 40,
    "surface_1.cutoff_um": 42.0,
    "surface_2.cutoff_um": 42.0,
    "times.steps_per_half_width": 80,
    "solver.tolerance": 1e-5,
    "solver.load_tolerance": 1e-4,
    "frames.steps": [],
    "frames.every": 20,
}
# minutes: for the animation alone, waves from 80 um on
LIGHT: dict[str, Any] = GRID | {
    "solver.nodes_x": 161,
    "solver.rows": 24,
    "surface_1.cutoff_um": 80.0,
    "surface_2.cutoff_um": 80.0,
    "times.steps_per_half_width": 40,
    "frames.every": 8,
}
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "crossed": ("jamali_2015_a", {}),
    "no_flow": ("jamali_2015_a", {"side_conditions": "no_flow"}),
    "straight": ("jamali_2015_a_straight", {"solver.rows": 16}),
    "five_times": ("jamali_2015_d", {}),
}
SHOWN = (740, 820, 880)  # steps of the differences: 0.3, 0.6 and 0.9 of the rough part
logger = logging.getLogger("docs.rough_line_contact")


def marched(work: Path) -> dict[str, xr.Dataset]:
    """Return the statistics of all cases; what is there is not marched again."""
    found = {}
    for name, (shipped, more) in CASES.items():
        case, folder = RoughCase.named(shipped).varied(GRID | more), work / name
        done = folder / "rough.nc"
        if not done.exists():
            logger.info("%s", name)
            run_rough(case, folder=folder)
        found[name] = xr.load_dataset(done, engine="scipy")
    return found


def animation(work: Path) -> None:
    """March a light run and draw its films as docs/images/rough_film.gif."""
    case, folder = RoughCase.named("jamali_2015_a").varied(LIGHT), work / "light"
    if not (folder / "rough.nc").exists():
        logger.info("light")
        run_rough(case, folder=folder)
    films = xr.concat(list(read_frames(folder, case.key())), "time")
    save_rough_animation(
        films.isel(time=slice(1, None)), IMAGES / "rough_film.gif", per_second=8, dots_per_inch=64
    )


def frames(work: Path, name: str) -> xr.Dataset:
    """Return the kept films of a case at the steps that are shown."""
    return xr.concat(
        [xr.load_dataset(frame_file(work / name, step), engine="scipy") for step in SHOWN], "time"
    )


def numbers(work: Path, found: dict[str, xr.Dataset]) -> list[tuple[str, str, float, str]]:
    """Return the numbers of the page: case, quantity, value, unit."""
    rows = [(name, *row) for name, run in found.items() for row in summary_rows(run)]
    for name, run in found.items():
        rough = run.isel(time=run["time"].values >= run.attrs["rough_time"] * (1.0 - 1e-12))
        touched = (rough["contact_nodes"].values[:, 2] > 0.0).mean()
        rows.append((name, "share of rough steps with a film below 10 nm", float(touched), "1"))
        for k, limit in enumerate(rough["threshold"].values):
            nodes = float(rough["contact_share"].values[:, k].mean())
            words = f"share of the zone below {1e9 * limit:.0f} nm, rough"
            rows.append((name, words, nodes, "1"))
        rows += distribution_rows(name, run)
    rows += _side_numbers(work)
    return rows


def distribution_rows(name: str, run: xr.Dataset) -> list[tuple[str, str, float, str]]:
    """Return percentiles of film and pressure of a march: name, quantity, value, unit."""
    rows = []
    for percent in (1.0, 5.0, 50.0):
        film = float(run["film_percentile_all"].sel(percent=percent))
        rows.append((name, f"film that {percent:g} % of the zone is below", film, "m"))
    for percent in (50.0, 99.0, 99.9):
        pressure = float(run["pressure_percentile_all"].sel(percent=percent))
        rows.append((name, f"pressure that {percent:g} % is below", pressure, "Pa"))
    return rows


def _side_numbers(work: Path) -> list[tuple[str, str, float, str]]:
    cyclic, closed = frames(work, "crossed"), frames(work, "no_flow")
    half_width = RoughCase.named("jamali_2015_a").section().hertz_contact[0]
    inside = np.abs(cyclic["x"].values) < half_width
    y = cyclic["y"].values
    middle = (y > 0.2e-3) & (y < 0.8e-3)
    rows = []
    for k, step in enumerate(SHOWN):
        p, h = (
            (cyclic[name] - closed[name]).isel(time=k).transpose("x", "y").values[inside]
            for name in ("pressure", "film")
        )
        top = float(cyclic["pressure"].isel(time=k).max())
        last = {
            "largest difference of pressure": (float(np.abs(p).max()), "Pa"),
            "largest difference of pressure over p_max": (float(np.abs(p).max()) / top, "1"),
            "largest difference of film": (float(np.abs(h).max()), "m"),
            "the same of pressure, y 0.2 to 0.8 mm": (float(np.abs(p[:, middle]).max()), "Pa"),
            "the same of film, y 0.2 to 0.8 mm": (float(np.abs(h[:, middle]).max()), "m"),
            "correlation of differences of p at both sides": (
                float(np.corrcoef(p[:, 0], p[:, -1])[0, 1]),
                "1",
            ),
            "correlation of differences of p and h at the sides": (
                float(np.corrcoef(p[:, [0, -1]].ravel(), h[:, [0, -1]].ravel())[0, 1]),
                "1",
            ),
        }
        rows += [(f"sides, step {step}", words, *one) for words, one in last.items()]
    return rows


def main(work: Path) -> None:
    """March, draw, write."""
    animation(work)
    found = marched(work)
    slow = {name: found[name] for name in ("crossed", "straight")}
    figure = rough_history(slow, float(found["crossed"].attrs["time_step"]))
    figure.savefig(IMAGES / "rough_history.png", dpi=110)
    rows = ((c, q, f"{v:.4g}", u) for c, q, v, u in numbers(work, found))
    write_text(csv_text(("case", "quantity", "value", "unit"), rows), NUMBERS)


if __name__ == "__main__":
    main(begin("rough_line_contact"))
