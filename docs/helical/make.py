"""Rewrite docs/helical.md and its pictures: python -m docs.helical.make [workdir].

Under two minutes on two cores; about fifteen the first time, until the elastic teeth of all
refinements and helix angles lie in the cache. Finished positions of the loaded contact and rows
of the maps are kept in the folder given as argument, by default build/helical.
"""

from __future__ import annotations

import logging
import sys
from pathlib import Path

from docs.helical.cases import HIGH, LOW, Evidence
from docs.helical.claims_mesh import MESH
from docs.helical.claims_motion import MOTION
from docs.helical.claims_thesis import LINES
from docs.helical.claims_thesis_flanks import FLANKS
from docs.helical.closed_forms import zone_differences
from docs.helical.errata import errata_text, printed
from docs.helical.figures import save_separation_figure
from docs.helical.film import (
    OIL_TEMPERATURE,
    RPM,
    SPEEDS,
    TEMPERATURES,
    along_lines,
    mean_friction,
    moved,
)
from docs.helical.film_pages import (
    agreement_sentence,
    along_table,
    formula_table,
    instability_table,
    moved_table,
)
from docs.helical.loaded import bodies, crowned, refinements, sharing, spur_harris
from docs.helical.loaded_claims import PLACE, loaded_claims_table
from docs.helical.pages import (
    branch_table,
    choice_table,
    claims_table,
    form_table,
    harris_table,
    iso_sentence,
    limit_table,
    parting_sentence,
    refinement_table,
    sample_table,
    sharing_table,
    torque_table,
    verdict_counts,
    zone_table,
)
from docs.helical.separation import crowned_curves, plain_curves
from docs.helical.stiffness_density import choices, effects, table_density, used
from docs.helical.structure import six_against_twelve, spur_limit
from docs.helical.study import study
from docs.validation.rejudge import helical_section
from gearlube.studies.helical.figures.catalogue import GEOMETRY_CATALOGUE, HELICAL_CATALOGUE
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_SPEED, PINION_TORQUE

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
PICTURES = (
    "tooth_stiffness_loaded", "load_sharing", "harris_map", "displacements", "composites",
    "friction_harmonics", "instability", "film_on_lines", "film_over_mesh",
)  # fmt: skip
THESIS_PICTURES = ("lines_relieved", "lay_angles")
logger = logging.getLogger("docs.helical")


def main() -> None:
    """Run, write the page and the pictures."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logger.setLevel(logging.INFO)
    work = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "helical"
    store = work / "positions"
    done = study(store)
    if done.mesh is None:
        sys.exit(1)
    datasets, mesh = done.datasets, done.mesh
    at_load = datasets["contact"].sel(torque=PINION_TORQUE, method="nearest")
    logger.info("crowned and spur pairs")
    crowned_contact, crowned_mesh = crowned(store)
    spur = spur_harris(store)
    logger.info("tooth separation")
    plain, crowns = plain_curves(), crowned_curves(crowned_mesh)
    logger.info("claims")
    evidence = Evidence(contact=at_load)
    named = sorted((*MESH, *MOTION), key=lambda claim: int(claim.name[1:]))
    he = [claim.evaluate(evidence) for claim in named]
    rows = (*LINES, *FLANKS)
    thesis = [claim.evaluate(evidence) for claim in rows]
    found, ends = choices(), bodies()

    logger.info("other helix angles")
    page = _text("method").replace(PLACE, loaded_claims_table(store))
    page += verdict_counts(he) + claims_table(named, he) + _text("thesis")
    page += verdict_counts(thesis) + claims_table(rows, thesis)
    page += _text("structure").replace("REJUDGED\n", helical_section())
    page += zone_table(zone_differences()) + _text("limits")
    page += limit_table(spur_limit()) + _text("six_dof")
    page += form_table({mu: six_against_twelve(mu) for mu in (LOW, HIGH)}) + _text("iso")
    page += sample_table() + _text("density")
    page += choice_table(found, effects([c.density for c in found])) + used()
    page += _text("contact").format(
        tangent=1e-9 * table_density(mesh, PINION_TORQUE),
        within=iso_sentence(datasets["contact"], PINION_TORQUE, ends),
    )
    page += torque_table(datasets["contact"]) + _text("sharing")
    page += sharing_table(sharing(at_load)) + _text("refinement")
    page += refinement_table(refinements()) + refinement_table(ends) + _text("harris")
    page += harris_table(
        [
            ("helical, plain", datasets["contact"]),
            ("helical, crowned", crowned_contact),
            ("spur, plain", spur["plain"]),
            ("spur, tips relieved", spur["relieved"]),
        ]
    )
    page += _text("film") + along_table(along_lines(mesh)) + _text("formulas")
    means = [mean_friction(rpm, OIL_TEMPERATURE) for rpm in SPEEDS]
    means += [mean_friction(PINION_SPEED / RPM, T) for T in TEMPERATURES if T != OIL_TEMPERATURE]
    page += formula_table(means)
    page += _text("film_motion").format(agreement=agreement_sentence(means)) + moved_table(*moved())
    page += _text("separation") + branch_table([*plain, *crowns])
    page += _text("instability").format(parting=parting_sentence(plain))
    page += instability_table(datasets["stability"])
    page += errata_text(printed(), _text("errata")) + _text("open") + _text("tests")
    (ROOT / "docs" / "helical.md").write_text(page, encoding="utf-8")

    logger.info("pictures")
    images = ROOT / "docs" / "images"
    images.mkdir(exist_ok=True)
    for name in PICTURES:
        one = HELICAL_CATALOGUE[name]
        one.draw(datasets[one.needs]).savefig(images / f"helical_{name}.png", dpi=110)
    pairs = [data for name, data in datasets.items() if name.startswith("geometry_")]
    for name in THESIS_PICTURES:
        GEOMETRY_CATALOGUE[name](pairs).savefig(images / f"helical_{name}.png", dpi=110)
    panels = [("plain flanks, µ = 0.1", plain), ("crowned flanks, ζ = 0.02", crowns)]
    save_separation_figure(panels, images / "helical_separation.png")


def _text(name: str) -> str:
    return (TEXTS / f"{name}.md").read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
