"""The command `gearlube helical`."""

from __future__ import annotations

import logging
import shlex
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from gearlube.cli.exit_codes import INTERRUPTED, told
from gearlube.cli.options import (
    HelicalGearArgument,
    JobsOption,
    OilTemperatureOption,
    RoughnessOption,
    SpeedOfFileOption,
    TorqueOfFileOption,
)
from gearlube.cli.ranges import numbers_from
from gearlube.cli.spread_values import SpreadingCommand
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin

logger = logging.getLogger("gearlube")
console = Console(stderr=True)

_RPM = 0.10471975511965977  # rad/s


class HelicalCommand(SpreadingCommand):
    """Takes several values after some options."""

    spreading = frozenset({"--mu", "--speeds-rpm", "--torques"})


def helical(
    gear: HelicalGearArgument = "he_2007",
    torque: TorqueOfFileOption = None,
    speed_rpm: SpeedOfFileOption = None,
    mu: Annotated[
        list[str] | None,
        typer.Option(
            help="Coefficients of friction: first:last:step and single values. Default 0:0.3:0.01.",
            metavar="RANGE...",
        ),
    ] = None,
    speeds_rpm: Annotated[
        list[str] | None,
        typer.Option(
            help="Pinion speeds of the sweep [rpm]. Default: 60 past the mesh resonance.",
            metavar="RANGE...",
        ),
    ] = None,
    friction: Annotated[
        str,
        typer.Option(
            help="film: oil film beside the constant coefficients; constant: these alone.",
            metavar="film|constant",
        ),
    ] = "film",
    mesh: Annotated[
        str,
        typer.Option(
            help="density: one stiffness along all contact lines; contact: that of the loaded "
            "contact.",
            metavar="density|contact",
        ),
    ] = "density",
    density: Annotated[
        float | None,
        typer.Option(
            help="Stiffness per length of contact line [N/(um mm)]. Default: ISO 6336-1.",
            metavar="DENSITY",
        ),
    ] = None,
    torques: Annotated[
        list[float] | None,
        typer.Option(
            help="Pinion torques of the loaded contact [N.m], one or more. Default: 0.1 to 1.5 "
            "times TORQUE.",
            metavar="TORQUE...",
        ),
    ] = None,
    positions: Annotated[
        int, typer.Option(help="Mesh phases of the loaded contact.", metavar="N")
    ] = 24,
    oil: Annotated[
        str, typer.Option(help="mohammadpour_2015, karagiannis_2012 or jamali_2015.")
    ] = "mohammadpour_2015",
    oil_temperature: OilTemperatureOption = 80.0,
    roughness_um: RoughnessOption = 0.5,
    parts: Annotated[
        str,
        typer.Option(help="What to run.", metavar="all|contact|dynamics|geometry"),
    ] = "all",
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_helical"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Few points and coarse teeth, for a first look.")
    ] = False,
) -> None:
    """Study a helical or spur pair; write NetCDF datasets, summary.csv and figures.

    Loaded contact, vibration under sliding friction, parametric instability, tooth separation,
    oil film, geometry. Finished parts are kept in OUT/parts: run the same command again to go on
    after a stop.
    """
    from gearlube.studies.helical.console import console_helical
    from gearlube.studies.helical.settings import HelicalSettings, quick_settings
    from gearlube_core.helical_geometry.gear_file import HelicalGearFile

    with told(f"Stopped while results were written; {out} may be incomplete."):
        file = HelicalGearFile.given(gear)
        if jobs is not None:
            check_within("--jobs", jobs, 1, 1024)
        check_within("--oil-temperature", oil_temperature, -20.0, 160.0, "degC")
        given = file.operation
        torque = torque if torque is not None or given is None else given.pinion_torque_n_m
        speed_rpm = speed_rpm if speed_rpm is not None or given is None else given.pinion_speed_rpm
        if torque is None or speed_rpm is None:
            raise ParameterError(
                f"--torque and --speed-rpm must be given for {file.name}, whose file has no "
                f"[operation], got {torque} N.m and {speed_rpm} rpm. Add the section or give both."
            )
        check_within("--torque", torque, 1e-3, 1e6, "N.m", "Give its magnitude.")
        check_within("--speed-rpm", speed_rpm, 0.1, 1e6, "rpm", "Give its magnitude.")
        if density is not None:
            check_within("--density", density, 1e-2, 1e4, "N/(um mm)", "13 is usual for steel.")
        speeds = numbers_from(
            "--speeds-rpm", speeds_rpm or (), "rpm", 0.1, 1e6, example="100:3000:100"
        )
        settings = HelicalSettings(
            file=file,
            pinion_torque=torque,
            pinion_speed=speed_rpm * _RPM,
            mu=numbers_from("--mu", mu or ("0:0.3:0.01",), "", 0.0, 1.0, example="0:0.3:0.01"),
            speeds=tuple(speed * _RPM for speed in speeds),
            friction=friction,
            mesh=mesh,
            density=None if density is None else 1e9 * density,
            torques=tuple(sorted(set(torques or ()))),
            positions=positions,
            oil=oil,
            oil_temperature=celsius_to_kelvin(oil_temperature),
            roughness_rms=1e-6 * roughness_um,
            parts=parts,
        )
        outcome = console_helical(
            console,
            settings=quick_settings(settings) if quick else settings,
            out=out,
            jobs=jobs,
            command_line=shlex.join(["gearlube", *sys.argv[1:]]),
        )
    if outcome == INTERRUPTED:
        logger.warning("Stopped. Run the same command again to go on from %s.", out / "parts")
    if outcome:
        raise typer.Exit(outcome)
