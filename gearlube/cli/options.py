"""Arguments and options that several commands have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube_core.checks import check_within

if TYPE_CHECKING:
    from drivetrain.sump_heat import SumpHeat

AirTemperatureOption = Annotated[
    float | None,
    typer.Option(help="Air temperature for --steady-temperature [degC]. Default: 23."),
]
ConductanceAtRestOption = Annotated[
    float | None,
    typer.Option(
        help="Thermal conductance, housing to air, car at rest [W/K]; "
        "assumed, 4.5 to 10. Default: 7."
    ),
]
ConductanceAt100Option = Annotated[
    float | None,
    typer.Option(
        help="Thermal conductance, housing to air, at 100 km/h [W/K]; "
        "assumed, 9 to 30. Default: 18."
    ),
]
MOST_JOBS = 1024


def given_cooling(
    wanted: bool, air: float | None, at_rest: float | None, at_100: float | None
) -> tuple[float, SumpHeat] | None:
    """Return air temperature [K] and conductances; None where no steady temperature is wanted.

    Raises
    ------
    ParameterError
        A value is given without --steady-temperature, or out of range.
    """
    from drivetrain.sump_heat import SumpHeat
    from gearlube_core.errors import ParameterError
    from gearlube_core.units import celsius_to_kelvin

    given = {
        "--air-temperature": air,
        "--conductance-at-rest": at_rest,
        "--conductance-at-100": at_100,
    }
    if not wanted:
        idle = [name for name, value in given.items() if value is not None]
        if idle:
            raise ParameterError(
                f"{idle[0]} works only with --steady-temperature. Add that option, or leave this "
                "one out."
            )
        return None
    usual = SumpHeat()
    heat = SumpHeat(
        conductance_at_rest=usual.conductance_at_rest if at_rest is None else at_rest,
        conductance_at_100_kmh=usual.conductance_at_100_kmh if at_100 is None else at_100,
    )
    return celsius_to_kelvin(23.0 if air is None else air), heat


def _checked_jobs(jobs: int | None) -> int | None:
    with exit_on_error():
        if jobs is not None:
            check_within("--jobs", jobs, 1, MOST_JOBS, "", "Leave it out to use all processors.")
    return jobs


CaseArgument = Annotated[
    str, typer.Argument(help="Case file (TOML) or the name of a shipped one.", metavar="CASE")
]
AxleArgument = Annotated[
    str, typer.Argument(help="Axle file (TOML) or the name of a shipped one.", metavar="AXLE")
]
OilOfAxleOption = Annotated[
    str | None,
    typer.Option(
        help="Shipped oil or an oil file (TOML). Default: that of the axle.", metavar="OIL"
    ),
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
