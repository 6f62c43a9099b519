"""Tables and figure that compare marches: python -m docs.rough_line_contact.tables.

Prints the tables of docs/rough_line_contact.md from variants.csv and cases.csv, which `marches`
writes, and draws docs/images/rough_lambda.png; seconds.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence

import numpy as np

from docs.page import IMAGES
from docs.rough_line_contact.marches import ANGLES, GRIDS, LAYS, SEEDS, THIN_SHARE, written
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.contact.greenwood_tripp_1971 import asperity_load, gear_flanks
from gearlube_core.ehl.case.rough_case import RoughCase

Found = dict[str, dict[str, float]]
SHOWN = {
    "largest pressure [GPa]": ("largest pressure, rough", 1e-9),
    "its mean over time [GPa]": ("mean of the largest pressure, rough", 1e-9),
    "pressure that 99.9 % are below [GPa]": ("pressure that 99.9 % is below", 1e-9),
    "smallest film [nm]": ("smallest film, rough", 1e9),
    "film that 1 % are below [nm]": ("film that 1 % of the zone is below", 1e9),
    "film that 50 % are below [nm]": ("film that 50 % of the zone is below", 1e9),
    "steps with contact [%]": ("share of steps with a film below 10 nm", 100.0),
    "zone below 5 nm [%]": ("share of the zone below 5 nm, rough", 100.0),
    "zone below 10 nm [%]": ("share of the zone below 10 nm, rough", 100.0),
    "zone below 25 nm [%]": ("share of the zone below 25 nm, rough", 100.0),
    "load on solids [%]": ("share of the load on solids, rough", 100.0),
    "friction coefficient": ("friction coefficient, rough", 1.0),
    "zone below 100 nm [%]": (THIN_SHARE, 100.0),
    "smooth film/Rq": ("smooth film over roughness", 1.0),
    "mean film/Rq": ("mean film over roughness", 1.0),
}
_EACH = [shown for shown in SHOWN if shown != "zone below 100 nm [%]"]  # of variants
CHANGED = (
    "crossed",
    "crossed, tolerances a tenth",
    "crossed, half time step",
    "crossed, layer 5 nm",
    "crossed, layer 20 nm",
    "crossed, 64 rows",
    "crossed, finer grid",
    "crossed, finer grid, waves from 28 um",
)
TABLE = (
    "its mean over time [GPa]",
    "pressure that 99.9 % are below [GPa]",
    "film that 1 % are below [nm]",
    "film that 50 % are below [nm]",
    "zone below 10 nm [%]",
    "zone below 100 nm [%]",
)


def numbers(table: str) -> Found:
    """Return what was written: march, quantity, value."""
    return {name: {row[1]: row[2] for row in rows} for name, rows in written(table).items()}


def of(found: Found, variant: str, shown: str) -> float:
    """Return a number in the unit that is shown; nan: not there."""
    quantity, unit = SHOWN[shown]
    return unit * found.get(variant, {}).get(quantity, math.nan)


def seeds(found: Found, lay: str, shown: str) -> np.ndarray:
    """Return a number of the five seeds."""
    names = (lay if seed == 1 else f"{lay}, seed {seed}" for seed in SEEDS)
    return np.array([of(found, name, shown) for name in names])


def seed_rows(found: Found) -> Iterable[Sequence[str]]:
    """Mean, and least to largest, of five seeds; crossed over straight."""
    yield ("", "crossed", "straight", "crossed over straight, each seed")
    for shown in _EACH:
        crossed, straight = (seeds(found, lay, shown) for lay in ("crossed", "straight"))
        cells = (f"{v.mean():.3g} ({v.min():.3g} to {v.max():.3g})" for v in (crossed, straight))
        ratio = ", ".join(f"{one:.2f}" for one in crossed / straight)
        yield (shown, *cells, ratio)


def case_rows(found: Found, cases: Sequence[str]) -> Iterable[Sequence[str]]:
    """One column for each of some variants."""
    yield ("", *cases)
    for shown in _EACH:
        yield (shown, *(f"{of(found, case, shown):.3g}" for case in cases))


def film_ratio_rows(found: Found) -> Iterable[Sequence[str]]:
    """Film over roughness, contact, load of solids and of Greenwood and Tripp; shares in %."""
    yield ("march", "smooth film/Rq", "mean film/Rq", "zone below 10 nm", "load on solids",
           "heights that overlap, rigid", "load, Greenwood and Tripp")  # fmt: skip
    section = RoughCase.named("jamali_2015_a").section()
    mean_pressure = 0.25 * math.pi * section.hertz_contact[2]
    marches = sorted(
        (name for name in found if name not in CHANGED[1:]),
        key=lambda name: of(found, name, "smooth film/Rq"),
    )
    for name in marches:
        mean = of(found, name, "mean film/Rq")
        # share of a Gaussian surface that stands higher than the mean film
        overlap = 0.5 * math.erfc(mean / math.sqrt(2.0))
        law = asperity_load(mean, 1.0, section.contact_modulus, gear_flanks(1.0)) / mean_pressure
        yield (
            name,
            f"{of(found, name, 'smooth film/Rq'):.2f}",
            f"{mean:.2f}",
            f"{of(found, name, 'zone below 10 nm [%]'):.2g}",
            f"{of(found, name, 'load on solids [%]'):.2g}",
            *(f"{100.0 * share:.2g}" for share in (overlap, law)),
        )


def draw(found: Found) -> None:
    """Draw contact share and load on solids over the film ratio."""
    with house_style():
        figure = new_figure(8.0, 4.0)
        left, right = figure.subplots(1, 2)
        for k, lay in enumerate(("crossed", "straight")):
            names = [
                name for name in found if name.split(",")[0] == lay and name not in CHANGED[1:]
            ]
            ratio = [of(found, name, "smooth film/Rq") for name in names]
            for ax, shown in ((left, "zone below 25 nm [%]"), (right, "load on solids [%]")):
                share = [of(found, name, shown) for name in names]
                line = {"color": SERIES[k], "label": f"{lay} lays", "fillstyle": "none"}
                ax.plot(ratio, share, "os"[k], **line)
        left.set(ylabel="Hertz zone with a film below 25 nm [%]")
        right.set(ylabel="load on touching solids [%]")
        for ax in (left, right):
            ax.set(xlim=(0.0, None), ylim=(0.0, None))
            ax.set_xlabel("film of the smooth contact over roughness Rq")
        right.legend()
        figure.suptitle("Contact falls fast with the film: five seeds, and one at higher speeds")
        figure.savefig(IMAGES / "rough_lambda.png", dpi=110)


def of_seeds(found: Found, case: str, lay: str, grid: str, shown: str) -> np.ndarray:
    """Return a number of the seeds that were marched with both lays."""
    names = ([f"case {case}, {one}, seed {seed}{grid}" for one in (lay, *LAYS)] for seed in SEEDS)
    kept = [own for own, *both in names if set(both) <= set(found)]
    return np.array([of(found, name, shown) for name in kept])


def ratio(crossed: np.ndarray, straight: np.ndarray) -> str:
    """Return mean, spread, least and largest of the ratios of the seeds."""
    some = straight > 0.0
    each = crossed[some] / straight[some]
    if each.size < 2:
        return "-"
    return f"{each.mean():.2f} +- {each.std(ddof=1):.2f} ({each.min():.2f} to {each.max():.2f})"


def lay_rows(found: Found, grid: str) -> Iterable[Sequence[str]]:
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


def main() -> None:
    """Print all tables and draw."""
    found, coarse = numbers("variants"), numbers("cases")
    cases = ("case B, crossed", "case B, straight", "case C, crossed", "case C, straight")
    speeds = ("crossed, 2 u", "straight, 2 u", "crossed, 5 u", "straight, 5 u")
    changed = tuple(name for name in CHANGED if name in found)
    for title, rows in (
        ("Five seeds", seed_rows(found)),
        ("Cases B and C", case_rows(found, cases)),
        ("Speeds", case_rows(found, speeds)),
        ("What the choices change", case_rows(found, changed)),
        ("Film over roughness", film_ratio_rows(found)),
        *((f"Five seeds, three cases{grid}", lay_rows(coarse, grid)) for grid in GRIDS),
    ):
        lines = ["| " + " | ".join(row) + " |" for row in rows]
        lines.insert(1, "|" + "---|" * lines[0].count(" | ") + "---|")
        sys.stdout.write("\n".join((title, "", *lines, "", "")))
    draw(found)


if __name__ == "__main__":
    main()
