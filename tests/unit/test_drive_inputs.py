"""Refused inputs say what, got, limit and cure; tyres and gears follow their rules."""

import math

import numpy as np
import pytest

from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters, shaft_stiffness
from drivetrain.drivers import CoupledVehicle, SpeedHold
from drivetrain.engine import Engine, Gearbox, TorqueOrder
from drivetrain.road_load import FinalDrive, Tyre, Vehicle, mohammadpour_2015_road_load
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.units import rpm_to_rads
from tests.helpers.each import each

LOAD = mohammadpour_2015_road_load()
CAR = DrivelineParameters(road_load=LOAD)


def test_195_65_r16_has_an_unladen_radius_of_329_95_mm() -> None:
    tyre = Tyre.from_size("195/65R16")
    # 8 inch rim radius and 65 % of 195 mm, exact in decimal.
    assert tyre.unladen_radius == pytest.approx(0.32995, abs=1e-12)
    assert tyre.rolling_radius == pytest.approx(0.3203, abs=5e-5)
    other = Tyre.from_size(" 195/65 r16 91V", rolling_radius="fraction")
    assert other.rolling_radius == pytest.approx(0.965 * 0.32995, rel=1e-12)


@each("size", ["195-65-16", "", "R16", "195/65R", None])
def test_an_unreadable_tyre_size_is_refused_with_an_example(size: str) -> None:
    with pytest.raises(ParameterError, match=r"got .*195/65R16"):
        Tyre.from_size(size)


def test_an_impossible_tyre_size_names_the_part_that_is_wrong() -> None:
    with pytest.raises(ParameterError, match=r"rim diameter must be within 10 to 24 inch, got 99"):
        Tyre.from_size("195/65R99")
    with pytest.raises(ParameterError, match="circumference, fraction"):
        Tyre.from_size("195/65R16", rolling_radius="static")
    with pytest.raises(ParameterError, match="rolls a few per cent shorter"):
        Tyre(unladen_radius=0.33, rolling_radius=0.34)


def test_a_weight_given_as_mass_in_tonnes_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"mass must be .* got 1\.3 kg"):
        Vehicle(
            mass=1.3,
            frontal_area=2.2,
            drag_coefficient=0.33,
            rolling_coefficient=0.0166,
            air_density=1.22,
        )


def test_a_negative_speed_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"vehicle speed must be .* got -1 m/s.*forward"):
        LOAD.resistance(-1.0)
    with pytest.raises(ParameterError, match="got -10 m/s"):
        SpeedHold(LOAD, -10.0)
    with pytest.raises(ParameterError, match=r"vehicle speed must be within 0\.1"):
        LOAD.pinion_torque(0.0, axle_power_loss=10.0)


def test_tooth_numbers_are_whole() -> None:
    with pytest.raises(ParameterError, match=r"pinion_teeth must be a whole number, got 13\.5"):
        FinalDrive(pinion_teeth=13.5)  # type: ignore[arg-type]


@pytest.mark.parametrize("speed", [1.0, 110.0])
def test_a_speed_beyond_the_gears_names_the_range_and_the_other_driver(speed: float) -> None:
    with pytest.raises(ParameterError, match=r"must be within 23\.3 to 785\.4 rad/s.*SpeedHold"):
        CoupledVehicle(CAR, speed)


@each(("speed_kmh", "gear"), [(20, 1), (40, 2), (60, 3), (80, 5), (100, 5)])
def test_the_highest_gear_that_keeps_the_engine_lively_is_used(speed_kmh: int, gear: int) -> None:
    propshaft = LOAD.pinion_speed(speed_kmh / 3.6)
    engine, gearbox = Engine(), Gearbox()
    assert gearbox.gear_for(propshaft, engine) == gear
    assert 1400 <= gearbox.ratios[gear - 1] * propshaft * 30 / math.pi <= 2200


def test_below_the_lively_range_first_gear_is_used() -> None:
    assert Gearbox().gear_for(rpm_to_rads(250.0), Engine()) == 1


@pytest.mark.parametrize("ratios", [(), (1.0, 1.4), (1.0, 1.0), (-1.0,)])
def test_gear_ratios_must_fall(ratios: tuple[float, ...]) -> None:
    with pytest.raises(ParameterError):
        Gearbox(ratios=ratios)


def test_engine_parameters_are_checked() -> None:
    with pytest.raises(ParameterError, match=r"primary_inertia must be above 0 kg m2"):
        Engine(primary_inertia=0.0)
    with pytest.raises(ParameterError, match=r"amplitude must be .* got -0\.5"):
        TorqueOrder(order=2, amplitude=-0.5, phase=0.0)


