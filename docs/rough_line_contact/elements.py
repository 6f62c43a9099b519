"""Finite elements against finite volumes in time: python -m docs.rough_line_contact.elements.

Two minutes of one processor. Prints numbers for docs/rough_line_contact.md. Films
are kept in the folder given as argument, by default build/rough_line_contact/elements.
"""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from docs.kept_films import KeptFilms
from docs.page import begin
from docs.rough_line_contact.make import GRID
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.transient.march import FilmMarch

SCHEMES = ("differences", "elements")
GRIDS = {241: 64, 385: 96}  # columns, steps per half width
LENGTH, SHOWN = 1.875, 0.125  # half widths of travel, and of travel between two kept films
FIRST = 6  # kept films before the one from which all is rough and carried on
MARCH: dict[str, Any] = GRID | {
    "solver.rows": 32,
    "surface_1.cutoff_um": 60.0,
    "surface_2.cutoff_um": 60.0,
    "times.feed": "in_place",
    "times.until_rough": 0.5,
    "solver.tolerance": 1e-4,
}
Films = tuple[np.ndarray, np.ndarray, np.ndarray]  # x over a, pressure [Pa], film [m]
logger = logging.getLogger("docs.rough_line_contact")


def marched(work: Path, scheme: str, columns: int) -> Films:
    """Return x over the half width, and pressure and film at the kept times, (times, nx, ny)."""

    def march_case() -> dict[str, np.ndarray]:
        steps = GRIDS[columns]
        case = RoughCase.named("jamali_2015_a").varied(
            MARCH
            | {
                "solver.nodes_x": columns,
                "solver.discretisation": scheme,
                "times.steps_per_half_width": steps,
            }
        )
        march = FilmMarch(case.film(), case.schedule().time_step, settings=case.settings())
        films = []
        for step in range(1, round(LENGTH * steps) + 1):
            solution = march.step()
            if step % round(SHOWN * steps) == 0:
                films.append((solution.pressure, solution.film))
                logger.info("%s, %d columns: step %d", scheme, columns, step)
        section = case.section()
        pressure, film = np.array(films).swapaxes(0, 1)
        return {"x": section.x / section.hertz_contact[0], "pressure": pressure, "film": film}

    kept = KeptFilms(work).kept(f"{scheme}_{columns}", march_case)
    return kept["x"], kept["pressure"][FIRST:], kept["film"][FIRST:]


def off(one: Films, other: Films) -> tuple[float, float]:
    """Return the rms difference of film [nm] and pressure [MPa] in the Hertz zone of `one`."""
    x = one[0]
    inside = np.abs(x) < 1.0
    pressure, film = (
        (CubicSpline(other[0], there, axis=1)(x) - here)[:, inside]
        for here, there in zip(one[1:], other[1:], strict=True)
    )
    return 1e9 * float(np.sqrt(np.mean(film**2))), 1e-6 * float(np.sqrt(np.mean(pressure**2)))


def main(work: Path) -> None:
    """March what is missing, print."""
    found = {(s, n): marched(work, s, n) for n in GRIDS for s in SCHEMES}
    coarse, fine = GRIDS
    for (scheme, columns), films in found.items():
        inside = np.abs(films[0]) < 1.0
        p, h = 1e-9 * films[1][:, inside], 1e9 * films[2][:, inside]
        lowest = h.min(axis=(1, 2))
        sys.stdout.write(
            f"{scheme}, {columns} columns: largest pressure {p.max(axis=(1, 2)).mean():.3f} GPa, "
            f"99.9 % below {np.percentile(p, 99.9):.3f} GPa, smallest film {lowest.min():.1f} and "
            f"{lowest.mean():.1f} nm, 1 and 50 % below {np.percentile(h, 1):.1f} and "
            f"{np.percentile(h, 50):.1f} nm, mean {h.mean():.1f} nm\n"
        )
    for name, one, other in (
        *((f"{s}, fine", (s, coarse), (s, fine)) for s in SCHEMES),
        *((f"schemes, {n} columns", ("differences", n), ("elements", n)) for n in GRIDS),
    ):
        film, pressure = off(found[one], found[other])
        sys.stdout.write(f"{name}: off by {film:.1f} nm, {pressure:.0f} MPa rms\n")


if __name__ == "__main__":
    main(begin("rough_line_contact/elements"))
