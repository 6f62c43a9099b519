"""Ball and cylindrical roller bearings in trains: rest, moments, energy, the passing of balls."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from scipy.optimize import fsolve

from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing
from gearlube_core.dynamics.train.elements.cylindrical_bearing import CylindricalBearing
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.ring_bearing import RingBearing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import ParameterError
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.shafts.section import ShaftSection
from tests.helpers.constant_force import ConstantForce
from tests.helpers.each import each

OIL, KELVIN, SPEED = Lubricant.named("mohammadpour_2015"), 333.15, 300.0
ALL = ("x", "y", "z", "rx", "ry", "rz")
FORCE = (1000.0, 300.0, 500.0)
PLACES = {"left": -0.05, "right": 0.05}
SHAFT = Body(name="shaft", mass=3.0, inertia=0.01, polar_inertia=0.004)
HELD = Body(name="case", mass=20.0, inertia=0.5, polar_inertia=0.5, held=ALL)
FREE = replace(HELD, held=())
# of the housing's centre, against that of the shaft
OFFSET = (0.03, -0.04, 0.02)


def placed(name: str) -> dict[str, object]:
    given = {"name": name, "body": "shaft", "housing": "case", "clearance": 1e-5}
    places = {"arm": PLACES[name], "housing_z": PLACES[name], "pitch_diameter": 43.5e-3}
    return given | places | {"f0": 2.0, "f1": 3e-4, "damping_time": 1e-5}


def ball(name: str, **more) -> BallBearing:
    grooves = {"inner_groove": 0.52, "outer_groove": 0.53, "axial_factor": 3.0}
    return BallBearing(**(placed(name) | grooves | {"n_balls": 7, "ball_diameter": 11.5e-3} | more))


def cylindrical(name: str, **more) -> CylindricalBearing:
    rollers = {"n_rollers": 13, "roller_diameter": 9e-3, "roller_length": 13.6e-3}
    ribs = {"flange_stiffness": 1e8, "side": 1 if name == "right" else -1}
    return CylindricalBearing(**(placed(name) | rollers | ribs | more))


# code is compiled for each list of elements
BOTH = [ball, pytest.param(cylindrical, marks=pytest.mark.slow)]


def shaft_on(
    bearings: list[RingBearing], *, case: Body = HELD, force=FORCE, arm=0.02, **more
) -> Train:
    pull = ConstantForce(name="pull", body="shaft", force=force, arm=arm)
    elements = [Port(name="drive", body="shaft"), *bearings, pull]
    return Train([SHAFT, case], elements, OIL, driver="generated", **more)


def at_rest(train: Train, torque: float = 0.0, speed: float = SPEED) -> Train:
    train.initialise({"shaft": speed}, {"drive": torque}, KELVIN)
    return train


@pytest.mark.parametrize("make", BOTH)
def test_a_shaft_rests_where_balls_and_rollers_balance_its_force(make):
    """The equations of all elements, written out here and solved by scipy, to its tolerance.

    Without dampers, which turn the force a little where balls roll through it.
    """
    train = at_rest(shaft_on([make(name, damping_time=0.0) for name in PLACES]))
    rest = [train.state(f"shaft.{one}") for one in ("x", "y", "z", "rx", "ry")]
    scale = np.array([1e-6, 1e-6, 1e-6, 1e-5, 1e-5])

    def unbalanced(v):
        x, y, z, rx, ry = v * scale
        force, moment = np.array(FORCE), np.cross([0.0, 0.0, 0.02], FORCE)
        for name, arm in PLACES.items():
            at = x + arm * ry, y - arm * rx, z, rx, ry
            one, other = LOADS[make](at, 1.0 if name == "right" else -1.0)
            force = force + one
            moment = moment + other + np.cross([0.0, 0.0, arm], one)
        return [*force, *(100.0 * moment[:2])]

    found = fsolve(unbalanced, np.array(rest) / scale * 1.03, xtol=1e-13) * scale
    assert np.abs(unbalanced(found / scale)).max() < 1e-6
    np.testing.assert_allclose(rest, found, rtol=1e-7, atol=1e-13)


def loads_of_balls(at, side):
    """ISO 16281 with c_p = 10.5491 N/m^1.5, which the deep groove bearing's own test shows."""
    x, y, z, rx, ry = at
    A, R = 0.05 * 11.5e-3, 0.5 * 43.5e-3
    force, moment = np.zeros(3), np.zeros(3)
    for i in range(7):
        c, s = math.cos(2 * math.pi * i / 7), math.sin(2 * math.pi * i / 7)
        radial, axial = A - 5e-6 + x * c + y * s, z + R * (rx * s - ry * c)
        length = math.hypot(radial, axial)
        Q = 10549106955.9 * max(0.0, length - A) ** 1.5
        on = -Q / length * np.array([radial * c, radial * s, axial])
        force += on
        moment += R * on[2] * np.array([s, -c, 0.0])
    return force, moment


