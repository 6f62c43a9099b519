"""Cost of HypoidAxle.fmu through FMI: `pytest -n 0 benchmarks/bench_fmu.py --benchmark-only`."""

from __future__ import annotations

import ctypes
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fmpy import extract, read_model_description
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.timing import instantiated
from fmu_src.build import build_hypoid_axle

SHORT = 1e-6  # s: one inner step, so that the call itself is seen beside it


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = build_hypoid_axle(tmp_path_factory.mktemp("fmu"))
    return Path(extract(str(path), str(tmp_path_factory.mktemp("extracted"))))


@pytest.fixture
def slave(folder: Path) -> Iterator[Any]:
    slave = instantiated(folder)
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    yield slave
    slave.terminate()
    slave.freeInstance()


def _references(folder: Path, causality: str) -> tuple[Any, Any, int]:
    variables = read_model_description(str(folder)).modelVariables
    found = [v.valueReference for v in variables if v.causality == causality and v.type == "Real"]
    return (ctypes.c_uint * len(found))(*found), (ctypes.c_double * len(found))(), len(found)


def test_instantiate_and_free(benchmark: BenchmarkFixture, folder: Path) -> None:
    instantiated(folder).freeInstance()
    benchmark(lambda: instantiated(folder).freeInstance())


def test_initialise(benchmark: BenchmarkFixture, folder: Path) -> None:
    slave = instantiated(folder)

    def initialise() -> None:
        slave.reset()
        slave.setupExperiment()
        slave.enterInitializationMode()
        slave.exitInitializationMode()

    benchmark(initialise)
    slave.freeInstance()


@pytest.mark.parametrize("h", [SHORT, 1e-4, 1e-3])
def test_do_step(benchmark: BenchmarkFixture, slave: Any, h: float) -> None:
    count = itertools.count()
    benchmark(lambda: slave.fmi2DoStep(slave.component, next(count) * h, h, 1))


def test_a_call_that_stays_in_the_wrapper(benchmark: BenchmarkFixture, slave: Any) -> None:
    benchmark(lambda: slave.fmi2GetTypesPlatform())


def test_get_all_real_outputs(benchmark: BenchmarkFixture, slave: Any, folder: Path) -> None:
    references, values, n = _references(folder, "output")
    benchmark(lambda: slave.fmi2GetReal(slave.component, references, n, values))


def test_set_all_inputs(benchmark: BenchmarkFixture, slave: Any, folder: Path) -> None:
    references, values, n = _references(folder, "input")
    slave.fmi2GetReal(slave.component, references, n, values)
    benchmark(lambda: slave.fmi2SetReal(slave.component, references, n, values))


def test_save_and_restore_state(benchmark: BenchmarkFixture, slave: Any) -> None:
    def there_and_back() -> None:
        state = slave.getFMUstate()
        slave.setFMUstate(state)
        slave.freeFMUstate(state)

    benchmark(there_and_back)


@pytest.mark.parametrize("h", [1e-4, 1e-3, 1e-2])
def test_simulated_time_at_100_km_per_hour(
    benchmark: BenchmarkFixture, folder: Path, h: float
) -> None:
    """Torques in, step, five outputs back: a real loop over 0.1 s; extra_info has the factor."""
    names = {v.name: v.valueReference for v in read_model_description(str(folder)).modelVariables}
    slave = instantiated(folder)
    torques = [names["pinion.torque"], names["wheel.torque"]]
    motion = [names[n] for n in ("mesh.dte", "pinion.speed", "wheel.speed", "pinion.angle")]
    values = [66.2, 177.2]  # N.m, road load with all losses
    slave.setReal([names["pinion.speed_start"], *torques], [240.0, *values])
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    time = 0.0

    def tenth_of_a_second() -> None:
        nonlocal time
        for _ in range(round(0.1 / h)):
            slave.setReal(torques, values)
            slave.doStep(time, h)
            slave.getReal(motion)
            time += h

    benchmark(tenth_of_a_second)
    benchmark.extra_info["simulated seconds per second"] = 0.1 / benchmark.stats["median"]
    slave.terminate()
    slave.freeInstance()
