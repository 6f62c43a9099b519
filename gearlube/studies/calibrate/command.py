"""The command `gearlube calibrate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.options import AxleArgument, OverwriteOption
from gearlube.cli.study_run import study_run


def calibrate(
    axle: AxleArgument,
    measurements: Annotated[
        Path,
        typer.Argument(
            help="Table of loss torques or efficiencies (.csv); columns end with their unit.",
            metavar="TABLE",
        ),
    ],
    inputs: Annotated[
        list[str],
        typer.Option(
            "--input",
            help="Uncertain inputs to fit, such as churning,seals,bearing_drag; repeat it or part "
            "them by commas. A wrong name lists those of the axle.",
            metavar="NAME,...",
        ),
    ],
    gain: Annotated[
        float,
        typer.Option(help="Standard deviation of the gain of the torque sensor [%].", metavar="%"),
    ] = 3.0,
    offset: Annotated[
        float,
        typer.Option(help="Standard deviation of the sensor's zero [N.m].", metavar="N.M"),
    ] = 0.2,
    model_error: Annotated[
        float,
        typer.Option(
            help="Standard deviation of the model's own error [%], alike at near torques.",
            metavar="%",
        ),
    ] = 5.0,
    runs: Annotated[
        int | None,
        typer.Option(
            help="Runs of the axle for the emulator. Default: enough for the inputs.", metavar="N"
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of the random numbers.")] = 1,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_calibrate"),
    overwrite: OverwriteOption = False,
) -> None:
    """Fit uncertain inputs of an axle to measured losses; name those that stay unknown.

    Writes calibrated.toml (the axle file), calibrated.ssv (for its FMU), draws.csv, residuals.csv,
    report.html and figures.
    """
    from drivetrain.axle_file.read_axle import read_axle
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.studies.calibrate.results import calibration_report, write_calibration
    from gearlube.studies.calibrate.run import CalibrationSettings, run_calibration
    from gearlube_core.input_file.measurements import read_measurements

    with study_run("calibrate", out, overwrite=overwrite) as run:
        measured = read_measurements(measurements)
        bring_gears_up_to_date(axle)
        described = read_axle(axle)
        settings = CalibrationSettings(
            axle=described.axle,
            measured=measured,
            inputs=tuple(
                name.strip().removesuffix("_factor") for one in inputs for name in one.split(",")
            ),
            gain=0.01 * gain,
            offset=offset,
            model_error=0.01 * model_error,
            runs=runs,
            seed=seed,
        )
        with run.results() as progress:
            found = run_calibration(settings, folder=out, progress=progress)
            written = write_calibration(found, described, axle, out)
        run.written("calibrated.toml", "calibrated.ssv", "draws.csv", "residuals.csv", "figures")
        run.finish(calibration_report(found, written, described))
