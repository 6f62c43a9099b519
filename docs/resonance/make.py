"""Rewrite docs/resonance.md and its pictures: python -m docs.resonance.make [workdir].

Follows the branches of nine pairs, runs flank contacts along their motions, and checks motions by
integration in time: about three minutes on two cores. What is finished is kept in the folder given
as argument, by default build/resonance; run again to go on after a stop.
"""

from __future__ import annotations

import logging
import shutil
import sys
from pathlib import Path

import xarray as xr

from docs.resonance.claims_dynamics import DYNAMICS
from docs.resonance.claims_tribology import TRIBOLOGY
from docs.resonance.evidence import gather, kept
from docs.resonance.figures import save_mismatch_figure
from docs.resonance.numerics import agreements, drifts, linear_limit
from docs.resonance.pages import (
    agreement_summary,
    agreement_table,
    branch_table,
    claims_table,
    double_count_table,
    drift_table,
    flank_table,
    linear_table,
    start_table,
    twice_counted,
    verdict_counts,
)
from docs.resonance.starts import starts
from docs.validation.rejudge import pair_section
from gearlube.studies.resonance.figures import save_resonance_figures
from gearlube.studies.resonance.run import run_resonance
from gearlube.studies.resonance.settings import ResonanceSettings

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
AGREE_AT = (0.3, 0.5, 0.65, 0.9, 1.0, 1.3)


def study() -> tuple[xr.Dataset, xr.Dataset]:
    """Return what `gearlube resonance` writes with its defaults."""
    found = run_resonance(ResonanceSettings())
    return found.response, found.cycle


def main() -> None:
    """Run or resume, write the page and the pictures."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logging.getLogger("docs.resonance").setLevel(logging.INFO)
    work = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "resonance"
    evidence = gather(work)
    agreed = kept(
        work,
        "agreement",
        lambda: agreements(
            {
                ("shipped", "2-DOF"): evidence.two,
                ("shipped", "1-DOF"): evidence.one,
                ("0.2 % mismatch", "2-DOF"): evidence.mismatched[0.002],
                ("0.4 % mismatch", "2-DOF"): evidence.mismatched[0.004],
            },
            AGREE_AT,
        ),
    )
    started = kept(work, "starts", starts)
    drifted = kept(work, "drift", drifts)
    linear = kept(work, "linear_limit", linear_limit)
    motion = [claim.evaluate(evidence) for claim in DYNAMICS]
    flanks = [claim.evaluate(evidence) for claim in TRIBOLOGY]

    page = _text("method")
    page += branch_table(evidence)
    page += _text("branches").replace("STARTS\n", start_table(started) + "\n")
    page += double_count_table(evidence.double_counts)
    page += _text("motion").replace("TWICE\n", twice_counted(evidence))
    page += verdict_counts([*motion, *flanks])
    page += claims_table(DYNAMICS, motion) + _text("flanks")
    page += flank_table(TRIBOLOGY, flanks)
    page += _text("integration").replace("REJUDGED\n", kept(work, "rejudged", pair_section))
    page += agreement_table(agreed) + agreement_summary(agreed) + _text("linear")
    page += linear_table(linear) + _text("drift")
    page += drift_table(drifted) + _text("tests")
    (ROOT / "docs" / "resonance.md").write_text(page, encoding="utf-8")

    images = ROOT / "docs" / "images"
    images.mkdir(exist_ok=True)
    save_mismatch_figure(evidence, images / "resonance_mismatch.png")
    for picture in save_resonance_figures(*kept(work, "study", study), work / "figures"):
        if f"resonance_{picture.name}" in page:
            shutil.copyfile(picture, images / f"resonance_{picture.name}")


def _text(name: str) -> str:
    return (TEXTS / f"{name}.md").read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
