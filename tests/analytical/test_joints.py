"""Springs between two bodies: the stiffness matrix of a place in a housing, and refusals."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.errors import ParameterError
from tests.helpers.planetary_sets import KELVIN, OIL

RADIUS, AZIMUTH, ARM_1, ARM_2 = 0.2, 0.7, 0.03, -0.05
SPRINGS = {"K_xx": 3e8, "K_yy": 2e8, "K_zz": 1e8, "K_ax": 4e5, "K_ay": 3e5, "K_x_ay": 2e6,
           "K_y_ax": -1e6}  # fmt: skip
PLACES = ("x", "y", "z", "rx", "ry")


def housed(held: tuple[str, ...] = ("rz",)) -> Train:
    bodies = [
        Body(name="shaft", mass=2.0, inertia=0.01, polar_inertia=0.02),
        Body(name="housing", mass=20.0, inertia=1.0, polar_inertia=1.0, held=held),
    ]
    parts = [
        Joint(name="bearing", first="shaft", second="housing", radius=RADIUS, azimuth=AZIMUTH,
              arm_1=ARM_1, arm_2=ARM_2, **SPRINGS),
        SpringSupport(name="mounts", body="housing"),
    ]  # fmt: skip
    return Train(bodies, parts, OIL)


def stiffness(train: Train) -> Array:
    """Return forces on both bodies against displacements, x y z rx ry each, from accelerations."""
    resist = np.array([2.0, 2.0, 2.0, 0.01, 0.01, 20.0, 20.0, 20.0, 1.0, 1.0])
    names = [f"{body}.{one}" for body in ("shaft", "housing") for one in PLACES]
    at = [train.state_names.index(name) for name in names]
    of = [train.state_names.index(f"{name}.rate") for name in names]
    state, found = train.get_state(), np.zeros((10, 10))
    for j, place in enumerate(at):
        moved = state.copy()
        moved[place] += 1e-6
        train.set_state(moved)
        found[:, j] = -train.rates()[of] * resist / 1e-6
    train.set_state(state)
    return found


def test_a_bearing_in_a_housing_has_the_matrix_of_its_place():
    """K = B^T k B with the displacement B q of the shaft in the bearing, in the bearing's axes."""
    train = housed()
    train.initialise({"shaft": 100.0}, {}, KELVIN)
    k = np.diag([SPRINGS[name] for name in ("K_xx", "K_yy", "K_zz", "K_ax", "K_ay")])
    k[0, 4] = k[4, 0] = SPRINGS["K_x_ay"]
    k[1, 3] = k[3, 1] = SPRINGS["K_y_ax"]
    c, s = math.cos(AZIMUTH), math.sin(AZIMUTH)
    turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])

    def moves(place: Array) -> Array:
        """Return displacement and tilts of a point of a body, from x y z rx ry."""
        about = np.cross(np.eye(3)[:2], place)  # of a unit tilt about x and y
        whole = np.block([[turn, turn @ about.T], [np.zeros((2, 3)), turn[:2, :2]]])
        return whole

    there = np.array([RADIUS * c, RADIUS * s, ARM_2])
    b = np.hstack([moves(np.array([0.0, 0.0, ARM_1])), -moves(there)])
    # differences of forces of some 100 N, and no rounding of the linear springs beside
    np.testing.assert_allclose(stiffness(train), b.T @ k @ b, rtol=1e-9, atol=1.0)


def test_a_joint_off_the_axis_of_a_body_that_turns_needs_an_orbit():
    with pytest.raises(ParameterError, match=re.escape(
        "bearing needs the axis of shaft at x, y = 152.968, 128.844 mm from that of housing"
    )):  # fmt: skip
        housed(held=())
