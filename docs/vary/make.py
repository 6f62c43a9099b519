"""Draw the figures of docs/vary.md: python -m docs.vary.make [FOLDER].

A van's axle with the tolerances of scattering_van.toml at 60 km/h: 128 short marches, some minutes.
Then its whine with those of whine_tolerances.toml: 200 axles, loaded and marched, some minutes. The
results are kept in FOLDER, where a run that was stopped goes on.
"""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

from docs.page import IMAGES, Page
from gearlube.output.csv_text import csv_text
from gearlube.variation.design import Design, Sampling
from gearlube.variation.figures import histogram_figure, rank_figure
from gearlube.variation.parts import scattered_parts
from gearlube.variation.parts_report import check_figure, findings, parts_figure, pays_figure
from gearlube.variation.point_study import point_study, scatter
from gearlube.variation.run import run_variation
from gearlube.variation.scatter import spreads_in
from gearlube.variation.store import open_variation
from gearlube.variation.summary import write_summary
from gearlube_core.storage.atomic_file import write_text

HERE = Path(__file__).resolve().parent
LIMITS = {"tone_to_noise": 5.0}  # dB


def main(folder: Path) -> None:
    """Run the scatter, draw it, and keep its numbers beside this script."""
    study = point_study("sweep", str(HERE / "scattering_van.toml"), quick=True)
    design = Design(spreads=scatter(study), sampling=Sampling("sobol", 128))
    run_variation(study, design, out=folder)
    results, summary = write_summary(folder)
    histogram_figure(results, summary).savefig(IMAGES / "vary_scatter.png", dpi=110)
    rank_figure(results, summary).savefig(IMAGES / "vary_ranks.png", dpi=110)
    statistics = summary["statistics"].sel(quantity=list(study.shown))
    rows = [
        [name, *(f"{number:.4g}" for number in statistics.sel(quantity=name).values)]
        for name in study.shown
    ]
    head = ["quantity", *map(str, summary["statistic"].values)]
    write_text(csv_text(head, rows), HERE / "numbers.csv")


def whine(folder: Path) -> None:
    """Run the whine of 200 axles, predict 10,000, and draw them."""
    study = point_study("whine", str(HERE / "scattering_van.toml"), quick=True)
    spreads = spreads_in(HERE / "whine_tolerances.toml", study)
    design = Design(spreads=spreads, sampling=Sampling("lhs", 200))
    run_variation(study, design, out=folder)
    draw_whine(folder, design)


def draw_whine(folder: Path, design: Design) -> None:
    """Predict and draw from the runs that `whine` keeps."""
    results = open_variation(folder)
    many = scattered_parts(results, design, parts=10_000, limits=LIMITS)
    for name, draw in (("parts", parts_figure), ("pays", pays_figure), ("check", check_figure)):
        draw(results, many).savefig(IMAGES / f"vary_whine_{name}.png", dpi=110)
    shown = (one.headline for one in findings(results, many))
    said = "\n".join(f"- {one}" for one in shown if re.search("tone_to_noise|level_mesh_2", one))
    page = Page("vary")
    page.paragraph("<!-- begin: written by docs.vary.make -->", said)
    page.write()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as nowhere:
        kept = Path(sys.argv[1] if len(sys.argv) > 1 else nowhere)
        main(kept / "loss")
        whine(kept / "whine")
