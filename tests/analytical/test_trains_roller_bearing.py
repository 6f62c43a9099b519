"""A single roller bearing in a train: against the opposed pair, a closed form, and its energy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.train.element import COORDINATES
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.roller_bearing import RollerBearing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.errors import ParameterError
from gearlube_core.oil.lubricant import Lubricant

OIL, BEARING = Lubricant.named("mohammadpour_2015"), mohammadpour_2015_axle().bearing
KELVIN, SPEED, ARM = 363.15, 200.0, 0.04
MASS, INERTIA = 5.0, 0.02


def rotor(held: tuple[str, ...], arm: float, law: str = "none") -> Train:
    """A rotor in two bearings, one mounted against the other, each at its arm."""
    body = Body(name="rotor", mass=MASS, inertia=INERTIA, polar_inertia=0.01, held=held)
    singles = [
        RollerBearing(name=name, body="rotor", bearing=BEARING, arm=place, side=side,
                      torque_loss=law)
        for name, place, side in (("first", arm, 1), ("second", -arm, -1))
    ]  # fmt: skip
    return Train([body], [Port(name="drive", body="rotor"), *singles], OIL)


@pytest.fixture(scope="module")
def tilting() -> Train:
    return rotor((), ARM, "palmgren")


def opposed_and_singles(law: str) -> tuple[Train, Train]:
    """The opposed pair, and two single ones at one place, at rest alike."""
    held = ("rx", "ry")
    body = Body(name="rotor", mass=MASS, inertia=INERTIA, polar_inertia=0.01, held=held)
    of_pair = {"palmgren": "palmgren_loaded"}.get(law, law)
    pair = OpposedBearings(name="pair", body="rotor", bearing=BEARING, torque_loss=of_pair)
    opposed = Train([body], [Port(name="drive", body="rotor"), pair], OIL)
    return opposed, rotor(held, 0.0, law)


@pytest.mark.slow
def test_two_of_them_at_one_place_are_the_opposed_pair() -> None:
    """Forces of both, and the heat of their rollers, at states of some micrometres."""
    opposed, single = opposed_and_singles("none")
    chance = np.random.default_rng(5)
    for one in (opposed, single):
        one.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
    for _ in range(10):
        moves, rates = chance.uniform(-4e-6, 4e-6, 3), chance.uniform(-1e-3, 1e-3, 3)
        cage = chance.uniform(0.0, 1.0)
        found = []
        for train in (opposed, single):
            state = train.get_state()
            cages = [i for i, name in enumerate(train.state_names) if name.endswith(".cage")]
            state[:3], state[6:9], state[cages] = moves, rates, cage
            train.set_state(state)
            at = train.rates()
            heat = at[train.state_names.index("energy.bearing_damping")]
            found.append([*at[6:9], at[11], heat])
        np.testing.assert_allclose(found[1], found[0], rtol=1e-9, atol=1e-9)


@pytest.mark.slow
def test_two_of_them_drag_as_the_opposed_pair_by_every_law() -> None:
    found = {}
    for law in ("palmgren", "skf_2013", "zhou_hoeprich_1991", "solved_films"):
        opposed, single = opposed_and_singles(law)
        for one in (opposed, single):
            one.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
            s = one.get_state()
            # moved and slowed down: what is kept must be found again
            s[:3], s[11] = (50e-6, -30e-6, 8e-6), 0.5 * SPEED
            one.set_state(s)
            one.step(1e-6, {"drive": 0.0}, KELVIN)
        torque, alone = opposed.outputs(), single.outputs()
        # the shafts move apart by round-off alone
        two = alone["first.torque"] + alone["second.torque"]
        assert two == pytest.approx(torque["pair.torque"], rel=1e-7), law
        for which in ("first", "second"):
            for one in ("roller_load_max", "roller_load_min", "film_thickness", "film_bound"):
                of_pair = torque[f"pair.{which}.{one}"]
                assert alone[f"{which}.{one}"] == pytest.approx(of_pair, rel=1e-7), (law, one)
        bound = alone["bearing_bound.power"]
        assert bound == pytest.approx(torque["bearing_bound.power"], rel=1e-7), law
        assert (bound > 0.0) == (alone["first.film_thickness"] > 0.0) == (law == "solved_films")
        found[law] = two
    assert len(set(found.values())) == len(found)


def test_bearings_apart_carry_a_tilt_with_their_arms(tilting: Train) -> None:
    """K_tilt = K_radial arm^2, so the modes stand as arm sqrt(m/I), whatever the rollers are."""
    tilting.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
    frequency, shapes = tilting.modes()
    # of the free coordinates x, y, z, rx, ry, rz
    which = [int(np.argmax(abs(shapes[:, k]))) for k in range(6)]
    radial = [f for f, at in zip(frequency, which, strict=True) if at in (0, 1)]
    tilt = [f for f, at in zip(frequency, which, strict=True) if at in (3, 4)]
    assert len(radial) == len(tilt) == 2
    assert np.array(tilt) / np.array(radial) == pytest.approx(
        ARM * math.sqrt(MASS / INERTIA), rel=1e-5
    )


@pytest.mark.parametrize(("law", "allowed"), [("none", 1e-4), ("palmgren", 1e-3)])
def test_what_swings_in_them_is_stored_or_lost(law: str, allowed: float) -> None:
    """But for the work of films, which change with the speed that a drag takes away."""
    train = rotor((), ARM, law)
    train.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
    state = train.get_state()
    rest = train.energy
    state[0], state[4] = state[0] + 3e-6, state[4] + 5e-5
    train.set_state(state)
    start = train.energy
    for _ in range(20):
        train.step(1e-4, {"drive": 0.0}, KELVIN)
    missing = train.energy + sum(train.lost.values()) - start
    assert abs(missing) < allowed * (start - rest)
    assert train.lost["bearing_damping"] > 0.0
    assert (train.lost["bearing_torque"] > 0.0) == (law != "none")


def test_the_housing_bears_what_the_shaft_does() -> None:
    """Forces and moments on both have no sum, about one point; drag and rollers on cages too."""
    rotor_body = Body(name="rotor", mass=MASS, inertia=INERTIA, polar_inertia=0.01)
    case = Body(name="case", mass=20.0, inertia=0.5, polar_inertia=0.5)
    offset = np.array([0.03, -0.04, 0.02])  # of the case's centre from the rotor's
    singles = [
        RollerBearing(name=name, body="rotor", housing="case", bearing=BEARING, arm=place,
                      side=side, torque_loss="palmgren", housing_x=-offset[0],
                      housing_y=-offset[1], housing_z=place - offset[2])
        for name, place, side in (("first", ARM, 1), ("second", -ARM, -1))
    ]  # fmt: skip
    elements = [Port(name="drive", body="rotor"), *singles]
    held, train = (
        Train([rotor_body, one], elements, OIL) for one in (replace(case, held=COORDINATES), case)
    )
    held.initialise({"rotor": SPEED}, {"drive": 0.0}, KELVIN)
    state, chance = held.get_state(), np.random.default_rng(2)
    for at, size in ((0, 4e-6), (6, 1e-3), (12, 4e-6), (18, 1e-3)):
        state[at : at + 3] = size * chance.normal(size=3)
        state[at + 3 : at + 5] = 10.0 * size * chance.normal(size=2)
    train.set_state(state)
    rates, out = train.rates(), train.outputs()
    on_rotor = rates[6:12] * [*3 * (MASS,), *2 * (INERTIA,), 0.01]
    on_case = rates[18:24] * [*3 * (20.0,), *3 * (0.5,)]
    assert np.abs(on_rotor[:3]).max() > 100.0
    np.testing.assert_allclose(on_case[:3], -on_rotor[:3], rtol=1e-12)
    moments = on_rotor[3:] + on_case[3:] + np.cross(offset, on_case[:3])
    np.testing.assert_allclose(moments[:2], 0.0, atol=1e-9)
    # about z forces stand apart by displacements, which rollers on the cages make up for
    left = moments[2]
    for one in singles:
        seat = [one.housing_x, one.housing_y, one.housing_z]
        apart = state[:3] + np.cross(state[3:6], [0.0, 0.0, one.arm])
        apart = apart - state[12:15] - np.cross(state[15:18], seat)
        left += np.cross(apart, [out[f"{one.name}.force.{c}"] for c in "xyz"])[2]
    assert abs(left) < 1e-9


def test_at_rest_each_bears_the_preload(tilting: Train) -> None:
    tilting.initialise({"rotor": 1e-3}, {"drive": 0.0}, KELVIN)
    found = tilting.outputs()
    preload = BEARING.preload_force()
    assert found["first.force.z"] == pytest.approx(-preload, rel=1e-3)
    assert found["second.force.z"] == pytest.approx(preload, rel=1e-3)


def test_what_it_cannot_be_is_said() -> None:
    with pytest.raises(ParameterError, match="side of one must be 1 or -1, got 0"):
        RollerBearing(name="one", body="rotor", bearing=BEARING, side=0)

    class Springs(Bearing):
        def parameters(self) -> tuple[float, ...]:
            return (1.0,)

    with pytest.raises(ParameterError, match="must be a tapered roller bearing"):
        RollerBearing(name="one", body="rotor", bearing=Springs())
