"""Meshes between any two bodies: conservation, contact across the face, both flanks, orbits."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from tests.helpers.planetary_sets import FIXED, KELVIN, OIL, helical_set

GROUND = Body(name="ground", mass=1.0, inertia=1.0, polar_inertia=1.0, held=FIXED)
WAVES = (0.12, 0.05, 0.0, -0.04)
ROWS = tuple(
    tuple(1e-6 * (1.0 + math.sin(k + 0.9 * i) + 0.3 * i) for k in range(5)) for i in range(3)
)
ROUGH = {"stations": 3, "stiffness_waves": WAVES, "gap": ROWS, "damping": 400.0, "friction": 0.06,
         "keyed_angle": 0.02}  # fmt: skip
SET_LOADS = {"sun torque": 100.0, "ring torque": 0.0, "carrier torque": 0.0}


def pair(**given: Any) -> Train:
    """Return two free gears, the second of which carries the load."""
    fields = {"teeth_1": 20, "teeth_2": 31, "normal_module": 3e-3, "face_width": 0.03,
              "stiffness": 4e8, "backlash": 1e-4, "right_hand": True} | given  # fmt: skip
    bodies = [
        GROUND,
        Body(name="pinion", mass=1.0, inertia=1e-3, polar_inertia=2e-3),
        Body(name="wheel", mass=3.0, inertia=4e-3, polar_inertia=7e-3),
    ]
    parts = [
        GearMesh(name="mesh", first="pinion", second="wheel", **fields),
        Port(name="load", body="wheel"),
        *(
            SpringSupport(name=f"{one} bearing", body=one, K_xx=2e8, K_yy=2e8, K_zz=1e8, K_ax=2e5,
                          K_ay=2e5)
            for one in ("pinion", "wheel")
        ),
    ]  # fmt: skip
    return Train(bodies, parts, OIL)


def shaken(train: Train, start: tuple[str, dict[str, float]], seed: int = 3) -> Train:
    """Return a train at a random state about its rest, turning fast enough for friction."""
    train.initialise({start[0]: 30.0}, start[1], KELVIN)
    chance, state = np.random.default_rng(seed), train.get_state()
    moved = [i for i, name in enumerate(train.state_names) if "energy" not in name]
    free = {name for body in train.bodies for name in body_states(body)}
    for i in moved:
        name = train.state_names[i]
        if name in free or "rotation" in name or "twist" in name:
            size = 1e-2 if name.endswith("rate") else 3e-6
            state[i] += 0.4 if name.endswith(".rz") else size * chance.uniform(-1.0, 1.0)
    train.set_state(state)
    return train


def body_states(body: Body) -> list[str]:
    free = [one for one in ("x", "y", "z", "rx", "ry", "rz") if one not in body.held]
    return [f"{body.name}.{one}{end}" for one in free for end in ("", ".rate")]


def along_flow(train: Train, value: Callable[[Train], float], h: float = 1e-9) -> float:
    """Return d/dt of a number of the state, by central differences along the motion."""
    rates, state = train.rates(), train.get_state()
    found = []
    for sign in (1.0, -1.0):
        moved = state.copy()
        moved[: rates.size] += sign * h * rates
        train.set_state(moved)
        found.append(value(train))
    train.set_state(state)
    return (found[0] - found[1]) / (2.0 * h)


def losses(train: Train) -> float:
    rates = train.rates()
    names = train.state_names
    return sum(rates[names.index(f"energy.{one}")] for one in train.lost)


def put_in(train: Train) -> float:
    rates = train.rates()
    return sum(rates[at] for at in train.assembly.works.values())


KINDS: dict[str, dict[str, Any]] = {
    "helical": {"helix_angle": 0.4, "azimuth": 2.0, "arm_1": 0.02, "arm_2": -0.05},
    "ring": {"teeth_2": 61, "helix_angle": 0.3, "ring": True, "azimuth": -1.0},
    "backward": {"helix_angle": 0.2, "drives_forward": False},
    "bevel": {
        "teeth_1": 15, "teeth_2": 30, "helix_angle": 0.6, "cone_angle_1": math.atan(0.5),
        "cone_angle_2": math.atan(2.0), "azimuth": 0.7, "azimuth_2": 1.9,
    },
    "hypoid": {
        "teeth_1": 9, "teeth_2": 34, "helix_angle": 0.85, "helix_angle_2": 0.4,
        "cone_angle_1": 0.3, "cone_angle_2": 1.1, "stations": 1, "gap": ROWS[:1],
    },
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_energy_of_a_pair_goes_into_heat_alone(kind: str):
    """Stiffness and gaps that change, friction, damping, tilted gears, at a random state."""
    sense = -1.0 if kind == "backward" else 1.0
    load = {"load": sense * (-900.0 if kind == "ring" else 900.0)}
    train = shaken(pair(**(ROUGH | KINDS[kind])), ("pinion", load))
    balance = along_flow(train, lambda one: one.energy) + losses(train) - put_in(train)
    assert losses(train) > 10.0
    # differences of some 100 J over 1e-9 s, to the last digits of the energy
    assert abs(balance) < 2e-5 * max(losses(train), abs(put_in(train)))


def of_set(**more: Any) -> Train:
    return shaken(helical_set(3, mesh=ROUGH | more), ("carrier", SET_LOADS))


def test_energy_of_a_planetary_set_goes_into_heat_alone():
    """The carrier turns, so that pins and lines of action turn with it."""
    train = of_set()
    balance = along_flow(train, lambda one: one.energy) + losses(train) - put_in(train)
    assert losses(train) > 10.0
    assert abs(balance) < 2e-5 * max(losses(train), abs(put_in(train)))


def turning_momentum(train: Train) -> float:
    """Return the angular momentum about the axis of the sun [kg m2/s], from places in space.

    Tilts count as vectors that turn with the rest, which gives them a share of second order.
    """
    total, angle, w = 0.0, train.state("carrier.rz"), train.state("carrier.rz.rate")
    orbits = {one.body: one for one in train.elements if isinstance(one, Orbit)}
    for body in train.bodies[1:]:

        def plane(one: str, other: str, body: Body = body) -> complex:
            return complex(train.state(f"{body.name}.{one}"), train.state(f"{body.name}.{other}"))

        place, speed = plane("x", "y"), plane("x.rate", "y.rate")
        if body.name in orbits:
            one = orbits[body.name]
            centre = cmath.rect(one.radius, one.azimuth + angle)
            place, speed = place + centre, speed + 1j * w * centre
        total += body.polar_inertia * train.state(f"{body.name}.rz.rate")
        total += body.mass * (place.conjugate() * speed).imag
        total += body.inertia * (plane("rx", "ry").conjugate() * plane("rx.rate", "ry.rate")).imag
    return total


def test_angular_momentum_of_a_planetary_set():
    """Ports and the ring's support alone change it: bearings are round and hold at the axis."""
    train = of_set()
    outside = sum(SET_LOADS.values()) - train.outputs()["ring twist.torque"]
    # differences of some kg m2/s over 2e-8 s, to the last digits
    assert along_flow(train, turning_momentum, h=1e-8) == pytest.approx(outside, rel=1e-6)
