"""A resonance study with messages, a progress bar, files and a summary."""

from __future__ import annotations

import logging
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.resonance import MODELS, ResonanceSettings, Stage, study_resonance
from gearlube.studies.resonance.cycle_dataset import cycle_dataset
from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.figures import save_resonance_figures
from gearlube.studies.resonance.figures.load_curves import load_curves
from gearlube.studies.resonance.load_response import load_response
from gearlube.studies.resonance.summary import ModelSummary, summaries
from gearlube_core.storage.atomic_file import write_dataset

logger = logging.getLogger("gearlube")
_PARTS = 1000  # of the progress bar


def console_resonance(
    console: Console, *, settings: ResonanceSettings, out: Path, load_at: float | None
) -> bool:
    """Run a study, write datasets and figures to `out`; return False if it was stopped."""
    began = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    with progress_bar(console) as bar:
        task = bar.add_task("resonance", total=_PARTS)

        def observe(stage: Stage) -> None:
            bar.update(task, completed=int(_PARTS * stage.done), description=stage.name)

        study = study_resonance(settings, observe)
        bar.update(task, description="figures")
        response, cycle = resonance_dataset(study), cycle_dataset(study)
        write_dataset(response, out / "resonance.nc")
        write_dataset(cycle, out / "cycle.nc")
        save_resonance_figures(response, cycle, out / "figures")
        if load_at is not None and not study.interrupted:
            bar.update(task, description="load")
            load = load_response(settings, load_at)
            write_dataset(load, out / "load.nc")
            load_curves(load).savefig(out / "figures" / "load_response.png", dpi=150)
    found = summaries(response)
    if found:
        console.print(_table(found))
    if "natural_frequency" in response.attrs:
        logger.info("Natural frequency %.0f Hz.", response.attrs["natural_frequency"])
    for summary in found:
        for sentence in summary.remarks:
            logger.warning("%s: %s", MODELS[summary.model], sentence)
    logger.info("Studied in %.1f s.", time.monotonic() - began)
    logger.info("Results: %s, %s, %s", out / "resonance.nc", out / "cycle.nc", out / "figures")
    return not study.interrupted


def _table(found: list[ModelSummary]) -> Table:
    table = Table(title="Resonance; mesh frequencies over the natural frequency")
    for heading in (
        "model",
        "folds, bifurcations",
        "p-p [µm]",
        "at",
        "apart, rising",
        "apart, falling",
    ):
        table.add_column(heading, justify="left" if heading == "model" else "right")
    for summary in found:
        table.add_row(
            MODELS[summary.model],
            "\n".join(f"{kind} {at:.4f}" for kind, at in summary.special) or "none",
            f"{1e6 * summary.peak:.2f}",
            f"{summary.peak_at:.3f}",
            _ranges(summary.separated_up),
            _ranges(summary.separated_down),
        )
    return table


def _ranges(ranges: list[tuple[float, float]]) -> str:
    return "\n".join(f"{first:.3f} to {last:.3f}" for first, last in ranges) or "none"
