"""Mean power loss of the axle, measured before a vehicle is coupled to it."""

from __future__ import annotations

import math

from drivetrain.drivers import Driver
from gearlube.studies.sweep.channels import LOSSES
from gearlube.studies.sweep.recording import SteppedAxle
from gearlube.studies.sweep.settings import SweepSettings

LOSS_CHANNELS = (
    "pinion.angle",
    "pinion.speed",
    "wheel.angle",
    "wheel.speed",
    *(f"energy.{loss}" for loss in LOSSES),
)
_SETTLING, _MEASURING = 0.06, 0.06  # s


def measured_loss(axle: SteppedAxle, driver: Driver, settings: SweepSettings) -> float:
    """Return the mean power that the axle loses in a short run [W].

    The speed controller of the vehicle is slower than the run: without this it would spend
    seconds to find the few per cent of engine torque that the axle takes.

    Parameters
    ----------
    axle : SteppedAxle
        Parameters set, not yet initialised; `read` returns LOSS_CHANNELS.
    driver : Driver
        Holds the speed of the axle.
    settings : SweepSettings
        Temperature and communication step.
    """
    h = settings.communication_step
    axle.initialise(*driver.initial_torques(), settings.oil_temperature)
    now = axle.read()
    lost_before = 0.0
    settling, total = math.ceil(_SETTLING / h), math.ceil((_SETTLING + _MEASURING) / h)
    for step in range(total):
        if step == settling:
            lost_before = float(now[4:].sum())
        axle.step(h, *driver.step(h, now[0], now[1], now[2], now[3]))
        now = axle.read()
    return (float(now[4:].sum()) - lost_before) / (h * (total - settling))
