"""The bench that holds a speed ramp."""

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import read_axle
from drivetrain.ramp_vehicle import RampVehicle, gear_for_ramp
from drivetrain.speed_ramp import RampHold, SpeedRamp
from gearlube_core.errors import ParameterError

RATIO, INERTIA = 36 / 13, 9.3e-3  # -, kg m2
RAMP = SpeedRamp(start=100.0, end=150.0, duration=2.0)


def bench(loss: float = 2.0) -> RampHold:
    return RampHold(
        RAMP,
        ratio=RATIO,
        pinion_torque=np.array([80.0, 90.0]),
        loss_torque=np.array([loss, loss]),
        axle_inertia=INERTIA,
        lead=1.0,
    )


def test_the_angle_of_a_ramp_is_the_integral_of_its_speed() -> None:
    times = np.linspace(-0.5, 2.5, 3001)
    speeds = np.array([RAMP.speed(float(t)) for t in times])
    angles = np.array([RAMP.angle(float(t)) for t in times])
    steps = 0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times)
    assert np.diff(angles) == pytest.approx(steps, abs=1e-5)
    assert RAMP.angle(0.0) == 0.0


def test_a_rigid_axle_with_an_unknown_loss_follows_the_ramp() -> None:
    driver, h = bench(), 1e-4
    angle, speed, lost = 0.3, 100.0, 2.5  # 0.5 N m more than expected
    errors, pinion_torques = [], []
    for _ in range(30_000):
        pinion, wheel = driver.step(h, angle, speed, angle / RATIO, speed / RATIO)
        rate = (pinion - wheel / RATIO - lost) / INERTIA
        angle += h * speed + 0.5 * h * h * rate
        speed += h * rate
        errors.append(speed - RAMP.speed(driver.time))
        pinion_torques.append(pinion)
    # learnt within the lead of 1 s to 0.1 %, kept through both kinks of the ramp
    assert np.abs(errors[10_000:]).max() < 0.1
    # the torque is what was asked for: held, then from 80 to 90 N m along the ramp
    assert pinion_torques[0] == 80.0
    assert pinion_torques[20_000] == pytest.approx(85.0, abs=1e-2)
    assert driver.time == pytest.approx(2.0)


def test_a_saved_state_goes_on_bit_by_bit() -> None:
    driver, other = bench(), bench()
    for n in range(5):
        driver.step(1e-4, 1e-2 * n, 100.0 + n, 0.0, 0.0)
    other.set_state(driver.get_state())
    assert other.step(1e-4, 0.06, 101.0, 0.0, 0.0) == driver.step(1e-4, 0.06, 101.0, 0.0, 0.0)
    with pytest.raises(ParameterError, match="4 finite numbers"):
        other.set_state(np.zeros(3))


def test_the_car_follows_the_ramp_in_one_gear_with_the_torque_that_it_needs() -> None:
    car = read_axle("mohammadpour_2015").driveline
    ramp, h, loss = SpeedRamp(start=130.0, end=190.0, duration=4.0), 2.5e-4, 3.0
    driver = RampVehicle(car, ramp, np.full(5, loss), lead=1.0)
    assert driver.driveline.gear == 3  # 1.4 * 130 rad/s = 1738 rpm; 1.0 would be below 1400 rpm
    angle, speed = 0.0, driver.initial_pinion_speed
    errors, torques = [], []
    while driver.time < ramp.duration:
        pinion, wheel = driver.step(h, angle, speed, angle / RATIO, speed / RATIO)
        rate = (pinion - wheel / RATIO - loss) / INERTIA
        angle += h * speed + 0.5 * h * h * rate
        speed += h * rate
        wanted = ramp.speed(driver.time) * car.rolling_radius / RATIO
        errors.append(driver.driveline.vehicle_speed / wanted - 1.0)
        torques.append(pinion)
    on_ramp = slice(round(1.0 / h), None)
    # tyres slip by 1 to 2 %: the car loses less than that, the slow controller gives it back
    assert np.abs(errors[on_ramp]).max() < 0.01
    # road load at 160 rad/s, 1300 kg and four wheels of 0.9 kg m2, loss
    radius = car.rolling_radius
    mass = 1300.0 + 4 * 0.9 / radius**2
    force = car.road_load.resistance(160.0 * radius / RATIO) + mass * 15.0 * radius / RATIO
    middle = torques[round(2.0 / h) : round(4.0 / h)]  # 145 to 175 rad/s
    assert np.mean(middle) == pytest.approx(force * radius / RATIO + loss, rel=0.02)


def test_a_ramp_that_no_gear_spans_is_refused() -> None:
    car = read_axle("mohammadpour_2015").driveline
    with pytest.raises(ParameterError, match="Take a shorter ramp, or leave the engine out"):
        gear_for_ramp(car, SpeedRamp(start=30.0, end=400.0, duration=60.0))


def test_a_saved_car_goes_on_bit_by_bit() -> None:
    car = read_axle("mohammadpour_2015").driveline
    driver, other = (RampVehicle(car, RAMP, np.full(2, 2.0), lead=1.0) for _ in range(2))
    for n in range(5):
        driver.step(1e-4, 1e-2 * n, 100.0, 3.6e-3 * n, 36.0)
    other.set_state(driver.get_state())
    assert other.step(1e-4, 0.05, 100.0, 0.018, 36.0) == driver.step(1e-4, 0.05, 100.0, 0.018, 36.0)
