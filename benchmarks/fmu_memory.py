"""Memory of a process that makes, runs and frees HypoidAxle.fmu again and again.

`python benchmarks/fmu_memory.py [COUNT]` logs the growth per instance and fails above 2 kB; what
remains are the strings that PythonFMU's wrapper leaks while it looks for the slave class.
"""

from __future__ import annotations

import gc
import logging
import sys
import tempfile

import psutil
from bench_fmu import instantiated
from fmpy import extract

from fmu_src.build import build_hypoid_axle

ALLOWED = 2000.0  # bytes per instance
WARM_UP = 200


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
    """Return the bytes by which the process grows per instance."""
    with tempfile.TemporaryDirectory() as name:
        folder = extract(str(build_hypoid_axle(name)), name + "/extracted")
        for _ in range(WARM_UP):
            _run(folder)
        before = _used()
        for _ in range(count):
            _run(folder)
        return (_used() - before) / count


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    instances = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    leak = growth(instances)
    logging.info("%d instances: %.0f bytes each", instances, leak)
    sys.exit(leak > ALLOWED)
