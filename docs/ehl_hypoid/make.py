"""Rewrite docs/ehl_hypoid.md and its pictures: python -m docs.ehl_hypoid.make [workdir].

Solves the shipped flank and its variants, some five minutes of one core. What is finished is kept
in the folder given as argument, by default build/ehl_hypoid; run again to go on after a stop.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from docs.ehl_hypoid.grid import grid_sentence
from gearlube.studies.films.hypoid.summary import RatioRow, ratio_rows
from gearlube.studies.films.run_hypoid import run_hypoid
from gearlube_core.ehl.case.hypoid_case import HypoidCase

ROOT = Path(__file__).resolve().parents[2]
TEXT = Path(__file__).parent / "text.md"


class Variant(NamedTuple):
    """One run of the page."""

    name: str
    title: str
    changes: dict[str, Any]
    march: bool


CASE = HypoidCase.named("mohammadpour_2015")
HALF = (CASE.solver.steady + 1) // 2  # every second one of the drive flank's positions
COAST_TORQUE = -20.0  # N.m
VARIANTS = (
    Variant(
        "drive",
        f"Drive flank, {CASE.pinion_torque_n_m:g} N.m, {CASE.pinion_speed_rpm:g} rpm",
        {},
        True,
    ),
    Variant(
        "newtonian",
        "The same, a film that flows as a Newtonian one",
        {"flow": "newtonian", "solver.steady": HALF},
        False,
    ),
    Variant(
        "thermal",
        "The same, with heat in the steady films",
        {"temperature": "thermal", "solver.steady": HALF},
        False,
    ),
    Variant(
        "moving_contact",
        "The same, entrainment against the moving point of contact",
        {"entrainment": "moving_contact", "solver.steady": HALF},
        False,
    ),
    Variant(
        "coast",
        f"Coast flank, {COAST_TORQUE:g} N.m",
        {"pinion_torque_n_m": COAST_TORQUE, "solver.steady": 7},
        False,
    ),
)
_UNITS = {"m": (1e6, "µm"), "Pa": (1e-9, "GPa"), "1": (1.0, ""), "deg": (1.0, "°")}


def solved(work: Path, variant: Variant) -> xr.Dataset:
    """Return the data set of a variant, solved where it is not there."""
    out = work / variant.name
    if not (out / "hypoid.nc").exists():
        case = CASE.varied(variant.changes) if variant.changes else CASE
        run_hypoid(case, march=variant.march, folder=out)
    return xr.load_dataset(out / "hypoid.nc", engine="scipy")


def table(rows: list[RatioRow]) -> str:
    """Return the summary as a table."""
    lines = ["| Quantity | Of | Least | Largest | Mean | Unit |", "|---|---|---|---|---|---|"]
    for row in rows:
        factor, unit = _UNITS.get(row.unit, (1.0, row.unit))
        numbers = (row.least, row.largest, row.load_weighted_mean)
        texts = " | ".join(f"{factor * value:.3g}" for value in numbers)
        lines.append(f"| {row.quantity} | {row.source} | {texts} | {unit} |")
    return "\n".join(lines) + "\n"


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


def findings(drive: list[RatioRow], sets: dict[str, xr.Dataset]) -> str:
    """Return what the runs say, with their numbers."""

    def of(rows: list[RatioRow], quantity: str, source: str) -> RatioRow:
        return next(row for row in rows if (row.quantity, row.source) == (quantity, source))

    def span(quantity: str, source: str) -> str:
        row = of(drive, quantity, source)
        return f"{row.least:.2f} to {row.largest:.2f}"

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

    def over(source: str) -> float:
        return of(thermal, "friction", f"{source}, over thermal").load_weighted_mean

    def loss(least: float, largest: float) -> str:
        return f"{100.0 * (1.0 - largest):.1f} to {100.0 * (1.0 - least):.1f} %"

    return f"""## What the runs say

