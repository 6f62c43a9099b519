"""Drive of a driveline: inputs and the interval."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest

from drivetrain.driveline.equations import MEMORY, POWERS, STATES, driveline_stepper
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters, shaft_stiffness
from drivetrain.drivers import CoupledVehicle, SpeedHold
from drivetrain.engine import Engine, Gearbox, TorqueOrder
from drivetrain.road_load import FinalDrive, Tyre, Vehicle, mohammadpour_2015_road_load
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.units import rpm_to_rads
from tests.helpers.communication_stability import interval_jacobian
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


N, COUNT = len(STATES), len(POWERS)
PROPSHAFT, HALF_SHAFT = 700.0, 90.0  # N m/rad
H, INNER = 0.08, 3
RNG = np.random.default_rng(8)
RATES = RNG.uniform(-3.0, 3.0, (N + COUNT + 2, N + 5))  # of states, powers, torques
P = (0.4, -0.7, 1.3)


def linear(x: ca.SX, u: ca.SX, p: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Return what `driveline_equations` does: rates, torques, powers, stored."""
    y = ca.DM(RATES) @ ca.vertcat(x, u, p)
    return y[:N], y[N + COUNT :], y[N : N + COUNT], ca.SX(0.0)


@pytest.fixture(scope="module")
def interval() -> ca.Function:
    return driveline_stepper(linear, INNER, PROPSHAFT, HALF_SHAFT)


def curved(x: ca.SX, u: ca.SX, p: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Return the same with rates that depend on every state in a bent way."""
    return tuple(part + ca.sum1(ca.sin(x)) * ca.sin(part) for part in linear(x, u, p))


def step_matrix() -> np.ndarray:
    """Return the map of an interval on (states, speeds, p, integrals): RK4, order by order."""
    size = N + 5 + COUNT + 2
    rates = np.zeros((size, size))
    rates[:N, : N + 5] = RATES[:N]
    rates[N + 5 :, : N + 5] = RATES[N:]
    z = H / INNER * rates
    one = np.eye(size) + z + z @ z / 2.0 + z @ z @ z / 6.0 + z @ z @ z @ z / 24.0
    return np.asarray(np.linalg.matrix_power(one, INNER))


@pytest.mark.parametrize("started", [0.0, 1.0])
def test_interval_is_runge_kutta_after_twists_follow_the_angles(
    interval: ca.Function, started: float
):
    before = dict(zip(MEMORY, RNG.uniform(-1.0, 1.0, len(MEMORY)), strict=True))
    before |= {"crank_angle": 12.5, "crank_speed": 40.0, "started": started}
    motion = {"pinion_angle": 0.3, "pinion_speed": 5.0, "wheel_angle": -0.2, "wheel_speed": 2.0}
    z_end, torques = interval(list(before.values()), [H, *motion.values()], P)
    after = dict(zip(MEMORY, np.asarray(z_end).ravel(), strict=True))

    lead = started * (motion["pinion_angle"] - before["pinion_angle"])
    lead_wheel = started * (motion["wheel_angle"] - before["wheel_angle"])
    start = before | {
        "propshaft_twist": before["propshaft_twist"] - lead,
        "half_shaft_twist": before["half_shaft_twist"] + lead_wheel,
    }
    whole = [start[name] for name in STATES]
    whole += [motion["pinion_speed"], motion["wheel_speed"], *P, *[0.0] * (COUNT + 2)]
    end = step_matrix() @ whole
    turned = end[0]
    assert turned > 4.0 * math.pi  # within the next cycle of four strokes
    end[0] -= 4.0 * math.pi
    assert [after[name] for name in STATES] == pytest.approx(end[:N])

    works = dict(zip(POWERS, end[N + 5 :], strict=False))
    # the axle turned farther than expected, under the torques of the interval before
    works["pinion"] += before["pinion_torque"] * lead
    works["ring_gear"] += before["wheel_torque"] * lead_wheel
    for name in POWERS:
        assert after[name] - before[name] == pytest.approx(works[name])
    stored = [
        0.5 * PROPSHAFT * one["propshaft_twist"] ** 2
        + 0.5 * HALF_SHAFT * one["half_shaft_twist"] ** 2
        for one in (before, start)
    ]
    left = before["pinion_torque"] * lead - before["wheel_torque"] * lead_wheel
    assert after["interface"] - before["interface"] == pytest.approx(stored[1] - stored[0] + left)

    means = end[-2:] / H
    assert [after["pinion_torque"], after["wheel_torque"]] == pytest.approx(means)
    assert after["pinion_angle"] == pytest.approx(0.3 + H * 5.0)
    assert after["wheel_angle"] == pytest.approx(-0.2 + H * 2.0)
    assert after["started"] == 1.0
    assert np.asarray(torques).ravel() == pytest.approx([*means, sum(after.values())])


def test_derivatives_of_an_interval_are_parts_of_its_matrix(interval: ca.Function):
    # of states but the crank angle, and of pinion and wheel speed, with the angles expected
    states, torques = interval_jacobian(interval)(RNG.uniform(-1.0, 1.0, N + 1), H, P)
    matrix = step_matrix()
    free = slice(1, N + 2)
    assert np.asarray(states) == pytest.approx(matrix[1:N, free])
    assert np.asarray(torques) == pytest.approx(matrix[-2:, free] / H)


def test_derivatives_are_taken_at_crank_angle_zero_with_the_angles_expected():
    interval = driveline_stepper(curved, INNER, PROPSHAFT, HALF_SHAFT)
    y, step = RNG.uniform(-1.0, 1.0, N + 1), 1e-5

    def outcome(y: np.ndarray) -> np.ndarray:
        memory = dict.fromkeys(MEMORY, 0.0) | dict(zip(STATES[1:], y, strict=False))
        z_end, torques = interval(list(memory.values()), [H, 0.0, y[-2], 0.0, y[-1]], P)
        return np.concatenate((np.asarray(z_end)[1:N, 0], np.asarray(torques)[:2, 0]))

    differences = np.array(
        [
            (outcome(y + step * one) - outcome(y - step * one)) / (2.0 * step)
            for one in np.eye(N + 1)
        ]
    ).T
    found = np.vstack([np.asarray(one) for one in interval_jacobian(interval)(y, H, P)])
    # third derivatives times 1e-10
    assert found == pytest.approx(differences, abs=1e-6 * np.abs(differences).max())
