"""Cost of loss maps and drive cycles: `python -m benchmarks.bench_losses`, two minutes.

Prints the figures of benchmarks/README.md: wall and processor time of one process.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from drivetrain.axle_file.read_axle import read_axle
from drivetrain.cycle.traces import DriveCycle
from drivetrain.steady_temperature import Cooling
from gearlube.studies.drive_cycle.run import run_cycle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube.studies.loss_map.regulation import regulation_map
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings

_LOGGER = logging.getLogger("bench_losses")


def timed(words: str, call: Callable[[], object]) -> None:
    """Run a call and print its wall and processor time."""
    wall, cpu = time.perf_counter(), time.process_time()
    call()
    _LOGGER.info(
        "%-52s %6.1f s, %6.1f s of processor",
        words,
        time.perf_counter() - wall,
        time.process_time() - cpu,
    )


def main() -> None:
    """Print the cost of each."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    car = read_axle("mohammadpour_2015")
    grid = {"torques": np.linspace(-190.0, 380.0, 20), "speeds": np.linspace(25.0, 525.0, 20)}
    point = LossMapSettings(
        axle=car.axle, torques=np.array([50.0]), speeds=np.array([200.0]), draws=0
    )
    timed("first point: compiled code from disk", lambda: run_loss_map(point))
    plain = LossMapSettings(axle=car.axle, draws=0, **grid)
    timed("map of 20 x 20 x 4 points", lambda: run_loss_map(plain))
    usual = LossMapSettings(axle=car.axle, draws=60, **grid)
    timed("the same with 60 draws and 18 ends", lambda: run_loss_map(usual))
    cooled = LossMapSettings(
        axle=car.axle, draws=0, cooling=Cooling(driveline=car.driveline), **grid
    )
    timed("map with steady temperatures", lambda: run_loss_map(cooled))
    timed("grid of heavy-duty axle tests, 259 points", lambda: regulation_map(plain))
    cold = DriveCycleSettings(car=car, cycle=DriveCycle.named("nedc"), draws=0)
    timed("NEDC from 23 degC", lambda: run_cycle(cold))
    timed("NEDC with error bars", lambda: run_cycle(replace(cold, draws=60)))
    finer = replace(cold, grid=cold.grid.finer)
    timed("NEDC with a map twice as fine", lambda: run_cycle(finer))


if __name__ == "__main__":
    main()
