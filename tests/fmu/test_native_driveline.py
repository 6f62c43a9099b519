"""Driveline.fmu against the driveline of the package."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import fmpy
import numpy as np
import pytest

from docs.fmu_hosts.hosts import Job, in_c_host, in_fmpy
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.engine import Gearbox
from fmu_src import build
from fmu_src.build import axle_definition, pair_definition
from fmu_src.check import problems
from fmu_src.native.build import NativeOptions, build_native, native_guid
from fmu_src.native.driveline import default_car, driveline_model
from fmu_src.native.model import NativeModel
from fmu_src.native.models import native_model
from fmu_src.native.platforms import platform_of_this_machine
from gearlube_core.errors import ParameterError
from tests.helpers.native_fmus import unpacked_library
from tests.helpers.native_library import OK, NativeInstance, NativeLibrary
from tests.helpers.native_walk import walk
from tests.helpers.reference_run import check_reference

OUTPUTS = ("pinion.torque", "wheel.torque", "vehicle.speed", "engine.speed", "start.pinion_speed",
           "start.gear")  # fmt: skip


@pytest.fixture(scope="module")
def model() -> NativeModel:
    return driveline_model()


@pytest.fixture(scope="module")
def fmus(model: NativeModel, tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    options = NativeOptions(platforms=[platform_of_this_machine()])
    return build_native(model, tmp_path_factory.mktemp("driveline"), options)


@pytest.fixture(scope="module")
def one_gear(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, DrivelineParameters, float]:
    """An FMU with one gear, its car, and a speed of its table of starts [m/s]."""
    car = dataclasses.replace(default_car(), gearbox=Gearbox(ratios=(2.0,)))
    model = driveline_model(car)
    options = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
    (fmu,) = build_native(model, tmp_path_factory.mktemp("one_gear"), options)
    # engine speeds at idle and at most, then speeds of the vehicle in this gear
    return fmu, car, float(model.data[4])


def expected(car: Driveline, ripple: float, steps: int, h: float) -> list[float]:
    """Last outputs of the driveline in Python, asked to go 0.5 m/s faster on a rigid axle."""
    pinion, wheel = car.steady.pinion_speed, car.steady.wheel_speed
    state = car.get_state()
    if ripple == 0.0:
        state[: len(car.steady.state)] = car.steady.state
    state[-1] = ripple
    car.set_state(state)
    car.request_speed(float(car.inputs[0]) + 0.5)
    torques = car.steady.pinion_torque, car.steady.wheel_torque
    for k in range(steps):
        at = k * h
        torques = car.step(h, at * pinion, pinion, at * wheel, wheel)
    return [*torques, car.vehicle_speed, car.engine_speed, pinion, car.gear]


@pytest.mark.slow
@pytest.mark.parametrize("speed", [3.0, 8.7, 13.1, 20.0, 41.0])
def test_it_starts_as_the_driveline_of_the_package(fmus: list[Path], speed: float) -> None:
    car = Driveline(default_car(), speed)
    job = Job(
        fmu=fmus[0],
        reals={
            "vehicle.speed_start": speed,
            "vehicle.speed_request": speed + 0.5,
            "pinion.speed": car.steady.pinion_speed,
            "wheel.speed": car.steady.wheel_speed,
        },
        integers={},
        names=OUTPUTS,
        step_size=2.0**-13,
        steps=0,
    )
    # between 33 speeds of a gear, by a cubic: road load is nearly one, the orders' answer is not
    found = in_fmpy(job)
    assert found[:2] == pytest.approx([car.steady.pinion_torque, car.steady.wheel_torque], rel=1e-6)
    assert found[4:] == [pytest.approx(car.steady.pinion_speed, rel=1e-9), car.gear]
    assert in_fmpy(dataclasses.replace(job, steps=1))[3] == pytest.approx(
        expected(car, 1.0, 1, job.step_size)[3], rel=1e-5
    )


@pytest.mark.parametrize(
    ("ripple", "h", "connected"),
    [(1.0, 2.0**-13, True), (0.0, 2.0**-13, True), (1.0, 2.0**-8, True), (1.0, 2.0**-8, False)],
)
def test_it_computes_what_the_package_computes(
    one_gear: tuple[Path, DrivelineParameters, float], ripple: float, h: float, connected: bool
) -> None:
    """At a speed of the table of starts, to rounding: the highest of the only gear.

    Longer steps than the integration resolves are taken in parts. Angles that are not connected
    stay at their start value and are continued with the speeds.
    """
    fmu, car, speed = one_gear
    python = Driveline(car, speed * (1.0 - 1e-12))
    steps = round(0.0625 / h)
    names = OUTPUTS[:4]
    wanted = expected(python, ripple, steps, h)[:4]
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=steps * h,
        output_interval=h,
        start_values={
            "engine.order_scale": ripple,
            "vehicle.speed_start": speed,
            "vehicle.speed_request": speed + 0.5,
            "pinion.speed": python.steady.pinion_speed,
            "wheel.speed": python.steady.wheel_speed,
        },
        input=_motion(python, steps, h) if connected else None,
        output=names,
    )
    found = [float(result[name][-1]) for name in names]
    assert found == pytest.approx(wanted, rel=1e-9)  # the start differs by 1e-12


def _motion(car: Driveline, steps: int, h: float):  # type: ignore[no-untyped-def]
    steady = car.steady
    times = np.arange(steps + 1) * h
    columns = {
        "time": times,
        "pinion.angle": steady.pinion_speed * times,
        "pinion.speed": np.full_like(times, steady.pinion_speed),
        "wheel.angle": steady.wheel_speed * times,
        "wheel.speed": np.full_like(times, steady.wheel_speed),
    }
    table = np.zeros(times.size, dtype=[(name, float) for name in columns])
    for name, values in columns.items():
        table[name] = values
    return table


@pytest.mark.slow
def test_checkers_find_no_problem(fmus: list[Path]) -> None:
    assert [problems(fmu) for fmu in fmus] == [[], []]


def test_its_reference_results_come_out_again(fmus: list[Path], tmp_path: Path) -> None:
    """80 km/h lie between the speeds of the table of starts."""
    for fmu in fmus:
        expected = check_reference(fmu, tmp_path / fmu.stem)
        # the controller has begun to answer the request of 2 % more, and the torque orders swing
        assert expected["vehicle.speed"][-1] > expected["vehicle.speed"][25]
        assert np.ptp(expected["pinion.torque"]) > 1.0


@pytest.mark.parametrize("h", [None, 1e-5, 1e-2, 0.1])
def test_it_holds_its_speed_by_its_defaults_in_any_step(fmus: list[Path], h: float | None) -> None:
    """By its defaults alone the car holds the 80 km/h that it starts with."""
    for fmu in fmus:
        stop = None if h is None else min(1.0, 100 * h)
        result = fmpy.simulate_fmu(str(fmu), output_interval=h, stop_time=stop)
        assert result["time"][-1] == pytest.approx(stop or 1.0, rel=1e-9)
        # the engine's orders swing the car by less than 1e-4 of its speed
        assert result["vehicle.speed"] == pytest.approx(80.0 / 3.6, rel=1e-4)
        assert not result["range.exceeded"].any()


def test_every_value_that_a_host_sets_has_finite_limits(model: NativeModel) -> None:
    models = [model, native_model(axle_definition()), native_model(pair_definition())]
    given = [v for one in models for v in one.definition.variables if not v.is_computed]
    assert [v.name for v in given if not all(map(math.isfinite, v.range))] == []


@pytest.mark.parametrize("version", [2, 3])
def test_random_and_extreme_calls_never_break_it(
    model: NativeModel, fmus: list[Path], version: int, tmp_path: Path
) -> None:
    path = unpacked_library(fmus[version - 2], version, tmp_path)
    library = NativeLibrary(path, model, str(native_guid(model)), version)
    counts = walk(library, sequences=150, seed=1)
    for kind in ("start 0", "steps 0", "step 2", "get 0", "freed_again 3", "forged 0", "forged 3"):
        assert counts[kind] > 0


@pytest.mark.parametrize("h", [5e-324, 1e-320, 2e-308, 1e-15])
def test_the_shortest_steps_have_the_torques_of_that_moment(
    model: NativeModel, fmus: list[Path], h: float, tmp_path: Path
) -> None:
    path = unpacked_library(fmus[0], 2, tmp_path)
    instance = NativeInstance(NativeLibrary(path, model, str(native_guid(model)), 2))
    assert instance.start() == OK
    assert instance.step(1e-4) == OK
    state = instance.save()
    assert instance.step(1e-9, time=instance.time) == OK
    expected = [instance.get(f"{one}.torque") for one in ("pinion", "wheel")]
    assert instance.restore(state) == OK
    assert instance.step(h, time=1e-4) == OK
    found = [instance.get(f"{one}.torque") for one in ("pinion", "wheel")]
    # over 1 ns torques of modes below 350 Hz change by 2e-6 of their size
    assert found == pytest.approx(expected, rel=1e-5)
    instance.close()


def test_a_start_speed_without_a_gear_is_refused(fmus: list[Path], tmp_path: Path) -> None:
    reals = {"vehicle.speed_start": 30.0}
    job = Job(fmu=fmus[0], reals=reals, integers={"gearbox.gear": 1}, names=OUTPUTS)
    with pytest.raises(RuntimeError, match=r"keep the engine within its speeds in gearbox\.gear"):
        in_c_host(job, tmp_path)


@pytest.mark.slow
def test_the_car_of_an_axle_file_is_built_beside_its_axle(
    model: NativeModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "light.toml"
    file.write_text('[gear_set]\nmesh_table = "mohammadpour_2015"\n[vehicle]\nmass_kg = 900.0\n')
    made: list[NativeModel] = []

    def kept(model: NativeModel, folder: Path, options: NativeOptions) -> list[Path]:
        made.append(model)
        return []

    monkeypatch.setattr(build, "build_native", kept)
    build.build_models(tmp_path, axle=file, native=NativeOptions())
    assert [one.definition.name for one in made] == ["HypoidAxle", "Driveline"]
    assert native_guid(made[1]) != native_guid(model)
    torque = [car.definition.variables[1].start for car in (made[1], model)]
    assert torque[0] == pytest.approx(torque[1], rel=1e-2)
    # a row of the first gear: the engine's torque at idle pulls less of a lighter car
    first = 5 + 2 * 10
    assert made[1].data[first] < model.data[first]


def test_the_driveline_has_no_fmu_that_computes_in_python(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="--model driveline cannot be combined with --python"):
        build.build_models(tmp_path, "driveline")
    assert list(tmp_path.iterdir()) == []
