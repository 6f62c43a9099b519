"""Rewrite docs/tooth_contact.md and its pictures: python -m docs.tooth_contact.make [workdir].

Analyses the shipped gear pair, its variants and refinements, and runs the axle with each variant's
mesh table: about half an hour on two cores. Edges and relief are from
`python -m docs.tooth_contact.relief`, which comes first. What is finished is kept in the folder
given as argument, by default build/tooth_contact; run again to go on after a stop.
"""

from __future__ import annotations

import logging
import shutil
import sys
from pathlib import Path

import xarray as xr

from docs.tooth_contact import sensitivity
from docs.tooth_contact.claims import CLAIMS
from docs.tooth_contact.pages import (
    axle_table,
    claims_table,
    refinement_table,
    torque_table,
    variant_table,
)
from docs.tooth_contact.refinement import refinements
from docs.tooth_contact.relief import relief_table
from docs.tooth_contact.study import analysed, axle_sweep
from docs.tooth_contact.variants import variants
from gearlube.studies.contact.figures import save_contact_figures
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
VARIANT_SETTINGS = ContactSettings(cycle=CycleSettings(positions=12, torques=(20.0, 50.0, 100.0)))
logger = logging.getLogger("docs.tooth_contact")


def main() -> None:
    """Run or resume the study, write the page and the pictures."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logger.setLevel(logging.INFO)
    work = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "tooth_contact"
    pairs = variants()
    shipped = analysed(work, "shipped_full", pairs[0].file, ContactSettings())
    rows: list[tuple[str, xr.Dataset, xr.Dataset]] = []
    for number, variant in enumerate(pairs, 1):
        logger.info("variant %d of %d: %s", number, len(pairs), variant.label)
        contact = analysed(work, variant.name, variant.file, VARIANT_SETTINGS)
        sweep = axle_sweep(work, variant.name, variant.file, contact)
        rows.append((variant.label, contact, sweep))
    finer: list[tuple[str, xr.Dataset]] = []
    for number, case in enumerate(refinements(), 1):
        logger.info("refinement %d of %d: %s", number, len(refinements()), case.label)
        finer.append((case.label, analysed(work, case.name, pairs[0].file, case.settings)))

    page = (TEXTS / "method.md").read_text(encoding="utf-8")
    page += claims_table(CLAIMS, shipped)
    page += (TEXTS / "load.md").read_text(encoding="utf-8")
    page += torque_table(shipped)
    page += (TEXTS / "edges.md").read_text(encoding="utf-8")
    page += relief_table()
    page += (TEXTS / "relief.md").read_text(encoding="utf-8")
    page += variant_table(rows)
    page += (TEXTS / "open.md").read_text(encoding="utf-8")
    page += axle_table(rows)
    page += (TEXTS / "axle.md").read_text(encoding="utf-8")
    page += refinement_table(finer)
    page += (TEXTS / "tests.md").read_text(encoding="utf-8")
    (ROOT / "docs" / "tooth_contact.md").write_text(page, encoding="utf-8")
    images = ROOT / "docs" / "images"
    images.mkdir(exist_ok=True)
    for picture in save_contact_figures(shipped, work / "figures"):
        shutil.copyfile(picture, images / f"contact_{picture.name}")
    sensitivity.main()


if __name__ == "__main__":
    main()