def loads_of_rollers(at, side):
    """ISO 16281 with 31 laminae, and ribs of 1e8 N/m without play."""
    x, y, z, rx, ry = at
    t = (np.arange(31) + 0.5) / 31 * 13.6e-3 - 6.8e-3
    gap = 5e-6 + 2 * 0.00035 * 9e-3 * np.log(1 / (1 - (2 * t / 13.6e-3) ** 2))
    force, moment = np.array([0.0, 0.0, -side * 1e8 * max(0.0, side * z)]), np.zeros(3)
    for i in range(13):
        c, s = math.cos(2 * math.pi * i / 13), math.sin(2 * math.pi * i / 13)
        d = np.maximum(0.0, x * c + y * s + t * (ry * c - rx * s) - gap)
        q = 35948 / 31 * 13.6 ** (8 / 9) * (1e3 * d) ** (10 / 9)
        force -= np.sum(q) * np.array([c, s, 0.0])
        moment += np.sum(q * t) * np.array([s, -c, 0.0])
    return force, moment


LOADS = {ball: loads_of_balls, cylindrical: loads_of_rollers}


def test_two_preloaded_angular_contacts_share_an_axial_force():
    """Offsets of 12 um press both; the sum of both closed forms of Q(z) balances the force."""
    pair = [
        ball(name, contact_angle=math.radians(25.0), side=side, offset=12e-6, clearance=0.0)
        for name, side in (("left", -1), ("right", 1))
    ]
    train = at_rest(shaft_on(pair, force=(0.0, 0.0, 400.0)))
    z = train.state("shaft.z")
    rings = pair[0].rings()[0]
    A, a0 = 0.05 * 11.5e-3, math.radians(25.0)

    def along(at):  # force of one bearing that is pressed by `at` [m]
        axial = A * math.sin(a0) + at
        length = math.hypot(A * math.cos(a0), axial)
        return 7.0 * rings.stiffness * (length - A) ** 1.5 * axial / length

    assert along(12e-6 + z) - along(12e-6 - z) == pytest.approx(400.0, rel=1e-9)
    out = train.outputs()
    assert out["left.loaded"] == out["right.loaded"] == 7.0
    assert out["right.contact_angle_max"] > a0
    assert -out["left.contact_angle_min"] > a0


def wrench(train: Train, body: int):
    """Force and moment on a body about its centre, from its accelerations."""
    rates = train.rates()[12 * body + 6 : 12 * body + 12]
    one = train.bodies[body]
    return rates * np.array([*3 * (one.mass,), *2 * (one.inertia,), one.polar_inertia])


@pytest.mark.slow
@pytest.mark.parametrize("make", BOTH)
def test_forces_on_body_and_housing_have_no_sum_and_no_moment(make):
    """About one point, with the displacements: elements on the cage, drag and dampers included."""
    given = {"housing_x": -OFFSET[0], "housing_y": -OFFSET[1]}
    bearings = [make(name, housing_z=PLACES[name] - OFFSET[2], **given) for name in PLACES]
    train = at_rest(shaft_on(bearings))
    free = shaft_on(bearings, case=FREE, force=(0.0, 0.0, 0.0))
    state = train.get_state()
    chance = np.random.default_rng(5)
    for _ in range(8):
        for at, size in ((0, 8e-6), (12, 8e-6), (6, 1e-3), (18, 1e-3)):
            state[at : at + 3] = size * chance.normal(size=3)
            state[at + 3 : at + 6] = 10.0 * size * chance.normal(size=3)
        state[11], state[23] = SPEED, -12.0
        state[24:26] = chance.uniform(0.0, 6.0, 2)  # cages
        free.set_state(state)
        on_shaft, on_case = wrench(free, 0), wrench(free, 1)
        cages = [one.rings()[0].cage_ratio for one in bearings]
        wanted = [one * SPEED + (1.0 - one) * state[23] for one in cages]
        np.testing.assert_allclose(free.rates()[24:26], wanted, rtol=1e-12)
        np.testing.assert_allclose(on_case[:3], -on_shaft[:3], rtol=1e-12, atol=1e-9)
        moments = on_shaft[3:] + on_case[3:] + np.cross(OFFSET, on_case[:3])
        assert np.abs(on_shaft[:3]).max() > 100.0
        np.testing.assert_allclose(moments[:2], 0.0, atol=1e-9)
        # about z the forces stand apart by displacements: to second order nothing is left
        left, out = moments[2], free.outputs()
        for name, arm in PLACES.items():
            seat = np.array([-OFFSET[0], -OFFSET[1], arm - OFFSET[2]])
            at = state[:3] + np.cross(state[3:6], [0.0, 0.0, arm])
            apart = at - state[12:15] - np.cross(state[15:18], seat)
            tilt = state[3:6] - state[15:18]
            force = np.array([out[f"{name}.force.{c}"] for c in "xyz"])
            moment = np.array([*(out[f"{name}.moment.{c}"] for c in "xy"), 0.0])
            left += np.cross(apart, force)[2] + np.cross(tilt, moment)[2]
        assert abs(left) < 1e-9


