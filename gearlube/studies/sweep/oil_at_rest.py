"""The steady oil temperature of a point of a sweep, where heat in and out balance."""

from __future__ import annotations

from dataclasses import replace

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.steady_temperature import steady_temperature
from drivetrain.sump_heat import SumpHeat
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube_core.errors import ConvergenceError
from gearlube_core.units import kmh_to_ms

_ROUNDS, _SETTLED = 20, 1e-4  # K; a round leaves some per cent of the last one's change


def oil_at_rest(car: CarAxle, speed_kmh: float, settings: SweepSettings) -> SweepSettings:
    """Return the settings with the oil temperature at which the air takes what the axle loses.

    Parameters
    ----------
    car : CarAxle
        Axle and car of the point, with its preload and oil.
    speed_kmh : float
        Vehicle speed [km/h].
    settings : SweepSettings
        Unless its `oil_state` is "steady" it comes back as it is.

    Raises
    ------
    ParameterError
        The oil would leave the range of its data.

    Notes
    -----
    The pinion's torque is that of the road and that of the loss, which is hA (T - T_air) at rest.
    The loss is that of `axle_losses`, within 1 % of the march that follows.
    """
    if settings.oil_state != STEADY:
        return settings
    road = car.driveline.road_load
    speed = kmh_to_ms(speed_kmh)
    heat = SumpHeat(
        conductance_at_rest=settings.conductance_at_rest,
        conductance_at_100_kmh=settings.conductance_at_100_kmh,
    )
    found = settings.air_temperature
    for _ in range(_ROUNDS):
        lost = heat.conductance(speed) * (found - settings.air_temperature)
        before = found
        found = steady_temperature(
            car,
            torque=road.pinion_torque(speed, lost),
            speed=road.pinion_speed(speed),
            air_temperature=settings.air_temperature,
            heat=heat,
        )
        if abs(found - before) < _SETTLED:
            return replace(settings, oil_temperature=found)
    raise ConvergenceError(
        f"The oil temperature at {speed_kmh:g} km/h must settle within {_ROUNDS} rounds, but it "
        f"changed by {abs(found - before):.3g} K in the last one. Change the speed a little."
    )
