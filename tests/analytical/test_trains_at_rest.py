"""The start of a train: its equilibrium, and what cannot be one."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.pair import helical_pair
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.as_train import axle_train
from gearlube_core.dynamics.train.choice import interpreted_kernel
from gearlube_core.dynamics.train.element import COORDINATES
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.roller_bearing import RollerBearing
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.march import START, work_size
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.rest_search import APART, LOOSE, OK
from gearlube_core.errors import ConvergenceError, ParameterError, StepError
from gearlube_core.number import Output
from tests.helpers.each import each
from tests.helpers.small_trains import (
    GEARS_ON_ROLLERS,
    KELVIN,
    LOAD,
    OIL,
    PAIR,
    RATIO,
    e_axle,
    two_rotors,
)


@pytest.mark.parametrize(("left", "right"), [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0)])
def test_a_wheel_without_load_leaves_its_shaft_straight(left: float, right: float) -> None:
    train = e_axle(friction="off")
    road = {"left": 200.0 * RATIO**2 * left, "right": 200.0 * RATIO**2 * right}
    torques = {f"{one} wheel": torque for one, torque in road.items()}
    torques["motor"] = 200.0 * (left + right)
    train.initialise({"left": -50.0}, torques, KELVIN)
    found = train.outputs()
    # the left wheel bears what the work of moving lines leaves, 1e-4 of it
    assert found["left shaft.torque"] == pytest.approx(-road["left"], rel=1e-4, abs=0.05)
    assert found["right shaft.torque"] == pytest.approx(-road["right"], rel=1e-9, abs=1e-6)


def test_a_shaft_that_is_locked_at_one_end_starts_at_rest():
    """The lock bears the torque: each shaft is twisted by T/k, and nothing moves."""
    locked = Body(name="lock", mass=1.0, inertia=1.0, polar_inertia=1.0, held=COORDINATES)
    rotors = [Body.spinning("motor", 0.2), Body.spinning("middle", 1.0), locked]
    shafts = [
        HalfShaft(name="first", first="motor", second="middle", stiffness=1e4),
        HalfShaft(name="second", first="middle", second="lock", stiffness=2e4),
    ]
    train = Train(rotors, [Port(name="drive", body="motor"), *shafts], PAIR.oil)
    train.initialise({"motor": 0.0}, {"drive": 30.0}, KELVIN)
    assert train.state("first.twist") == pytest.approx(30.0 / 1e4, rel=1e-9)
    assert train.state("second.twist") == pytest.approx(30.0 / 2e4, rel=1e-9)
    train.step(0.01, {"drive": 30.0}, KELVIN)
    assert train.state("motor.rz.rate") == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(ParameterError, match="speeds must fit together"):
        train.initialise({"motor": 5.0}, {"drive": 30.0}, KELVIN)


class NoKernels(NamedTuple):
    """Of an element that forgets its kernels."""

    number: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Twisting(Element):
    """An element with an own state."""

    name: str
    body: str
    on: ClassVar = ("body",)
    states: ClassVar = (Output("twist", "rad", "rotation against the ground"),)

    def numbers(self) -> NoKernels:
        return NoKernels(1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Speedometer(Twisting):
    """An element with an output that bodies have."""

    states: ClassVar = ()
    outputs: ClassVar = (Output("speed", "rad/s", "speed"),)


def test_what_cannot_be_a_train_is_named():
    rotor, port = Body.spinning("rotor", 0.1), Port(name="motor", body="rotor")
    with pytest.raises(ParameterError, match="bodies must have names of their own, got 'rotor'"):
        Train([rotor, rotor], [port], OIL)
    with pytest.raises(ParameterError, match=r"motor names 'shaft', which is not .* are: rotor"):
        Train([rotor], [replace(port, body="shaft")], OIL)
    with pytest.raises(ParameterError, match="mass must be within"):
        Body(name="rotor", mass=-1.0, inertia=1.0, polar_inertia=1.0)
    with pytest.raises(ParameterError, match=r"two has own states, .* must include at_rest"):
        Train([rotor], [Twisting(name="two", body="rotor")], OIL)
    with pytest.raises(ParameterError, match=r"got 'rotor\.speed' twice\. Rename the body or"):
        Train([rotor], [Speedometer(name="rotor", body="rotor")], OIL)
    loose = Train([rotor, Body.spinning("load", 1.0)], [port], OIL)
    with pytest.raises(StepError, match=r"no state yet\. Call initialise"):
        loose.step(1e-3, {"motor": 0.0}, KELVIN)
    with pytest.raises(ParameterError, match=r"which leave load free\. Give 1 more"):
        loose.initialise({"rotor": 1.0}, {"motor": 0.0}, KELVIN)
    train = two_rotors()
    with pytest.raises(ParameterError, match="every port, which are motor; wrong is moter"):
        train.initialise({"engine": 1.0}, {"motor": 0.0, "moter": 0.0}, KELVIN)
    with pytest.raises(ParameterError, match="speeds must name bodies of the train, got 'wheel'"):
        train.initialise({"wheel": 1.0}, {"motor": 0.0}, KELVIN)
    with pytest.raises(ParameterError, match=r"fit together .* apart\. Give one of them"):
        train.initialise({"engine": 1.0, "load": 2.0}, {"motor": 0.0}, KELVIN)
    with pytest.raises(ParameterError, match="at least one body of the train, got none"):
        train.initialise({}, {"motor": 0.0}, KELVIN)
    train.initialise({"engine": 1.0}, {"motor": 0.0}, KELVIN)
    saved = train.get_state()
    with pytest.raises(
        ParameterError, match=r"engine 1 rad.s \(9\.5493 rpm\), .* 0\.333 rad.s \(3\.18 rpm\)"
    ):
        train.initialise({"engine": 1.0, "load": 2.0}, {"motor": 9.0}, 300.0)
    assert np.array_equal(train.get_state(), saved)
    with pytest.raises(StepError, match="turns faster than"):
        train.step(0.1, {"motor": 1e7}, KELVIN)
    assert np.array_equal(train.get_state(), saved)


def test_teeth_without_bearings_have_no_rest():
    bodies, elements = helical_pair(PAIR)
    loose = [SpringSupport(name=one.name, body=one.body) for one in elements[3:]]
    train = Train(bodies, [*elements[:3], *loose], PAIR.oil)
    with pytest.raises(ConvergenceError, match=r"nothing holds pinion along x, .* wheel along z"):
        train.initialise({"wheel": 80.0}, LOAD, KELVIN)


def test_a_torque_that_splits_starts_in_equal_halves():
    # four equal shafts close a loop: loads on them are not determined by the torques alone
    rotors = [Body.spinning(name, 0.1) for name in ("in", "upper", "lower", "out")]
    ways = [("in", "upper"), ("in", "lower"), ("upper", "out"), ("lower", "out")]
    shafts = [HalfShaft(name=f"{a} {b}", first=a, second=b, stiffness=1e4) for a, b in ways]
    ports = [Port(name="drive", body="in"), Port(name="load", body="out", sign=-1.0)]
    train = Train(rotors, [*shafts, *ports], OIL)
    train.initialise({"out": 10.0}, {"drive": 60.0, "load": 60.0}, KELVIN)
    found = train.outputs()
    assert [found[f"{a} {b}.torque"] for a, b in ways] == pytest.approx(4 * [30.0], rel=1e-9)
    assert [found[f"{one.name}.speed"] for one in rotors] == pytest.approx(4 * [10.0], rel=1e-12)
    # a ring of four inertias and springs: 0, w, w and sqrt(2) w with w^2 = 2 k/I
    w = math.sqrt(2.0 * 1e4 / 0.1) / (2.0 * math.pi)
    assert train.modes()[0] == pytest.approx([0.0, w, w, math.sqrt(2.0) * w], rel=1e-6, abs=1e-3)
    # the march takes as many steps in a period of the highest mode as it is asked for
    assert train.get_state()[-1] == pytest.approx(16.0 * math.sqrt(2.0) * w, rel=1e-9)


def test_a_refused_start_leaves_the_state_as_it_was_with_the_number_that_says_why():
    made = two_rotors().assembly
    operate, work = interpreted_kernel(), np.zeros(work_size(made.sizes))
    before = np.random.default_rng(1).normal(size=made.sizes.states)

    def started(*wanted: float) -> tuple[int, list[float]]:
        work[: len(wanted)] = wanted
        s = before.copy()
        status = int(
            operate(START, s, KELVIN, made.numbers, made.memory, made.plan, 16.0, 0.0, work)
        )
        assert np.array_equal(s, before) == (status != OK)
        return status, work[:2].tolist()

    status, (_, free) = started(0.0, math.nan, math.nan)  # both turn as one, at no given speed
    assert (status, free) == (LOOSE, 1.0)
    # the shaft and both speeds share what is missing in equal parts
    status, (_, apart) = started(0.0, 1.0, 4.0)
    assert (status, apart) == (APART, pytest.approx(1.0))
    status, (rate, _) = started(1.0, math.nan, 3.0)
    omega = math.sqrt(1e4 * (1.0 / 0.2 + 1.0 / 2.0))
    assert (status, rate) == (OK, pytest.approx(max(1e3, 16.0 * omega / (2.0 * math.pi))))


def test_steps_of_a_start_with_little_load_are_those_of_teeth_that_all_touch():
    """The pair by itself finds its highest mode with a search of its own, at a larger torque."""
    given = replace(PAIR, friction="off")
    train, alone = Train(*helical_pair(given), given.oil), HelicalPairModel(given)
    for torque in (0.0, 1.0, -1.0, 226.0):
        train.initialise({"wheel": 84.4}, {"input": torque, "output": torque * RATIO}, KELVIN)
        alone.initialise(pinion_speed=104.7, pinion_torque=torque, wheel_torque=torque * RATIO,
                         oil_temperature=KELVIN)  # fmt: skip
        rate = train.get_state()[-1]
        highest = alone.step_control.highest_frequency
        # lines touch over their whole length in both, so that stiffness does not feel the torque;
        # differences over 1e-8 m leave 3e-7. At rest without torque the mode is 1.2 % lower
        assert rate / 16.0 == pytest.approx(highest, rel=1e-6), torque


@pytest.mark.slow
def test_loads_of_gears_follow_the_torques_down_to_a_millionth():
    """Flanks in contact are linear springs; friction is a share of the load."""
    found = []
    for share in (1e-3, 1e-6):
        case = TrainFile.named("e_axle_elastic").case()
        torques = {port: share * torque for port, torque in case.torques.items()}
        out = replace(case, torques=torques).start().outputs()
        found.append([out["stage_1.load"] / share, out["stage_2.load"] / share])
    # 1e-6 N of the search, over the share, is 2e-4 of the loads
    np.testing.assert_allclose(found[1], found[0], rtol=2e-4)


# clearances of pinion and gear [um], torque [N.m], speed [rad/s]
LIGHT = [
    (13.2, 35.8, 0.8532, 152.0), (30.6, 35.3, 0.0218, 130.0), (35.0, 11.7, -0.7145, 192.0),
    (31.7, 31.8, 0.0151, 44.0), (16.2, 14.9, 2.3572, 263.0), (15.5, 30.8, 0.4307, 239.0),
]  # fmt: skip


@each("of_pinion, of_gear, torque, speed", LIGHT)
def test_a_light_axle_rests_at_the_edges_of_its_clearances(of_pinion, of_gear, torque, speed):
    """One row of tapered rollers touches: x sin(a) + r cos(a) = c, along the axis and across.

    Films of 0.2 to 1 um and the distance of rollers, 35 um (1 - cos 10 deg), are left out.
    """
    given = mohammadpour_2015_axle()
    pinion, gear = (
        replace(given.bearing, preload=None, interference=-1e-6 * one)
        for one in (of_pinion, of_gear)
    )
    train = axle_train(replace(given, bearing=pinion, gear_bearing=gear))
    train.initialise({"pinion": speed}, {"input": torque, "output": 3.78 * torque}, KELVIN)
    angle = given.bearing.contact_angle
    for body, clearance, axis, across in (
        ("pinion", of_pinion, "x", "yz"), ("gear", of_gear, "z", "xy"),
    ):  # fmt: skip
        along = abs(train.state(f"{body}.{axis}"))
        radial = math.hypot(*(train.state(f"{body}.{c}") for c in across))
        edge = along * math.sin(angle) + radial * math.cos(angle)
        assert 1e6 * edge == pytest.approx(clearance, abs=1.5), body


def test_forces_of_single_roller_bearings_do_not_depend_on_their_clearance():
    data = tomllib.loads(GEARS_ON_ROLLERS)
    for one in data["elements"].values():
        if one["kind"] == "roller_bearing":
            one["torque_loss"] = "none"
    data["elements"]["mesh"]["film"] = "formula"
    torques = {"input": 0.19, "output": 0.2}
    case = TrainFile.from_data(
        data | {"start": data["start"] | {"torque_n_m": torques}}, "x"
    ).case()
    found = []
    for clearance in (0.0, 1e-5, 3e-5):
        elements = [
            replace(one, bearing=replace(one.bearing, preload=None, interference=-clearance))
            if isinstance(one, RollerBearing)
            else one
            for one in case.train.elements
        ]
        train = case.train.changed(elements=elements)
        train.initialise(case.speeds, torques, KELVIN)
        out = train.outputs()
        sums = [out[f"pinion_left.force.{c}"] + out[f"pinion_right.force.{c}"] for c in "xyz"]
        found.append(np.linalg.norm(sums))
    # gears that move by the clearance turn the line of action by 30 um over some 80 mm
    np.testing.assert_allclose(found[1:], found[0], rtol=2e-3)


def test_planets_without_torque_rest_on_their_pins_alone():
    """Each pin carries m r w^2; nothing else acts on the set."""
    case = TrainFile.named("planetary").case()
    out = replace(case, torques=dict.fromkeys(case.torques, 0.0)).start().outputs()
    wanted = 1523.0 * 0.863 * (12.1 * math.pi / 30.0) ** 2
    for n in (1, 2, 3):
        # 1e-6 of the force is what the search leaves
        assert out[f"pin_{n}.force.x"] == pytest.approx(-wanted, rel=2e-6)
        assert out[f"sun_mesh_{n}.load"] == out[f"ring_mesh_{n}.load"] == 0.0
