"""The command `gearlube ehl rough`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_if_failed
from gearlube.cli.options import CaseArgument, ExampleOption, OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube.cli.study_run import progress_on
from gearlube.studies.films.commands.console import exit_on_errors

logger = logging.getLogger("gearlube")


def rough(
    case: CaseArgument = "jamali_2015_a",
    steps: Annotated[
        int | None,
        typer.Option(
            help="Time steps to compute. Default: all. A later run continues.", metavar="N"
        ),
    ] = None,
    nodes: Annotated[int | None, typer.Option(help="Nodes along x.", metavar="N")] = None,
    rows: Annotated[int | None, typer.Option(help="Rows along y.", metavar="N")] = None,
    sides: Annotated[
        str | None, typer.Option(help="Boundary condition along y.", metavar="cyclic|no_flow")
    ] = None,
    threads: Annotated[
        int, typer.Option(help="Number of threads; results do not depend on it.")
    ] = 1,
    statistics: Annotated[
        bool,
        typer.Option("--statistics", help="Only compute statistics of the films stored in OUT."),
    ] = False,
    animation: Annotated[
        bool, typer.Option("--animation", help="Also write the stored films as animation.gif.")
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_ehl_rough"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """March a line contact between rough surfaces; write rough.nc, films, summary and figures.

    A stopped march goes on from its record in OUT. Options given here replace those of the case.
    """
    if example:
        print_example("gearlube_core.ehl.case.rough_case:RoughCase", case, "rough_")
        return
    from gearlube.studies.films.rough.animation import ANIMATION, check_animation, write_animation
    from gearlube.studies.films.rough.files import summary_rows
    from gearlube.studies.films.rough.run import run_rough, statistics_again
    from gearlube_core.ehl.case.rough_case import RoughCase

    with exit_on_errors(out):
        changes = {"solver.nodes_x": nodes, "solver.rows": rows, "side_conditions": sides}
        given = {name: value for name, value in changes.items() if value is not None}
        file = RoughCase.given(case)
        file = file.varied(given) if given else file
        if animation and not statistics:
            check_animation(file, steps)
        with results_folder(out, "ehl rough", overwrite=overwrite, by_parts=True):
            if statistics:
                dataset = statistics_again(file, out)
            else:
                with progress_on("steps") as progress:
                    dataset = run_rough(
                        file, steps=steps, folder=out, threads=threads, progress=progress
                    )
            if animation:
                with progress_on("animation") as progress:
                    write_animation(file, out, progress)
    for quantity, value, unit in summary_rows(dataset):
        logger.info("%s: %.4g%s", quantity.capitalize(), value, "" if unit == "1" else f" {unit}")
    logger.info("Results: %s", out / ("frames.nc" if statistics else "rough.nc"))
    if animation:
        logger.info("Animation: %s", out / ANIMATION)
    outcome = str(dataset.attrs["outcome"])
    exit_if_failed("" if dataset.attrs["converged"] else outcome)
    logger.info("%s", outcome)