@pytest.mark.parametrize("make", BOTH)
def test_energy_of_a_march_is_kept(make):
    """Work, stored and lost energy of a shaft that is thrown about in its clearance, to 1e-6."""
    bearings = [make(name) for name in PLACES]
    state = at_rest(shaft_on(bearings)).get_state()
    state[6:8] = 5e-3, -8e-3  # m/s
    state[23] = 20.0  # rad/s of the case
    train = shaft_on(bearings, case=FREE)
    train.set_state(state)
    begun = train.energy - train.work + sum(train.lost.values())
    for _ in range(20):
        train.step(1e-3, {"drive": -2.0}, KELVIN)
    left = train.energy - train.work + sum(train.lost.values()) - begun
    passed = abs(train.work) + sum(abs(one) for one in train.lost.values())
    assert train.lost["bearing_damping"] > 1e-5
    assert abs(left) < 1e-6 * passed


@pytest.mark.slow
@each(
    "force, clearance, make, damping",
    [
        *product([1e-2, 1.0, 30.0], [1e-5, 5e-5], [ball], [0.0]),
        # the damper of a roller that enters the load is many times the force
        *product([1e-2, 0.3, 30.0], [1e-5, 5e-5], [cylindrical], [0.0, 1e-5]),
    ],
)
def test_a_light_shaft_rests_at_the_edge_of_its_clearance(force, clearance, make, damping):
    """A force across, off the middle: both bearings carry their share, to the search's 1e-6 N."""
    bearings = [make(name, clearance=clearance, damping_time=damping) for name in PLACES]
    out = at_rest(shaft_on(bearings, force=(0.6 * force, 0.8 * force, 0.0))).outputs()
    for name, share in (("left", 0.3), ("right", 0.7)):  # 20 mm off, bearings 100 mm apart
        found = math.hypot(out[f"{name}.force.x"], out[f"{name}.force.y"])
        # balls that touch at the edge carry a moment of the tilt, 1e-4 of the force's
        assert found == pytest.approx(share * force, rel=1e-3, abs=2e-6)


@pytest.mark.slow
def test_nodes_of_a_shaft_that_bends_rest_in_bearings_on_the_ground():
    """Two bearings share a force as its lever arms do; the shaft bends between them as a beam."""
    tube = ShaftSection(start=0.0, end=0.2, outer_diameter=0.02)
    nodes = {"left": 0.0, "middle": 0.1, "right": 0.2}
    rotor = Shaft(name="rotor", sections=[tube], nodes=nodes)
    given = {"housing": "ground", "arm": 0.0, "housing_z": 0.0, "damping_time": 0.0}
    bearings = [ball(one, body=f"rotor.{one}", **given) for one in PLACES]
    pull = ConstantForce(name="pull", body="rotor.middle", force=(400.0, 0.0, 0.0))
    elements = [Port(name="drive", body="rotor.left"), *bearings, pull]
    train = Train([rotor], elements, OIL, driver="generated")
    train.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
    out = train.outputs()
    for name in PLACES:
        assert out[f"{name}.force.x"] == pytest.approx(-200.0, rel=1e-6)
    bent = out["rotor.middle.displacement.x"] - out["rotor.left.displacement.x"]
    inertia = math.pi * 0.02**4 / 64.0
    # F L^3/(48 E I) of a slender beam; shear adds 2 %, bearings that resist a tilt take off as much
    assert bent == pytest.approx(400.0 * 0.2**3 / (48.0 * 2.06e11 * inertia), rel=0.05)


@pytest.mark.slow
def test_one_bearing_alone_carries_a_moment():
    """A body that is held by a single bearing tilts through its clearance."""
    train = at_rest(shaft_on([ball("left", arm=0.0, housing_z=0.0)], force=(200.0, 0.0, 50.0)))
    out = train.outputs()
    assert out["left.moment.y"] == pytest.approx(-200.0 * 0.02, rel=1e-5)
    assert out["left.tilt"] > 1e-3


def test_a_shaft_that_rests_without_load_may_be_thrown_about():
    """Steps are as short as loaded balls ask for: balls that bounce keep its energy to 1e-3."""
    train = at_rest(
        shaft_on([ball(name, f0=0.0, f1=0.0) for name in PLACES], force=(0.0, 0.0, 0.0))
    )
    state = train.get_state()
    state[6:9] = 0.03, -0.02, 0.01  # m/s
    train.set_state(state)
    begun = train.energy
    thrown = 0.5 * SHAFT.mass * (0.03**2 + 0.02**2 + 0.01**2)
    for _ in range(20):
        train.step(1e-3, {"drive": 0.0}, KELVIN)
    lost = train.lost["bearing_damping"]
    assert lost > 0.1 * thrown
    assert train.energy + lost == pytest.approx(begun, abs=1e-3 * thrown)


