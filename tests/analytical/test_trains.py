"""Trains of elements: against closed forms, the helical pair alone, and balances."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.drag import CHURNING_LAWS, ChurningConstants, churning_torque
from gearlube_core.dynamics.helical_model.pair import helical_pair
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.model import Train
from gearlube_core.kernels.jit import kernel
from tests.helpers.small_trains import (
    KELVIN,
    PAIR,
    PLANE,
    RATIO,
    e_axle,
    loads,
    two_rotors,
)


def test_two_rotors_on_a_shaft_swing_as_the_closed_form():
    train = two_rotors()
    train.initialise({"engine": 100.0}, {"motor": 0.0}, KELVIN)
    frequencies, shapes = train.modes()
    omega = math.sqrt(1e4 * (1.0 / 0.2 + 1.0 / 2.0))
    assert frequencies == pytest.approx([0.0, omega / (2.0 * math.pi)], abs=1e-4)
    assert shapes[0, 1] / shapes[1, 1] == pytest.approx(-10.0, rel=1e-6)  # inverse of the inertias
    # a torque that steps on: twist T/I1/omega^2 (1 - cos), beside the common acceleration
    for _ in range(40):
        train.step(1e-3, {"motor": 50.0}, KELVIN)
    twist = 50.0 / 0.2 / omega**2 * (1.0 - math.cos(omega * 0.04))
    # RK4 with 16 steps a period: its phase is behind by (2 pi/16)^4/120 of the angle
    assert train.state("shaft.twist") == pytest.approx(twist, rel=1e-3)
    momentum = 0.2 * train.state("engine.rz.rate") + 2.0 * train.state("load.rz.rate")
    assert momentum == pytest.approx(100.0 * 2.2 + 50.0 * 0.04, rel=1e-12)
    assert train.outputs()["shaft.torque"] == pytest.approx(1e4 * train.state("shaft.twist"))


def test_outputs_of_two_rotors_follow_from_torque_speed_and_time():
    train = two_rotors(brake=3.0)
    units = {one.name: one.unit for one in train.output_records}
    energies = [f"energy.{one}" for one in ("motor.work", "shaft_damping", "brake", "stored")]
    assert list(units) == [
        *(f"{b}.{one}" for b in ("engine", "load") for one in ("angle", "speed", "acceleration")),
        "shaft.torque", "shaft_damping.power_loss", "brake.power_loss", "motor.power",
        "efficiency", *energies,
    ]  # fmt: skip
    assert [units[one] for one in ("engine.speed", "motor.power", *energies)] == [
        "rad/s", "W", "J", "J", "J", "J",
    ]  # fmt: skip
    train.initialise({"engine": 100.0}, {"motor": 3.0}, KELVIN)
    found = train.outputs()  # before the first step those of the instant
    assert found["motor.power"] == pytest.approx(300.0, rel=1e-12)
    assert found["brake.power_loss"] == pytest.approx(300.0, rel=1e-9)
    assert found["efficiency"] == pytest.approx(0.0, abs=1e-9)
    assert found["energy.stored"] == pytest.approx(0.5 * 2.2 * 1e4 + 0.5 * 9.0 / 1e4, rel=1e-12)
    for _ in range(3):
        before = found
        train.step(2e-3, {"motor": 50.0}, KELVIN)
        found = train.outputs()
        turned = found["engine.angle"] - before["engine.angle"]
        assert found["motor.power"] == pytest.approx(50.0 * turned / 2e-3, rel=1e-9)
        braked = found["load.angle"] - before["load.angle"]
        assert found["brake.power_loss"] == pytest.approx(3.0 * braked / 2e-3, rel=1e-6)
        share = found["brake.power_loss"] / found["motor.power"]
        assert found["efficiency"] == pytest.approx(1.0 - share, rel=1e-12)
        accelerating = (50.0 - found["shaft.torque"]) / 0.2
        assert found["engine.acceleration"] == pytest.approx(accelerating, rel=1e-9)
    # a step too short for a mean leaves the means, and a saved state keeps them
    train.step(5e-8, {"motor": 70.0}, KELVIN)
    after, other = train.outputs(), two_rotors(brake=3.0)
    for name in ("motor.power", "brake.power_loss", "efficiency"):
        assert after[name] == pytest.approx(found[name], rel=1e-9)
    other.set_state(train.get_state())
    assert other.outputs() == after
    # driven by its load, the motor takes work
    train.step(2e-3, {"motor": -50.0}, KELVIN)
    assert train.outputs()["motor.power"] < -4e3
    assert train.outputs()["efficiency"] == 0.0


def test_a_brake_from_outside_the_package_stops_a_rotor_after_its_angle():
    # w0^2 I / (2 T) for both rotors as one, which a stiff shaft makes of them
    train = two_rotors(brake=40.0, damping=20.0)
    train.initialise({"engine": 10.0}, {"motor": 0.0}, KELVIN)
    start = train.energy
    for _ in range(800):
        train.step(1e-3, {"motor": 0.0}, KELVIN)
    assert abs(train.state("load.rz.rate")) < 0.01
    assert train.state("load.rz") == pytest.approx(10.0**2 * 2.2 / (2.0 * 40.0), rel=5e-3)
    assert sum(train.lost.values()) == pytest.approx(start - train.energy, rel=1e-7)


def test_two_stages_carry_torque_speed_and_thrust_as_rigid_gears_do():
    train = e_axle(friction="off")
    train.initialise({"left": -50.0, "right": -50.0}, loads(200.0), KELVIN)
    speeds = [train.state(f"{body.name}.rz.rate") for body in train.bodies]
    expected = np.array([-(RATIO**2), RATIO, -1.0, -1.0, -1.0])
    assert speeds == pytest.approx(50.0 * expected, rel=1e-9)
    found = train.outputs()
    # without friction each mesh carries the torque of its pinion at its base radius, but for the
    # work of lines that move under load, 1e-4 of it
    for mesh, torque in (("first", 200.0), ("second", 200.0 * RATIO)):
        across = math.hypot(found[f"{mesh}.force.x"], found[f"{mesh}.force.y"])
        assert across == pytest.approx(torque / PLANE.r_bp, rel=1e-4)
        axial = abs(found[f"{mesh}.force.z"])
        assert axial == pytest.approx(across * PLANE.sin_b / PLANE.cos_b, rel=1e-9)
    # a left-hand pinion that turns about -z is pushed towards +z; so is a right-hand one about +z
    assert found["first.force.z"] > 0.0
    assert found["second.force.z"] > 0.0
    # parallel forces on the teeth have M . F = 0, and bearings bear all of M but 200 N.m
    work = sum(found[f"input bearings.moment.{c}"] * found[f"first.force.{c}"] for c in "xy")
    assert work == pytest.approx(200.0 * found["first.force.z"], rel=1e-3)
    both = found["left shaft.torque"] + found["right shaft.torque"]
    assert both == pytest.approx(-200.0 * RATIO**2, rel=1e-4)
    # the countershaft feels the first mesh's reaction and the second one's action: with gears of
    # one hand they pull apart, as every countershaft is made
    other = e_axle(friction="off", hand=False)
    other.initialise({"left": -50.0, "right": -50.0}, loads(200.0), KELVIN)
    assert other.outputs()["first.force.z"] == pytest.approx(-found["first.force.z"], rel=1e-4)


def test_energy_of_two_stages_is_balanced_while_torques_swing():
    train = e_axle()
    train.initialise({"left": -50.0, "right": -50.0}, loads(200.0), KELVIN)
    start = train.energy
    for k in range(100):
        train.step(1e-3, loads(200.0 * (1.0 + 0.3 * math.sin(0.6 * k))), KELVIN)
    put_in = 200.0 * 50.0 * RATIO**2 * 0.1
    lost = train.lost
    assert min(lost.values()) >= 0.0
    assert lost["friction"] > 0.005 * put_in
    missing = train.work - sum(lost.values()) - (train.energy - start)
    assert abs(missing) < 1e-6 * put_in


def test_a_train_turned_about_its_axes_moves_as_before():
    before, after = e_axle(), e_axle(turned=1.1)
    for train in (before, after):
        train.initialise({"left": -50.0, "right": -50.0}, loads(200.0), KELVIN)
        for k in range(20):
            train.step(5e-4, loads(200.0 - 10.0 * k), KELVIN)
    found, turned = before.outputs(), after.outputs()
    assert turned["first.dte"] == pytest.approx(found["first.dte"], rel=1e-6)
    x, y = found["second.force.x"], found["second.force.y"]
    rotated = x * math.cos(1.1) - y * math.sin(1.1)
    assert turned["second.force.x"] == pytest.approx(rotated, rel=1e-6)
    assert before.state("counter.x") == pytest.approx(
        after.state("counter.x") * math.cos(1.1) + after.state("counter.y") * math.sin(1.1),
        rel=1e-5,
    )


class SpringsOfShaft(NamedTuple):
    """Linear springs without a cage, and a drag of their own; all floats."""

    stiffness: float  # of either bearing [N/m]
    drag: float  # of either [N.m]
    cage_ratio: float = 0.0

    @kernel
    def shaft_forces(self, motion, f_ref, oil):
        k = self.stiffness
        F = (-k * motion.r1, -k * motion.r2, -k * motion.axial)
        return F[0], F[1], F[2], F[0], F[1], F[2], 0.0

    @kernel
    def shaft_energy(self, motion, oil):
        square = motion.r1 * motion.r1 + motion.r2 * motion.r2 + motion.axial * motion.axial
        return self.stiffness * square

    @kernel
    def shaft_drag(self, speed, axial_load, radial_load, law, oil):
        return math.copysign(self.drag, speed)


class Springs(Bearing):
    """A bearing type that is not registered."""

    def parameters(self) -> SpringsOfShaft:
        return SpringsOfShaft(1.5e8, 0.2)


def on_bearings(bearings: tuple[Bearing, Bearing], law: str) -> Train:
    """Return the pair of he_2007 on bearings of any type, with a seal and churning."""
    bodies, elements = helical_pair(PAIR)
    bodies = [replace(body, held=("rx", "ry")) for body in bodies]
    opposed = [
        OpposedBearings(name=f"{body.name} bearings", body=body.name, bearing=one,
                        torque_loss=law, orders=25.0)
        for body, one in zip(bodies, bearings, strict=True)
    ]  # fmt: skip
    drags = [
        Seal(name="seal", body="pinion", torque=0.3),
        Churning(name="sump", body="wheel", law="changenet_velex_2007", ring_diameter=0.2,
                 ring_width=0.03, immersion=0.04, oil_volume=1e-3),
    ]  # fmt: skip
    return Train(bodies, [*elements[:3], *opposed, *drags], PAIR.oil)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("bearings", "law"),
    [
        pytest.param(lambda: (Springs(), Springs()), "palmgren", id="springs"),
        pytest.param(lambda: mohammadpour_2015_axle().bearings, "zhou_hoeprich_1991", id="rollers",
                     marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_bearings_seals_and_churning_of_the_axle_serve_the_helical_pair(bearings, law):
    train, load = on_bearings(bearings(), law), {"input": 200.0, "output": 240.0}
    train.initialise({"wheel": 100.0}, load, KELVIN)
    found = train.outputs()
    for axis in "xyz":  # at rest the bearings of the pinion bear what its mesh exerts
        force = found[f"mesh.force.{axis}"]
        assert found[f"pinion bearings.force.{axis}"] == pytest.approx(-force, abs=0.01)
    start = train.energy
    for _ in range(30):
        train.step(1e-3, load, KELVIN)
    lost, before = train.lost, train.outputs()
    # the torque of a seal does not depend on the speed, but for its rounding off near rest
    assert before["seal.torque"] == pytest.approx(-0.3, rel=1e-4)
    assert lost["seals"] == pytest.approx(0.3 * -train.state("pinion.rz"), rel=1e-3)
    missing = train.work - sum(lost.values()) - (train.energy - start)
    # forces of bearings are expanded about states near by: 1e-5 of what passes through
    assert abs(missing) < 1e-5 * 200.0 * 100.0 * RATIO * 0.03
    # in one more step, bearings and sump lose their torques times the mean speeds
    names = [body.name for body in train.bodies]
    speed = {name: 0.5 * train.state(f"{name}.rz.rate") for name in names}
    train.step(1e-3, load, KELVIN)
    speed = {name: half + 0.5 * train.state(f"{name}.rz.rate") for name, half in speed.items()}
    drag = sum(before[f"{name} bearings.torque"] * w for name, w in speed.items())
    assert train.lost["bearing_torque"] - lost["bearing_torque"] == pytest.approx(
        1e-3 * drag, rel=0.02
    )
    sump = ChurningConstants(CHURNING_LAWS.index("changenet_velex_2007"), 0.2, 0.03, 0.04, 1e-3)
    nu = PAIR.oil.dynamic_viscosity(KELVIN) / PAIR.oil.density
    torque = churning_torque(speed["wheel"], nu, PAIR.oil.density, sump)
    churned = train.lost["churning"] - lost["churning"]
    assert churned == pytest.approx(1e-3 * torque * speed["wheel"], rel=0.01)
    # kept from the begin of a step that the outputs do not take
    torque = churning_torque(before["wheel.speed"], nu, PAIR.oil.density, sump)
    assert before["sump.torque"] == pytest.approx(torque, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("rollers", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_a_train_goes_on_from_a_saved_state_to_the_last_bit(rollers):
    train = on_bearings((Springs(), Springs()), "palmgren")
    if rollers:  # whose drag is kept
        train = on_bearings(mohammadpour_2015_axle().bearings, "zhou_hoeprich_1991")
    train.initialise({"wheel": 100.0}, {"input": 200.0, "output": 240.0}, KELVIN)
    for k in range(5):
        train.step(1e-3, {"input": 200.0 + k, "output": 240.0}, KELVIN)
    saved, before = train.get_state(), train.outputs()

    def go_on(one: Train) -> np.ndarray:
        for k in range(5):
            one.step(1e-3, {"input": 180.0 - k, "output": 240.0}, KELVIN)
        return one.get_state()

    first = go_on(train)
    for one in (Train(train.bodies, train.elements, train.oil), train):
        one.set_state(saved)
        assert one.outputs() == before  # and reading them leaves the motion as it is
        assert np.array_equal(go_on(one), first)
