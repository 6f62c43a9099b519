"""Put numbers into docs/tooth_contact.md: python -m docs.tooth_contact.make [workdir].

Analyses the shipped gear pair, its variants and refinements, and runs the axle with each variant's
mesh table: about half an hour on two cores. Edges and relief are from
`python -m docs.tooth_contact.relief`, which comes first. What is finished is kept in the folder
given as argument, by default build/tooth_contact; run again to go on after a stop.
"""

from __future__ import annotations

import logging
import shutil
from pathlib import Path

from docs.page import IMAGES, Page, begin
from docs.tooth_contact import sensitivity
from docs.tooth_contact.claims import CLAIMS
from docs.tooth_contact.pages import refinement_words, torque_rows, variant_row
from docs.tooth_contact.relief import put_relief
from docs.tooth_contact.study import axle_sweep, refinements
from docs.tooth_contact.variants import variants
from gearlube.report.pictures import save_pictures
from gearlube.studies.contact.figures.catalogue import CONTACT_CATALOGUE
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings

VARIANT_SETTINGS = ContactSettings(cycle=CycleSettings(positions=12, torques=(20.0, 50.0, 100.0)))
logger = logging.getLogger("docs.tooth_contact")


def main(work: Path) -> None:
    """Run or resume the study, write the page and the pictures."""
    pairs, store = variants(), work / "positions"
    shipped = analyse_contact(pairs[0].file, ContactSettings(), store=store)
    rows = []
    for number, variant in enumerate(pairs, 1):
        logger.info("variant %d of %d: %s", number, len(pairs), variant.label)
        contact = analyse_contact(variant.file, VARIANT_SETTINGS, store=store)
        sweep = axle_sweep(work, variant.name, variant.file, contact)
        rows.append([variant.label, *variant_row(contact, sweep)])
    finer = []
    for number, (name, settings) in enumerate(refinements().items(), 1):
        logger.info("refinement %d: %s", number, name)
        finer.append(analyse_contact(pairs[0].file, settings, store=store))

    page = Page("tooth_contact")
    found = {name: claim(shipped) for name, claim in CLAIMS.items()}
    cells = {name: (one.value, f"**{one.verdict}**", one.reason) for name, one in found.items()}
    page.claims(cells, "## Validation")
    page.rows("Pinion torque [N.m]", torque_rows(shipped))
    put_relief(page)
    page.rows("Variant (each cell", rows)
    page.fill("mean stiffness by at most {} %. The chosen size of the elastic body changes it by "
              "{} to {} %.", *refinement_words(finer))  # fmt: skip
    page.write()
    for picture in save_pictures(CONTACT_CATALOGUE, work / "figures", shipped):
        if f"contact_{picture.name}" in page.text:
            shutil.copyfile(picture, IMAGES / f"contact_{picture.name}")
    sensitivity.main()


if __name__ == "__main__":
    main(begin("tooth_contact"))
