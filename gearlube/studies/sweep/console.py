"""A sweep with messages and a progress bar."""

from __future__ import annotations

import logging
from pathlib import Path

from rich.console import Console

from fmu_src.fmu_cache import cached_hypoid_axle
from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.sweep import Progress as PointProgress
from gearlube.studies.sweep import SweepSettings, run_sweep
from gearlube.studies.sweep.figures import CATALOGUE, ESSENTIAL
from gearlube.studies.sweep.report import write_report
from gearlube.studies.sweep.warm_up import warm_up

logger = logging.getLogger("gearlube")


def console_sweep(
    console: Console,
    *,
    fmu: Path | None,
    mesh_table: Path | None,
    speeds_kmh: list[float],
    preloads: list[float],
    settings: SweepSettings,
    out: Path,
    jobs: int | None,
    scheduler: str | None,
    quick: bool,
    command_line: str,
) -> int:
    """Run a sweep, write its report, and return the number of failed points.

    Without `fmu` the axle is that of this installation, with `mesh_table` if one is given.
    """
    logger.info("Preparing the axle; the first time this compiles it, about 20 s.")
    if fmu is None:
        fmu = cached_hypoid_axle(mesh_table)
    if scheduler is None:
        warm_up(fmu, settings)
    with progress_bar(console) as bar:
        task = bar.add_task("sweep", total=len(speeds_kmh) * len(set(preloads)))

        def observe(progress: PointProgress) -> None:
            where = f"{progress.speed_kmh:g} km/h, {progress.preload:g} N"
            bar.update(task, completed=progress.done, description=where)

        dataset = run_sweep(
            fmu,
            speeds_kmh=speeds_kmh,
            preloads=preloads,
            settings=settings,
            out=out,
            jobs=jobs,
            scheduler=scheduler,
            observer=observe,
            command_line=command_line,
            prepare=None,
        )
        bar.update(task, description="report")
        report = write_report(dataset, out, ESSENTIAL if quick else CATALOGUE)
    failures = int((dataset["status"] == 0).sum())
    if failures:
        logger.warning("%d points failed; the report says why.", failures)
    computed = dataset.attrs["computed_points"]
    logger.info("%d points computed in %.1f s.", computed, dataset.attrs["wall_time"])
    logger.info("Results: %s, %s, %s", report, out / "sweep.nc", out / "summary.csv")
    return failures
