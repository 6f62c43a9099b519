"""Compile the axle once before many processes run it."""

from __future__ import annotations

from pathlib import Path

from gearlube.studies.sweep.axle_in_fmu import car_axle_of
from gearlube.studies.sweep.channels import CHANNELS
from gearlube.studies.sweep.fmu_axle import FmuAxle
from gearlube.studies.sweep.operating_point import operation
from gearlube.studies.sweep.settings import SweepSettings
from gearlube.studies.sweep.unpack import unpacked

_SPEED_KMH = 50.0


def compile_axle(fmu: Path, settings: SweepSettings) -> None:
    """Initialise the FMU and take two steps.

    The machine code stays in numba's cache on disk, from where the workers load it.
    """
    with unpacked(fmu) as directory, FmuAxle(directory, CHANNELS) as axle:
        where = operation(settings, _SPEED_KMH, car_axle_of(directory).driveline)
        axle.set_parameters(settings.fmu_parameters)
        axle.set_parameters({"pinion.speed_start": where.pinion_speed})
        torques = where.driver.initial_torques()
        axle.initialise(*torques, settings.lowest_oil_temperature[1])
        for _ in range(2):
            axle.step(settings.communication_step, *torques)
            axle.read()
