"""Trains in which nothing holds a part: the error names the part and the cure."""

from __future__ import annotations

import pytest

from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.dynamics.train.supports import unsupported
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.shafts.section import ShaftSection
from tests.helpers.small_trains import KELVIN, OIL

STIFF = dict.fromkeys(("K_xx", "K_yy", "K_zz"), 1e8) | {"K_ax": 1e6, "K_ay": 1e6}
ROTOR = Shaft(
    name="rotor",
    sections=(ShaftSection(start=0.0, end=0.2, outer_diameter=0.03),),
    nodes={"left": 0.0, "right": 0.2},
)
BALLS = {
    "n_balls": 9, "ball_diameter": 7.94e-3, "pitch_diameter": 38.5e-3, "inner_groove": 0.52,
    "outer_groove": 0.53, "f0": 0.0, "f1": 0.0,
}  # fmt: skip


def pair_on(*supports: Element) -> Train:
    bodies = [
        Body(name=one, mass=1.0, inertia=1e-3, polar_inertia=2e-3) for one in ("pinion", "wheel")
    ]
    mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=20, teeth_2=40,
                    normal_module=3e-3, face_width=0.03, backlash=1e-4)  # fmt: skip
    ports = [Port(name="motor", body="pinion"), Port(name="road", body="wheel")]
    return Train(bodies, [*ports, mesh, *supports], OIL)


def test_a_wheel_without_bearings_is_named_where_no_rest_is_found():
    train = pair_on(SpringSupport(name="bearings", body="pinion", **STIFF))
    with pytest.raises(ConvergenceError, match="leads from wheel to the ground: give it one"):
        train.initialise({"pinion": 100.0}, {"motor": 50.0, "road": 100.0}, KELVIN)


def test_a_joint_to_what_stands_holds_a_body():
    springs = SpringSupport(name="bearings", body="pinion", **STIFF)
    joint = Joint(name="joint", first="wheel", second="pinion", **STIFF)
    train = pair_on(springs)
    assert unsupported(train.bodies, train.elements) == ["wheel"]
    assert unsupported(train.bodies, [springs, joint]) == []
    assert unsupported(train.bodies, [joint]) == ["pinion", "wheel"]


def test_nodes_of_a_shaft_are_held_with_it():
    train = Train([ROTOR], [SpringSupport(name="springs", body="rotor.left", **STIFF)], OIL)
    assert unsupported(train.bodies, train.elements) == []
    assert unsupported(train.bodies, []) == ["rotor"]


@pytest.mark.parametrize(
    ("between", "field"),
    [
        (BallBearing(name="odd", body="rotor.left", housing="rotor.right", **BALLS), "housing"),
        (Motor(name="odd", body="rotor.left", stator="rotor.right"), "stator"),
    ],
)
def test_both_sides_of_a_bearing_or_motor_cannot_be_of_one_shaft(between: Element, field: str):
    words = rf"between two bodies, got rotor.left and rotor.right of one.*as its {field}"
    with pytest.raises(ParameterError, match=words):
        Train([ROTOR], [between], OIL)


def test_an_unknown_node_lists_those_that_a_user_can_name():
    with pytest.raises(
        ParameterError, match=r"There are: rotor, rotor\.left, rotor\.right(, ground)?\.$"
    ):
        Train([ROTOR], [Port(name="motor", body="rotor.lft")], OIL)
