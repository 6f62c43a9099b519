"""Exponential steps of trains, against closed forms and against RK4 with far shorter steps."""

from __future__ import annotations

import tomllib
from functools import cache

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import ParameterError
from gearlube_core.shafts.section import ShaftDisc, ShaftSection
from tests.helpers.frame_model import box_frame, reduced
from tests.helpers.small_trains import OIL

KELVIN = 333.15
LOADS = ("stage_1.load", "stage_2.load")


@cache
def axle(integration: str) -> tuple[Train, dict[str, float], np.ndarray]:
    """Return the shipped e-axle on elastic shafts, its torques and its state at rest, turning."""
    data = tomllib.loads(TrainFile.shipped_text("e_axle_elastic"))
    case = TrainFile.from_data(data | {"integration": integration}, "file").case()
    train = case.start()
    return train, dict(case.torques), train.get_state()


def loads(integration: str, h: float, duration: float, per_step: float = 1.0) -> np.ndarray:
    """Return the loads of both meshes every 0.5 ms, of communication steps of `h` [s]."""
    train, torques, state = axle(integration)
    state = state.copy()
    state[-1] *= per_step  # RK4 steps a second
    train.set_state(state)
    found = []
    for k in range(round(duration / h)):
        train.step(h, torques, KELVIN)
        if (k + 1) % round(5e-4 / h) == 0:
            outputs = train.outputs()
            found.append([outputs[one] for one in LOADS])
    return np.array(found)


def test_error_falls_with_the_fourth_power_of_the_step():
    """One step each communication step, flanks in contact, both meshes with two waves."""
    reference = loads("rk4", 5e-4, 0.01, per_step=8.0)
    errors = [np.abs(loads("exponential", h, 0.01) - reference).max() for h in (25e-6, 12.5e-6)]
    order = np.log2(errors[0] / errors[1])
    assert 3.5 < order < 4.5  # higher modes are not yet in their asymptotic range


def test_short_steps_give_what_short_rk4_steps_give():
    reference = loads("rk4", 5e-4, 5e-3, per_step=8.0)
    found = loads("exponential", 5e-6, 5e-3)
    # RK4 at 1 us is right to 1e-7 of the swing, ETDRK4 at 5 us by its order to 4e-6
    assert np.abs(found - reference).max() < 1e-5 * reference.std()


def test_energies_balance_over_long_steps():
    train, torques, state = axle("exponential")
    train.set_state(state)
    stored, work, lost = train.energy, train.work, sum(train.lost.values())
    driven = train.outputs()["energy.motor.work"]
    for _ in range(100):
        train.step(1e-3, torques, KELVIN)
    through = train.outputs()["energy.motor.work"] - driven
    put_in, heat = train.work - work, sum(train.lost.values()) - lost
    assert heat > 1e-3 * through  # there is something to balance
    assert train.energy - stored == pytest.approx(put_in - heat, abs=1e-6 * through)


def test_losses_are_those_of_short_steps():
    found = {}
    for integration in ("rk4", "exponential"):
        train, torques, state = axle(integration)
        train.set_state(state)
        for _ in range(40):
            train.step(1e-3, torques, KELVIN)
        found[integration] = train.lost
    for name, lost in found["rk4"].items():
        # dampers of the mesh see rates of the stages, which are of lower order
        assert found["exponential"][name] == pytest.approx(
            lost, rel=0.1 if "mesh" in name else 5e-3
        )


def swing_apart(trains: dict[str, Train], torques: dict[str, float], h: float, n: int) -> float:
    """Return how far rates differ after RK4 and after exponential steps, over their largest one."""
    found = {}
    for integration, train in trains.items():
        for _ in range(n):
            train.step(h, torques, KELVIN)
        names = train.state_names
        rates = [i for i, one in enumerate(names) if one.endswith((".x.rate", ".y.rate"))]
        found[integration] = train.get_state()[rates]
    return float(np.abs(found["exponential"] - found["rk4"]).max() / np.abs(found["rk4"]).max())


