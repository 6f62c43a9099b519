"""The bench that holds a speed ramp."""

import numpy as np
import pytest

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
