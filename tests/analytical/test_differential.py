"""Differentials and splines with play, against statics and against energy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.elements.differential import Differential
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from tests.helpers.small_trains import KELVIN, OIL

DRIVE = {"drive": 300.0, "left road": -120.0, "right road": -120.0}


def axle(locked: bool = False, **given: float) -> Train:
    """Return a rotor whose shaft turns the case, two side gears and a wheel on each."""
    right = Body.spinning("right", 1.0)
    if locked:
        right = Body(
            name="right", mass=1.0, inertia=1.0, polar_inertia=1.0,
            held=("x", "y", "z", "rx", "ry", "rz"),
        )  # fmt: skip
    bodies = [
        *(Body.spinning(one, inertia) for one, inertia in (("rotor", 0.5), ("case", 0.05))),
        *(Body.spinning(f"{one} side", 0.01) for one in ("left", "right")),
        Body.spinning("left", 1.0),
        right,
    ]
    elements: list[Element] = [
        Port(name="drive", body="rotor"),
        Port(name="left road", body="left"),
        Port(name="right road", body="right"),
        HalfShaft(name="input", first="rotor", second="case", stiffness=5e4, damping=2.0),
        Differential(
            name="differential",
            case="case",
            left="left side",
            right="right side",
            damping=2.0,
            **given,
        ),
        HalfShaft(name="left shaft", first="left side", second="left", stiffness=9e3, damping=2.0),
        HalfShaft(
            name="right shaft", first="right side", second="right", stiffness=7e3, damping=2.0
        ),
    ]
    return Train(bodies, elements, OIL)


def balance(train: Train, torques: dict[str, float], steps: int = 400) -> float:
    """Return by how much energy is out over a march, of all that passes through [-]."""
    before, passed = train.energy, 0.0
    for _ in range(steps):
        done = train.work
        train.step(1e-3, torques, KELVIN)
        passed += abs(train.work - done)
    out = train.work - sum(train.lost.values()) - (train.energy - before)
    return abs(out) / (passed + sum(train.lost.values()))


def test_a_wheel_that_is_locked_makes_the_other_one_turn_twice_as_fast_as_the_case():
    train = axle(locked=True)
    train.initialise({"case": 20.0}, DRIVE, KELVIN)
    assert train.state("left.rz.rate") == pytest.approx(40.0, rel=1e-12)
    assert train.state("right.rz.rate") == 0.0


def test_torques_in_a_curve_have_the_bias_ratio_and_power_balances():
    train = axle(locking=0.5)
    train.initialise({"left": 30.0, "right": 20.0}, DRIVE, KELVIN)
    found = train.outputs()
    assert train.state("case.rz.rate") == pytest.approx(25.0, rel=1e-12)
    left, right = found["differential.torque.left"], found["differential.torque.right"]
    assert left + right == pytest.approx(300.0, rel=1e-9)  # of the case, at rest
    assert right / left == pytest.approx(3.0, rel=1e-9)
    power = left * 30.0 + right * 20.0 + found["differential.friction"]
    assert power == pytest.approx(300.0 * 25.0, rel=1e-9)
    assert found["differential.friction"] == pytest.approx(0.5 * 150.0 * 10.0, rel=1e-9)


def test_wheels_bear_what_the_roads_leave_on_both_sides():
    """Two bodies can turn independently: unlike torques of the road are no equilibrium."""
    train = axle(preload=40.0, locking=0.1)
    train.initialise({"left": 30.0, "right": 20.0}, {**DRIVE, "left road": 15.0}, KELVIN)
    found = train.outputs()
    assert found["left shaft.torque"] == pytest.approx(0.5 * (300.0 - 70.0), rel=1e-9)
    assert found["right shaft.torque"] == pytest.approx(0.5 * (300.0 + 70.0), rel=1e-9)


def test_straight_ahead_nothing_is_lost():
    train = axle(preload=40.0, locking=0.3)
    torques = {"drive": 300.0, "left road": -150.0, "right road": -150.0}
    train.initialise({"left": 30.0, "right": 30.0}, torques, KELVIN)
    for _ in range(50):
        train.step(1e-3, torques, KELVIN)
    assert train.state("right.rz.rate") == pytest.approx(30.0, rel=1e-9)
    assert train.lost["differential"] == pytest.approx(0.0, abs=1e-12)


def test_energy_balances_through_a_curve_and_out_of_it():
    """The friction turns round as the speeds meet; the error is that of RK4 at these steps."""
    train = axle(preload=20.0, locking=0.2)
    train.initialise({"left": 31.0, "right": 29.0}, DRIVE, KELVIN)
    assert balance(train, {**DRIVE, "left road": -200.0}) < 1e-6
    assert train.state("left.rz.rate") < train.state("right.rz.rate")
    assert train.lost["differential"] > 1.0  # J


def test_light_sides_ask_for_steps_that_friction_can_take():
    """Between sides of 0.001 kg m2 friction damps at 1e6 per second: it still comes to rest."""
    train = axle(preload=200.0, slip_speed=0.1)
    light = [Body.spinning(one.name, 1e-3) if "side" in one.name else one for one in train.bodies]
    train = Train(light, train.elements, OIL)
    torques = {**DRIVE, "left road": -140.0, "right road": -160.0}
    train.initialise({"left": 30.0, "right": 30.0}, torques, KELVIN)
    assert balance(train, torques, 30) < 1e-6
    # the creep that carries half of the difference of both torques
    creep = 0.1 * math.atanh(20.0 / 200.0)
    assert abs(train.outputs()["differential.slip"]) < 2.0 * creep


def spline(backlash: float, damping: float = 0.0) -> Train:
    rotors = [Body.spinning("engine", 0.2), Body.spinning("load", 2.0)]
    shaft = HalfShaft(
        name="shaft", first="engine", second="load", stiffness=1e4, damping=damping,
        backlash=backlash,
    )  # fmt: skip
    elements = [Port(name="motor", body="engine"), Port(name="brake", body="load"), shaft]
    return Train(rotors, elements, OIL, steps_per_highest_period=128)


@pytest.mark.parametrize(("torque", "twist"), [(30.0, 3e-3), (-30.0, -3e-3 - 0.02)])
def test_a_spline_rests_on_the_flank_that_the_torque_turns_it_to(torque: float, twist: float):
    train = spline(0.02)
    train.initialise({"engine": 100.0}, {"motor": torque, "brake": -torque}, KELVIN)
    assert train.state("shaft.twist") == pytest.approx(twist, rel=1e-9)
    assert train.outputs()["shaft.torque"] == pytest.approx(torque, rel=1e-9)


def test_a_spline_that_changes_its_flank_crosses_its_play_freely():
    """Over the play the speeds differ by what the torque on the engine makes of it."""
    play, torque = 0.05, -20.0
    train = spline(play)
    train.initialise({"engine": 100.0}, {"motor": 0.0, "brake": 0.0}, KELVIN)
    time = math.sqrt(2.0 * play * 0.2 / -torque)  # s, of the way under constant acceleration
    steps = 200
    for _ in range(steps):
        train.step(time / steps, {"motor": torque, "brake": 0.0}, KELVIN)
    assert train.state("shaft.twist") == pytest.approx(-play, rel=1e-4)
    assert train.state("load.rz.rate") == pytest.approx(100.0, rel=1e-9)
    slower = 100.0 - train.state("engine.rz.rate")
    assert slower == pytest.approx(-torque * time / 0.2, rel=1e-4)


def test_energy_balances_while_splines_rattle():
    train = spline(0.01, damping=3.0)
    train.initialise({"engine": 100.0}, {"motor": 30.0, "brake": -30.0}, KELVIN)
    before, crossed, twists = train.energy, 0, []
    for i in range(1000):
        sense = 1.0 if (i // 50) % 2 else -1.0
        train.step(1e-3, {"motor": 60.0 * sense, "brake": -60.0 * sense}, KELVIN)
        twists.append(train.state("shaft.twist"))
    sides = np.sign(np.array(twists) + 0.005)
    crossed = int((np.diff(sides) != 0.0).sum())
    assert crossed > 20
    out = train.work - sum(train.lost.values()) - (train.energy - before)
    assert abs(out) < 1e-5 * train.energy  # corners of the force, each within one step


def test_the_shipped_axle_holds_its_curve_and_its_energy():
    """Friction of the open differential: 10 N.m and 8 % of the torque of the case."""
    case = TrainFile.named("e_axle_full").case()
    train = case.start()
    found = train.outputs()
    left, right = found["differential.torque.left"], found["differential.torque.right"]
    # but for 1 - tanh(10.5) = 2e-9
    assert left - right == pytest.approx(10.0 + 0.08 * (left + right), rel=1e-8)
    assert left - right == pytest.approx(645.2 - 540.4, rel=2e-3)  # as the file says
    before, passed = train.energy, 0.0
    for _ in range(50):
        done = train.work
        train.step(1e-3, case.torques, case.oil_temperature)
        passed += abs(train.work - done)
    assert train.outputs()["differential.slip"] == pytest.approx(-math.pi * 20.0 / 30.0, rel=0.05)
    out = train.work - sum(train.lost.values()) - (train.energy - before)
    assert abs(out) < 1e-6 * passed
