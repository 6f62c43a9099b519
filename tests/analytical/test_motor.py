"""Motors of trains: ripple and pull of a table against closed forms, the lag of the control."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from drivetrain.train.train_file import TrainCase
from fmu_src.train import definition_with_train
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.dynamics.train.ripple_table import RippleTable, skew_factor
from gearlube_core.errors import ParameterError
from tests.helpers.small_trains import KELVIN, OIL

SLOT = math.radians(7.5)  # of 48
ONE_ORDER = "speed_rpm,torque_Nm,order,T_amp_Nm,T_phase_deg\n0,0,24,2,30\n"
HEAD = "speed_rpm,torque_Nm,order,T_amp_Nm,T_phase_deg,F_amp_N,F_phase_deg\n"


def table(folder: Path, text: str) -> RippleTable:
    file = folder / "ripple.csv"
    file.write_text(text)
    return RippleTable.read(file)


def rotor(**given: object) -> Train:
    """Return a rotor of 0.05 kg m2 and 2 kg on soft springs, in a stator that is free to turn."""
    bodies = [
        Body(name="rotor", mass=2.0, inertia=0.05, polar_inertia=0.05, held=("z", "rx", "ry")),
        Body(name="stator", mass=20.0, inertia=1.0, polar_inertia=1.0, held=("z", "rx", "ry")),
        Body.spinning("load", 1e3),
    ]
    motor = Motor(name="motor", body="rotor", stator="stator", **given)  # type: ignore[arg-type]
    springs = [
        SpringSupport(
            name=f"{one.name} springs",
            body=one.name,
            K_xx=1e6,
            K_yy=1e6,
            K_zz=0.0,
            K_ax=0.0,
            K_ay=0.0,
            c_x=0.0,
            c_y=0.0,
            c_z=0.0,
        )
        for one in bodies[:2]
    ]
    shaft = HalfShaft(name="shaft", first="rotor", second="load", stiffness=1e3)
    mount = HalfShaft(name="mount", first="stator", second="ground", stiffness=1e4)
    return Train(bodies, [motor, Port(name="brake", body="load"), *springs, shaft, mount], OIL)


@pytest.mark.parametrize(
    ("order", "steps", "left"),
    [
        (24, 0, 0.636620), (48, 0, 0.0), (72, 0, 0.212207),
        (24, 3, 0.666667), (48, 3, 0.0), (72, 3, 0.333333),
        (24, 2, 0.707107), (48, 2, 0.0), (96, 2, 1.0), (0, 0, 1.0), (24, 1, 1.0),
    ],
)  # fmt: skip
def test_skew_leaves_what_its_mean_over_the_length_leaves(order: int, steps: int, left: float):
    """Two steps of 3.75 deg are in phase again for order 96."""
    assert skew_factor(order, SLOT, steps) == pytest.approx(left, abs=6e-7)  # digits given


def test_ripple_moves_the_rotor_by_its_closed_form(tmp_path: Path):
    """A rotor on a soft shaft: amplitude A / (I_r (nu w)^2 - k) far above resonance."""
    train = rotor(ripple=table(tmp_path, ONE_ORDER))
    speed, twists, torques = 100.0, [], []
    train.initialise({"load": speed}, {"motor": 0.0, "brake": 0.0}, KELVIN)
    period, n = 2.0 * math.pi / (24.0 * speed), 32
    angles = []
    for _ in range(64 * n):
        train.step(period / n, {"motor": 0.0, "brake": 0.0}, KELVIN)
        angles.append(24.0 * (train.state("rotor.rz") - train.state("stator.rz")))
        torques.append(train.outputs()["motor.ripple"])
        twists.append(train.state("rotor.rz.rate"))
    np.testing.assert_allclose(
        torques, 2.0 * np.cos(np.array(angles) + math.radians(30.0)), atol=1e-9
    )
    times = period / n * np.arange(1, len(twists) + 1)
    parts = [f(phase) for phase in (np.array(angles), math.sqrt(1e3 / 0.05) * times)
             for f in (np.cos, np.sin)]  # fmt: skip
    fit = np.linalg.lstsq(np.stack([*parts, np.ones_like(times)], axis=1), twists, rcond=None)[0]
    inertia = 0.05 - 1e3 / (24.0 * speed) ** 2  # of the rotor and its spring at this frequency
    # the stator moves a little too, which modulates the order by 1e-4
    assert math.hypot(*fit[:2]) == pytest.approx(2.0 / (inertia * 24.0 * speed), rel=1e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_pull_turns_with_the_rotor_and_acts_on_both(tmp_path: Path, sign: float):
    """At a tenth of the resonance it bends the springs by B / (k - m w^2), in phase."""
    train = rotor(ripple=table(tmp_path, HEAD + "0,0,1,0,0,50,90\n"), sign=sign)
    speed, torques = sign * 70.0, {"motor": 0.0, "brake": 0.0}
    train.initialise({"load": speed}, torques, KELVIN)
    places, pulls, angles, stators = [], [], [], []
    for _ in range(2000):
        train.step(1e-3, torques, KELVIN)
        found = train.outputs()
        angles.append(train.state("rotor.rz"))
        pulls.append(found["motor.pull.x"] + 1j * found["motor.pull.y"])
        places.append(train.state("rotor.x") + 1j * train.state("rotor.y"))
        stators.append(train.state("stator.x") + 1j * train.state("stator.y"))
    turning = np.exp(1j * np.array(angles))
    np.testing.assert_allclose(pulls, sign * 50j * turning, atol=1e-8)
    for found, mass, sense in ((places, 2.0, 1.0), (stators, 20.0, -1.0)):
        around = np.mean(np.array(found) / turning)
        wanted = sense * sign * 50j / (1e6 - mass * speed**2)
        # free vibrations of the start cancel over some hundred periods
        assert abs(around - wanted) < 1e-2 * abs(wanted)


def test_the_pull_that_grows_with_displacement_is_a_negative_spring(tmp_path: Path):
    """Rotor and stator on springs K with -k_m between them: frequencies, and rest under a pull."""
    k, drawn, pull = 1e6, 3e5, 50.0
    table_of_pull = table(tmp_path, HEAD + f"0,0,0,0,0,{pull:g},0\n")
    train = rotor(pull_stiffness=drawn, ripple=table_of_pull)
    train.initialise({"load": 0.0}, {"motor": 0.0, "brake": 0.0}, KELVIN)
    stiffness = np.array([[k - drawn, drawn], [drawn, k - drawn]])
    wanted = np.sqrt(np.linalg.eigvals(stiffness / np.array([[2.0], [20.0]]))) / (2.0 * math.pi)
    found = train.modes()[0]
    for one in wanted:  # along x and along y, by differences of 1e-9 m
        assert np.sum(np.abs(found / one - 1.0) < 1e-6) == 2
    x = np.linalg.solve(stiffness, [pull, -pull])
    places = [train.state("rotor.x"), train.state("stator.x")]
    np.testing.assert_allclose(places, x, rtol=1e-6)
    assert train.outputs()["motor.pull.x"] == pytest.approx(pull + drawn * (x[0] - x[1]), rel=1e-6)


def test_a_pull_that_draws_the_rotor_away_is_refused():
    """det K = K^2 - 2 K k_m is zero at half of K."""
    torques = {"motor": 0.0, "brake": 0.0}
    start = {"speeds": {"load": 0.0}, "torques": torques, "oil_temperature": KELVIN}
    TrainCase(name="rotor", train=rotor(pull_stiffness=4.9e5), **start).start()
    case = TrainCase(name="rotor", train=rotor(pull_stiffness=5.1e5), **start)
    with pytest.raises(ParameterError, match="got 510000 N/m of motor: 2 motion"):
        case.start()


def test_work_of_the_growing_pull_is_the_energy_of_the_train():
    train = rotor(pull_stiffness=3e5)
    train.initialise({"load": 300.0}, {"motor": 0.0, "brake": 0.0}, KELVIN)
    state = train.get_state()
    state[train.state_names.index("rotor.x")] = 1e-4
    train.set_state(state)
    before = train.energy
    for _ in range(123):
        train.step(1e-4, {"motor": 0.0, "brake": 0.0}, KELVIN)
    # 5 mJ swing at 84 Hz; RK4 is off by (w h)^5 of it in a step, 2e-9 J, which 123 steps add up
    assert abs(train.work) > 1e-3
    assert train.energy - before == pytest.approx(train.work, abs=2.5e-7)


def test_the_torque_follows_its_control_with_the_lag_of_first_order():
    train = rotor(bandwidth=20.0)
    train.initialise({"load": 50.0}, {"motor": 10.0, "brake": 0.0}, KELVIN)
    assert train.outputs()["motor.torque_about_z"] == pytest.approx(10.0, rel=1e-12)
    for i in range(1, 21):
        train.step(1e-3, {"motor": 30.0, "brake": 0.0}, KELVIN)
        wanted = 30.0 - 20.0 * math.exp(-2.0 * math.pi * 20.0 * 1e-3 * i)
        assert train.outputs()["motor.torque_about_z"] == pytest.approx(wanted, rel=1e-6)
    ideal = rotor()
    ideal.initialise({"load": 50.0}, {"motor": 10.0, "brake": 0.0}, KELVIN)
    ideal.step(1e-6, {"motor": 30.0, "brake": 0.0}, KELVIN)
    assert ideal.outputs()["motor.torque_about_z"] == 30.0


def test_work_of_ripple_and_pull_is_the_energy_of_the_train():
    """No damper is there; at 16 steps per period of order 72 RK4 loses less than this."""
    train = rotor(ripple=RippleTable.named("48_slots_8_poles"), bandwidth=200.0, skew_angle=SLOT)
    train.initialise({"load": 300.0}, {"motor": 80.0, "brake": -80.0}, KELVIN)
    before, passed = train.energy, 0.0
    for _ in range(300):
        done = train.work
        train.step(1e-3, {"motor": 150.0, "brake": -80.0}, KELVIN)
        passed += abs(train.work - done)
    assert abs(train.energy - before - train.work) < 1e-6 * passed


def test_a_motor_without_a_table_is_a_port_to_the_bit():
    """One body turns the load through a shaft; nothing else acts."""
    found = []
    for drive in (Motor(name="drive", body="engine"), Port(name="drive", body="engine")):
        bodies = [Body.spinning("engine", 0.2), Body.spinning("load", 2.0)]
        shaft = HalfShaft(name="shaft", first="engine", second="load", stiffness=1e4)
        train = Train(bodies, [drive, shaft], OIL)
        train.initialise({"load": 50.0}, {"drive": 10.0}, KELVIN)
        for _ in range(20):
            train.step(1e-3, {"drive": 30.0}, KELVIN)
        found.append([train.state(f"{one}.rz.rate") for one in ("engine", "load")])
    assert found[0] == found[1]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (ONE_ORDER + "3000,0,24,2,0\n3000,50,24,2,0\n", "order 24 lacks the row of 0 rpm and 50"),
        (ONE_ORDER.replace(",24,", ",-24,"), "order must be a finite number within 0 to"),
        (ONE_ORDER.replace("T_phase_deg", "phase"), "unknown column 'phase'"),
        (ONE_ORDER + "0,0,24,2,0\n", "line 3: order 24 at 0 rpm and 0 N.m is there twice"),
        ("speed_rpm,torque_Nm,order\n0,0,24\n", "must have amplitudes of torque"),
        ("speed_rpm,torque_Nm,order,T_amp_Nm,T_amp_share\n0,0,24,1,1\n", "in one column"),
        ("speed_rpm,order,T_amp_Nm\n0,24,1\n", "missing: torque_Nm"),
    ],
)
def test_wrong_tables_are_refused_by_name(tmp_path: Path, text: str, told: str):
    with pytest.raises(ParameterError, match=told):
        table(tmp_path, text)


def test_shares_of_the_torque_are_amplitudes(tmp_path: Path):
    text = "speed_rpm;torque_Nm;order;T_amp_share\n0;50;24;0,02\n0;100;24;0,03\n"
    np.testing.assert_allclose(table(tmp_path, text).torque, [[[1.0, 3.0]]], rtol=1e-15)


def test_an_unknown_name_of_a_table_is_refused():
    with pytest.raises(ParameterError, match="Known: 48_slots_8_poles"):
        RippleTable.named("36_slots")


def test_the_torque_of_a_motor_is_an_input_of_the_fmu_and_its_lag_a_state():
    definition, case = definition_with_train("e_axle_full")
    of_name = {one.name: one for one in definition.variables}
    assert of_name["motor.torque"].causality == "input"
    assert of_name["motor.torque"].start == 150.0
    assert definition.flanges["motor"][1:] == (
        "motor.torque", "input.rotor.speed", "input.rotor.angle"
    )  # fmt: skip
    assert "motor.mean_torque" in case.train.continuous_names
    assert of_name["motor.mean_torque"].unit == "N.m"
