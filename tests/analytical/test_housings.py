"""Housings by their modes against the whole finite element model that they are reduced from."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from gearlube_core.dynamics.train.element import COORDINATES
from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.housings.housing_modes import housing_motion
from tests.helpers.frame_model import MOUNTS, NODES, SEATS, SIZE, box_frame, reduced
from tests.helpers.small_trains import OIL

KELVIN = 333.15
FRAME = box_frame()
MODEL = reduced(FRAME, modes=120)
ARMS = {"low": -0.125, "high": 0.125}  # m, of the bearings from the centres of both shafts
SHAFTS = {
    "a": Body(name="a", mass=3.0, inertia=0.02, polar_inertia=0.01),
    "b": Body(name="b", mass=5.0, inertia=0.05, polar_inertia=0.03),
}
SPEED = 100.0  # rad/s, of shaft a
REST = {"motor": 0.0, "shaker": 0.0}
BEARING = {"K_xx": 2e8, "K_yy": 1.5e8, "K_zz": 5e7}  # N/m
MOUNT = {"K_xx": 4e5, "K_yy": 3e5, "K_zz": 2e5}


def elements(mount: float = 1.0, **more) -> list:
    """Return bearings of two shafts in the case, its mounts, a motor and one that shakes it."""
    found: list = [Port(name="motor", body="a"), Port(name="shaker", body="case.b_low")]
    for seat in SEATS:
        shaft, end = seat.split("_")
        found.append(Joint(name=seat, first=shaft, second=f"case.{seat}", arm_1=ARMS[end],
                           **BEARING, **more))  # fmt: skip
    soft = {name: mount * k for name, k in MOUNT.items()}
    found += [Joint(name=one, first=f"case.{one}", second="ground", **soft) for one in MOUNTS]
    return found


def turning(parts: list, **of_case) -> Train:
    """Return both shafts in their case, turning without load."""
    case = Housing(name="case", model=MODEL, **of_case)
    train = Train([*SHAFTS.values(), case], parts, OIL,
                  steps_per_highest_period=40)  # fmt: skip
    train.initialise({"a": SPEED, "b": 0.0}, REST, KELVIN)
    return train


def whole_frequencies() -> np.ndarray:
    """Return the frequencies of the whole finite element model with shafts and mounts [Hz]."""
    n = len(FRAME.mass)
    stiffness, mass = np.zeros((n + 12, n + 12)), np.zeros((n + 12, n + 12))
    stiffness[:n, :n], mass[:n, :n] = FRAME.stiffness, FRAME.mass
    for i, one in enumerate(SHAFTS.values()):
        at = slice(n + 6 * i, n + 6 * i + 6)
        mass[at, at] = np.diag([*3 * [one.mass], *2 * [one.inertia], one.polar_inertia])

    def spring(k: float, *ends: tuple[int, float]) -> None:
        way = np.zeros(n + 12)
        for row, factor in ends:
            way[row] += factor
        stiffness[:] += k * np.outer(way, way)

    for seat in SEATS:
        shaft, end = seat.split("_")
        body, node, arm = n + 6 * list(SHAFTS).index(shaft), FRAME.first(seat), ARMS[end]
        spring(BEARING["K_xx"], (body, 1.0), (body + 4, arm), (node, -1.0))
        spring(BEARING["K_yy"], (body + 1, 1.0), (body + 3, -arm), (node + 1, -1.0))
        spring(BEARING["K_zz"], (body + 2, 1.0), (node + 2, -1.0))
    for name in MOUNTS:
        for i, k in enumerate(MOUNT.values()):
            spring(k, (FRAME.first(name) + i, 1.0))
    squares = scipy.linalg.eigh(stiffness, mass, eigvals_only=True)
    return np.sqrt(np.maximum(squares, 0.0)) / (2.0 * math.pi)


def test_a_case_with_two_shafts_has_the_frequencies_of_the_whole_model():
    """Modes to 5 kHz and the remaining flexibility: all frequencies to half of it, to 0.1 %."""
    exact = whole_frequencies()
    found = turning(elements()).modes()[0]
    exact, found = exact[(exact > 1.0) & (exact < 2500.0)], found[found > 1.0]
    assert exact.size == 42
    np.testing.assert_allclose(found[: exact.size], exact, rtol=1e-3)


def test_a_free_case_has_six_rigid_modes():
    motion = housing_motion(MODEL, True, 5e3)
    assert np.count_nonzero(motion.stiffness == 0.0) == 6
    moved = rigid_motions(about=np.zeros(3))
    assert motion.mass == pytest.approx((moved.T @ FRAME.mass @ moved)[0, 0], rel=1e-9)


def test_energy_of_shafts_in_a_shaken_case_balances():
    """The error of steps falls with their fourth power or faster."""
    of_case = {"highest_frequency": 2e3, "damping_ratio": 0.02}
    train = turning(elements(c_x=300.0, c_y=300.0, c_z=300.0), **of_case)
    before = train.energy
    for i in range(40):
        train.step(2e-4, {"motor": 20.0, "shaker": (-1.0) ** (i // 4) * 300.0}, KELVIN)
    lost = sum(train.lost.values())
    assert train.lost["housing_damping"] > 1e-3
    passed = abs(train.work) + lost
    assert abs(train.energy - before - train.work + lost) < 1e-6 * passed


def test_forces_inside_change_no_momentum_of_a_free_case_and_its_shafts():
    """Mounts are as good as none; torques from outside change the angular momentum alone."""
    train = turning(elements(mount=1e-9), highest_frequency=2e3)
    whole = rigid_motions(about=FRAME.places[FRAME.first("a_low") // 6])
    inertia = whole.T @ FRAME.mass @ whole
    for i in range(20):
        train.step(2e-4, {"motor": 20.0, "shaker": (-1.0) ** (i // 4) * 300.0}, KELVIN)
    # six rigid modes move the node a_low; elastic ones have no momentum
    places = [f"modes_{1 + i // 5}.{COORDINATES[i % 5]}" for i in range(6)]
    rates = np.array([train.state(f"case.{one}.rate") for one in places])
    rigid = housing_motion(MODEL, True, 2e3).shapes[:6, 0]
    case = inertia @ (rates @ rigid)
    momenta, angular = [case[:3]], case[5]
    for name, one in SHAFTS.items():
        momenta.append(one.mass * np.array([train.state(f"{name}.{c}.rate") for c in "xyz"]))
        x, y, _ = SIZE * (np.array(SEATS[f"{name}_low"]) - SEATS["a_low"])
        angular += x * momenta[-1][1] - y * momenta[-1][0]
        angular += one.polar_inertia * train.state(f"{name}.rz.rate")
    put_in = SHAFTS["a"].polar_inertia * SPEED + (20.0 * 20 + 300.0 * 4) * 2e-4
    assert abs(sum(momenta)).max() < 1e-10 * abs(np.array(momenta)).max()
    assert angular == pytest.approx(put_in, rel=1e-4)  # forces act where bodies stood at first


def rigid_motions(about: np.ndarray) -> np.ndarray:
    """Return the rigid motions of the whole model about a point, a column for each."""
    found = np.zeros((len(FRAME.mass), 6))
    for place, (x, y, z) in enumerate(FRAME.places - about):
        found[6 * place : 6 * place + 6] = np.eye(6)
        found[6 * place : 6 * place + 3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    return found


def exact_compliance(rows: list[int]) -> np.ndarray:
    """Return the displacements at rows of the model clamped in one corner under unit loads."""
    free = [i for i in range(len(FRAME.mass)) if not 42 <= i < 48]
    unit = np.zeros((len(FRAME.mass), len(rows)))
    unit[rows, range(len(rows))] = 1.0
    moved = np.zeros_like(unit)
    moved[free] = np.linalg.solve(FRAME.stiffness[np.ix_(free, free)], unit[free])
    return moved[rows]


def test_preloaded_ball_bearings_bend_the_case_that_carries_them():
    """Forces on the case are those on the shaft, turned round, with its own compliance."""
    rings = {"n_balls": 7, "ball_diameter": 11.5e-3, "pitch_diameter": 43.5e-3, "f0": 2.0,
             "inner_groove": 0.52, "outer_groove": 0.53, "f1": 3e-4, "axial_factor": 3.0,
             "contact_angle": 0.5, "offset": 1e-5}  # fmt: skip
    seats = {"low": 1, "high": -1}
    bearings = [
        BallBearing(name=one, body="a", housing=f"case.a_{one}", arm=ARMS[one], side=side, **rings)
        for one, side in seats.items()
    ]
    case = Housing(name="case", model=reduced(FRAME, 20, fixed=True), free=False,
                   highest_frequency=1e3)  # fmt: skip
    parts = [Port(name="motor", body="a"), *bearings]
    train = Train([SHAFTS["a"], case], parts, OIL)
    train.initialise({"a": SPEED}, {"motor": 0.0}, KELVIN)
    found = train.outputs()
    loads, moved, rows = [], [], []
    for one in seats:
        force = [-found[f"{one}.force.{c}"] for c in "xyz"]
        moment = [-found[f"{one}.moment.{c}"] for c in "xy"]
        assert abs(force[2]) > 100.0
        loads += [*force, *moment, found[f"{one}.torque"]]
        place = f"case.a_{one}"
        moved += [found[f"{place}.displacement.{c}"] for c in "xyz"]
        moved += [*(found[f"{place}.tilt.{c}"] for c in "xy"), found[f"{place}.angle"]]
        rows += [FRAME.first(f"a_{one}") + i for i in range(6)]
    exact = exact_compliance(rows) @ loads
    np.testing.assert_allclose(moved, exact, rtol=0.0, atol=1e-9 * abs(exact).max())  # of the rest


@pytest.mark.parametrize("limit", [5e3, 1e3, 100.0])
def test_deflection_under_unit_loads_is_that_of_the_whole_model(limit: float):
    """Forces and moments at all nodes, for any limit of the modes."""
    motion = housing_motion(reduced(FRAME, modes=10, fixed=True), False, limit)
    exact = exact_compliance([FRAME.first(name) + i for name in NODES for i in range(6)])
    shapes = motion.shapes.reshape(motion.stiffness.size, -1)
    found = (shapes.T / motion.stiffness) @ shapes
    own = np.sqrt(np.diag(exact))
    # remaining shapes that are left out have a share of 1e-9 each
    assert abs((found - exact) / np.outer(own, own)).max() < 1e-6


def test_a_model_of_another_frame_turns_into_that_of_the_train():
    """z of the train along x of the model: a shaft along z bends what lies along x there."""
    case = Housing(name="case", model=MODEL, model_axes=("y", "z", "x"))
    own = housing_motion(MODEL, True, case.highest_frequency).shapes
    turned = case.motion().shapes
    np.testing.assert_array_equal(turned[..., [0, 1, 2]], own[..., [1, 2, 0]])
    np.testing.assert_array_equal(turned[..., [3, 4, 5]], own[..., [4, 5, 3]])


def test_modes_are_damped_by_the_damping_matrix_of_the_model():
    """C = 1e-5 s K: each elastic mode has c = 1e-5 s k."""
    damped = replace(MODEL, damping=1e-5 * MODEL.stiffness)
    motion = housing_motion(damped, True, 2e3, 0.5)
    below = motion.stiffness < (2.0 * math.pi * 2e3) ** 2 * motion.mass
    np.testing.assert_allclose(motion.damping[below], 1e-5 * motion.stiffness[below],
                               atol=1e-9 * motion.damping.max())  # fmt: skip