def test_drag_acts_between_body_and_housing_as_palmgren_has_it():
    """M0 = 1e-7 f0 (nu n)^(2/3) dm^3, M1 = f1 max(Y F_a, F_r) dm of each bearing."""
    train = at_rest(shaft_on([ball(name) for name in PLACES]))
    out, nu = train.outputs(), OIL.state(KELVIN).nu
    for name in PLACES:
        f_x, f_y, f_z = (out[f"{name}.force.{c}"] for c in "xyz")
        viscous = 1e-10 * 2.0 * (1e6 * nu * SPEED * 30 / math.pi) ** (2 / 3) * 43.5**3
        loaded = 3e-4 * max(3.0 * abs(f_z), math.hypot(f_x, f_y)) * 43.5e-3
        wanted = (viscous + loaded) * 300 / math.hypot(300, 1)  # the factor through rest
        # it takes loads without those of the dampers, which are 1e-6 of them
        assert out[f"{name}.torque"] == pytest.approx(wanted, rel=1e-6)


@pytest.mark.slow
def test_stiffness_varies_as_balls_pass():
    """A radial load rests between two balls lower than on one; the period is one spacing."""
    fixed = replace(SHAFT, held=("z", "rx", "ry"))
    deflections = []
    for share in (0.0, 0.5, 1.0):
        pull = ConstantForce(name="pull", body="shaft", force=(1000.0, 0.0, 0.0))
        elements = [Port(name="drive", body="shaft"), *(ball(one) for one in PLACES), pull]
        train = at_rest(Train([fixed, HELD], elements, OIL, driver="generated"))
        state = train.get_state()
        state[24:26] = share * 2.0 * math.pi / 7.0
        state[11] = 0.0  # the cage stands
        train.set_state(state)
        for _ in range(60):  # dampers bring it to rest
            train.step(1e-3, {"drive": 0.0}, KELVIN)
        deflections.append(train.state("shaft.x"))
    assert deflections[2] == pytest.approx(deflections[0], rel=1e-6)
    assert abs(deflections[1] - deflections[0]) > 1e-3 * deflections[0]


REFUSED = (
    (lambda: ball("left", n_balls=2), "n_balls must be within 3 to 40"),
    (lambda: ball("left", n_balls=7.5), "whole number"),
    (lambda: ball("left", n_balls=20), "at most 11"),
    (lambda: ball("left", ball_diameter=0.05), "pitch diameter"),
    (lambda: ball("left", side=0), "side of left must be 1 or -1"),
    (lambda: ball("left", clearance=9e-4, inner_groove=0.505, outer_groove=0.505), "clearance"),
    (lambda: ball("left", tilt_arm="here"), "tilt_arm must be one of"),
    (lambda: ball("left", f0=-1.0), "f0 must be within"),
    (lambda: cylindrical("left", laminae=2.5), "laminae of left must be a whole number"),
    (lambda: cylindrical("left", damping_time=math.nan), "damping_time must be finite"),
    (lambda: shaft_on([ball("left", housing="shaft")]), "2 different bodies"),
    (lambda: shaft_on([ball("left", housing="gearbox")]), "'gearbox', which is not among"),
)


@each("make, words", REFUSED)
def test_what_is_no_bearing_is_refused(make, words):
    with pytest.raises(ParameterError, match=words):
        make()


def test_pressure_has_a_range():
    train = at_rest(shaft_on([ball(name) for name in PLACES], force=(3e5, 0.0, 0.0)))
    assert "left.pressure" in train.exceeded()
    assert not at_rest(shaft_on([ball(name) for name in PLACES])).exceeded()


@each("number", [math.nan, math.inf, -1.0, 0.0, 2.0, 6.5, 41.0, 1e9])
def test_elements_that_cannot_be_counted_are_refused(number):
    """As of a file of a native FMU, see `Kernels.check`."""
    numbers = ball("left").numbers()
    memory, at = np.zeros(2), (0, 12, 24, 25, 26)
    state = np.zeros(30)
    given = at, memory, state, OIL.state(KELVIN), 0
    assert numbers.check(*given) == 1.0
    assert replace_count(numbers, number).check(*given) == 0.0
    assert numbers.check(at, np.array([0.0, math.nan]), *given[2:]) == 0.0
    assert numbers.check(at, np.zeros(1), *given[2:]) == 0.0


def replace_count(numbers, count):
    return numbers._replace(rings=numbers.rings._replace(n_elements=count))
