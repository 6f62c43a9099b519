"""Numbers and pictures of docs/ehl_hypoid.md: python -m docs.ehl_hypoid.make [workdir].

Solves the shipped flank and its variants, some five minutes of one core. What is finished is kept
in the folder given as argument, by default build/ehl_hypoid; run again to go on after a stop.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from docs.kept_films import KeptFilms
from docs.page import IMAGES, Page, begin
from gearlube.studies.films.hypoid.flank import HypoidFlank, hypoid_flank
from gearlube.studies.films.hypoid.summary import RatioRow, ratio_rows
from gearlube.studies.films.run_hypoid import run_hypoid
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.transient.curves import central_film
from gearlube_core.ehl.transient.steady import solve_steady_film


class Film(NamedTuple):
    """Central and smallest film [m]."""

    central: float
    minimum: float


def _solved(flank: HypoidFlank, nodes: tuple[int, int]) -> Film:
    film = replace(flank.film, nodes=nodes)
    first, last = film.cycle.time[[0, -1]]
    middle = 0.5 * float(first + last)
    solution = solve_steady_film(film.moving_film(), middle, flank.case.settings())
    return Film(central_film(solution), solution.minimum_film)


def _grids(nodes: tuple[int, int]) -> tuple[list[int], list[int]]:
    """Return half, three quarters and all of the nodes across; all and more of those along."""
    across, along = (count - 1 for count in nodes)
    return [across * k // 4 + 1 for k in (2, 3, 4)], [along * k // 2 + 1 for k in (2, 3, 6)]


def _below(values: list[float], across: list[int]) -> str:
    """Return how far the films on three grids lie below what they go to, to second order."""
    finer = (across[-1] - 1) / (across[0] - 1)
    limit = values[-1] + (values[-1] - values[0]) / (finer**2 - 1.0)
    return listed([f"{100.0 * (1.0 - value / limit):.1f}" for value in values]) + " %"


def listed(words: list[str]) -> str:
    """Return words as "a, b and c"."""
    return f"{', '.join(words[:-1])} and {words[-1]}"


def put_grids(page: Page, work: Path, case: HypoidCase) -> None:
    """Put in what the grid decides; films are kept in `work`."""
    across, along = _grids((case.solver.nodes_minor, case.solver.nodes_major))

    def solve() -> dict[str, Any]:
        flank = hypoid_flank(case)
        grids = [*((n, along[0]) for n in across), *((across[-1], n) for n in along[1:])]
        return {"films": np.array([_solved(flank, nodes) for nodes in grids])}

    films = [Film(*row) for row in KeptFilms(work).kept("grids", solve)["films"].tolist()]
    coarse_to_fine, longer = films[: len(across)], films[len(across) :]
    moved = max(
        abs(there / here - 1.0)
        for film in longer
        for there, here in zip(film, coarse_to_fine[-1], strict=True)
    )
    page.fill(
        "In the middle of the engagement {} nodes across leave the central film {} and the "
        "smallest one {} below what they go to, to second order; {} nodes along it change neither "
        "by more than {} %.",
        listed([str(n) for n in across]),
        _below([film.central for film in coarse_to_fine], across),
        _below([film.minimum for film in coarse_to_fine], across),
        " or ".join(str(n) for n in along[1:]),
        f"{100.0 * moved:.1g}",
    )


class Variant(NamedTuple):
    """One run of the page."""

    name: str
    changes: dict[str, Any]
    march: bool = False


CASE = HypoidCase.named("mohammadpour_2015")
HALF = (CASE.solver.steady + 1) // 2  # every second one of the drive flank's positions
VARIANTS = (  # in the order of the table of means
    Variant("drive", {}, True),
    Variant("newtonian", {"flow": "newtonian", "solver.steady": HALF}),
    Variant("thermal", {"temperature": "thermal", "solver.steady": HALF}),
    Variant("moving_contact", {"entrainment": "moving_contact", "solver.steady": HALF}),
    Variant("coast", {"pinion_torque_n_m": -20.0, "solver.steady": 7}),
)
MEANS = (  # rows of the table of means: quantity, formula
    ("central film", "Chittenden et al. 1985"),
    ("central film", "Chittenden, minor-axis component"),
    ("central film", "Grubin 1949"),
    ("minimum film", "Chittenden et al. 1985"),
    ("largest pressure", "Hertz"),
    ("friction", "Evans and Johnson 1986"),
    ("friction", "Evans and Johnson, film and Roelands"),
    ("friction", "axle, with asperities"),
    ("friction", "Eyring, isothermal"),
)
_UNITS = {"m": (1e6, "µm"), "Pa": (1e-9, "GPa"), "1": (1.0, ""), "deg": (1.0, "°")}


def solved(work: Path, variant: Variant) -> xr.Dataset:
    """Return the data set of a variant, solved where it is not there."""
    out = work / variant.name
    if not (out / "hypoid.nc").exists():
        case = CASE.varied(variant.changes) if variant.changes else CASE
        run_hypoid(case, march=variant.march, folder=out)
    return xr.load_dataset(out / "hypoid.nc", engine="scipy")


def cells(rows: list[RatioRow]) -> Iterator[list[str]]:
    """Yield the rows of a summary."""
    for row in rows:
        factor, unit = _UNITS.get(row.unit, (1.0, row.unit))
        numbers = (row.least, row.largest, row.load_weighted_mean)
        yield [row.quantity, row.source, *(f"{factor * one:.3g}" for one in numbers), unit]


def of(rows: list[RatioRow], quantity: str, source: str) -> RatioRow:
    """Return one row of a summary."""
    return next(row for row in rows if (row.quantity, row.source) == (quantity, source))


def means(runs: list[list[RatioRow]]) -> Iterator[list[str]]:
    """Yield the load-weighted means of formulas over solution, of all runs."""
    for quantity, source in MEANS:
        found = (of(rows, quantity, source).load_weighted_mean for rows in runs)
        yield [f"{quantity}, {source}", *(f"{one:.3g}" for one in found)]


def changes(given: xr.Dataset, other: xr.Dataset, name: str) -> str:
    """Return how much a steady quantity of every second position lies above another run's."""
    ratio = given[f"steady_{name}"].values[::2] / other[f"steady_{name}"].values
    # adding zero takes the sign off a rounded zero
    least, most = (round(100.0 * (float(end) - 1.0), 1) + 0.0 for end in (ratio.min(), ratio.max()))
    return f"{least:.1f} to {most:.1f} %"


