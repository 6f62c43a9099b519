"""What must hold for bearings whatever the motion."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses.catalogue import drag_torque
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.shaft_expansion import shaft_bearing_energy
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import shaft_bearing_forces

OIL = (0.0171, 2.383e-8)
TIGHT = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
LOOSE = TaperedRollerBearing.mohammadpour_2015().with_clearance(8e-6).parameters()
POINT = TIGHT._replace(n=1.5, kn=1e10)

length = st.floats(-2e-5, 2e-5)
velocity = st.floats(-0.05, 0.05)
angle = st.floats(0.0, 2 * math.pi)
speed = st.floats(-700.0, 700.0)
bearing = st.sampled_from([TIGHT, LOOSE, POINT])


def still(r1, r2, xa, th, w):
    return ShaftMotion(r1, r2, xa, 0.0, 0.0, 0.0, th, w)


@given(length, length, length, velocity, velocity, velocity, angle, speed, bearing)
def test_rollers_never_pull_and_never_give_energy(r1, r2, xa, v1, v2, va, th, w, p):
    args = (ShaftMotion(r1, r2, xa, v1, v2, va, th, w), 250.0, *OIL, p)
    out = np.zeros(12)
    for side in (1.0, -1.0):
        roller_loads(*args, side, out)
        assert out.min() >= 0.0
    F = shaft_bearing_forces(*args)
    assert F[6] >= 0.0
    assert F[2] <= 0.0 <= F[5]


@given(length, length, length, angle, speed, bearing)
def test_motion_in_reverse_mirrors_the_force(r1, r2, xa, th, w, p):
    """A mirror through the plane of r1 and a turns r2, the angle and the speed around."""
    one = shaft_bearing_forces(still(r1, r2, xa, th, w), 250.0, *OIL, p)
    two = shaft_bearing_forces(still(r1, -r2, xa, -th, -w), 250.0, *OIL, p)
    scale = 1e-11 * (1.0 + abs(one[2]) + abs(one[5])) / p.sin_contact
    # rounding of sums in another order
    assert two[0] == pytest.approx(one[0], abs=scale)
    assert two[1] == pytest.approx(-one[1], abs=scale)
    assert two[2] == pytest.approx(one[2], abs=scale)


@given(length, length, length, angle, speed, bearing)
def test_one_roller_pitch_of_the_cage_changes_nothing(r1, r2, xa, th, w, p):
    one = shaft_bearing_forces(still(r1, r2, xa, th, w), 250.0, *OIL, p)
    two = shaft_bearing_forces(still(r1, r2, xa, th + math.pi / 6, w), 250.0, *OIL, p)
    scale = 1e-10 * (1.0 + abs(one[2]) + abs(one[5])) / p.sin_contact
    assert np.array(two) == pytest.approx(np.array(one), abs=scale)


@given(length, length, length, length, length, length, angle)
def test_energy_is_convex_in_the_displacement(a1, a2, a3, b1, b2, b3, th):
    """Rollers only push, and harder the more they are pressed: a stable support."""

    def V(u):
        return shaft_bearing_energy(*u, th, 145.0, *OIL, LOOSE)

    a, b = np.array([a1, a2, a3]), np.array([b1, b2, b3])
    # rounding of energies of up to 1 J
    assert V(0.5 * (a + b)) <= 0.5 * (V(a) + V(b)) + 1e-13


@given(speed, st.floats(0.0, 2e4), st.floats(1e-6, 1e-3))
def test_drag_opposes_rotation_and_grows_with_load(w, load, nu):
    drag = drag_torque(w, load, 0.0, nu, TIGHT)
    assert drag * w >= 0.0
    assert drag_torque(-w, load, 0.0, nu, TIGHT) == -drag
    assert abs(drag_torque(w, load + 100.0, 0.0, nu, TIGHT)) >= abs(drag)


def test_drag_passes_zero_speed_smoothly():
    w = np.linspace(-1e-3, 1e-3, 21)
    drag = np.array([drag_torque(a, 2500.0, 0.0, 19e-6, TIGHT) for a in w])
    slope = np.diff(drag) / np.diff(w)
    assert drag[10] == 0.0
    # w/sqrt(1 + w^2) is straight to w^2
    assert slope == pytest.approx(np.full(20, slope[0]), rel=1e-5)
