"""Tables and a figure that compare marches: python -m docs.rough_line_contact.tables.

Puts tables into docs/rough_line_contact.md from variants.csv and cases.csv, which `marches` writes,
and draws docs/images/rough_lambda.png; seconds.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from docs.page import IMAGES, Page
from docs.rough_line_contact.marches import ANGLES, GRIDS, LAYS, SEEDS, written
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.contact.greenwood_tripp_1971 import asperity_load, gear_flanks
from gearlube_core.ehl.case.rough_case import RoughCase

Found = dict[str, dict[str, float]]
SHOWN = {
    "largest pressure [GPa]": ("largest pressure, rough", 1e-9),
    "largest pressure, mean over time [GPa]": ("mean of the largest pressure, rough", 1e-9),
    "smallest film [nm]": ("smallest film, rough", 1e9),
    "film that 1 % are below [nm]": ("film that 1 % of the zone is below", 1e9),
    "film that 50 % are below [nm]": ("film that 50 % of the zone is below", 1e9),
    "steps with contact [%]": ("share of steps with a film below 10 nm", 100.0),
    "zone below 10 nm [%]": ("share of the zone below 10 nm, rough", 100.0),
    "zone below 25 nm [%]": ("share of the zone below 25 nm, rough", 100.0),
    "load on solids [%]": ("share of the load on solids, rough", 100.0),
    "friction coefficient": ("friction coefficient, rough", 1.0),
    "smooth film/Rq": ("smooth film over roughness", 1.0),
    "mean film/Rq": ("mean film over roughness", 1.0),
}
# rows of the tables of seeds, of what choices change, and of lays
OF_SEEDS = (
    "largest pressure [GPa]",
    "largest pressure, mean over time [GPa]",
    "smallest film [nm]",
    "film that 1 % are below [nm]",
    "film that 50 % are below [nm]",
    "steps with contact [%]",
    "zone below 10 nm [%]",
    "load on solids [%]",
    "friction coefficient",
)
OF_CHOICES = (
    "largest pressure, mean over time [GPa]",
    "film that 1 % are below [nm]",
    "zone below 10 nm [%]",
    "zone below 25 nm [%]",
    "load on solids [%]",
    "friction coefficient",
)
OF_LAYS = (
    "largest pressure, mean over time [GPa]",
    "film that 1 % are below [nm]",
    "zone below 10 nm [%]",
)
CHANGED = (
    "crossed",
    "crossed, half time step",
    "crossed, layer 5 nm",
    "crossed, layer 20 nm",
    "crossed, finer grid",
)
# marches that change a setting of the computation, not the contact
SETTINGS = (*CHANGED[1:], "crossed, tolerances a tenth", "crossed, 64 rows")
WAVES = {"": "from 72 um", ", fine": "from 42 um"}  # left by the filter on each of `GRIDS`


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


def seed_rows(found: Found) -> Iterable[list[str]]:
    """Mean, and least to largest, of five seeds; crossed over straight."""
    for shown in OF_SEEDS:
        crossed, straight = (seeds(found, lay, shown) for lay in ("crossed", "straight"))
        ratios = crossed / straight
        yield [
            shown,
            *(f"{v.mean():.3g} ({v.min():.3g} to {v.max():.3g})" for v in (crossed, straight)),
            f"{ratios.min():.2f} to {ratios.max():.2f}",
        ]


def choice_rows(found: Found) -> Iterable[list[str]]:
    """One column for each changed choice."""
    for shown in OF_CHOICES:
        yield [shown, *(f"{of(found, one, shown):.3g}" for one in CHANGED)]


def is_compared(name: str) -> bool:
    """Whether a march differs from others by its film and its seed alone."""
    return name not in SETTINGS and not name.startswith(("his columns", "crossed, finer"))


def film_ratio_rows(found: Found) -> Iterable[list[str]]:
    """Film over roughness, contact, load of solids and of Greenwood and Tripp; shares in %."""
    section = RoughCase.named("jamali_2015_a").section()
    mean_pressure = 0.25 * math.pi * section.hertz_contact[2]
    crossed = (name for name in found if name.startswith("crossed") and is_compared(name))
    for name in sorted(crossed, key=lambda name: of(found, name, "smooth film/Rq")):
        mean = of(found, name, "mean film/Rq")
        # share of a Gaussian surface that stands higher than the mean film
        overlap = 0.5 * math.erfc(mean / math.sqrt(2.0))
        law = asperity_load(mean, 1.0, section.contact_modulus, gear_flanks(1.0)) / mean_pressure
        yield [
            name,
            f"{of(found, name, 'smooth film/Rq'):.2f}",
            f"{mean:.2f}",
            f"{of(found, name, 'zone below 10 nm [%]'):.2g}",
            f"{of(found, name, 'load on solids [%]'):.2g}",
            *(f"{100.0 * share:.2g}" for share in (overlap, law)),
        ]


def draw(found: Found) -> None:
    """Draw contact share and load on solids over the film ratio."""
    with house_style():
        figure = new_figure(8.0, 4.0)
        left, right = figure.subplots(1, 2)
        for k, lay in enumerate(("crossed", "straight")):
            names = [name for name in found if name.split(",")[0] == lay and is_compared(name)]
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
    return f"{each.mean():.2f} ± {each.std(ddof=1):.2f} ({each.min():.2f} to {each.max():.2f})"


def lay_rows(found: Found) -> Iterable[list[str]]:
    """Crossed over straight on both grids: mean, spread, and least to largest of the seeds."""
    for grid in GRIDS:
        for shown in OF_LAYS:
            both = ([of_seeds(found, case, lay, grid, shown) for lay in LAYS] for case in ANGLES)
            ratios = [ratio(*pair) for pair in both]
            if set(ratios) != {"-"}:
                yield [f"{WAVES[grid]}: {shown.partition(' [')[0]}", *ratios]


def main() -> None:
    """Put in all tables and draw."""
    found, cases, page = numbers("variants"), numbers("cases"), Page("rough_line_contact")
    page.rows("| crossed | straight | crossed over straight", seed_rows(found))
    page.rows("| as above", choice_rows(found))
    page.rows("march | smooth film/Rq", film_ratio_rows(found))
    page.rows("crossed over straight | case A, 2.8 deg", lay_rows(cases))
    page.write()
    draw(found)


if __name__ == "__main__":
    main()