def gain(drive: xr.Dataset, moving: xr.Dataset) -> float:
    """Return how much thicker the central film is [%], weighted with the load."""
    weight = moving["steady_load"].values
    films = (moving["steady_central_film"].values, drive["steady_central_film"].values[::2])
    counted, plain = ((weight * film).sum() for film in films)
    return float(100.0 * (counted / plain - 1.0))


def put_findings(page: Page, drive: list[RatioRow], sets: dict[str, xr.Dataset]) -> None:
    """Put the numbers into what the runs say."""

    def spans(source: str) -> list[str]:
        found = [of(drive, quantity, source) for quantity in ("central film", "minimum film")]
        return [f"{row.least:.2f} to {row.largest:.2f}" for row in found]

    names = ("central_film", "minimum_film", "traction_heated", "pressure_max")
    h_c, h_min, friction, p_max = (
        changes(sets["drive"], sets["newtonian"], name) for name in names
    )
    thicker = gain(sets["drive"], sets["moving_contact"])
    own = of(drive, "friction", "Evans and Johnson 1986").load_weighted_mean
    like = of(drive, "friction", "Evans and Johnson, film and Roelands").load_weighted_mean
    cool = of(drive, "friction", "Eyring, isothermal").load_weighted_mean
    squeeze = of(drive, "central film", "in time")
    thermal = ratio_rows(sets["thermal"])
    hot = {row.quantity: row for row in thermal if row.source == "solution, thermal"}
    hot_film = of(thermal, "central film", "thermal, over isothermal")
    hot_min = of(thermal, "minimum film", "thermal, over isothermal")
    cooled = of(thermal, "friction", "thermal, over isothermal Eyring").load_weighted_mean
    heated = of(thermal, "friction", "thermal, over heated Eyring").load_weighted_mean

    def over(source: str) -> str:
        return f"{of(thermal, 'friction', f'{source}, over thermal').load_weighted_mean:.2f}"

    def loss(least: float, largest: float) -> str:
        return f"{100.0 * (1.0 - largest):.1f} to {100.0 * (1.0 - least):.1f} %"

    grubin = spans("Grubin 1949")[0]
    for words, values in (
        ("of the axle model, is {} times the solved central film and {} times the smallest one",
         spans("Chittenden et al. 1985")),
        ("with psi = 0 in the same formula, gives {} and {}.",
         spans("Chittenden, minor-axis component")),
        ("**Grubin** gives {}: too thin", [grubin]),
        ("as the axle has it is {} times the integrated friction.", [f"{own:.2f}"]),
        ("in place of exp(alpha p) it is {}: most of the excess", [f"{like:.2f}"]),
        ("at the oil's temperature throughout is {} times the heated one", [f"{cool:.2f}"]),
        ("the film is up to {} K and a flank's surface up to {} K above the oil",
         [f"{hot[key].largest:.0f}" for key in ("rise in the film", "rise of a surface")]),
        ("Central films lose {}, smallest ones {}. Friction is {} times that at the oil's "
         "temperature and {} times the one heated across",
         [loss(hot_film.least, hot_film.largest), loss(hot_min.least, hot_min.largest),
          f"{cooled:.2f}", f"{heated:.2f}"]),
        ("Evans and Johnson's formula is {} times the friction of the thermal films",
         [over("Evans and Johnson 1986")]),
        ("thermal films, with the solution's film and Roelands' viscosity {}.",
         [over("Evans and Johnson, film and Roelands")]),
        ("changes the central film by {}, the smallest one by {} and the friction by {} against",
         [h_c, h_min, friction]),
        ("the largest pressure changes by {} (spikes", [p_max]),
        ("central films in time are {} to {} of the steady ones",
         [f"{squeeze.least:.2f}", f"{squeeze.largest:.2f}"]),
        ("Counted against it the mean central film is {} % thicker", [f"{thicker:.0f}"]),
    ):  # fmt: skip
        page.fill(words, *values)


def main(work: Path) -> None:
    """Solve what is missing, write the page and the pictures."""
    sets = {one.name: solved(work, one) for one in VARIANTS}
    rows, page = {name: ratio_rows(dataset) for name, dataset in sets.items()}, Page("ehl_hypoid")
    put_grids(page, work, CASE)
    put_findings(page, rows["drive"], sets)
    page.rows("Mean, over solution", means(list(rows.values())))
    drive = [row for row in rows["drive"] if row.unit != "over solution"]
    page.rows("Quantity | Of", cells(drive), "\n## Drive flank, 40 N.m, 1377 rpm\n")
    hot = [row for row in rows["thermal"] if row.source.startswith(("thermal", "solution, th"))]
    page.rows("Quantity | Of", cells(hot), "\n## With heat in the steady films\n")
    page.write()
    for picture in sorted((work / "drive" / "figures").glob("*.png")):
        shutil.copyfile(picture, IMAGES / f"ehl_hypoid_{picture.name}")


if __name__ == "__main__":
    main(begin("ehl_hypoid"))
