"""Options on the air that cools an axle, of the commands that find a steady oil temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

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
