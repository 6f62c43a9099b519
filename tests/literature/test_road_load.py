"""Road load of Mohammadpour et al. 2015, Tables A1 and A3, eq. (7)-(9)."""

import math

import pytest

from drivetrain.road_load import (
    FinalDrive,
    RoadLoad,
    Tyre,
    mohammadpour_2015_road_load,
    mohammadpour_2015_vehicle,
)
from gearlube_core.units import kmh_to_ms
from tests.helpers.each import each

# Vehicle speed [km/h], ring gear torque [N m], pinion torque [N m]; worked out by hand from
# eq. (7)-(9) with r_t = 0.318 m and the tooth ratio 36/13.
BY_HAND = [(20, 72, 25.9), (40, 85, 30.6), (60, 106, 38.4), (80, 137, 49.4), (100, 176, 63.6)]


@pytest.fixture
def shorter_radius() -> RoadLoad:
    tyre = Tyre.from_size("195/65R16", rolling_radius="fraction")
    return RoadLoad(vehicle=mohammadpour_2015_vehicle(), tyre=tyre)


@pytest.mark.parametrize(("speed_kmh", "ring_gear", "pinion"), BY_HAND)
def test_road_torques_of_the_paper_car_at_the_965_per_mille_radius(
    shorter_radius: RoadLoad, speed_kmh: float, ring_gear: float, pinion: float
) -> None:
    speed = kmh_to_ms(speed_kmh)
    # 1 %: r_t is 0.13 % above 0.318 m, the rest is rounding of the values to two or three digits.
    assert shorter_radius.ring_gear_torque(speed) == pytest.approx(ring_gear, rel=1e-2)
    assert shorter_radius.pinion_torque(speed) == pytest.approx(pinion, rel=1e-2)


@each(("speed_kmh", "ring_gear", "pinion"), BY_HAND)
def test_road_torques_scale_with_the_rolling_radius(
    speed_kmh: float, ring_gear: float, pinion: float
) -> None:
    load, speed = mohammadpour_2015_road_load(), kmh_to_ms(speed_kmh)
    scale = load.tyre.rolling_radius / 0.318
    # Half a unit of the last printed digit, 0.5 N m and 0.05 N m, with 20 % for 9.81 or 9.80665.
    assert load.ring_gear_torque(speed) == pytest.approx(scale * ring_gear, abs=0.6)
    assert load.pinion_torque(speed) == pytest.approx(scale * pinion, abs=0.06)


def test_resistances_at_100_kmh_split_into_rolling_and_drag() -> None:
    vehicle = mohammadpour_2015_vehicle()
    assert vehicle.rolling_resistance == pytest.approx(0.0166 * 1300 * 9.80665, rel=1e-12)
    # 341.7 N by hand: 0.61 * 0.33 * 2.2 * 27.778^2 with four digits.
    assert vehicle.drag_area * kmh_to_ms(100) ** 2 == pytest.approx(341.7, abs=0.05)


def test_mesh_frequency_is_five_hertz_per_kmh() -> None:
    load = mohammadpour_2015_road_load()
    # 5.0 printed with two digits; 4.97 at r_t = 0.3203 m.
    assert load.mesh_frequency(kmh_to_ms(1.0)) == pytest.approx(5.0, abs=0.05)
    wheel_turns = kmh_to_ms(60.0) / (2 * math.pi * load.tyre.rolling_radius)
    assert load.mesh_frequency(kmh_to_ms(60.0)) == pytest.approx(36 * wheel_turns, rel=1e-12)


def test_speeds_through_the_axle_are_consistent() -> None:
    load = mohammadpour_2015_road_load()
    speed = kmh_to_ms(73.0)
    wheel = load.wheel_speed(speed)
    assert load.vehicle_speed(wheel) == pytest.approx(speed, rel=1e-14)
    assert load.pinion_speed(speed) / wheel == pytest.approx(36 / 13, rel=1e-14)


def test_a_lossless_axle_conserves_power_and_a_loss_is_paid_by_the_pinion() -> None:
    load, speed = mohammadpour_2015_road_load(), kmh_to_ms(50.0)
    output = load.ring_gear_torque(speed) * load.wheel_speed(speed)
    pinion = load.pinion_speed(speed)
    assert load.pinion_torque(speed) * pinion == pytest.approx(output, rel=1e-12)
    assert load.pinion_torque(speed, 90.0) * pinion == pytest.approx(output + 90.0, rel=1e-12)


def test_a_five_percent_climb_adds_its_share_of_the_weight() -> None:
    flat, steep = mohammadpour_2015_road_load(), mohammadpour_2015_road_load(grade=0.05)
    slope = math.atan(0.05)
    weight = 1300 * 9.80665
    expected = weight * math.sin(slope) - 0.0166 * weight * (1 - math.cos(slope))
    difference = steep.resistance(10.0) - flat.resistance(10.0)
    assert difference == pytest.approx(expected, rel=1e-9)


def test_a_standing_car_on_the_flat_needs_no_torque() -> None:
    assert mohammadpour_2015_road_load().ring_gear_torque(0.0) == 0.0


def test_the_radius_ratio_of_eq_9_differs_from_the_tooth_ratio_by_a_tenth_of_a_percent() -> None:
    # Rp0 = 21.1 mm and Rg0 = 58.4 mm are known to three digits.
    assert pytest.approx(FinalDrive().ratio, rel=1e-3) == 58.4 / 21.1
