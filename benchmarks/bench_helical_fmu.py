"""Cost of HelicalPair.fmu: `pytest -n 0 benchmarks/bench_helical_fmu.py --benchmark-only`.

The pair of He et al. 2007 at 1000 rpm and 2000 lbf in. `extra_info` has the simulated seconds per
second; HelicalPair.fmu is meant to have ten and more.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fmpy import extract, read_model_description
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.timing import instantiated
from fmu_src.build import build_helical_pair

FRICTION = {"film": 1, "constant": 2, "off": 3}
TORQUES = [225.97, 280.2028]  # N.m
SPEED = 104.71975511965977  # rad/s
GAIN = 0.05  # N.m s/rad


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = build_helical_pair(tmp_path_factory.mktemp("fmu"))
    return Path(extract(str(path), str(tmp_path_factory.mktemp("extracted"))))


@pytest.fixture
def slave(folder: Path) -> Iterator[Any]:
    slave = instantiated(folder)
    yield slave
    slave.freeInstance()


def initialise(slave: Any) -> None:
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()


def test_instantiate_and_free(benchmark: BenchmarkFixture, folder: Path) -> None:
    instantiated(folder).freeInstance()
    benchmark(lambda: instantiated(folder).freeInstance())


def test_initialise(benchmark: BenchmarkFixture, slave: Any) -> None:
    def again() -> None:
        slave.reset()
        initialise(slave)

    benchmark(again)


@pytest.mark.parametrize("friction", list(FRICTION))
@pytest.mark.parametrize("h", [1e-4, 1e-3, 1e-2])
def test_simulated_time_at_1000_rpm(
    benchmark: BenchmarkFixture, folder: Path, slave: Any, h: float, friction: str
) -> None:
    """Torques in, step, five outputs back: a real loop over 0.1 s at constant speed."""
    names = {v.name: v.valueReference for v in read_model_description(str(folder)).modelVariables}
    torques = [names["pinion.torque"], names["wheel.torque"]]
    wanted = ("pinion.speed", "friction.power_loss", "mesh.dte", "mesh.load", "efficiency")
    read = [names[name] for name in wanted]
    slave.setInteger([names["friction.model"]], [FRICTION[friction]])
    initialise(slave)
    time, speed, loss = 0.0, SPEED, 0.0

    def tenth_of_a_second() -> None:
        nonlocal time, speed, loss
        for _ in range(round(0.1 / h)):
            # the load takes what friction leaves, and a little more when the pair runs fast
            load = TORQUES[1] - 31.0 / 25.0 * loss / speed + GAIN * (speed - SPEED)
            slave.setReal(torques, [TORQUES[0], load])
            slave.doStep(time, h)
            speed, loss, *_ = slave.getReal(read)
            time += h

    benchmark(tenth_of_a_second)
    assert abs(speed / SPEED - 1.0) < 0.02
    benchmark.extra_info["simulated seconds per second"] = 0.1 / benchmark.stats["median"]
