"""The slow speed hold: mean speed, learning of losses, and what it does to the mesh mode."""

import math

import numpy as np
import pytest

from drivetrain.drivers import SpeedHold
from drivetrain.road_load import mohammadpour_2015_road_load
from tests.helpers.each import each

LOAD = mohammadpour_2015_road_load()
RATIO = 36 / 13
IP, IG = 1.734e-3, 5.81e-2  # kg m2, Mohammadpour et al. 2015 Table 1
INERTIA = IP + IG / RATIO**2


def drive(driver: SpeedHold, loss: float, duration: float, h: float = 1e-4) -> np.ndarray:
    """Pinion speeds of a rigid axle with a loss and a ripple six times that of a 1 um error."""
    angle, speed = 0.0, driver.initial_pinion_speed
    speeds = np.empty(round(duration / h))
    for n in range(len(speeds)):
        pinion, wheel = driver.step(h, angle, speed, angle / RATIO, speed / RATIO)
        ripple = 1.0 * math.sin(13 * angle)
        rate = (pinion - wheel / RATIO - loss + ripple) / INERTIA
        angle += h * speed + 0.5 * h * h * rate
        speed += h * rate
        speeds[n] = speed
    return speeds


@each("speed_kmh", [20.0, 100.0])
@each("loss_share", [0.0, 0.05])
def test_the_mean_speed_meets_the_request_after_the_start(
    speed_kmh: float, loss_share: float
) -> None:
    driver = SpeedHold(LOAD, speed_kmh / 3.6)
    loss = loss_share * driver.initial_torques()[0]
    speeds = drive(driver, loss, 1.0)
    # 0.1 % from 0.4 s on is the requirement.
    assert speeds[4000:].mean() == pytest.approx(driver.initial_pinion_speed, rel=1e-3)
    # What was learnt: the loss; half a per cent of the torque for the ripple that is averaged.
    assert driver.loss_torque == pytest.approx(loss, abs=0.005 * driver.initial_torques()[0])
    assert driver.vehicle_speed == pytest.approx(speeds[-2] * 0.320331 / RATIO, rel=1e-5)


def test_the_slow_loop_alone_is_critically_damped() -> None:
    driver = SpeedHold(LOAD, 20 / 3.6, start_factor=1.0)
    a, loss = 0.05 / (2 * INERTIA), 0.26
    angle, speed, h = 0.0, driver.initial_pinion_speed, 1e-4
    for _ in range(5000):
        pinion, wheel = driver.step(h, angle, speed, angle / RATIO, speed / RATIO)
        rate = (pinion - wheel / RATIO - loss) / INERTIA
        angle += h * speed + 0.5 * h * h * rate
        speed += h * rate
    # w' = -T/I exp(-a t) (1 - a t) integrates to -(T/I) t exp(-a t).
    expected = -loss / INERTIA * 0.5 * math.exp(-a * 0.5)
    # Torques are held for h: a h = 3e-4 relative.
    assert speed - driver.initial_pinion_speed == pytest.approx(expected, rel=1e-3)


def test_a_known_loss_needs_no_learning() -> None:
    driver = SpeedHold(LOAD, 20 / 3.6, axle_power_loss=15.0)
    pinion, wheel = driver.initial_torques()
    speed = driver.initial_pinion_speed
    assert pinion * speed - wheel * speed / RATIO == pytest.approx(15.0, rel=1e-9)
    first = driver.step(1e-4, 0.0, speed, 0.0, speed / RATIO)
    assert first == pytest.approx((pinion, wheel), rel=1e-12)


def mesh_mode_damping(gain: float) -> float:
    """Damping ratio of pinion, gear and mesh (Karagiannis et al. 2012) with a speed hold."""
    rp, rg, k, c = 21.1e-3, 58.4e-3, 4.55e8, 2278.1
    # States: x = rp * pinion angle - rg * gear angle, both speeds.
    a = np.array(
        [
            [0.0, rp, -rg],
            [-rp * k / IP, -(rp * c * rp + gain) / IP, rp * c * rg / IP],
            [rg * k / IG, rg * c * rp / IG, -rg * c * rg / IG],
        ]
    )
    values = np.linalg.eigvals(a)
    mode = values[np.argmax(values.imag)]
    return float(-mode.real / abs(mode))


def test_the_default_gain_leaves_the_mesh_mode_alone_and_a_hundredfold_does_not() -> None:
    free = mesh_mode_damping(0.0)
    # zeta = 0.03 is the paper's; its stiffness was inferred with three digits.
    assert free == pytest.approx(0.03, rel=0.01)
    share = (21.1e-3**2 / IP) / (21.1e-3**2 / IP + 58.4e-3**2 / IG)
    frequency = math.sqrt(4.55e8 * (21.1e-3**2 / IP + 58.4e-3**2 / IG))
    for gain, size in ((0.05, 0.001), (5.0, 0.1)):
        added = mesh_mode_damping(gain) - free
        # 10 %: the sizes are printed with one digit.
        assert added == pytest.approx(size, rel=0.1)
        # First-order perturbation: share of the pinion's motion times gain over 2 I w.
        # Second order is (added)^2.
        assert added == pytest.approx(share * gain / (2 * IP * frequency), rel=0.05)


def test_the_integral_holds_the_angle_not_a_sum_of_sampled_speeds() -> None:
    driver = SpeedHold(LOAD, 50 / 3.6, proportional_gain=0.0, integral_gain=2.0, start_factor=1.0)
    base = driver.initial_torques()[0]
    speed, h = driver.initial_pinion_speed, 1e-4
    driver.step(h, 5.0, speed, 0.0, speed / RATIO)
    # The pinion lags by 1 mrad at an unchanged sampled speed.
    torque, _ = driver.step(h, 5.0 + h * speed - 1e-3, speed, 0.0, speed / RATIO)
    # Rounding of angles.
    assert torque - base == pytest.approx(2e-3, abs=1e-12)
