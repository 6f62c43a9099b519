"""What several benchmarks measure with."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fmpy import fmi2, read_model_description


def median_time(function: Callable[[], Any], rounds: int) -> float:
    """Return the median wall time [s] after one call that is not counted."""
    function()
    walls = []
    for _ in range(rounds):
        start = time.perf_counter()
        function()
        walls.append(time.perf_counter() - start)
    return statistics.median(walls)


def instantiated(folder: Path) -> Any:
    """Return an instance of an FMU 2.0 whose files are in a folder."""
    description = read_model_description(str(folder))
    name = description.coSimulation.modelIdentifier
    slave = fmi2.FMU2Slave(
        guid=description.guid, unzipDirectory=str(folder), modelIdentifier=name, instanceName=name
    )
    slave.instantiate()
    return slave
