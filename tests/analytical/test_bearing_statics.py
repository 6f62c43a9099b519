import math

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import shaft_bearing_forces
from gearlube_core.errors import ConvergenceError
from tests.helpers.bearing_statics import (
    static_displacement,
    stiffness,
)

P = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(2500.0).parameters()
OIL = (0.0171, 2.383e-8)


def test_stiffness_at_rest_has_its_closed_form():
    w = 2500.0 / (12 * math.sin(math.radians(15)))
    d = (w / 5e8) ** 0.9
    rate = 10 / 9 * w / d
    radial = 12 * rate * math.cos(math.radians(15)) ** 2
    axial = 24 * rate * math.sin(math.radians(15)) ** 2
    # rounding of sums
    assert stiffness(P) == pytest.approx(np.diag([radial, radial, axial]), rel=1e-9, abs=1.0)


def test_stiffness_is_the_slope_of_the_kernel_force():
    u = (2e-6, -1e-6, 3e-6)
    wet = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
    for p in (P, wet):
        h = 1e-8
        slope = np.zeros((3, 3))
        for k in range(3):
            F = []
            for s in (1, -1):
                v = np.array(u)
                v[k] += s * h
                motion = ShaftMotion(*v.tolist(), 0.0, 0.0, 0.0, 0.3, 145.0)
                f = shaft_bearing_forces(motion, 1e3, *OIL, p._replace(loss=0.0, squeeze=0.0))
                F.append(np.array(f[:3]) + np.array(f[3:6]))
            slope[:, k] = -(F[0] - F[1]) / (2 * h)
        K = stiffness(p, u, cage_angle=0.3, shaft_speed=145.0, eta0=OIL[0], alpha=OIL[1])
        # second-order differences of a force with a scale of 5 um: (h/d)^2 and the film's fit
        assert pytest.approx(slope, rel=1e-5, abs=1e-6 * K.max()) == K
        assert pytest.approx(K.T, rel=1e-12) == K


def test_static_displacement_balances_the_load():
    load = np.array([1500.0, -400.0, 2000.0])
    u = static_displacement(P, load, cage_angle=0.2)
    F = shaft_bearing_forces(ShaftMotion(*u.tolist(), 0.0, 0.0, 0.0, 0.2, 0.0), 1.0, *OIL, P)
    # the solver's own limit, 1e-10 of the load
    assert np.array(F[:3]) + np.array(F[3:6]) == pytest.approx(-load, abs=1e-6)


def test_cylindrical_rollers_with_clearance_carry_a_radial_load_only():
    p = (
        TaperedRollerBearing.mohammadpour_2015(contact_angle=0.0, film="off")
        .with_clearance(10e-6)
        .parameters()
    )
    u = static_displacement(p, (1500.0, 0.0, 0.0))
    assert u[0] > 10e-6
    with pytest.raises(ConvergenceError, match="contact angle"):
        static_displacement(p, (1500.0, 0.0, 100.0))
