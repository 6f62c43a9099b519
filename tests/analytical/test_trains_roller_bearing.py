"""A single roller bearing in a train: against the opposed pair, a closed form, and its energy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
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
        for train, cages in ((opposed, 1), (single, 2)):
            state = train.get_state()
            state[:3], state[6:9], state[12 : 12 + cages] = moves, rates, cage
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
