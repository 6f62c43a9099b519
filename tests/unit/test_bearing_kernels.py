"""Compiled kernels against their Python source."""

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from gearlube_core.bearings import (
    ninth_root,
    parameters,
    roller_contact,
    roller_loads,
    shaft_expansion,
    standalone,
    tapered_roller_kernels,
)
from gearlube_core.bearings.bearing_type import ShaftMotion, loaded_drag
from gearlube_core.bearings.losses import catalogue
from gearlube_core.bearings.losses.laws import PALMGREN, SKF
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.solid import pi_contact_modulus
from gearlube_core.film import mostofi_gohar_1983 as film
from gearlube_core.oil.lubricant import Lubricant, lubricant_state

P = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
OIL = (0.0171, 2.383e-8)
MOTION = ShaftMotion(3e-6, -1e-6, 0.5e-6, 1e-3, 2e-3, -1e-3, 0.3, 145.0)
OIL_STATE = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), 333.15)
ROTOR = standalone.Rotor(50.0, 1500.0, 209.0, 159.0, *OIL, P)
SHAFT = (MOTION, 300.0, *OIL, P)
CASES = [
    (film.squeeze_factor, (1e-3, 2.0)),
    (film.dimensionless_groups, (500.0, 2.0, *OIL, 6e-3, 3.6e11)),
    (film.dimensionless_groups_as_printed, (500.0, 2.0, *OIL, 6e-3, 3.6e11)),
    (film.central_film, (500.0, 2.0, 1e-4, *OIL, 6e-3, 3.6e11)),
    (ninth_root.ninth_root_start, (3.7,)),
    (ninth_root.ninth_root_residual, (1.156, 1 / 3.7)),
    (ninth_root.ninth_root_refined, (1.156, 1e-3)),
    (ninth_root.ninth_root, (3.7,)),
    (ninth_root.ninth_root_change, (0.01,)),
    (roller_contact.contact_angle_terms, (0.26,)),
    (roller_contact.contact_angle_terms, (0.0,)),
    (roller_contact.film_amplitude, (145.0, *OIL, P)),
    *((roller_contact.moving_share, (x,)) for x in (0.5, 1.1, 8.0, 210.0, 300.0)),
    (roller_contact._squeezed_excess, (-1e-2,)),
    (roller_contact.roller_load_line, (8.0, 300.0, 0.7, 3e-5, 40.0, 3e-5, 0.0)),
    (roller_contact.roller_load_general, (8.0, 300.0, 0.7, 3e-5, 40.0, 3e-5, 0.0, 1.3)),
    (roller_contact.film_and_slope, (8.0, 0.7, 1.3)),
    (roller_contact.approach_with_film, (8.0, 0.7, 1.3)),
    (parameters.approach_terms, (MOTION, 0.8, 0.6, P)),
    (parameters.cage_torque, (1e-6, 2e-6, 300.0, -200.0)),
    (tapered_roller_kernels.shaft_bearing_forces, SHAFT),
    (roller_loads.bearing_forces, (*SHAFT, -1.0)),
    (shaft_expansion.roller_energy, (8.0, 0.7, 1.3)),
    (shaft_expansion.bearing_energy, (*MOTION[:3], 0.3, 145.0, *OIL, P, 1.0)),
    (shaft_expansion.shaft_bearing_energy, (*MOTION[:3], 0.3, 145.0, *OIL, P)),
    (catalogue.drag_torque, (150.0, 2500.0, 0.0, 19e-6, P)),
    *((loaded_drag, (P, MOTION, law, OIL_STATE)) for law in (PALMGREN, SKF)),
]


@pytest.mark.parametrize(("kernel", "args"), CASES, ids=lambda x: getattr(x, "__name__", ""))
def test_compiled_kernel_equals_its_source(kernel, args):
    # a product and a sum rounded once instead of twice, amplified by 1 - y^9/x
    assert kernel(*args) == pytest.approx(kernel.py_func(*args), rel=1e-13)


def test_compiled_roller_loads_equal_their_source():
    one, two = np.zeros(12), np.zeros(12)
    assert roller_loads.roller_loads(*SHAFT, 1.0, one) == 0
    assert roller_loads.roller_loads.py_func(*SHAFT, 1.0, two) == 0
    assert one == pytest.approx(two, rel=1e-13)


