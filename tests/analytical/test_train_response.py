"""Vibration by a transmission error: closed forms, another model, and a run in time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.dynamics.train.response import frequency_response, order_response
from gearlube_core.errors import ParameterError
from tests.helpers.elastic_e_axle import whole
from tests.helpers.small_trains import DAMPING, OIL, two_rotors
from tests.helpers.small_trains import FIRST as ENGINE
from tests.helpers.small_trains import SECOND as LOAD
from tests.helpers.small_trains import STIFFNESS as TORSION

FIRST, SECOND = 1e-3, 1e-2  # kg.m2
STIFFNESS, SPEED, KELVIN = 4e8, 100.0, 340.0  # N/m, rad/s, K
TEETH, MODULE = 20, 5e-3
ARMS = [0.5 * teeth * MODULE * math.cos(math.radians(20.0)) for teeth in (TEETH, 2 * TEETH)]
SAMPLES = 97  # of a mesh period
MASS = 1.0 / (ARMS[0] ** 2 / FIRST + ARMS[1] ** 2 / SECOND)  # of both gears along the line


def gears(**more: object) -> Train:
    bodies = [Body.spinning("pinion", FIRST), Body.spinning("wheel", SECOND)]
    mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=TEETH, teeth_2=2 * TEETH,
                    normal_module=MODULE, face_width=0.05, backlash=1e-4, stiffness=STIFFNESS,
                    **more)  # fmt: skip
    ports = [Port(name="motor", body="pinion"), Port(name="road", body="wheel")]
    train = Train(bodies, [mesh, *ports], OIL)
    train.initialise({"pinion": SPEED}, {"motor": 50.0, "road": 100.0}, KELVIN)
    return train


@pytest.mark.parametrize("ratio", [0.0, 0.03])
def test_the_load_of_two_gears_is_that_of_the_closed_form(ratio: float):
    """k m w2 / (k - m w2) with a complex stiffness k, below and above resonance."""
    frequencies = np.array([10.0, 500.0, 5000.0, 9000.0])
    found = frequency_response(gears(), "mesh", ["mesh.load"], frequencies, ratio)[:, 0]
    inertia = MASS * (2.0 * math.pi * frequencies) ** 2
    stiffness = STIFFNESS * (1.0 + 2j * ratio)
    # the stiffness of the load itself is taken as real, which changes it by the loss factor
    expected = STIFFNESS * inertia / (stiffness - inertia)
    # differences over 1 nm take 3e-5
    np.testing.assert_allclose(abs(found), abs(expected), rtol=3e-5 + 2.0 * ratio**2)


def test_forces_of_an_axle_are_those_of_the_other_model():
    """N over 1 um at the first mesh. There damping was viscous, of each mode, with 2 %.

    Between resonances that differs by up to 3 % where forces cancel, and by 0.5 % elsewhere.
    """
    expected = [
        [34.770, 77.001, 30.115],
        [255.804, 169.439, 180.354],
        [35.945, 9.503, 149.977],
        [762.590, 349.789, 200.752],
        [466.020, 16.696, 22.550],
    ]
    outputs = ["stage_1.load", "stage_2.load", "counter_fixed.force.y"]
    at = [500.0, 1000.0, 2000.0, 5000.0, 10_000.0]
    found = 1e-6 * abs(frequency_response(whole().train, "stage_1", outputs, at))
    np.testing.assert_allclose(found, expected, rtol=0.03)
    assert np.median(abs(found / np.array(expected) - 1.0)) < 5e-3


def test_forces_at_one_mesh_by_the_error_of_another_are_those_the_other_way():
    axle, at = whole().train, [300.0, 1200.0, 4000.0]
    there = frequency_response(axle, "stage_1", ["stage_2.load"], at)
    back = frequency_response(axle, "stage_2", ["stage_1.load"], at)
    np.testing.assert_allclose(abs(there), abs(back), rtol=1e-5)  # differences over 1 nm


def test_a_run_in_time_swings_as_the_response():
    """One gap of 0.5 um that follows the mesh cycle; flanks stay in contact under 1.1 kN."""
    amplitude, cycle = 0.5e-6, np.linspace(0.0, 2.0 * math.pi, 64, endpoint=False)
    row = tuple((amplitude * (1.0 - np.cos(cycle))).tolist())
    damping = 0.005 * 2.0 * math.sqrt(STIFFNESS * MASS)
    train = gears(gap=(row,), damping=damping)
    frequency = TEETH * SPEED / (2.0 * math.pi)
    period, loads = 1.0 / frequency, []
    torques = {"motor": 50.0, "road": 100.0}
    for _ in range(60):  # what swings at the start dies
        train.step(period, torques, KELVIN)
    for _ in range(SAMPLES):
        train.step(period / SAMPLES, torques, KELVIN)
        loads.append(train.outputs()["mesh.load"])
    angle = 2.0 * math.pi * np.arange(1, SAMPLES + 1) / SAMPLES
    first = 2.0 / SAMPLES * abs(np.sum(np.array(loads) * np.exp(-1j * angle)))
    response = abs(frequency_response(gears(), "mesh", ["mesh.load"], [frequency], 0.0)[0, 0])
    # the load moves along the slope of the gap, which turns the pinion a little, in quadrature
    turning = np.mean(loads) * TEETH * ARMS[0] / FIRST * MASS
    turning /= 1.0 - MASS * (TEETH * SPEED) ** 2 / STIFFNESS
    # 0.5 % damping and the ripple of the speed, which moves the gap
    assert first == pytest.approx(amplitude * math.hypot(response, turning), rel=1e-3)
    assert min(loads) > 0.0


def test_a_torque_on_one_of_two_rotors_twists_the_shaft_as_in_the_closed_form():
    """T_s = k' T / I1 / (k' (1/I1 + 1/I2) - w2) with k' = k + i w c, the shaft's own damper."""
    rotors, frequencies = two_rotors(damping=DAMPING), np.array([5.0, 37.0, 38.0, 400.0])
    rotors.initialise({"engine": 100.0}, {"motor": 0.0}, KELVIN)
    found = frequency_response(rotors, "motor", ["shaft.torque"], frequencies, None)[:, 0]
    omega = 2.0 * math.pi * frequencies
    complex_stiffness = TORSION + 1j * omega * DAMPING
    both = complex_stiffness * (1.0 / ENGINE + 1.0 / LOAD)
    expected = complex_stiffness / ENGINE / (both - omega**2)
    np.testing.assert_allclose(abs(found), abs(expected), rtol=1e-5)  # differences over 1 nrad


@pytest.mark.parametrize("speed", [0.7, 1.0, 1.3])
def test_a_run_in_time_swings_as_the_orders_of_a_mesh(speed: float):
    """Waves of 0.2 % of the stiffness give errors of its square; flanks stay in contact."""
    train = gears(stiffness_waves=(2e-3, 0.0, 0.0, 1e-3), damping=300.0)
    expected = abs(order_response(train, "mesh", ["mesh.load"], [speed], 2)[0, :, 0])
    torques, turning = {"motor": 50.0, "road": 100.0}, speed * SPEED
    train.initialise({"pinion": turning}, torques, KELVIN)
    period, loads = 2.0 * math.pi / (TEETH * turning), []
    for _ in range(80):  # what swings at the start dies
        train.step(period, torques, KELVIN)
    for _ in range(SAMPLES):
        train.step(period / SAMPLES, torques, KELVIN)
        loads.append(train.outputs()["mesh.load"])
    found = 2.0 / SAMPLES * abs(np.fft.rfft(loads)[1:3])
    np.testing.assert_allclose(found, expected, rtol=1e-3)


def test_planets_take_an_error_that_changes_slowly_as_statics_do():
    """Far below the first mode, 9.7 Hz, forces depend neither on frequency nor on damping.

    Three equal planets have double modes, and their bodies go around with the carrier.
    """
    stage = TrainFile.named("planetary").case().start()
    outputs = ["sun_mesh_1.load", "ring_mesh_2.load"]
    slow = frequency_response(stage, "sun_mesh_1", outputs, [0.1, 0.2], 0.02)
    undamped = frequency_response(stage, "sun_mesh_1", outputs, [0.1], 0.0)[0]
    # the square of the frequency over that of the mode: 4e-4
    np.testing.assert_allclose(abs(slow), np.array([abs(undamped)] * 2), rtol=1e-3)


def test_meshes_and_outputs_that_are_not_there_are_named():
    with pytest.raises(
        ParameterError, match=r"source must be one of mesh, motor, road, got 'stage'"
    ):
        frequency_response(gears(), "stage", ["mesh.load"], [100.0])
    with pytest.raises(ParameterError, match=r"got 'mesh.none'"):
        frequency_response(gears(), "mesh", ["mesh.none"], [100.0])
