"""Draw the figures of docs/vary.md: python -m docs.vary.make [FOLDER].

A van's axle with the tolerances of scattering_van.toml at 60 km/h: 128 short marches, some minutes.
The results are kept in FOLDER, where a run that was stopped goes on.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from docs.page import IMAGES
from gearlube.output.csv_text import csv_text
from gearlube.variation.design import Design, Sampling
from gearlube.variation.figures import histogram_figure, rank_figure
from gearlube.variation.point_study import point_study, scatter
from gearlube.variation.run import run_variation
from gearlube.variation.summary import write_summary
from gearlube_core.storage.atomic_file import write_text

HERE = Path(__file__).resolve().parent


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


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as nowhere:
        main(Path(sys.argv[1] if len(sys.argv) > 1 else nowhere))