- **Chittenden at the entrainment's angle**, the film of the axle model, is
  {span("central film", "Chittenden et al. 1985")} times the solved central film and
  {span("minimum film", "Chittenden et al. 1985")} times the smallest one. The ellipse is slender: a
  line carries no information along itself, so that what flows along the major axis neither
  adds to the film nor leaves it. The formula counts part of it.
- **The component across the contact alone**, u cos(psi) with psi = 0 in the same formula, gives
  {span("central film", "Chittenden, minor-axis component")} and
  {span("minimum film", "Chittenden, minor-axis component")}.
- **Grubin** gives {span("central film", "Grubin 1949")}: too thin without an angle, too thick at a
  large one, and right in between by cancellation.
- **Evans and Johnson** as the axle has it is {own:.2f} times the integrated friction. With the
  solution's film and Roelands' viscosity at the mean pressure in place of exp(alpha p) it is
  {like:.2f}: most of the excess is the exponential. Heat takes little here: friction at the oil's
  temperature throughout is {cool:.2f} times the heated one.
- **Heat** in the whole contact, surfaces included, takes more: the film is up to
  {hot["rise in the film"].largest:.0f} K and a flank's surface up to
  {hot["rise of a surface"].largest:.0f} K above the oil, both flanks in bulk at the oil's
  temperature. Central films lose {loss(hot_film.least, hot_film.largest)}, smallest ones
  {loss(hot_min.least, hot_min.largest)}. Friction is {cooled:.2f} times that at the oil's
  temperature and {heated:.2f} times the one heated across the film with cool surfaces, of which
  the lines above tell. Evans and Johnson's formula, which knows both parts of the heat, is
  {over("Evans and Johnson 1986"):.2f} times the friction of the thermal films, with the
  solution's film and Roelands' viscosity
  {over("Evans and Johnson, film and Roelands"):.2f}: its excess over the solution is larger than
  the isothermal films let it seem.
- **Eyring's flow** changes the central film by {h_c}, the smallest one by
  {h_min} and the friction by {friction}
  against a film that flows as a Newtonian one. It flattens the pressure spikes of the lightly
  loaded ends: the largest pressure changes by {p_max}.
- **Squeeze** is small: central films in time are {squeeze.least:.2f} to
  {squeeze.largest:.2f} of the steady ones. At first the closing contact holds oil that it met with
  less load; later the film lags behind rising speed and falling load. Quasi-steady formulas
  are good enough here.
- **The point of contact moves** along the tooth, against the entrainment. Counted against it the
  speed is larger, and the mean central film by {thicker:.0f} %. The axle model and the mesh table
  leave this out; it makes up for part of what Chittenden's angle adds.

![Films, pressure and friction](images/ehl_hypoid_curves.png)

![Ratios](images/ehl_hypoid_ratios.png)

![Contours](images/ehl_hypoid_contours.png)

"""


def main() -> None:
    """Solve what is missing, write the page and the pictures."""
    work = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "ehl_hypoid"
    sets = {one.name: solved(work, one) for one in VARIANTS}
    rows = {name: ratio_rows(dataset) for name, dataset in sets.items()}
    page = TEXT.read_text(encoding="utf-8").format(
        nodes_minor=CASE.solver.nodes_minor,
        nodes_major=CASE.solver.nodes_major,
        grids=grid_sentence(work, CASE),
        smallest_load=f"{CASE.smallest_load:g}",
    )
    page += findings(rows["drive"], sets)
    for one in VARIANTS:
        page += f"## {one.title}\n\n{table(rows[one.name])}\n"
    (ROOT / "docs" / "ehl_hypoid.md").write_text(page.rstrip() + "\n", encoding="utf-8")
    images = ROOT / "docs" / "images"
    for picture in sorted((work / "drive" / "figures").glob("*.png")):
        shutil.copyfile(picture, images / f"ehl_hypoid_{picture.name}")


if __name__ == "__main__":
    main()