def test_films_of_rollers_are_those_of_the_formula_under_their_loads():
    compiled, source = np.zeros(12), np.zeros(12)
    assert roller_loads.roller_films(MOTION, *OIL, P, 1.0, compiled) == 0
    assert roller_loads.roller_films.py_func(MOTION, *OIL, P, 1.0, source) == 0
    assert compiled == pytest.approx(source, rel=1e-13)
    # without velocities and hysteresis a load is that of its film alone
    still = MOTION._replace(v1=0.0, v2=0.0, v_axial=0.0)
    lossless = P._replace(loss=0.0, cage_ratio=0.0, squeeze=0.0)
    loads = np.zeros(12)
    roller_loads.roller_loads(still, 300.0, *OIL, lossless, 1.0, loads)
    bearing = TaperedRollerBearing.mohammadpour_2015()
    shape = 0.5 * bearing.roller_diameter, pi_contact_modulus(bearing.solid, bearing.solid)
    u = P.film_speed_radius * MOTION.speed
    expected = [film.central_film(load, u, 0.0, *OIL, *shape) for load in loads]
    assert compiled == pytest.approx(expected, rel=1e-6)
    assert roller_loads.roller_films(MOTION, *OIL, P, 1.0, np.zeros(3)) == 1
    without = P._replace(film_constant=0.0)
    roller_loads.roller_films(MOTION, *OIL, without, 1.0, compiled)
    assert not compiled.any()


def test_compiled_rotor_equals_its_source():
    results = []
    for function in (standalone.rotor_history, standalone.rotor_history.py_func):
        states, loads = np.zeros((5, 6)), np.zeros((5, 12))
        s = np.array([1e-6, 0, 0, 1e-3, 0, 0])
        args = (s, 1e-5, 2, ROTOR, states, loads, np.zeros((5, 6)))
        assert function(*args) == 0
        results.append(np.append(states.ravel() / (np.abs(states).max(axis=0).sum()), loads))
    assert results[0] == pytest.approx(results[1], rel=1e-12, abs=1e-15)
    rate = np.zeros((2, 6))
    args = (s, 0.1, ROTOR)
    standalone.rotor_rate(*args, rate[0])
    standalone.rotor_rate.py_func(*args, rate[1])
    assert rate[0] == pytest.approx(rate[1], rel=1e-13)


def test_relaxed_sums_change_the_forces_by_rounding_only():
    """Everything interpreted, so that no compiled callee hides a difference."""
    code = (
        "import json\n"
        "from gearlube_core.bearings.bearing_type import ShaftMotion\n"
        "from gearlube_core.bearings.parameters import BearingParameters\n"
        "from gearlube_core.bearings.tapered_roller_kernels import shaft_bearing_forces\n"
        f"p = BearingParameters(*{list(P)!r})\n"
        f"a = {[list(a) for a in _grid()]!r}\n"
        "print(json.dumps([shaft_bearing_forces(ShaftMotion(*x[:8]), *x[8:], p) for x in a]))\n"
    )
    env = dict(os.environ, NUMBA_DISABLE_JIT="1")
    out = subprocess.run(
        [sys.executable, "-c", code], env=env, capture_output=True, text=True, check=True
    )
    for args, expected in zip(_grid(), json.loads(out.stdout), strict=True):
        F = tapered_roller_kernels.shaft_bearing_forces(ShaftMotion(*args[:8]), *args[8:], P)
        # 24 rollers of 1 kN summed in another order: a few 1e-16 each
        assert F[:6] == pytest.approx(expected[:6], rel=0, abs=1e-14 * 24e3)
        assert F[6] == pytest.approx(expected[6], rel=1e-12)


def _grid():
    generator = np.random.default_rng(7)
    for _ in range(20):
        u = generator.normal(size=3) * 4e-6
        v = generator.normal(size=3) * 3e-3
        yield (*u.tolist(), *v.tolist(), float(generator.uniform(0, 6)), 145.0, 300.0, *OIL)


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
