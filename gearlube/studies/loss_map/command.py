"""The command `gearlube map`."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_if_failed
from gearlube.cli.options import (
    AirTemperatureOption,
    AxleArgument,
    ConductanceAt100Option,
    ConductanceAtRestOption,
    ExampleOption,
    OilOfAxleOption,
    OverwriteOption,
    given_cooling,
)
from gearlube.cli.study_run import study_run

if TYPE_CHECKING:
    from drivetrain.driveline.parameters import DrivelineParameters
    from drivetrain.steady_temperature import Cooling
    from drivetrain.sump_heat import SumpHeat
    from gearlube_core.arrays import Array

logger = logging.getLogger("gearlube")

_RPM = 0.104719755119660  # rad/s


def loss_map(
    axle: AxleArgument = "mohammadpour_2015",
    torques: Annotated[
        list[str] | None,
        typer.Option(
            help="Torques on the pinion [N.m], below 0 for coast: first:last:step and single "
            "values. Default: 21 from half the coast end of the mesh table to its drive end.",
            metavar="RANGE...",
        ),
    ] = None,
    speeds: Annotated[
        list[str] | None,
        typer.Option(
            "--speeds",
            "--speeds-rpm",
            help="Pinion speeds [rpm]. Default: 250:5000:250.",
            metavar="RANGE...",
        ),
    ] = None,
    temperatures: Annotated[
        list[str] | None,
        typer.Option(
            "--temperatures",
            "--oil-temperatures",
            help="Oil temperatures [degC]. Default: 40 60 80 100.",
            metavar="RANGE...",
        ),
    ] = None,
    oil: OilOfAxleOption = None,
    draws: Annotated[
        int,
        typer.Option(help="Samples of the uncertain data for error bars; 0: none.", metavar="N"),
    ] = 60,
    seed: Annotated[int, typer.Option(help="Random seed of the samples.")] = 1,
    calibrated_bearings: Annotated[
        bool,
        typer.Option(
            "--calibrated-bearings",
            help="f0 and f1 of the axle are from measured torques of its bearings: their drag is "
            "known to a factor of 1.25 in place of 2.",
        ),
    ] = False,
    steady_temperature: Annotated[
        bool,
        typer.Option(
            "--steady-temperature",
            help="Also find the steady oil temperature of each torque and speed in the car, where "
            "heat in and out balance, and the loss there.",
        ),
    ] = False,
    air_temperature: AirTemperatureOption = None,
    conductance_at_rest: ConductanceAtRestOption = None,
    conductance_at_100: ConductanceAt100Option = None,
    regulation_grid: Annotated[
        bool,
        typer.Option(
            "--regulation-grid",
            help="Also write a file for VECTO at 70 degC on the grid of heavy-duty axle tests: "
            "wheel speeds in steps of 50 rpm, wheel torques in steps of 250 N.m and more.",
        ),
    ] = False,
    regulation_raised: Annotated[
        bool,
        typer.Option(
            "--regulation-raised",
            help="The same with the loss raised by its uncertainty less the larger of 5 % and "
            "1 N.m.",
        ),
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_map"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Map the losses of an axle over torque, speed and oil temperature, with error bars.

    Writes map.nc, map.csv, map.mat, report.html, figures, and a file for VECTO, GEM and Modelica
    for each oil temperature.
    """
    if example:
        print_example("drivetrain.axle_file.axle_file:AxleFile", "mohammadpour_2015")
        return
    from drivetrain.axle_file.read_axle import read_axle
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.report.inputs import noted_inputs
    from gearlube.studies.loss_map.exports import write_regulation_map
    from gearlube.studies.loss_map.report import loss_map_report
    from gearlube.studies.loss_map.run import run_loss_map
    from gearlube.studies.loss_map.settings import LossMapSettings
    from gearlube_core.oil.oil_file import read_oil

    with study_run("map", out, overwrite=overwrite) as run:
        bring_gears_up_to_date(axle)
        described = read_axle(axle)
        described_axle = described.axle
        if oil is not None:
            described_axle = replace(described_axle, oil=read_oil(oil).lubricant)
            described_axle.check_oil_of_models()
        grid = _grid(described.axle.torque_range, torques, speeds, temperatures)
        settings = LossMapSettings(
            axle=described_axle,
            torques=grid.get("torques"),
            speeds=grid["speeds"],
            temperatures=grid.get("temperatures"),
            draws=draws,
            seed=seed,
            calibrated_bearings=calibrated_bearings,
            cooling=_cooling(
                described.driveline,
                given_cooling(
                    steady_temperature, air_temperature, conductance_at_rest, conductance_at_100
                ),
            ),
        )
        with run.results() as progress:
            dataset = run_loss_map(settings, folder=out, progress=progress)
            for raised, wanted in ((False, regulation_grid), (True, regulation_raised)):
                if wanted:
                    write_regulation_map(settings, out, raised=raised, progress=progress)
        logger.info("%d points.", dataset["status"].size)
        run.written("map.nc", "map.csv", "figures")
        run.finish(loss_map_report(dataset, noted_inputs(described.inputs), described.name))
        failures = int((dataset["status"] != 0).sum())
        exit_if_failed(f"{failures} points failed; map.csv says why." if failures else "")


def _cooling(
    driveline: DrivelineParameters, given: tuple[float, SumpHeat] | None
) -> Cooling | None:
    """Return the cooling that the options give; None if no steady temperature is wanted."""
    from drivetrain.steady_temperature import Cooling

    if given is None:
        return None
    return Cooling(driveline=driveline, air_temperature=given[0], heat=given[1])


def _grid(
    mesh_torques: tuple[float, float],
    torques: list[str] | None,
    speeds: list[str] | None,
    temperatures: list[str] | None,
) -> dict[str, Array]:
    """Return the grid in SI units; what was not asked for is left out."""
    import numpy as np

    from gearlube.cli.ranges import numbers_from
    from gearlube_core.dynamics.ranges import TORQUE_MARGIN
    from gearlube_core.units import ZERO_CELSIUS

    low, high = (TORQUE_MARGIN * one for one in mesh_torques)
    grid: dict[str, Array] = {}
    if torques:
        grid["torques"] = np.array(
            numbers_from("--torques", torques, "N.m", low, high, example="-100:300:20")
        )
    rpm = numbers_from(
        "--speeds", speeds or ["250:5000:250"], "rpm", 1.0, 47_000.0, example="250:5000:250"
    )
    grid["speeds"] = _RPM * np.array(rpm)
    if temperatures:
        degc = numbers_from(
            "--temperatures", temperatures, "degC", -60.0, 250.0, example="40:100:20"
        )
        grid["temperatures"] = np.array(degc) + ZERO_CELSIUS
    return grid
