"""The command `gearlube optimise`."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.example import print_example
from gearlube.cli.options import JobsOption, OverwriteOption
from gearlube.cli.study_run import empty_table, study_run, tell_findings
from gearlube_core.checks import check_within
from gearlube_core.storage.file_names import pair_stem

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.optimise.dataset import MeasureRow

logger = logging.getLogger("gearlube")


def optimise(
    problem: Annotated[
        str,
        typer.Argument(
            help="Problem file (TOML), helical, helical_plain or hypoid.", metavar="PROBLEM"
        ),
    ] = "helical",
    front: Annotated[
        int,
        typer.Option(help="Points of the front of mesh orders against loss; 0: none.", metavar="N"),
    ] = 0,
    nominal: Annotated[
        bool,
        typer.Option("--nominal", help="Also search the best pair without errors, to compare."),
    ] = False,
    rounds: Annotated[int, typer.Option(help="Rounds of the search, at most.", metavar="N")] = 6,
    positions: Annotated[
        int, typer.Option(help="Mesh phases of the check by the plain analysis.", metavar="N")
    ] = 16,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_optimise"),
    example: Annotated[
        bool,
        typer.Option("--example", help="Print the shipped problem PROBLEM as a file, and stop."),
    ] = False,
    overwrite: OverwriteOption = False,
) -> None:
    """Make a pair quieter: reliefs, crowns and settings with least mesh orders under limits.

    Several torques, errors of assembly and making, limits of pressure, loss, sensitivity and
    contact at edges. Writes the better gear file, report.html, optimise.nc and figures. What is
    computed is kept in OUT: run the same command again to go on after a stop.
    """
    if example:
        print_example("gearlube_core.flank_optimisation.problem_file:OptimisationFile", problem)
        return
    from gearlube.report.stored import PAGE
    from gearlube.studies.optimise import run
    from gearlube.studies.optimise.dataset import measure_rows
    from gearlube.studies.optimise.findings import findings
    from gearlube_core.flank_optimisation.optimise import OptimiseSettings
    from gearlube_core.flank_optimisation.problem_file import OptimisationFile

    stopped = f"Stopped. Run the same command again to go on from {out}."
    with study_run("optimise", out, overwrite=overwrite, stopped=stopped) as frame:
        given = OptimisationFile.given(problem)
        usual = OptimiseSettings()
        check_within("--rounds", rounds, 1, 50)
        check_within("--front", front, 0, 50)
        least = 2 * max(given.orders) + 1
        check_within("--positions", positions, least, 400, "", "Twice the highest order and one.")
        settings = replace(
            usual,
            search=replace(usual.search, rounds=rounds),
            check=replace(usual.check, positions=positions),
            front=front,
            nominal=nominal,
        )
        with frame.results() as progress:
            results = run.run_optimise(
                given,
                settings,
                folder=out,
                jobs=jobs,
                progress=progress,
            )
        found = results.optimised
        frame.show(_table(given.name, measure_rows(found)))
        gear = out / f"{pair_stem(given.name)}.toml"
        frame.written(gear.name, "optimise.nc", "figures")
        tell_findings(findings(results.dataset), out / PAGE)
        kind = "contact" if found.problem.is_hypoid else "helical"
        logger.info("Next: gearlube %s %s", kind, gear)


def _table(name: str, rows: list[MeasureRow]) -> Table:
    table = empty_table(
        f"{name}: before and after, by the plain analysis",
        *(">torque [N·m]", "", "unit", ">before", ">after", ">change", "limit"),
    )
    torque = None
    for row in rows:
        limit = "" if row.limit is None else "kept" if row.is_kept else "not kept"
        table.add_row(
            "" if row.torque == torque else f"{row.torque:g}",
            row.what,
            row.unit,
            f"{row.before:.4g}",
            f"{row.after:.4g}",
            row.change,
            limit,
        )
        torque = row.torque
    return table
