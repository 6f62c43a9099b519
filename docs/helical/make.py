"""Put numbers into docs/helical.md and draw its pictures: python -m docs.helical.make [workdir].

Under two minutes on two cores, longer until all elastic teeth lie in the cache. Finished positions
of the loaded contact and rows of the maps are kept in the folder given as argument, by default
build/helical.
"""

from __future__ import annotations

import logging
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from docs.helical.cases import HIGH, Evidence, density, own_density, steady
from docs.helical.claims_mesh import MESH
from docs.helical.claims_motion import MOTION
from docs.helical.claims_thesis import THESIS
from docs.helical.film import along_row, stable_words
from docs.helical.loaded import (
    bodies,
    crowned,
    error_rows,
    iso_words,
    spur_harris,
    table_density,
    torque_rows,
)
from docs.helical.separation import (
    branch_rows,
    crowned_curves,
    plain_curves,
    separation_figure,
)
from docs.page import IMAGES, Claims, Page, begin
from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE
from gearlube.studies.helical.run import run_helical
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.stages import HelicalResults
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    PeriodicResponse,
    harmonics,
    periodic_response,
)
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE, he_2007_pair

logger = logging.getLogger("docs.helical")

TORQUES = (25.0, 50.0, 100.0, 160.0, PINION_TORQUE, 300.0, 450.0)  # N.m


# words of the page before the counts of statements
HE_CLAIMS = 'n is the mesh order, "times" the growth from mu = 0.01 to 0.1.'
THESIS_CLAIMS = "Designs A (33:34) and B (33:99) of Table 4.1; films: [ehl](ehl.md)."
PICTURES = ("tooth_stiffness_loaded", "displacements", "instability", "film_on_lines")


def study(store: Path) -> HelicalResults:
    """Run the command's study with the density of `he_2007_pair`.

    Its speed sweep is left at one speed, and its branches with separation are followed here.
    """
    asked = HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=PINION_TORQUE,
        pinion_speed=PINION_SPEED,
        speeds=(PINION_SPEED,),
        mesh="density",
        density=density(),
        torques=TORQUES,
        separation_speeds=0,
        friction="film",
    )
    logged: list[str] = []

    def log(_: float, sentence: str) -> None:
        stage = sentence.partition(",")[0]
        if stage not in logged:
            logged.append(stage)
            logger.info(stage)

    return run_helical(asked, store=store, progress=log)


def printed_forms(page: Page) -> None:
    """Put in what the printed equations of He et al. 2007 do where they run, mu = 0.1."""
    pair, consistent = he_2007_pair(HIGH), steady(HIGH)

    def response(throw: bool = False, **printed: str) -> PeriodicResponse:
        return periodic_response(replace(pair, **printed), PINION_SPEED, throw=throw)  # type: ignore[arg-type]

    sign = response(mesh_sign="as_printed")
    growth = float(np.log(np.abs(sign.multipliers[0])) / sign.period)
    page.fill('With `mesh_sign="as_printed"` the motion grows at {} 1/s', f"{growth:.2g}")
    free = float(np.abs(response(bearing_moments="as_printed").multipliers[0]))
    page.fill("multiplier of modulus {} and no steady state", f"{free:.6f}")
    damped = harmonics(response(support_damping="as_printed", throw=True).signal("u_yp"))
    ratio = float((damped / harmonics(consistent.signal("u_yp")))[7:10].min())
    page.fill("reduces orders 8 to 10 of u_yp by up to {} %", f"{100.0 * (1.0 - ratio):.0f}")
    page.fill(
        "friction leaves {} N.m of the torques unbalanced at mu = 0.1, which is {} W.",
        f"{consistent.friction_torque:.2f}",
        f"{consistent.friction_power:.0f}",
    )


def main(work: Path) -> None:
    """Run, write the page and the pictures."""
    store, page = work / "positions", Page("helical")
    done = study(store)
    if done.mesh is None:
        sys.exit(1)
    datasets, contact = done.datasets, done.datasets["contact"]
    at_load = contact.sel(torque=PINION_TORQUE, method="nearest")
    logger.info("claims")
    evidence = Evidence(contact=at_load)
    page.judged(Claims(MESH | MOTION), evidence, HE_CLAIMS)
    page.judged(THESIS, evidence, THESIS_CLAIMS)
    page.fill(
        "`he_2007_pair` has k = {} N/(mm um): the pair's own roots lie {} and {} normal modules",
        *own_density(),
    )
    printed_forms(page)
    logger.info("loaded contact")
    crowned_contact, crowned_mesh = crowned(store)
    spur = spur_harris(store)
    page.fill("At 226 N.m the mean stiffness is {} of it, times C_M {}: {} the scatter and the {} "
              "% of the body.", *iso_words(contact, PINION_TORQUE, bodies()))  # fmt: skip
    tangent = 1e-9 * table_density(done.mesh, PINION_TORQUE)
    page.fill("The lines' mean tangent density there is {} N/(mm um).", f"{tangent:.2f}")
    page.rows("Pinion torque, N.m", torque_rows(contact))
    every = (contact, crowned_contact, spur["plain"], spur["relieved"])
    page.cells("Error, p-p, um", error_rows(every), first=1)
    logger.info("film friction")
    page.cells("Line loads", [along_row(None), along_row(done.mesh)], first=1)
    page.fill(
        "variation is {} times as large, with 1 % damping at {} times, or if the damping ratio is "
        "below {}. This happens at a mesh frequency of {} Hz,",
        *stable_words(datasets["stability"]),
    )
    logger.info("tooth separation")
    plain, crowns = plain_curves(), crowned_curves(crowned_mesh)
    page.cells("Flanks | f_n", branch_rows([*plain, *crowns]), first=1)
    page.write()
    logger.info("pictures")
    for name in PICTURES:
        one = HELICAL_CATALOGUE[name]
        one.draw(datasets[one.needs]).savefig(IMAGES / f"helical_{name}.png", dpi=110)
    panels = [("plain flanks, µ = 0.1", plain), ("crowned flanks, ζ = 0.02", crowns)]
    separation_figure(panels).savefig(IMAGES / "helical_separation.png", dpi=150)


if __name__ == "__main__":
    main(begin("helical"))
