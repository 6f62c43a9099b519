"""Two rotors on a shaft, whose motion has a closed form, as file and list; a two-stage e-axle."""

from __future__ import annotations

from dataclasses import replace

from gearlube_core.dynamics.helical_model.pair import spring_support
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.coulomb_brake import CoulombBrake

FIRST, SECOND = 0.2, 2.0  # kg.m2
STIFFNESS, DAMPING = 1e4, 2.0  # N.m/rad, N.m.s/rad
BRAKE = 3.0  # N.m

ROTORS = f"""
name = "two rotors on a shaft"
steps_per_highest_period = 64

[oil]
name = "mohammadpour_2015"

[start]
speed_rpm = {{ engine = 1000.0 }}
torque_n_m = {{ drive = 0.0 }}

[bodies.engine]
mass_kg = 1.0
inertia_kg_m2 = 1.0
polar_inertia_kg_m2 = {FIRST}
held = ["x", "y", "z", "rx", "ry"]

[bodies.load]
mass_kg = 1.0
inertia_kg_m2 = 1.0
polar_inertia_kg_m2 = {SECOND}
held = ["x", "y", "z", "rx", "ry"]

[elements.drive]
kind = "port"
body = "engine"

[elements.shaft]
kind = "half_shaft"
first = "engine"
second = "load"
stiffness_n_m_per_rad = {STIFFNESS}
damping_n_m_s_per_rad = {DAMPING}
"""
WITH_BRAKE = f"""{ROTORS}
[elements.brake]
kind = "{CoulombBrake.kind}"
body = "load"
torque_n_m = {BRAKE}
"""

_ROLLERS = """
[elements.{body}_{name}]
kind = "roller_bearing"
body = "{body}"
arm_mm = {side}60.0
side = {side}1
torque_loss = "solved_films"
[elements.{body}_{name}.bearing]
preload_n = 2500.0
"""
# a pair in roller bearings that tilts: all films solved, oil churned
GEARS_ON_ROLLERS = """
name = "gears on rollers"

[oil]
name = "mohammadpour_2015"

[start]
speed_rpm = { pinion = -1500.0 }
torque_n_m = { input = 120.0, output = 150.0 }

[bodies.pinion]
mass_kg = 6.0
inertia_kg_m2 = 0.02
polar_inertia_kg_m2 = 0.02

[bodies.gear]
mass_kg = 12.0
inertia_kg_m2 = 0.06
polar_inertia_kg_m2 = 0.08

[elements.input]
kind = "port"
body = "pinion"
sign = -1.0

[elements.output]
kind = "port"
body = "gear"
sign = -1.0

[elements.mesh]
kind = "helical_mesh"
pinion = "pinion"
gear = "gear"
gear_file = "he_2007"
film = "solved"

[elements.churning]
kind = "churning"
body = "gear"
law = "changenet_velex_2007"
ring_diameter_mm = 165.0
ring_width_mm = 30.0
immersion_mm = 40.0
oil_volume_l = 1.2

[elements.seal]
kind = "seal"
body = "pinion"
torque_n_m = 0.15
""" + "".join(
    _ROLLERS.format(body=body, name=name, side=side)
    for body in ("pinion", "gear")
    for name, side in (("left", "-"), ("right", ""))
)

PAIR = helical_march_parameters(HelicalGearFile.named("he_2007"))
PLANE, RATIO = PAIR.pair.plane, PAIR.pair.ratio
OIL = Lubricant.named("mohammadpour_2015")
KELVIN = 333.15
LOAD = {"input": 226.0, "output": 280.0}


def two_rotors(*, brake: float = 0.0, damping: float = 0.0) -> Train:
    rotors = [Body.spinning("engine", 0.2), Body.spinning("load", 2.0)]
    shaft = HalfShaft(name="shaft", first="engine", second="load", stiffness=1e4, damping=damping)
    elements: list[Element] = [shaft, Port(name="motor", body="engine")]
    if brake:
        elements.append(CoulombBrake(name="brake", body="load", torque=brake))
    return Train(rotors, elements, OIL)


def e_axle(turned: float = 0.0, friction: str = "film", hand: bool = True) -> Train:
    """Return two stages: a rotor's shaft, a countershaft and a differential with two wheels.

    Gears are those of he_2007 twice, masses and shafts invented. Bearings are alike in x and y, so
    that the whole can be turned about z.
    """
    pair = replace(PAIR, friction=friction)
    own = spring_support("bearings", "gear", PAIR.gear, PAIR.support_damping_ratio)
    even = replace(own, K_yy=own.K_xx, K_ax=own.K_ay, c_y=own.c_x, c_ax=own.c_ay, K_x_ay=0.0,
                   K_y_ax=0.0)  # fmt: skip
    bodies = [
        Body(name="input", mass=3.0, inertia=0.004, polar_inertia=0.02),
        Body(name="counter", mass=6.0, inertia=0.02, polar_inertia=0.01),
        Body(name="differential", mass=9.0, inertia=0.03, polar_inertia=0.04),
        Body.spinning("left", 1.0),
        Body.spinning("right", 1.0),
    ]
    first = HelicalMesh(
        name="first", pinion="input", gear="counter", parameters=pair, angle=0.3 + turned,
        right_hand=not hand, gear_arm=-0.03,
    )  # fmt: skip
    second = HelicalMesh(
        name="second", pinion="counter", gear="differential", parameters=pair, angle=2.0 + turned,
        drives_forward=True, right_hand=hand, pinion_arm=0.03,
    )  # fmt: skip
    elements = [
        Port(name="motor", body="input", sign=-1.0),
        Port(name="left wheel", body="left"),
        Port(name="right wheel", body="right"),
        first,
        second,
        *(replace(even, name=f"{b.name} bearings", body=b.name) for b in bodies[:3]),
        HalfShaft(name="left shaft", first="differential", second="left", stiffness=8e3),
        HalfShaft(name="right shaft", first="differential", second="right", stiffness=6e3),
    ]
    return Train(bodies, elements, PAIR.oil)


def loads(torque: float) -> dict[str, float]:
    each = 0.5 * torque * RATIO**2
    return {"motor": torque, "left wheel": each, "right wheel": each}
