"""A train over a drive cycle: two gears and a seal in closed form, the axle by its own study."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import quad

import gearlube as gl
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import mohammadpour_2015_road_load
from drivetrain.train.train_file import TrainCase, TrainFile
from gearlube.report.numbers import column_texts
from gearlube.studies.drivetrain.cycle import (
    cycle_figure,
    cycle_losses,
    cycle_numbers,
    cycle_tables,
    of_cycle,
    plan_cycle,
    train_cycle,
)
from gearlube.studies.drivetrain.losses import map_losses
from gearlube.studies.drivetrain.operation import Operation
from gearlube_core.errors import ParameterError
from tests.analytical.test_drivetrain_runup import SEAL, case

CAR = DrivelineParameters(road_load=mohammadpour_2015_road_load())
RADIUS, RATIO = CAR.rolling_radius, 2.0  # teeth of the two gears
TOP, RAMP, HOLD, REST = 25.0, 20, 15, 5  # m/s; s
VEHICLE = CAR.road_load.vehicle
FELT = VEHICLE.mass + 4.0 * CAR.wheel_inertia / RADIUS**2
DISTANCE = TOP * (RAMP + HOLD)


def trapezium() -> gl.studies.DriveCycle:
    """Return a cycle of rest, ramp up, constant speed, ramp down, rest."""
    corners = np.cumsum([0, REST, RAMP, HOLD, RAMP, REST])
    time = np.arange(corners[-1] + 1.0)
    return gl.studies.DriveCycle(
        name="trapezium", time=time, speed=np.interp(time, corners, [0, 0, TOP, TOP, 0, 0])
    )


def two_gears() -> TrainCase:
    return replace(case(), car=CAR)


@pytest.fixture(scope="module")
def driven(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, xr.Dataset]:
    folder = tmp_path_factory.mktemp("cycle")
    return folder, train_cycle(two_gears(), trapezium(), folder=folder)


def drag(speed: float) -> float:
    force = 0.5 * 1.22 * 0.33 * 2.2 * speed**2 + 0.0166 * 1300.0 * 9.80665
    return force if speed > 0.0 else 0.0


@pytest.mark.slow
def test_a_seal_loses_its_torque_times_the_angle_that_its_shaft_turns(driven):
    found = driven[1]
    lost = found["energy_lost"].sel(source="seal.seals").item()
    angle = DISTANCE / RADIUS * RATIO
    # it lacks 0.01 rad/s over the speed: 1e-3 of this mean; the map is linear between speeds
    assert lost == pytest.approx(1e-3 * SEAL * angle, rel=2e-3)
    # dampers of mesh and supports take less than 1e-2 of that
    assert found["energy_lost"].sum().item() == pytest.approx(lost, rel=1e-2)
    braking = found["energy_lost_braking"].sel(source="seal.seals").item()
    # air and rolling brake less than the car at all speeds of the second ramp, which is all braking
    assert braking / lost == pytest.approx(0.5 * RAMP / (RAMP + HOLD), rel=2e-3)


@pytest.mark.slow
def test_the_shaft_gives_what_road_and_seal_take_and_gets_the_rest_of_the_motion_back(driven):
    found = driven[1]
    # the sum over seconds of a cubic: 1/4 s2 of the second derivative, below 1e-3 here
    up, _ = quad(lambda t: drag(TOP * t / RAMP) * TOP * t / RAMP, 0.0, RAMP)
    held = drag(TOP) * TOP * HOLD
    assert found["energy_road"].item() == pytest.approx(1e-3 * (2.0 * up + held), rel=1e-3)
    seal = SEAL * DISTANCE / RADIUS * RATIO
    kinetic = 0.5 * FELT * TOP**2
    part = 0.5 * RAMP / (RAMP + HOLD)
    given = kinetic + up + held + (1.0 - part) * seal
    # dampers take less than 1e-4 of what goes through
    assert found["energy_in_shaft"].item() == pytest.approx(1e-3 * given, rel=1e-3)
    assert found["energy_back"].item() == pytest.approx(
        1e-3 * (kinetic - up - part * seal), rel=1e-3
    )
    assert found["energy_brakes"].item() == 0.0
    assert found.attrs["imbalance"] < 1e-11  # the torque settles to 1e-9 N.m of some 100
    resting = found["vehicle_speed"].values == 0.0
    assert resting.sum() == 2 * REST
    assert not found["loss"].values[resting].any()
    assert not found["shaft_torque"].values[resting].any()


def test_a_stopped_cycle_goes_on_from_its_map_and_the_same_cycle_computes_nothing(driven):
    folder, found = driven
    kept = {one: one.stat().st_mtime_ns for one in (folder / "parts").iterdir()}
    again = train_cycle(two_gears(), trapezium(), folder=folder)
    assert {one: one.stat().st_mtime_ns for one in (folder / "parts").iterdir()} == kept
    xr.testing.assert_identical(again, found)
    with xr.open_dataset(folder / "cycle.nc") as written:
        np.testing.assert_array_equal(written["loss"], found["loss"])
    head, first, *_ = (folder / "cycle.csv").read_text().splitlines()
    assert head.split(",")[:4] == ["time_s", "step_s", "vehicle_speed_kmh", "shaft_speed_rpm"]
    assert first.startswith("0.5,1,0,0,0,")


def test_runs_of_single_steps_say_how_far_the_map_is_off(driven):
    found = driven[1]
    assert found.sizes["fresh"] == 10
    # of the seal nothing but the lack at low speeds, of the dampers what is not linear
    assert abs(found["map_error_largest"].item()) < 5e-3
    words = [one.headline for one in of_cycle(found)]
    assert words[0].startswith("The drivetrain loses ")
    assert "seal: seals 9" in words[0] or "seal: seals 100" in words[0]
    assert f"{100.0 * abs(found['map_error'].item()):.2g} %" in words[1]
    assert cycle_tables(found)[0].rows[-1][1] == pytest.approx(found["energy_lost"].sum().item())
    tiny = np.full(found.sizes["source"], 1e-5)  # kJ, of 20
    tiny[0] = 20.0
    table = cycle_tables(found.assign(energy_lost=("source", tiny)))[0]
    assert (table.rows[-1][0], table.rows[1][1]) == ("all", 0.0)
    assert column_texts([row[3] for row in table.rows])[-1] == "100.0"  # %
    (number,) = cycle_numbers(found)
    assert number.value == pytest.approx(1e-3 * (found["loss"].sum("source") @ found["duration"]))
    panels = cycle_figure(found).axes
    assert panels[0].lines[0].get_ydata().max() == pytest.approx(3.6 * TOP)


def test_points_of_the_map_without_equilibrium_are_filled_from_their_side_and_marked(driven):
    plan = plan_cycle(two_gears(), trapezium())
    whole = map_losses(two_gears(), speeds=plan.speeds, torques=plan.torques, folder=driven[0])
    torn = whole.copy(deep=True).assign(failure=whole["failure"].astype("U8"))
    at = {"speed": -2, "torque": int(np.searchsorted(plan.torques, 270.0))}
    torn["loss"][at], torn["failure"][at] = np.nan, "No rest."
    found = cycle_losses(plan, torn, driven[0])
    lost = found["energy_lost"].sel(source="seal.seals").item()
    # the seal's loss does not depend on the torque; 2e-3 as without gaps
    assert lost == pytest.approx(1e-3 * SEAL * DISTANCE / RADIUS * RATIO, rel=2e-3)
    around = found["filled"].values > 0.0
    assert 0 < around.sum() < around.size / 2
    assert found["energy_lost_filled"].item() > 0.0
    assert any("have no equilibrium" in one.headline for one in of_cycle(found))
    torn["loss"][{"speed": -2}], torn["failure"][{"speed": -2}] = np.nan, "No rest."
    with pytest.raises(ParameterError, match=r"got 0 at .* rpm: No rest"):
        cycle_losses(plan, torn)


def test_losses_that_are_linear_in_torque_on_either_side_are_met_at_all_steps(driven):
    """A made map: seal and 1 % of the torque, also through torque 0, where it has no point."""
    plan = plan_cycle(two_gears(), trapezium())
    made = map_losses(two_gears(), speeds=plan.speeds, torques=plan.torques, folder=driven[0])
    made["loss"][:] = 0.0
    made["loss"].loc[{"source": "seal.seals"}] = plan.speeds[:, None] * (
        SEAL + 0.01 * np.abs(plan.torques)
    )
    coast = (
        gl.studies.DriveCycle(  # slower and slower by air and rolling, and less and less than them
            name="coast", time=np.arange(21.0), speed=TOP - 0.01 * np.arange(21.0) ** 2
        )
    )
    gentle = plan_cycle(two_gears(), coast)
    plan = plan._replace(cycle=coast, demand=gentle.demand)
    found = cycle_losses(plan, made, driven[0])
    torque, asked = found["shaft_torque"].values, gentle.demand.torque
    lost = found["loss"].sum("source").values / gentle.demand.shaft_speed
    assert torque.min() < -plan.torques[plan.torques > 0.0].min()
    assert np.abs(torque).min() < plan.torques[plan.torques > 0.0].min()
    # the iteration of the torque settles to 1e-9 N.m
    np.testing.assert_allclose(lost, SEAL + 0.01 * np.abs(torque), atol=1e-8)
    np.testing.assert_allclose(torque, asked + lost, atol=1e-8)


def test_two_wheels_turn_by_the_ratio_of_both_stages_slower_than_the_motor():
    # the solved equilibrium of speeds, far below 1e-6
    assert Operation.of(TrainFile.named("e_axle").case()).ratio == pytest.approx((31 / 25) ** 2)


def test_friction_brakes_take_what_the_train_does_not(driven):
    plan = plan_cycle(two_gears(), trapezium(), 0.25)
    asked = plan_cycle(two_gears(), trapezium()).demand
    braked = asked.torque < 0.0
    np.testing.assert_allclose(plan.demand.torque[braked], 0.25 * asked.torque[braked])
    np.testing.assert_allclose(
        plan.demand.brakes, -0.75 * asked.torque * braked * asked.shaft_speed
    )


@pytest.mark.slow
def test_the_hypoid_axle_as_a_list_loses_what_its_own_study_says():
    """Another code: one mesh period without dynamics, at every temperature of a map."""
    corners = [0.0, 8.0, 14.0, 26.0, 34.0]
    time = np.arange(35.0)
    trace = gl.studies.DriveCycle(
        name="t", time=time, speed=np.interp(time, corners, [0, 10, 10, 25, 8])
    )
    warm = gl.celsius_to_kelvin(90.0)  # as in the train file
    settings = gl.DriveCycleSettings(
        car=gl.read_axle("mohammadpour_2015"),
        cycle=trace,
        regeneration=1.0,
        start_temperature=warm,
        air_temperature=warm,
        heat=gl.studies.SumpHeat(capacity=1e8),
        grid=gl.studies.LossGrid(torques=48, temperature_step=50.0),
        draws=0,
    )
    axle = gl.run_cycle(settings)
    listed = train_cycle(TrainFile.named("hypoid_axle").case(), trace)
    # the torque of the whole axle is in the file's fixed level of the mesh table: 0.5 % of NEDC
    assert listed["energy_lost"].sum().item() == pytest.approx(
        axle["energy_lost"].sum().item(), rel=5e-3
    )
    assert listed["energy_in"].item() == pytest.approx(axle["energy_in"].item(), rel=1e-3)
    bearings = listed["energy_lost"].sel(
        source=["pinion_bearings.bearing_torque", "gear_bearings.bearing_torque"]
    )
    assert bearings.sum().item() == pytest.approx(
        axle["energy_lost"].sel(source="bearing_torque").item(), rel=5e-3
    )


def test_a_train_without_a_vehicle_and_a_car_that_stands_or_crawls_are_refused():
    with pytest.raises(ParameterError, match=r"needs a vehicle, got none in two gears\. Give"):
        plan_cycle(case(), trapezium())
    still = gl.studies.DriveCycle(name="still", time=np.arange(5.0), speed=np.zeros(5))
    with pytest.raises(ParameterError, match="must move in still"):
        plan_cycle(two_gears(), still)
    rest = replace(
        two_gears(),
        speeds=dict.fromkeys(two_gears().speeds, 0.0),
        torques={name: -one for name, one in two_gears().torques.items()},  # powers of -0
    )
    with pytest.raises(ParameterError, match="got motor 0 W at speed 0, road 0 W at speed 0"):
        plan_cycle(rest, trapezium())
    # the map begins at 1/100 of the highest speed, and may at 1/1000 of the 200 rad/s of the start
    least = 0.1 * 200.0 / RATIO * RADIUS  # m/s
    crawl = [
        gl.studies.DriveCycle(name="crawl", time=np.arange(5.0), speed=np.full(5, share * least))
        for share in (0.5, 1.01)
    ]
    said = rf"crawl must be at least {3.6 * least:.3g} km/h for two gears, got {1.8 * least:.3g} k"
    with pytest.raises(ParameterError, match=said):
        plan_cycle(two_gears(), crawl[0])
    assert plan_cycle(two_gears(), crawl[1]).speeds[0] == pytest.approx(1.01e-3 * 200.0)
    with pytest.raises(ParameterError, match="regeneration must be within 0 to 1"):
        plan_cycle(two_gears(), trapezium(), 1.5)
