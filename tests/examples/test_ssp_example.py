"""The car and its axle as native FMUs in SSP archives compute what the coupled models compute."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.fmu_hosts.hosts import Job, c_host, in_c_host, in_fmpy
from examples.ssp import run
from examples.ssp.driveline_fmu import build_driveline
from examples.ssp.system import write_ssp, write_ssv
from fmu_src.check import problems
from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus

STEPS = 200
OUTPUTS = ("pinion.torque", "wheel.torque", "vehicle.speed", "engine.speed")


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    path = tmp_path_factory.mktemp("ssp") / "Driveline.fmu"
    return {
        "car": build_driveline(run.driveline(), path),
        "axle": native_fmus(HYPOID_AXLE).fmi2,
    }


@pytest.mark.parametrize("ripple", [1.0, 0.0])
def test_the_driveline_as_an_fmu_is_the_driveline_of_the_package(
    fmus: dict[str, Path], ripple: float
) -> None:
    car = run.driveline()
    pinion, wheel = car.steady.pinion_speed, car.steady.wheel_speed
    job = Job(
        fmu=fmus["car"],
        reals={"engine.order_scale": ripple, "vehicle.speed_request": 20.5},
        integers={},
        names=OUTPUTS,
        step_size=2.0**-13,
        steps=500,
    )
    state = car.get_state()
    if ripple == 0.0:
        state[: len(car.steady.state)] = car.steady.state
    state[-1] = ripple
    car.set_state(state)
    car.request_speed(20.5)
    for _ in range(job.steps):
        torques = car.step(job.step_size, 0.0, pinion, 0.0, wheel)
    expected = [*torques, car.vehicle_speed, car.engine_speed]
    assert in_fmpy(job) == pytest.approx(expected, rel=1e-12)  # rounding: another compiler


def test_the_driveline_as_an_fmu_starts_in_its_steady_state_and_passes_the_checkers(
    fmus: dict[str, Path],
) -> None:
    steady = run.driveline().steady
    job = Job(fmu=fmus["car"], reals={}, integers={}, names=OUTPUTS[:2], steps=0)
    assert in_fmpy(job) == pytest.approx([steady.pinion_torque, steady.wheel_torque], rel=1e-15)
    assert problems(fmus["car"]) == []


def test_the_driveline_refuses_steps_that_its_integration_cannot_take(
    fmus: dict[str, Path], tmp_path: Path
) -> None:
    job = Job(fmu=fmus["car"], reals={}, integers={}, names=OUTPUTS, step_size=2.0**-11)
    with pytest.raises(RuntimeError, match=r"steps of the driveline must be at most 0\.25 ms"):
        in_c_host(job, c_host(tmp_path), tmp_path)


@pytest.mark.parametrize("oil", run.OILS)
def test_ecos_and_libcosim_couple_both_fmus_as_python_does(
    fmus: dict[str, Path], tmp_path: Path, oil: str
) -> None:
    sets = run.parameter_sets(run.driveline(), oil)
    archive = write_ssp(tmp_path / "car_and_axle.ssp", fmus["car"], fmus["axle"], sets)
    expected = run.in_python(oil, STEPS)
    # the processor's instructions differ between Python and FMU: roundings of 1e-16 over 10 ms
    assert run.in_ecos(archive, oil, STEPS) == pytest.approx(expected, rel=1e-9)
    assert run.in_libcosim(archive, fmus, STEPS) == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_fmpy_runs_the_archive_with_a_system_connector(
    fmus: dict[str, Path], tmp_path: Path
) -> None:
    paths = fmus["car"], fmus["axle"]
    archive = write_ssp(tmp_path / "whole.ssp", *paths, [], system_connectors=True)
    oil = "mohammadpour"
    values = write_ssv(tmp_path / "start.ssv", run.parameter_sets(run.driveline(), oil)[:2])
    found = run.in_fmpy(archive, values, 2000)
    # its first step has all connected signals at 0; the jerk changes the speed by 1e-6 of it
    assert found == pytest.approx(run.in_python(oil, 2000)[0], rel=1e-6)