@pytest.mark.slow
def test_a_shaft_in_a_housing_moves_as_by_rk4():
    """All is linear but gyroscopic moments and coupling dampers: long steps are near to exact."""
    tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04)
    shaft = Shaft(name="shaft", sections=(tube,), nodes={"low": 0.0, "high": 0.25})
    case = Housing(name="case", model=reduced(box_frame(), modes=4), highest_frequency=3e3)
    stiff = {
        "K_xx": 1e8,
        "K_yy": 1e8,
        "K_zz": 5e7,
        "K_ax": 1e4,
        "K_ay": 1e4,
        "c_x": 200.0,
        "c_y": 200.0,
        "c_z": 100.0,
    }
    soft = {"K_xx": 1e7, "K_yy": 1e7, "K_zz": 1e7, "K_ax": 1e5, "K_ay": 1e5, "c_x": 100.0}
    joints = [
        Joint(name=f"{what} {one}", first=first, second=second, **springs)
        for one in ("low", "high")
        for what, first, second, springs in (
            ("seat", f"shaft.{one}", f"case.a_{one}", stiff),
            ("mount", f"case.a_{one}", "ground", soft),
        )
    ]
    trains: dict[str, Train] = {}
    for integration in ("rk4", "exponential"):
        port = Port(name="motor", body="shaft")
        train = Train([case, shaft], [*joints, port], OIL, integration=integration)
        train.initialise({"shaft": 300.0}, {"motor": 0.0}, KELVIN)
        state = train.get_state()
        state[train.state_names.index("shaft.x.rate")] = 1e-2  # a blow
        if integration == "rk4":
            state[-1] *= 8.0
        train.set_state(state)
        trains[integration] = train
    # 7e-4 at 40 us, of order 4 in the coupling dampers alone
    assert swing_apart(trains, {"motor": 3.0}, 1e-3, 20) < 2e-3


def test_ripple_play_and_a_differential_move_as_by_rk4():
    trains = {}
    for integration in ("rk4", "exponential"):
        data = tomllib.loads(TrainFile.shipped_text("e_axle_full"))
        case = TrainFile.from_data(data | {"integration": integration}, "file").case()
        trains[integration] = case.start()
    # 40 us are 5 steps in a period of the motor's highest order
    assert swing_apart(trains, dict(case.torques), 1e-3, 10) < 1e-2


def test_a_state_goes_on_in_another_train_to_the_bit():
    train, torques, state = axle("exponential")
    train.set_state(state)
    for _ in range(3):
        train.step(1e-3, torques, KELVIN)
    data = tomllib.loads(TrainFile.shipped_text("e_axle_elastic"))
    other = TrainFile.from_data(data | {"integration": "exponential"}, "file").case().train
    other.set_state(train.get_state())
    for one in (train, other):
        one.step(1e-3, torques, KELVIN)
    np.testing.assert_array_equal(train.get_state(), other.get_state())


def test_rounded_times_of_a_host_change_nothing():
    """Else 25 steps a ms were 26, of another length each time."""
    train, torques, state = axle("exponential")
    found = []
    for longer in (0.0, 4e-13):
        train.set_state(state)
        for _ in range(5):
            train.step(1e-3 * (1.0 + longer), torques, KELVIN)
        found.append([train.outputs()[one] for one in LOADS])
    np.testing.assert_allclose(found[1], found[0], rtol=1e-11)


def test_a_rotor_whirls_at_its_frequencies_with_far_higher_modes():
    """A disc overhung on a rigid, short shaft that tilts on springs, with modes above 50 kHz.

    Backward and forward whirl: w^2 -+ (I_p/I_d) speed w - k/I_d = 0 of tilting alone.
    """
    shaft = Shaft(
        name="rotor",
        sections=[ShaftSection(start=-0.02, end=0.02, outer_diameter=0.04)],
        nodes={"middle": 0.0},
        discs=[ShaftDisc(position=0.0, mass=5.0, inertia=0.022, polar_inertia=0.04)],
        highest_frequency=2e5,
        damping_ratio=0.0,
    )
    held = SpringSupport(
        name="springs", body="rotor", K_xx=1e8, K_yy=1e8, K_zz=1e8, K_ax=2e5, K_ay=2e5
    )
    train = Train(
        [shaft],
        [held, Port(name="motor", body="rotor")],
        OIL,
        integration="exponential",
    )
    train.initialise({"rotor": 1000.0}, {"motor": 0.0}, KELVIN)
    assert train.modes()[0][-1] > 5e4
    state = train.get_state()
    state[list(train.state_names).index("rotor.rx.rate")] = 1e-3
    train.set_state(state)
    place, tilts = list(train.state_names).index("rotor.rx"), []
    h, n = 25e-6, 40_000
    for _ in range(n):
        train.step(h, {"motor": 0.0}, KELVIN)
        tilts.append(train._state[place])
    spectrum = np.abs(np.fft.rfft(np.array(tilts) * np.hanning(n)))
    frequencies = np.fft.rfftfreq(n, h)
    members = train.bodies[0]
    i_d, i_p = members.inertia, members.polar_inertia
    half = 0.5 * i_p / i_d * 1000.0
    for sign in (-1.0, 1.0):
        expected = (sign * half + np.sqrt(half**2 + 2e5 / i_d)) / (2.0 * np.pi)
        near = np.abs(frequencies - expected) < 20.0
        found = frequencies[near][spectrum[near].argmax()]
        assert found == pytest.approx(expected, abs=1.0)  # the record of 1 s resolves 1 Hz


def test_bodies_on_carriers_are_refused():
    data = tomllib.loads(TrainFile.shipped_text("planetary"))
    with pytest.raises(ParameterError, match="integration must be automatic or rk4"):
        TrainFile.from_data(data | {"integration": "exponential"}, "file")
