"""Memory of a process that makes, runs and frees HypoidAxle.fmu again and again.

`python benchmarks/fmu_memory.py [COUNT]` logs the growth per instance and fails above 10 kB, less
than one axle that is not freed. About 1 kB is leaked by PythonFMU's wrapper while it looks for the
slave class; memory grows in lumps, so that a thousand instances resolve it to a few kB only.
"""

from __future__ import annotations

import gc
import logging
import sys
import tempfile

import numpy as np
import psutil
from bench_fmu import instantiated
from fmpy import extract

from fmu_src.build import build_hypoid_axle

_LOGGER = logging.getLogger("fmu_memory")
ALLOWED = 1e4  # bytes per instance
WARM_UP = 500
BATCH = 100


def _used() -> int:
    gc.collect()
    return int(psutil.Process().memory_info().rss)


def _run(folder: str) -> None:
    slave = instantiated(folder)
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=1e-4)
    slave.terminate()
    slave.freeInstance()


def growth(count: int) -> float:
    """Return the bytes by which the process grows per instance: slope of the resident size."""
    with tempfile.TemporaryDirectory() as name:
        folder = extract(str(build_hypoid_axle(name)), name + "/extracted")
        for _ in range(WARM_UP):
            _run(folder)
        used = [_used()]
        for _ in range(0, count, BATCH):
            for _ in range(BATCH):
                _run(folder)
            used.append(_used())
        return float(np.polyfit(BATCH * np.arange(len(used)), used, 1)[0])


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    instances = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    leak = growth(instances)
    _LOGGER.info("%d instances: %.0f bytes each", instances, leak)
    sys.exit(leak > ALLOWED)
