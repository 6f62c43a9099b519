"""The command `gearlube drivetrain`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.convert import REXS_ENDINGS, train_text
from gearlube.cli.example import print_example
from gearlube.cli.options import ExampleOption, OverwriteOption
from gearlube.cli.study_run import empty_table, study_run

_TARGET = "drivetrain.train.train_file:TrainFile"


def drivetrain(
    file: Annotated[
        str,
        typer.Argument(
            help="Train file (.toml), or the name of a shipped one, such as e_axle or "
            "e_axle_elastic; or a gearbox as REXS file (.rexs, .rexsj, .rexsz).",
            metavar="TRAIN",
        ),
    ] = "e_axle",
    duration_ms: Annotated[
        float, typer.Option(help="Length of the run [ms].", metavar="MS")
    ] = 50.0,
    step_us: Annotated[
        float | None,
        typer.Option(
            help="Time between two rows of the results [us]. Default: 1/24 of the shortest mesh "
            "period.",
            metavar="US",
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_drivetrain"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Run a drivetrain of bodies and elements: modes, transmission errors, losses.

    Writes drivetrain.nc with all outputs over time, report.html and figures; of a REXS file
    also train.toml, the train file to go on with.
    """
    if example:
        print_example(_TARGET, "e_axle")
        return
    from drivetrain.train.train_file import TrainFile
    from gearlube.report.inputs import file_inputs
    from gearlube.studies.drivetrain.report import losses, report, save_figures
    from gearlube.studies.drivetrain.run import run_drivetrain
    from gearlube_core.checks import check_within
    from gearlube_core.rexs.gearbox import read_gearbox
    from gearlube_core.storage.atomic_file import write_text

    with study_run("drivetrain", out, overwrite=overwrite) as run:
        check_within("--duration-ms", duration_ms, 1e-3, 1e7, "ms")
        if step_us is not None:
            check_within("--step-us", step_us, 0.1, min(1e5, 1e3 * duration_ms), "us")
        gearbox = read_gearbox(file) if Path(file).suffix.lower() in REXS_ENDINGS else None
        given = TrainFile.from_data(gearbox.data, file) if gearbox else TrainFile.given(file)
        case = given.case()
        with run.results() as progress:
            dataset = run_drivetrain(
                case,
                duration=1e-3 * duration_ms,
                step=None if step_us is None else 1e-6 * step_us,
                folder=out,
                progress=progress,
            )
            figures = save_figures(dataset, case.train, out / "figures")
            if gearbox:
                write_text(train_text(gearbox), out / "train.toml")
        table = empty_table("Power lost, mean of the second half", "kind", ">W")
        for name, power in losses(dataset).items():
            table.add_row(name.replace("_", " "), f"{power:.4g}")
        run.show(table)
        run.written("drivetrain.nc", "figures", *(["train.toml"] if gearbox else []))
        run.finish(report(dataset, figures, file_inputs(given), gearbox.notes if gearbox else ()))
