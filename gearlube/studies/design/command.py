"""The command `gearlube design`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.example import print_example
from gearlube.cli.options import ExampleOption, JobsOption, OverwriteOption
from gearlube.cli.study_run import empty_table, run_next, study_run, tell_findings
from gearlube_core.storage.file_names import pair_stem

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.design.findings import AskedAndFound

logger = logging.getLogger("gearlube")


def design(
    context: typer.Context,
    blank: Annotated[
        str, typer.Argument(help="Blank file (TOML) or a shipped one.", metavar="BLANK")
    ] = "hypoid_13_42",
    optimise: Annotated[
        bool,
        typer.Option(
            "--optimise",
            help="Then make the pair quieter: write OUT/problem.toml and run `gearlube optimise` "
            "on it, some minutes, into OUT/optimised.",
        ),
    ] = False,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_design"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Design a hypoid or bevel pair: from blank data and a wanted contact to machine settings.

    Writes the gear file (`gearlube contact` takes it), an axle file to complete, report.html,
    design.nc and figures. Takes some minutes of one processor. --optimise adds a
    quieter pair with a report of its own, and takes some minutes more.
    """
    if example:
        print_example("gearlube_core.hypoid_design.blank_file:BlankFile", "hypoid_13_42")
        return
    from gearlube.report.stored import PAGE
    from gearlube.studies.design import run
    from gearlube.studies.design.findings import asked_and_found, findings
    from gearlube.studies.design.problem import PROBLEM
    from gearlube_core.hypoid_design.blank_file import BlankFile

    with study_run("design", out, overwrite=overwrite) as frame:
        file = BlankFile.given(blank)
        with frame.results() as progress:
            results = run.run_design(file, folder=out, jobs=jobs, progress=progress)
        frame.show(_table(file.name, asked_and_found(results.design)))
        gear = out / f"{pair_stem(results.design.file.name)}.toml"
        frame.written(gear.name, "design.nc", "figures")
        tell_findings(findings(results.dataset), out / PAGE)
        logger.info("Next: gearlube contact %s --out %s", gear, out / "contact")
        logger.info("Then: gearlube map %s, once you have completed it", out / "axle.toml")
        if not optimise:
            logger.info("Quieter: gearlube optimise %s", out / PROBLEM)
            return
    again = ["--overwrite"] if overwrite else []
    workers = [] if jobs is None else ["--jobs", str(jobs)]
    quiet = ["--out", str(out / "optimised")]
    run_next(context, "optimise", [str(out / PROBLEM), *quiet, *workers, *again])


def _table(name: str, rows: list[AskedAndFound]) -> Table:
    table = empty_table(f"{name}: contact without load", "flanks", "", "asked", "found")
    for row in rows:
        table.add_row(*row)
    return table
