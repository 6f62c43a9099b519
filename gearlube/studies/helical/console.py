"""A study of a helical pair with messages, a progress bar and files."""

from __future__ import annotations

import logging
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from gearlube.cli.exit_codes import FAILED, INTERRUPTED
from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.helical.figures.catalogue import save_helical_figures
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.study import HelicalStudy, Stage, study_helical_pair
from gearlube.studies.helical.summary import Row, summary_csv, summary_rows
from gearlube_core.mesh_table.line_mesh_file import write_line_mesh
from gearlube_core.storage.atomic_file import write_dataset, write_text

logger = logging.getLogger("gearlube")
_PARTS = 1000  # of the progress bar


def console_helical(
    console: Console,
    *,
    settings: HelicalSettings,
    out: Path,
    jobs: int | None,
    command_line: str,
) -> int:
    """Run a study, write datasets, summary and figures to `out`; return what the shell is told.

    A stopped study has no figures.
    """
    began = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    with progress_bar(console) as bar:
        task = bar.add_task("helical pair", total=_PARTS)

        def observe(stage: Stage) -> None:
            bar.update(task, completed=int(0.95 * _PARTS * stage.done), description=stage.name)

        study = study_helical_pair(
            settings, observe, store=out / "parts", jobs=jobs, command_line=command_line
        )
        bar.update(task, description="stopped" if study.interrupted else "files and figures")
        for name, dataset in study.datasets.items():
            write_dataset(dataset, out / f"{name}.nc")
        if study.mesh is not None:
            write_line_mesh(study.mesh, out / "line_mesh.nc")
        rows = summary_rows(study)
        write_text(summary_csv(rows), out / "summary.csv")
        if not study.interrupted:
            save_helical_figures(study.datasets, out / "figures")
            bar.update(task, completed=_PARTS, description="done")
    console.print(_table(study, rows))
    for sentence in _doubts(study):
        logger.warning("%s", sentence)
    logger.info("Studied in %.1f s.", time.monotonic() - began)
    logger.info("Results: %s", out)
    for name, reason in study.failures.items():
        logger.error("%s: %s", name, reason)
    if study.interrupted:
        return INTERRUPTED
    return FAILED if study.failures else 0


def _table(study: HelicalStudy, rows: list[Row]) -> Table:
    table = Table(title=f"{study.settings.file.name}: helical pair")
    for heading in ("", "quantity", "value", "unit"):
        table.add_column(heading, justify="right" if heading == "value" else "left")
    topic = ""
    for row in rows:
        table.add_row(
            "" if row.topic == topic else row.topic, row.quantity, f"{row.value:.4g}", row.unit
        )
        topic = row.topic
    return table


def _doubts(study: HelicalStudy) -> list[str]:
    """Return what to be careful with, a sentence each."""
    found, sentences = study.datasets, []
    if study.settings.file.completed:
        fields = ", ".join(study.settings.file.completed)
        sentences.append(f"Not in the pair's source, completed: {fields}.")
    if "contact" in found and found["contact"].attrs["iso_outside"] != "none":
        sentences.append(f"ISO 6336-1 does not hold here: {found['contact'].attrs['iso_outside']}.")
    if "sweep" in found and bool((found["sweep"]["stability_margin"] <= 0.0).any()):
        sentences.append("Unstable within the speed sweep: rows without values in sweep.nc.")
    return sentences
