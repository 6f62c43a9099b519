"""Planetary sets whose carrier turns, against the equations in axes that turn with it."""

from __future__ import annotations

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.model import Train
from gearlube_core.errors import ParameterError
from tests.helpers.planetary_sets import KELVIN, LIN_PARKER_1999, flat_set

WIDE = {"backlash": 5e-3}  # planets move outwards by more than usual gaps


def turning_frequencies(train: Train, speed: float) -> Array:
    """Return natural frequencies in axes that turn with the carrier [Hz].

    The motion's matrix there is that in fixed axes, at carrier angle zero, less the turning.
    """
    names, state = list(train.continuous_names), train.continuous
    kept = [i for i, name in enumerate(names) if "energy" not in name]
    matrix, turning = np.zeros((2, len(names), len(names)))
    for j in kept:
        step = 1e-5 if "velocity" in names[j] or names[j].endswith("speed") else 1e-8
        moved = np.tile(state, (2, 1))
        moved[:, j] += (step, -step)
        ahead, behind = (train.derivative(one) for one in moved)
        matrix[:, j] = (ahead - behind) / (2.0 * step)
    for i, name in enumerate(names):
        if name.endswith(("displacement.x", "velocity.x")):
            k = names.index(f"{name[:-1]}y")
            turning[i, k], turning[k, i] = -1.0, 1.0
    found = np.linalg.eigvals((matrix - speed * turning)[np.ix_(kept, kept)])
    return np.sort(found.imag[found.imag > 1.0]) / (2.0 * np.pi)


@pytest.mark.parametrize(
    ("speed", "pairs"),
    [
        (100.0, (728.36, 757.91, 1090.66, 1114.09)),
        (500.0, (668.59, 816.20, 1042.75, 1159.86)),
        (1000.0, (592.84, 887.15, 981.05, 1214.86)),
    ],
)
def test_translational_modes_split_as_in_the_turning_frame(speed: float, pairs: tuple[float, ...]):
    """Set of Lin and Parker 1999 with their gyroscopic and centripetal terms, to 0.01 Hz."""
    train = flat_set(3, mesh=WIDE)
    loads = {"sun torque": 20.0, "ring torque": 0.0, "carrier torque": -80.0}
    train.initialise({"carrier": speed}, loads, KELVIN)
    np.testing.assert_allclose(turning_frequencies(train, speed)[:4], pairs, atol=0.006)


def test_march_of_a_turning_set_keeps_statics_and_centrifugal_force():
    """Pins carry 400 N.m and m w^2 (a + u) once dampers have stopped what the start set free."""
    radius, mass = 2.0 * 38.7e-3 / np.cos(np.radians(24.6)), 0.66
    train = flat_set(3, mesh={**WIDE, "damping": 3e4}, damper=3e4)
    loads = {"sun torque": 100.0, "ring torque": 0.0, "carrier torque": -400.0}
    train.initialise({"carrier": 100.0}, loads, KELVIN)
    for _ in range(100):
        train.step(1e-3, loads, KELVIN)
    found = train.outputs()
    assert found["carrier.angle"] == pytest.approx(10.0, rel=1e-4)
    # second-order moments of displaced forces let the carrier drift from its speed, by 1e-5
    speed = found["carrier.speed"]
    outwards = -found["p1 pin.force.x"] / 1e8
    for n in (1, 2, 3):
        of_pin = -found[f"p{n} pin.force.x"]
        assert of_pin == pytest.approx(mass * speed**2 * (radius + outwards), rel=1e-6)
        assert found[f"p{n} pin.force.y"] == pytest.approx(-400.0 / 3.0 / radius, rel=1e-4)
        for mesh in ("sun", "ring"):
            assert found[f"p{n} {mesh}.load"] == pytest.approx(100.0 / 3.0 / 38.7e-3, rel=1e-4)


def test_shipped_planetary_stage_turns_and_carries_as_its_teeth_count():
    """19, 17 and 56 teeth: the sun turns 75/19 times as fast; pins share the input torque.

    Friction takes 0.8 % of the power, which the planets' own loads bear.
    """
    case = TrainFile.named("planetary").case()
    train = case.start()
    found = train.outputs()
    w = 12.1 * np.pi / 30.0
    assert found["carrier.speed"] == pytest.approx(w, rel=1e-9)
    assert found["sun.speed"] == pytest.approx(w * 75.0 / 19.0, rel=1e-9)
    assert found["planet_1.speed"] == pytest.approx(w * (1.0 - 56.0 / 17.0), rel=1e-9)
    across = [found[f"pin_{n}.force.y"] for n in (1, 2, 3)]
    # rated power, printed with four digits; the carrier is nearly steady
    assert sum(across) * 0.863 == pytest.approx(3.946e6, rel=2e-3)
    # base radius of the sun
    load = 3.946e6 * 19.0 / 75.0 / 3.0 / (0.5 * 19 * 0.045 * np.cos(np.radians(20.0)))
    for n in (1, 2, 3):
        assert across[n - 1] == pytest.approx(sum(across) / 3.0, rel=1e-3)  # the sun floats
        assert -found[f"sun_mesh_{n}.load"] == pytest.approx(-load, rel=0.01)
        assert found[f"sun_mesh_{n}.frequency"] == pytest.approx(56.0 * 12.1 / 60.0, rel=1e-9)
    for _ in range(100):
        train.step(1e-3, case.torques, case.oil_temperature)
    after = train.outputs()
    assert after["sun.speed"] == pytest.approx(found["sun.speed"], rel=1e-3)
    assert 0.985 < after["efficiency"] < 0.997


def test_an_undamped_set_starts_turning_without_a_swing():
    """Deflections turn with the carrier from the start; what is left is w^2 u, of second order."""
    train = flat_set(3, mesh=WIDE)
    loads = {"sun torque": 100.0, "ring torque": 0.0, "carrier torque": -400.0}
    train.initialise({"carrier": 200.0}, loads, KELVIN)
    found = []
    for _ in range(50):
        train.step(2e-4, loads, KELVIN)
        outputs = train.outputs()
        found.append([outputs["p1 pin.force.x"], outputs["p1 pin.force.y"], outputs["p1 sun.load"]])
    swing = np.ptp(found, axis=0) / np.abs(np.mean(found, axis=0))
    # deflections are 2e-4 of the circle's radius, speeds a twentieth of the lowest frequency
    assert swing.max() < 2e-3


def test_a_power_split_has_two_speeds_and_shares_its_torques():
    """Sun, ring and carrier all free: Willis' speeds, torques as 1 to 3 to -4."""
    train = flat_set(3, LIN_PARKER_1999._replace(twists={}), mesh=WIDE)
    loads = {"sun torque": 100.0, "ring torque": 0.0, "carrier torque": 0.0}
    train.initialise({"carrier": 10.0, "ring": -3.0}, loads, KELVIN)
    found = train.outputs()
    # 30 w_s + 90 w_r = 120 w_c
    assert found["sun.speed"] == pytest.approx((120.0 * 10.0 + 90.0 * 3.0) / 30.0, rel=1e-9)
    for n in (1, 2, 3):
        for mesh in ("sun", "ring"):
            assert found[f"p{n} {mesh}.load"] == pytest.approx(100.0 / 3.0 / 38.7e-3, rel=1e-6)
    with pytest.raises(ParameterError, match="which leave sun, ring, p1, p2, p3 free"):
        train.initialise({"carrier": 10.0}, loads, KELVIN)
