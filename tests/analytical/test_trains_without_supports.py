"""Parts of a train that nothing holds or that stand off their axes: errors name part and cure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.dynamics.train.supports import check_supports
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.housings.reduced_model import InterfaceNode, ReducedModel
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


def pair_on(*supports: Element, more: Sequence[Any] = (), helix: float = 0.0) -> Train:
    bodies = [
        Body(name=one, mass=1.0, inertia=1e-3, polar_inertia=2e-3) for one in ("pinion", "wheel")
    ]
    mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=20, teeth_2=40,
                    normal_module=3e-3, face_width=0.03, backlash=1e-4,
                    helix_angle=helix)  # fmt: skip
    ports = [Port(name="motor", body="pinion"), Port(name="road", body="wheel")]
    return Train([*bodies, *more], [*ports, mesh, *supports], OIL)


def test_a_wheel_without_bearings_is_named_before_anything_is_computed():
    springs = SpringSupport(name="bearings", body="pinion", **STIFF)
    with pytest.raises(ParameterError, match=r"wheel must be held in place.* 1 mesh"):
        pair_on(springs)


def test_a_case_without_mounts_is_named_with_the_shafts_that_it_carries():
    case = Body(name="case", mass=9.0, inertia=0.1, polar_inertia=0.1)
    seats = [
        BallBearing(name=f"{body} bearing", body=body, housing="case", housing_x=x, **BALLS)
        for body, x in (("pinion", 0.0), ("wheel", 0.09))
    ]
    with pytest.raises(ParameterError, match=r"pinion, wheel, case must be held.* 0 mesh"):
        pair_on(*seats, more=[case])


@pytest.mark.parametrize("planets", [2, 3])
def test_a_sun_floats_between_three_planets_and_not_between_two(planets: int):
    """A line of action holds one motion; a sun has three in its plane, with the one to turn."""
    gears = {"teeth_1": 20, "teeth_2": 40, "normal_module": 3e-3, "face_width": 0.03}
    meshes = [
        GearMesh(name=f"mesh_{i}", first="sun", second=f"planet_{i}", backlash=1e-4,
                 azimuth=2.0 * math.pi * i / planets, **gears)
        for i in range(planets)
    ]  # fmt: skip
    bodies = [
        Body(name=one, mass=1.0, inertia=1e-3, polar_inertia=2e-3)
        for one in ("sun", *(mesh.second for mesh in meshes))
    ]
    supports = [SpringSupport(name=f"pin_{i}", body=f"planet_{i}", **STIFF) for i in range(planets)]
    refused = planets < 3
    with pytest.raises(ParameterError, match="sun must be") if refused else nullcontext():
        check_supports(bodies, [*meshes, *supports])


def test_nodes_of_a_shaft_are_held_with_it():
    turning = Body.spinning("wheel", 1.0)
    on = [SpringSupport(name="springs", body="rotor.left", **STIFF)]
    mesh = GearMesh(name="mesh", first="rotor.right", second="wheel", teeth_1=20, teeth_2=40,
                    normal_module=3e-3, face_width=0.03, backlash=1e-4)  # fmt: skip
    Train([ROTOR, turning], [mesh, *on], OIL)
    with pytest.raises(ParameterError, match="rotor must be held"):
        Train([ROTOR, turning], [mesh], OIL)


@pytest.mark.parametrize("off", [0.0, 0.05])
def test_a_bearing_off_the_axis_of_its_shaft_is_refused_with_the_distance(off: float):
    """The meshes put the wheel 90 mm along x from the pinion: half of 20 + 40 teeth of 3 mm."""
    seats = [
        BallBearing(name=f"{body} bearing", body=body, housing="case", housing_x=x, **BALLS)
        for body, x in (("pinion", 0.2), ("wheel", 0.29 + off))
    ]
    case = Body(name="case", mass=9.0, inertia=0.1, polar_inertia=0.1)
    mount = SpringSupport(name="mounts", body="case", **STIFF)
    words = r"wheel bearing must stand on the axis of wheel, at x, y = 290, 0 mm.* 50 mm off"
    with pytest.raises(ParameterError, match=words) if off else nullcontext():
        pair_on(*seats, mount, more=[case])


@pytest.mark.parametrize("side", ["y", "-y"])
def test_nodes_of_a_housing_are_where_the_axes_of_its_shafts_are(side: str):
    """Turned the other way round, the node of the wheel stands 180 mm from its axis."""
    nodes = [InterfaceNode("left", 0.0, 0.0, 0.0), InterfaceNode("right", 0.0, 90.0, 0.0)]
    model = ReducedModel(
        stiffness=4e5 * np.eye(6), mass=1e-3 * np.eye(6), nodes=nodes,
        owner=np.repeat([0, 1], 3), direction=np.tile(np.arange(3), 2), length_unit="mm",
        mass_unit="t",
    )  # fmt: skip
    axes = (side, "x", "-z" if side == "y" else "z")
    case = Housing(name="case", model=model, free=False, model_axes=axes)
    seats = [
        BallBearing(name=f"{body} bearing", body=body, housing=f"case.{node}", **BALLS)
        for body, node in (("pinion", "left"), ("wheel", "right"))
    ]
    words = "wheel bearing must stand on the axis of wheel.* 180 mm off"
    with pytest.raises(ParameterError, match=words) if side == "-y" else nullcontext():
        pair_on(*seats, more=[case])


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
    words = r"There are: rotor, rotor\.left, rotor\.right(, ground)?\. Is it rotor\.left\?$"
    with pytest.raises(ParameterError, match=words):
        Train([ROTOR], [Port(name="motor", body="rotor.lft")], OIL)


def test_a_direction_in_which_nothing_holds_a_shaft_is_named():
    """Thrust of helical teeth, and bearings that carry none."""
    loose = SpringSupport(name="road side", body="wheel", **(STIFF | {"K_zz": 0.0}))
    train = pair_on(SpringSupport(name="motor side", body="pinion", **STIFF), loose, helix=0.3)
    words = r"no static equilibrium: nothing holds wheel along z\. Give a support there"
    with pytest.raises(ConvergenceError, match=words):
        train.initialise({"pinion": 100.0}, {"motor": 50.0, "road": 100.0}, KELVIN)
