"""A run-up of the axle: settings, record, dataset, and that a stopped run goes on."""

import dataclasses

import numpy as np
import pytest
import xarray as xr

from drivetrain.speed_ramp import SpeedRamp
from gearlube.studies.runup.record import record_ramp
from gearlube.studies.runup.run import load_runup, run_runup
from gearlube.studies.runup.settings import fitting_duration
from gearlube_core.errors import ParameterError
from gearlube_core.storage.resumable import ARRAYS, ResultStore
from tests.helpers.short_ramp import SHORT
from tests.helpers.units import without_units


def test_a_ramp_too_fast_for_its_orders_is_refused_with_a_cure_that_helps() -> None:
    with pytest.raises(ParameterError, match="For this ramp take at least 11 s") as told:
        dataclasses.replace(SHORT, start_speed=50.0, duration=8.0)
    # 250 rad/s in 8 s: 31.25 rad/s2 * 25.13 rad / (50 rad/s)^2
    assert "got 31.4 %" in str(told.value)
    shortest = float(str(told.value).split("at least ")[1].split(" s,")[0])
    dataclasses.replace(SHORT, start_speed=50.0, duration=shortest)
    with pytest.raises(ParameterError, match="hold 8 times the 4 revolutions"):
        dataclasses.replace(SHORT, duration=0.4)
    with pytest.raises(ParameterError, match="must differ"):
        dataclasses.replace(SHORT, end_speed=280.0)


def test_the_cars_torque_is_road_load_and_its_mass_times_acceleration() -> None:
    settings = dataclasses.replace(
        SHORT, pinion_torque=None, start_speed=100.0, end_speed=200.0, duration=40.0
    )
    torque, loss = settings.torques()
    car = settings.car_axle.driveline
    radius, ratio = car.rolling_radius, 36 / 13
    # 1300 kg and four wheels of 0.9 kg m2
    force = (1300.0 + 4 * 0.9 / radius**2) * 2.5 * radius / ratio
    speed = 100.0 * radius / ratio
    road = car.road_load.resistance(speed)
    assert torque[0] == pytest.approx((road + force) * radius / ratio + loss[0], rel=1e-12)
    down = dataclasses.replace(settings, start_speed=200.0, end_speed=100.0, duration=25.0)
    assert down.name == "coast-down"
    assert down.torques()[0][0] < 0.0  # the engine brakes


def test_a_ramp_lasts_as_long_as_the_torque_of_the_mesh_table_asks() -> None:
    car = SHORT.car_axle
    high = car.axle.torque_range[1]
    fast = SpeedRamp(start=100.0, end=500.0, duration=3.0)
    duration = fitting_duration(car, fast)
    fitting = dataclasses.replace(
        SHORT, pinion_torque=None, start_speed=100.0, end_speed=500.0, duration=duration
    )
    torque, _ = fitting.torques()
    assert 0.94 * high < torque.max() < high
    slow = dataclasses.replace(fast, duration=100.0)
    assert fitting_duration(car, slow) == 100.0
    heavy = dataclasses.replace(car.driveline.road_load.vehicle, mass=1e5)
    road = dataclasses.replace(car.driveline.road_load, vehicle=heavy)
    too_heavy = dataclasses.replace(
        car, driveline=dataclasses.replace(car.driveline, road_load=road)
    )
    assert fitting_duration(too_heavy, fast) == 3.0  # no ramp fits


@pytest.mark.slow
def test_a_run_up_keeps_forces_and_speeds_with_units_at_a_constant_rate(tmp_path) -> None:
    made = run_runup(SHORT, folder=tmp_path)
    found = load_runup(tmp_path)
    force = found["bearing_force"]
    assert force.dims == ("time", "bearing", "direction")
    assert force.attrs["units"] == "N"
    assert not without_units(xr.open_dataset(tmp_path / "runup.nc", decode_times=False))
    assert (found["time"].attrs["units"], found["pinion_speed"].attrs["units"]) == ("s", "rad s-1")
    assert np.diff(found["time"].values) == pytest.approx(1.0 / 8192.0, rel=1e-9)
    assert found.sizes["time"] == made.sizes["time"] == round(0.8 * 8192.0)
    # action and reaction of the mesh, by axis of the fixed frame; 1 % for inertia and friction
    mean = {
        (str(b.values), str(found["axis"].sel(bearing=b, direction=d).values)): float(
            force.sel(bearing=b, direction=d).mean()
        )
        for b in found["bearing"]
        for d in found["direction"]
    }
    for axis in "xyz":
        assert mean["pinion", axis] == pytest.approx(-mean["gear", axis], rel=0.01)
    assert found["pinion_speed"].values[[0, -1]] == pytest.approx([280.0, 300.0], rel=0.01)
    # what goes in is what is asked for; losses are those of a mesh period at rest but for what
    # vibrates, which is little away from resonance
    power = found["power_in"].mean()
    assert float(power) == pytest.approx(80.0 * 290.0, rel=0.01)
    share = float(found["loss"].sum("source").mean() / power)
    assert share == pytest.approx(SHORT.torques()[1].mean() / 80.0, rel=0.02)
    assert not (tmp_path / "parts").exists()


@pytest.mark.slow
def test_a_stopped_ramp_goes_on_from_its_parts_to_the_same_bits(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("gearlube.studies.runup.record._PART", 0.25)
    whole = record_ramp(SHORT, folder=tmp_path)
    store = ResultStore(tmp_path, ARRAYS)
    first, *_, last = (f"{SHORT.key()}_{i}" for i in range(4))
    for flag in ("kept", "unknown"):  # whether something left its range, in the first part
        store.drop([last])
        if flag == "unknown":
            part = store.read(first)
            store.keep(first, {name: one for name, one in part.items() if name != "outside"})
        again = record_ramp(SHORT, folder=tmp_path)
        for name, values in whole.channels.items():
            assert np.array_equal(values, again.channels[name]), (flag, name)
        assert np.array_equal(whole.slow_time, again.slow_time)
        assert np.array_equal(whole.outside, again.outside)
