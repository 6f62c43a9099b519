"""Drive and coast flanks' view of the motion, against turns and strains in space."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gearlube_core.dynamics.helical_pair.march import flanks as module
from gearlube_core.dynamics.helical_pair.march.flanks import FlankConstants, FlankView
from gearlube_core.helical_geometry.contact_line import ContactPlane
from tests.helpers.each import each
from tests.helpers.pair_motions import N_MOTION, PHI_P, PSI, TH_G, TH_P, U_G, U_P, pair_motion
from tests.helpers.source_of import interpret

HELIX, TILT = 0.35, 0.6  # base helix angle, line of centres against y [rad]
PLANE = ContactPlane(
    A=0.004, D=0.021, P=0.011, W=0.03, x_g=0.026, pitch=0.009, sin_b=math.sin(HELIX),
    cos_b=math.cos(HELIX), r_bp=0.028, r_bg=0.041,
)  # fmt: skip
CONSTANTS = FlankConstants(
    plane=PLANE, damping=0.0, backlash=8e-5, coast_phase=3.7, turn_cos=math.cos(2.0 * TILT),
    turn_sin=math.sin(2.0 * TILT), line_work=0.0, lines=0.0, phases=0.0, stations=0.0,
)  # fmt: skip
RNG = np.random.default_rng(10)


@pytest.fixture(autouse=True)
def uncompiled(monkeypatch):
    interpret(monkeypatch, module)


def motion() -> np.ndarray:
    s = np.full(N_MOTION, np.nan)  # nothing else may count
    s[[PSI, *range(U_P, U_P + 3), *range(U_G, U_G + 3)]] = 1e-5 * RNG.normal(size=7)
    s[[TH_P, TH_P + 1, TH_G, TH_G + 1]] = 1e-4 * RNG.normal(size=4)
    s[PHI_P] = 12.3
    return s


def compression(s: np.ndarray, x: float, z: float) -> float:
    """Return how far the flanks come together at (x, z) of the plane of contact [m].

    Both gears move as rigid bodies; the plane is tangent to the base cylinders, below the pinion's
    axis by its base radius in the sense of y, and above the gear's.
    """
    normal = np.array([math.cos(HELIX), 0.0, -math.sin(HELIX)])
    # y of the plane as seen from either axis; the gear's axis lies x_g farther along x
    arms = {"p": np.array([x, PLANE.r_bp, z]), "g": np.array([x - PLANE.x_g, -PLANE.r_bg, z])}
    moved = {}
    for name, u, th in (("p", U_P, TH_P), ("g", U_G, TH_G)):
        turn = np.array([s[th], s[th + 1], 0.0])
        moved[name] = s[u : u + 3] + np.cross(turn, arms[name])
    return float(normal @ (moved["p"] - moved["g"]) + s[PSI] * math.cos(HELIX))


def test_drive_flanks_come_together_as_rigid_bodies_do():
    s = motion()
    view = module.drive_view(pair_motion(s), CONSTANTS)
    for x, z in ((0.0, 0.0), (0.01, -0.008), (0.02, 0.012)):
        along = x * PLANE.sin_b + z * PLANE.cos_b
        assert view.a + along * view.tilt == pytest.approx(compression(s, x, z), rel=1e-12)
    assert view.phase == pytest.approx(PLANE.r_bp * 12.3 / PLANE.pitch)


def test_coast_flanks_are_the_drive_flanks_of_the_turned_motion_less_the_backlash():
    s = motion()
    # half a turn about the line of centres, which rotations follow as displacements do
    half = Rotation.from_rotvec(math.pi * np.array([math.sin(TILT), math.cos(TILT), 0.0]))
    turned = s.copy()
    turned[PSI] = -s[PSI]
    for u in (U_P, U_G):
        turned[u : u + 3] = half.apply(s[u : u + 3])
    for th in (TH_P, TH_G):
        turned[th : th + 2] = half.apply([s[th], s[th + 1], 0.0])[:2]
    drive = module.drive_view(pair_motion(turned), CONSTANTS)
    coast = module.coast_view(pair_motion(s), CONSTANTS)
    assert coast.a == pytest.approx(drive.a - 8e-5, rel=1e-12)
    assert coast.tilt == pytest.approx(drive.tilt, rel=1e-12)
    assert coast.phase == pytest.approx(3.7 - PLANE.r_bp * 12.3 / PLANE.pitch)
    back = module.turned(*module.turned(0.3, -0.8, CONSTANTS), CONSTANTS)
    assert back == pytest.approx((0.3, -0.8))


@pytest.mark.parametrize("tilt", [3e-4, -3e-4])
def test_flanks_can_touch_where_the_farthest_corner_does(tilt: float):
    offset = -4e-6
    corner = max(
        (x * PLANE.sin_b + z * PLANE.cos_b) * abs(tilt)
        for x in (0.0, PLANE.x_g)
        for z in (-0.5 * PLANE.W, 0.5 * PLANE.W)
    )
    for beyond in (1e-9, -1e-9):
        view = FlankView(offset - corner + beyond, tilt, 0.0)
        assert module.touches(view, offset, CONSTANTS) == (beyond > 0.0)


def test_coast_flanks_that_are_not_near_cannot_touch():
    offset, near, far = -2e-6, 0, 0
    for _ in range(300):
        s = motion()
        s[PSI] = RNG.uniform(-2e-4, 2e-4)
        moved = pair_motion(s)
        if module.coast_near(moved, offset, CONSTANTS):
            near += 1
        else:
            far += 1
            assert not module.touches(module.coast_view(moved, CONSTANTS), offset, CONSTANTS)
    assert near > 20
    assert far > 20


@each("sign", [1.0, -1.0])
@each("at", [U_P, U_P + 1, U_P + 2, U_G, U_G + 1, U_G + 2])
def test_a_displacement_alone_brings_the_coast_flanks_near_before_they_touch(at: int, sign: float):
    s = np.zeros(N_MOTION)
    s[at] = sign * 1.01 * CONSTANTS.backlash  # no direction counts less than its size
    assert module.coast_near(pair_motion(s), 0.0, CONSTANTS)
    s[at] *= 0.98
    assert not module.coast_near(pair_motion(s), 0.0, CONSTANTS)
    assert module.coast_near(pair_motion(s), -0.02 * CONSTANTS.backlash, CONSTANTS)


@pytest.mark.parametrize("at", [TH_P, TH_P + 1, TH_G, TH_G + 1])
def test_tilts_reach_as_far_as_the_gears_are_large(at: int):
    s = np.zeros(N_MOTION)
    # least distance on any flank: the lever of the pinion's base radius
    s[at] = -1.01 * CONSTANTS.backlash / (PLANE.r_bp + PLANE.r_bg)
    assert module.coast_near(pair_motion(s), 0.0, CONSTANTS)
    s[at] = 1e-3 * CONSTANTS.backlash / PLANE.x_g
    assert not module.coast_near(pair_motion(s), 0.0, CONSTANTS)


def test_rotation_backward_brings_the_coast_flanks_near():
    s = np.zeros(N_MOTION)
    s[PSI] = -1.01 * CONSTANTS.backlash / PLANE.cos_b
    assert module.coast_near(pair_motion(s), 0.0, CONSTANTS)
    s[PSI] *= 0.98
    assert not module.coast_near(pair_motion(s), 0.0, CONSTANTS)
    assert not module.coast_near(pair_motion(-1.1 * s), 0.0, CONSTANTS)


def test_friction_fades_linearly_below_a_hundredth_of_a_radian_per_second():
    speeds = [-3.0, -0.011, -0.005, 0.0, 0.0025, 0.011, 3.0]
    found = [module.friction_direction(one) for one in speeds]
    assert found == pytest.approx([-1.0, -1.0, -0.5, 0.0, 0.25, 1.0, 1.0])
