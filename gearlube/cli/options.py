"""Arguments and options that several commands have."""

from __future__ import annotations

from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube_core.checks import check_within

MOST_JOBS = 1024


def _checked_jobs(jobs: int | None) -> int | None:
    with exit_on_error():
        if jobs is not None:
            check_within("--jobs", jobs, 1, MOST_JOBS, "", "Leave it out to use all processors.")
    return jobs


CaseArgument = Annotated[
    str, typer.Argument(help="Case file (TOML) or the name of a shipped one.", metavar="CASE")
]
ExampleOption = Annotated[
    bool,
    typer.Option("--example", help="Print the shipped case as a file to start from, and stop."),
]
HelicalGearArgument = Annotated[
    str,
    typer.Argument(
        help="he_2007, jamali_2015_a, jamali_2015_b or a gear file (TOML).", metavar="GEAR"
    ),
]
TorqueOfFileOption = Annotated[
    float | None,
    typer.Option(help="Pinion torque [N.m]. Default: that of the gear file.", metavar="TORQUE"),
]
SpeedOfFileOption = Annotated[
    float | None,
    typer.Option(help="Pinion speed [rpm]. Default: that of the gear file.", metavar="RPM"),
]
OilTemperatureOption = Annotated[
    float, typer.Option(help="Oil temperature [degC].", metavar="DEGC")
]
RoughnessOption = Annotated[
    float, typer.Option(help="Composite rms roughness of the flanks [um].", metavar="UM")
]
FilmRoughnessOption = Annotated[
    float | None,
    typer.Option(
        help="Composite rms roughness of both surfaces [um], for the film ratio. The film itself "
        "stays the same.",
        metavar="UM",
    ),
]
JobsOption = Annotated[
    int | None,
    typer.Option(
        help="Number of parallel processes. Default: all processors.",
        metavar="N",
        callback=_checked_jobs,
    ),
]
OverwriteOption = Annotated[
    bool,
    typer.Option(
        "--overwrite",
        help="Write into OUT even if it holds results of another study, version or input.",
    ),
]
