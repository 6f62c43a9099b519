"""Meshes between any two bodies: conservation, contact across the face, both flanks, orbits."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model.pair import helical_pair
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.gear_geometry import fitting_angle, split_delay
from gearlube_core.dynamics.train.gear_pair import GearPair
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.iso_6336_stiffness import iso_stiffness
from gearlube_core.helical_geometry.pair import HelicalPair
from tests.helpers.each import each
from tests.helpers.planetary_sets import KELVIN, OIL, helical_set
from tests.helpers.small_trains import PAIR

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
    for body in train.bodies:

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


@pytest.mark.parametrize("extra", [{}, {"friction": 0.0, "damping": 0.0}])
def test_energy_balance_of_a_march_whose_flanks_part(extra: dict[str, float]):
    """Gaps of 20 um under a light load: no contact in most of the time, at the usual steps."""
    rows = tuple(tuple(8.0 * one for one in row) for row in ROWS)
    train = pair(**(ROUGH | {"helix_angle": 0.3, "gap": rows} | extra))
    load = {"load": 3.0}
    train.initialise({"pinion": 60.0}, load, KELVIN)
    before, apart = train.energy, 0.0
    for _ in range(500):
        train.step(1e-4, load, KELVIN)
        apart += train.outputs()["mesh.separated"]
    assert 250 < apart < 500
    missing = train.work - sum(train.lost.values()) - (train.energy - before)
    assert abs(missing) < 1e-6 * abs(train.work)


def test_tilt_moves_the_load_along_the_face():
    """Linear load along the face: F_i = k/n (d + M z_i) at a tilt of the pinion alone."""
    train = pair(stations=9, azimuth=0.5)
    train.initialise({"pinion": 10.0}, {"load": 900.0}, KELVIN)
    flat, state = train.outputs(), train.get_state()
    assert flat["mesh.share.low"] == pytest.approx(1.0, abs=1e-9)
    tilt, normal = 4e-5, 0.5 + math.pi / 2.0 - math.radians(20.0)
    for name, share in (("rx", -math.sin(normal)), ("ry", math.cos(normal))):
        state[train.state_names.index(f"pinion.{name}")] += share * tilt
    train.set_state(state)
    found = train.outputs()
    assert found["mesh.tilt"] == pytest.approx(tilt, rel=1e-9)
    end = tilt * 4.0 / 9.0 * 0.03 * 4e8 / flat["mesh.load"]  # of the outer station's place
    assert found["mesh.share.high"] == pytest.approx(1.0 + end, rel=1e-9)
    assert found["mesh.share.low"] == pytest.approx(1.0 - end, rel=1e-9)


def test_coast_flanks_push_along_their_own_normal_across_the_backlash():
    fields = {"helix_angle": 0.4, "backlash": 8e-5}
    found = {}
    for torque in (90.0, -90.0):
        train = pair(**fields)
        train.initialise({"pinion": 10.0}, {"load": torque}, KELVIN)
        found[torque] = train.outputs()
    drive, coast = found[90.0], found[-90.0]
    assert (drive["mesh.coast_contact"], coast["mesh.coast_contact"]) == (0.0, 1.0)
    assert coast["mesh.load"] == pytest.approx(-drive["mesh.load"], rel=1e-9)
    # the azimuth is 0: tangential and axial force turn around, the one that parts the gears stays
    for along, sign in (("x", 1.0), ("y", -1.0), ("z", -1.0)):
        one = coast[f"mesh.force.{along}"]
        assert one == pytest.approx(sign * drive[f"mesh.force.{along}"], rel=1e-9)
    # both rest apart by the whole gap, and pressed by the load on either side
    pressed = 2.0 * drive["mesh.load"] / 4e8
    assert drive["mesh.dte"] - coast["mesh.dte"] > 8e-5 + 0.99 * pressed


def relative_stiffness(train: Train, mesh: str, turned: float) -> float:
    """Return the stiffness with gear 1 turned by an angle [rad], over its mean."""
    state, body = train.get_state(), next(one for one in train.elements if one.name == mesh).first
    moved = state.copy()
    moved[train.state_names.index(f"{body}.rz")] += turned
    train.set_state(moved)
    found = train.outputs()[f"{mesh}.stiffness"]
    train.set_state(state)
    return found / next(one for one in train.elements if one.name == mesh).stiffness - 1.0


def test_meshes_of_a_set_follow_each_other_as_their_azimuths_say():
    """Sun meshes by z_s psi/2 pi, and ring meshes of planets whose teeth fit the sun, likewise."""
    wave = 0.1
    train = helical_set(3, mesh={"stiffness_waves": (wave, 0.0)}, keyed=True)
    train.initialise({"carrier": 1.0}, SET_LOADS, KELVIN)
    for n in range(3):
        azimuth = 2.0 * math.pi * n / 3.0
        # the flank of the sun's tooth at the start, half a tooth ahead, and its way to the planet
        cycle = 0.25 - 30 * azimuth / (2.0 * math.pi)
        found = relative_stiffness(train, f"p{n + 1} sun", 0.0)
        assert found == pytest.approx(wave * math.cos(2.0 * math.pi * cycle), abs=1e-9)
        # a gear that turns by the delay has the next mesh where the first one was
        delay = split_delay(30, 0.0, azimuth)
        turned = relative_stiffness(train, f"p{n + 1} sun", 2.0 * math.pi * delay / 30)
        assert turned == pytest.approx(relative_stiffness(train, "p1 sun", 0.0), abs=1e-9)
        # even planets: ring meshes half a cycle after those of the sun, turning about -z
        ring = relative_stiffness(train, f"p{n + 1} ring", 0.0)
        planet = fitting_angle(30, 30, 0.0, azimuth)
        cycle = -30 * (planet - azimuth) / (2.0 * math.pi) + 0.25
        assert ring == pytest.approx(wave * math.cos(2.0 * math.pi * cycle), abs=1e-9)


def listed(change: str) -> Train:
    """Return a helical set with one thing wrong."""
    train = helical_set(3)
    parts = {one.name: one for one in train.elements}
    bodies = {one.name: one for one in train.bodies}
    name, field, value = {
        "place": ("p2 orbit", "radius", 0.0640),
        "azimuth": ("p2 pin", "azimuth", 2.0),
        "module": ("p2 ring", "normal_module", 2.5e-3),
        "hand": ("p2 sun", "right_hand", False),
        "mass": ("p2 orbit", "mass", 0.8),
        "teeth": ("p2 sun", "teeth_1", 31),
        "held": ("p2", "held", ("y",)),
    }[change]
    if name in parts:
        parts[name] = replace(parts[name], **{field: value})
    else:
        bodies[name] = replace(bodies[name], **{field: value})
    return Train(list(bodies.values()), list(parts.values()), OIL)


@each("change, words", [
    ("place", "p2 pin needs the axis of p2 at x, y = -31.9253, 55.2963 mm from that of carrier, "
              "got -32, 55.4256 mm by the orbits on carrier; a body without an orbit is on"),
    ("azimuth", "p2 pin needs the axis of p2 at x, y = -26.5713, 58.0592 mm from that of"),
    ("module", "the gear of ring with 90 teeth must have one normal_module, got 2 mm in p1 ring "
               "and 2.5 mm in p2 ring. Correct one"),
    ("hand", "the gear of sun with 30 teeth must have one hand, got both, in p1 sun and p2 sun"),
    ("mass", "mass of p2 orbit must be that of p2, 0.7 kg, got 0.8 kg."),
    ("teeth", "planets p1 and p2 must stand a multiple of 2.97521 deg apart"),
    ("held", "p2 must be free along x and y, since carrier carries it, but holds y. Fix it to"),
])  # fmt: skip
def test_gears_of_a_train_that_do_not_fit_each_other_are_refused(change: str, words: str):
    with pytest.raises(ParameterError, match=re.escape(words)):
        listed(change)


def test_planets_between_teeth_that_do_not_fit_are_refused():
    """30 and 90 teeth take planets at multiples of 3 deg."""
    with pytest.raises(ParameterError, match=re.escape(
        "planets p1 and p2 must stand a multiple of 3 deg apart, 360 deg over the 30 + 90 teeth of "
        "sun and ring, got 51.4286 deg: their teeth do not fit."
    )):  # fmt: skip
        helical_set(7)


@each("change, words", [
    ({"ring": True, "teeth_2": 20}, "teeth_2 of mesh, a ring, must be above the 20 teeth of gear"),
    ({"ring": True, "cone_angle_1": 0.3}, "mesh must not have ring beside cone angles"),
    ({"centre_distance": 0.07}, "centre_distance must be near 76.5 mm, that of these teeth, and"),
    ({"stiffness_waves": (0.1,)}, "stiffness_waves of mesh must have a cosine and a sine of each"),
    ({"stiffness_waves": (0.9, 0.9)}, "sum of stiffness_waves of mesh must be within 0 to 0.95"),
    ({"gap": ((0.0,), (0.0,)), "stations": 3}, "gap of mesh must have one row, or one for each"),
    ({"gap": ((5.0,),)}, "gap of mesh must be within -0.01 to 0.01 m, got 5"),
    ({"helix_angle_2": 0.3, "stations": 3}, "mesh has axes that are not parallel, or offset, for "
                                            "which more than one station"),
    ({"normal_module": 3.0}, "normal_module must be within 0.0001 to 1 m, got 3"),
])  # fmt: skip
def test_meshes_that_cannot_be_are_refused(change: dict[str, Any], words: str):
    with pytest.raises(ParameterError, match=re.escape(words)):
        pair(**change)


def test_default_stiffness_is_that_of_iso_6336_for_the_same_gears():
    """Against the fit for a whole pair, with a basic rack of 1.2 modules and no profile shift."""
    module, helix = 3e-3, math.radians(15.0)
    transverse = module / math.cos(helix)
    reference = 0.5 * transverse * 24, 0.5 * transverse * 47
    whole = HelicalPair(
        name="pair", pinion_teeth=24, gear_teeth=47, normal_module=module,
        normal_pressure_angle=math.radians(20.0), helix_angle=helix, face_width=0.03,
        centre_distance=sum(reference), pinion_tip_radius=reference[0] + module,
        gear_tip_radius=reference[1] + module, pinion_root_radius=reference[0] - 1.2 * module,
        gear_root_radius=reference[1] - 1.2 * module,
    )  # fmt: skip
    few = GearPair(
        name="pair", teeth_1=24, teeth_2=47, normal_module=module, helix_angle=helix,
        face_width=0.03,
    )  # fmt: skip
    assert few.contact_ratio == pytest.approx(whole.transverse_contact_ratio, rel=1e-12)
    along = iso_stiffness(whole, line_load=2e5, rack_dedendum=1.2).mesh
    wanted = 0.03 * along / math.cos(whole.base_helix_angle) ** 2
    assert few.iso_stiffness == pytest.approx(wanted, rel=1e-12)


def split(azimuth: float, second: float = 0.0) -> Train:
    """Return a pinion that drives a wheel by two idlers; the last mesh stands at an azimuth."""
    few = {"normal_module": 3e-3, "face_width": 0.03, "backlash": 1e-4}
    small, large = {"teeth_1": 20, "teeth_2": 30, **few}, {"teeth_1": 30, "teeth_2": 40, **few}
    names = ("pinion", "upper", "lower", "wheel")
    bodies = [Body.spinning(one, 2e-3) for one in names]
    turn = math.radians(60.0)
    parts = [
        GearMesh(name="a", first="pinion", second="upper", azimuth=turn, **small),
        GearMesh(name="b", first="upper", second="wheel", azimuth=second, **large),
        GearMesh(name="c", first="pinion", second="lower", azimuth=-turn, **small),
        GearMesh(name="d", first="lower", second="wheel", azimuth=azimuth, **large),
    ]
    return Train(bodies, parts, OIL)


def test_a_split_drive_whose_last_gears_do_not_touch_is_refused():
    """Centres of 75 and 105 mm: the wheel is level with the pinion where sines are as 75 to 105."""
    level = math.asin(math.sin(math.radians(60.0)) * 75.0 / 105.0)
    split(level, -level)
    with pytest.raises(ParameterError, match=re.escape(
        "d needs the axis of wheel at x, y = 105, 0 mm from that of lower, but the other meshes "
        "and shafts between them put it at 82.5"
    )):  # fmt: skip
        split(0.0, -level)


def test_force_is_that_of_the_helical_mesh_of_the_same_gears():
    """Gears of He et al. 2007 without friction, by both elements: load and direction at rest."""
    given = replace(PAIR, friction="off")
    train = Train(*helical_pair(given), OIL)
    train.initialise({"wheel": 84.4}, {"input": 226.0, "output": 280.0}, KELVIN)
    found, gears = train.outputs(), given.pair
    (mesh,) = (one for one in train.elements if isinstance(one, HelicalMesh))
    few = GearPair(
        name="he_2007", teeth_1=gears.pinion_teeth, teeth_2=gears.gear_teeth,
        normal_module=gears.normal_module, normal_pressure_angle=gears.normal_pressure_angle,
        helix_angle=gears.helix_angle, centre_distance=gears.centre_distance,
        face_width=gears.face_width, azimuth=mesh.angle, drives_forward=False,
    )  # fmt: skip
    load = found[f"{mesh.name}.load"]
    force = [found[f"{mesh.name}.force.{one}"] for one in "xyz"]
    np.testing.assert_allclose(force, -load * few.pitch_points()[0].drive, atol=1e-9 * load)
