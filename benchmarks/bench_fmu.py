"""Cost of HypoidAxle.fmu through FMI: `pytest benchmarks/bench_fmu.py --benchmark-only`."""

from __future__ import annotations

import ctypes
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fmpy import extract, fmi2, read_model_description
from pytest_benchmark.fixture import BenchmarkFixture

from fmu_src.build import build_hypoid_axle

SHORT = 1e-6  # s: one inner step, so that the call itself is seen beside it


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = build_hypoid_axle(tmp_path_factory.mktemp("fmu"))
    return Path(extract(str(path), str(tmp_path_factory.mktemp("extracted"))))


def instantiated(folder: Path) -> Any:
    description = read_model_description(str(folder))
    slave = fmi2.FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="axle",
    )
    slave.instantiate()
    return slave


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