def test_the_engine_torque_has_the_requested_mean_and_orders() -> None:
    engine = Engine()
    angle = np.arange(256) * 2 * math.pi / 256
    torque = np.array([engine.torque(50.0, float(a)) for a in angle])
    lines = np.fft.rfft(torque) / 256
    assert lines[0].real == pytest.approx(50.0, rel=1e-12)
    for order in engine.orders:
        line = 2 * lines[order.order] / 50.0
        assert abs(line) == pytest.approx(order.amplitude, rel=1e-12)
        assert math.remainder(np.angle(line) - order.phase, 2 * math.pi) == pytest.approx(
            0.0, abs=1e-12
        )


def test_driveline_parameters_are_checked() -> None:
    with pytest.raises(ParameterError, match=r"wheel_inertia must be above 0 kg m2, got -1"):
        DrivelineParameters(road_load=LOAD, wheel_inertia=-1.0)
    with pytest.raises(ParameterError, match=r"speed_control_frequency must be .* 0\.5 Hz, got 3"):
        DrivelineParameters(road_load=LOAD, speed_control_frequency=3.0)
    with pytest.raises(ParameterError, match=r"axle_power_loss must be .* got -5 W"):
        Driveline(CAR, 20.0, -5.0)


def test_a_tube_is_as_stiff_as_the_solid_shaft_less_its_core() -> None:
    solid, core = shaft_stiffness(0.07, 1.4), shaft_stiffness(0.066, 1.4)
    assert shaft_stiffness(0.07, 1.4, 0.066) == pytest.approx(solid - core, rel=1e-12)
    # G pi D^4 / (32 l) of a 27 mm bar of 0.7 m by hand: 5.91 kN m/rad.
    assert shaft_stiffness(0.027, 0.7) == pytest.approx(5.91e3, rel=1e-3)


@pytest.mark.parametrize("make", [CoupledVehicle, SpeedHold])
def test_a_signal_that_is_not_finite_is_refused_and_changes_nothing(make: type) -> None:
    driver = make(CAR if make is CoupledVehicle else LOAD, 20.0)
    speed = driver.initial_pinion_speed
    driver.step(1e-4, 0.0, speed, 0.0, speed * 13 / 36)
    before = driver.get_state()
    for signals in ((1e-4, math.nan, speed, 0.0, 50.0), (1e-4, 0.0, math.inf, 0.0, 50.0)):
        with pytest.raises(StepError, match="finite"):
            driver.step(*signals)
    for h in (0.0, -1e-4, math.nan):
        with pytest.raises(StepError, match="h "):
            driver.step(h, 0.0, speed, 0.0, 50.0)
    np.testing.assert_array_equal(driver.get_state(), before)
    driver.step(1e-4, 0.0, speed, 0.0, speed * 13 / 36)


@pytest.mark.parametrize("make", [CoupledVehicle, SpeedHold])
def test_a_restored_state_continues_bit_by_bit(make: type) -> None:
    argument = CAR if make is CoupledVehicle else LOAD
    one, other = make(argument, 20.0), make(argument, 20.0)
    speed = one.initial_pinion_speed

    def run(driver: CoupledVehicle, start: int, count: int) -> list[tuple[float, float]]:
        torques = []
        for n in range(start, start + count):
            wobble = 1e-4 * math.sin(0.3 * n)
            angle = 1e-4 * n * speed + wobble
            torques.append(driver.step(1e-4, angle, speed, angle * 13 / 36, speed * 13 / 36))
        return torques

    run(one, 0, 50)
    other.set_state(one.get_state())
    assert run(one, 50, 50) == run(other, 50, 50)
    assert one.vehicle_speed == other.vehicle_speed
    np.testing.assert_array_equal(one.get_state(), other.get_state())


@pytest.mark.parametrize("make", [CoupledVehicle, SpeedHold])
def test_a_foreign_state_is_refused(make: type) -> None:
    driver = make(CAR if make is CoupledVehicle else LOAD, 20.0)
    with pytest.raises(ParameterError, match=r"finite numbers, got shape \(2,\)"):
        driver.set_state(np.zeros(2))
    with pytest.raises(ParameterError, match="get_state"):
        driver.set_state(np.full_like(driver.get_state(), math.nan))


@pytest.mark.parametrize("make", [CoupledVehicle, SpeedHold])
def test_the_first_angle_is_only_a_reference(make: type) -> None:
    argument = CAR if make is CoupledVehicle else LOAD
    torques = []
    for offset in (0.0, 3.0):
        driver = make(argument, 20.0)
        speed, wheel = driver.initial_pinion_speed, driver.initial_pinion_speed * 13 / 36
        for n in range(20):
            angle = n * 1e-4 * speed
            last = driver.step(1e-4, angle + offset, speed, angle * 13 / 36 - offset, wheel)
        torques.append(last)
    # Rounding of an angle of 3 rad, 4e-16 rad, times 3e4 N m/rad, over 20 steps.
    assert torques[0] == pytest.approx(torques[1], abs=1e-9)
