"""The command `gearlube cycle`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.options import ExampleOption, OverwriteOption
from gearlube.cli.study_run import study_run

logger = logging.getLogger("gearlube")


def drive_cycle(
    axle: Annotated[
        str,
        typer.Argument(help="Axle file (TOML) or the name of a shipped one.", metavar="AXLE"),
    ] = "mohammadpour_2015",
    cycle: Annotated[
        str,
        typer.Option(
            "--cycle",
            "--trace",
            help="nedc, wltc, ftp75, a cycle of VECTO (.vdri), or a CSV file with time_s and "
            "speed_kmh, or time_s, pinion_speed_rpm and pinion_torque_n_m; a row at least every "
            "5 s.",
            metavar="NAME|FILE",
        ),
    ] = "nedc",
    start_temperature: Annotated[
        float, typer.Option(help="Initial temperature of oil and housing [degC].")
    ] = 23.0,
    air_temperature: Annotated[float, typer.Option(help="Air temperature [degC].")] = 23.0,
    regeneration: Annotated[
        float,
        typer.Option(
            help="Share of the braking beyond coast torque that goes through the axle, 0 to 1."
        ),
    ] = 0.0,
    coast_torque: Annotated[
        float,
        typer.Option(
            help="Drag of engine and gearbox at the pinion [N.m]; assumed, 0 to 60 for cars."
        ),
    ] = 30.0,
    heat_capacity: Annotated[
        float, typer.Option(help="Heat capacity of oil and housing [kJ/K]; assumed, 15 to 20.")
    ] = 18.0,
    conductance_at_rest: Annotated[
        float,
        typer.Option(
            help="Thermal conductance, housing to air, car at rest [W/K]; assumed, 4.5 to 10."
        ),
    ] = 7.0,
    conductance_at_100: Annotated[
        float,
        typer.Option(
            help="Thermal conductance, housing to air, at 100 km/h [W/K]; assumed, 9 to 30."
        ),
    ] = 18.0,
    check_grid: Annotated[
        bool,
        typer.Option(
            "--check-grid", help="Repeat with a loss map twice as fine and report the change."
        ),
    ] = False,
    draws: Annotated[
        int, typer.Option(help="Samples of the uncertain data for the error bars; 0: none.")
    ] = 60,
    seed: Annotated[int, typer.Option(help="Random seed of the samples.")] = 1,
    calibrated_bearings: Annotated[
        bool,
        typer.Option(
            "--calibrated-bearings",
            help="f0 and f1 of the file come from measured torques: smaller error bars.",
        ),
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_cycle"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Drive a car over a cycle: energy lost in its axle by source, and the oil temperature.

    Writes drive_cycle.nc, drive_cycle.csv, summary.csv, fastsim.yaml, co2mpas.csv, report.html and
    a figure.
    """
    if example:
        print_example("drivetrain.axle_file.axle_file:AxleFile", "mohammadpour_2015")
        return
    from drivetrain.axle_file.read_axle import read_axle
    from drivetrain.cycle.traces import DriveCycle
    from drivetrain.sump_heat import SumpHeat
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.report.inputs import noted_inputs
    from gearlube.studies.drive_cycle.report import cycle_report
    from gearlube.studies.drive_cycle.run import grid_change, run_cycle
    from gearlube.studies.drive_cycle.settings import DriveCycleSettings
    from gearlube_core.units import celsius_to_kelvin

    with study_run("cycle", out, overwrite=overwrite) as run:
        trace = DriveCycle.given(cycle)
        bring_gears_up_to_date(axle)
        settings = DriveCycleSettings(
            car=read_axle(axle),
            cycle=trace,
            start_temperature=celsius_to_kelvin(start_temperature),
            air_temperature=celsius_to_kelvin(air_temperature),
            regeneration=regeneration,
            coast_torque=coast_torque,
            heat=SumpHeat(
                capacity=1e3 * heat_capacity,
                conductance_at_rest=conductance_at_rest,
                conductance_at_100_kmh=conductance_at_100,
            ),
            draws=draws,
            seed=seed,
            calibrated_bearings=calibrated_bearings,
        )
        with run.results() as progress:
            dataset = run_cycle(settings, folder=out, progress=progress)
            if check_grid:
                change = grid_change(settings, dataset, progress)
                logger.info("A map twice as fine changes the energy by %+.2f %%.", 100.0 * change)
        run.written("drive_cycle.nc", "summary.csv", "figures")
        run.finish(cycle_report(dataset, noted_inputs(settings.car.inputs)))
