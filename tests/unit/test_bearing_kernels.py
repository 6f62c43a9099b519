"""Kernels of roller films and of drag by values; compiled ones are in test_compiled_entries.py."""

import math

import numpy as np
import pytest

from gearlube_core.bearings import roller_contact, roller_loads
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses import catalogue
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.solid import pi_contact_modulus
from gearlube_core.film import mostofi_gohar_1983 as film

P = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
OIL = (0.0171, 2.383e-8)
MOTION = ShaftMotion(3e-6, -1e-6, 0.5e-6, 1e-3, 2e-3, -1e-3, 0.3, 145.0)


def test_films_of_rollers_are_those_of_the_formula_under_their_loads():
    found = np.zeros(12)
    assert roller_loads.roller_films(MOTION, *OIL, P, 1.0, found) == 0
    # without velocities and hysteresis a load is that of its film alone
    still = MOTION._replace(v1=0.0, v2=0.0, v_axial=0.0)
    lossless = P._replace(loss=0.0, cage_ratio=0.0, squeeze=0.0)
    loads = np.zeros(12)
    roller_loads.roller_loads(still, 300.0, *OIL, lossless, 1.0, loads)
    bearing = TaperedRollerBearing.mohammadpour_2015()
    shape = 0.5 * bearing.roller_diameter, pi_contact_modulus(bearing.solid, bearing.solid)
    u = P.film_speed_radius * MOTION.speed
    expected = [film.central_film(load, u, 0.0, *OIL, *shape) for load in loads]
    assert found == pytest.approx(expected, rel=1e-6)
    assert roller_loads.roller_films(MOTION, *OIL, P, 1.0, np.zeros(3)) == 1
    without = P._replace(film_constant=0.0)
    roller_loads.roller_films(MOTION, *OIL, without, 1.0, found)
    assert not found.any()


def test_missing_speed_or_film_means_no_film():
    assert roller_contact.film_amplitude(0.0, *OIL, P) == (0.0, 0.0)
    assert roller_contact.film_amplitude(9.0, *OIL, P._replace(film_constant=0.0)) == (0.0, 0.0)
    assert film.central_film(500.0, 0.0, 0.0, *OIL, 6e-3, 3.6e11) == 0.0


def test_drag_follows_the_printed_units():
    """M0 = 1e-7 f0 (nu n)^(2/3) dm^3 N mm with cSt, 1/min, mm; M1 = f1 2 Y Fa dm."""
    speed = 150.0
    n = speed * 30 / math.pi
    M0 = 1e-7 * 6 * (19.0 * n) ** (2 / 3) * 61.85**3
    M1 = 4e-4 * 2 * 0.4 / math.tan(math.radians(15)) * 2500.0 * 61.85
    # the smoothing factor is 1 - 2e-5 at 150 rad/s
    expected = 1e-3 * (M0 + M1) / math.sqrt(1 + 1 / speed**2)
    assert catalogue.drag_torque(speed, 2500.0, 0.0, 19e-6, P) == pytest.approx(expected, rel=1e-12)
    slow = 1e-3 * (160e-7 * 6 * 61.85**3 + M1) / math.sqrt(1 + 1 / 25)
    assert catalogue.drag_torque(5.0, 2500.0, 0.0, 19e-6, P) == pytest.approx(slow, rel=1e-12)
