"""Compile the axle once before many processes run it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

from gearlube.studies.sweep.channels import CHANNELS
from gearlube.studies.sweep.fmu_axle import FmuAxle
from gearlube.studies.sweep.gear_pair import final_drive_of, mesh_table_of
from gearlube.studies.sweep.operating_point import operation
from gearlube.studies.sweep.settings import SweepSettings
from gearlube.studies.sweep.unpack import unpacked
from gearlube_core.storage.process_pool import processors

_SPEED_KMH = 50.0


def compile_axle(fmu: Path, settings: SweepSettings) -> None:
    """Initialise the FMU and take two steps; meanwhile a second process compiles the outputs.

    The machine code stays in numba's cache on disk, from where the workers load it.
    """
    with (
        _compiling_outputs(),
        unpacked(fmu) as directory,
        FmuAxle(directory, CHANNELS) as axle,
    ):
        where = operation(settings, _SPEED_KMH, final_drive_of(mesh_table_of(directory)))
        axle.set_parameters(settings.fmu_parameters)
        axle.set_parameters({"pinion.speed_start": where.pinion_speed})
        torques = where.driver.initial_torques()
        axle.initialise(*torques, settings.oil_temperature)
        for _ in range(2):
            axle.step(settings.communication_step, *torques)
            axle.read()


@contextmanager
def _compiling_outputs() -> Iterator[None]:
    """Compile the kernel of the outputs in a process of its own, where there is a processor for it.

    The FMU needs it last and then finds it on disk. If that process fails, the FMU compiles it.
    """
    if processors() == 1:
        yield
        return
    process = get_context("spawn").Process(target=_compile_outputs, daemon=True)
    process.start()
    try:
        yield
    finally:
        process.terminate()
        process.join()


def _compile_outputs() -> None:
    from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle

    HypoidAxle(mohammadpour_2015_axle()).compile_outputs()
