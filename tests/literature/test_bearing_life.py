"""Life of bearings by ISO 281 and ISO/TS 16281: closed forms and calculated examples."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.errors import ParameterError
from gearlube_core.rating.bearing_life import CLEANLINESS, RatedBearing, bearing_life

# the roller bearing of the calculated example: 12 kN at 1500 1/min in 20 mm2/s
EXAMPLE = RatedBearing(
    kind="radial_roller", dynamic_rating=80e3, fatigue_limit=8.5e3, pitch_diameter=62.7e-3,
    elements=16, element_diameter=9e-3,
)  # fmt: skip
SPEED = 1500.0 * math.pi / 30.0
BALL = RatedBearing(
    kind="radial_ball", dynamic_rating=52.7e3, static_rating=31.5e3, pitch_diameter=72.5e-3,
    elements=8, element_diameter=17.5e-3, grooves=(0.515, 0.53),
)  # fmt: skip
RATED = {"speed": SPEED, "viscosity": 20e-6, "cleanliness": "-/17/14"}


@pytest.mark.parametrize(
    ("cleanliness", "e_C", "a_iso", "hours"),
    [
        ("-/13/10", 0.8575, 3.0147, 18_679.0),
        ("-/15/12", 0.3888, 1.0493, 6_502.0),
        ("-/17/14", 0.2039, 0.5816, 3_604.0),
        ("-/19/16", 0.1070, 0.3779, 2_342.0),
    ],
)
def test_the_example_has_its_calculated_life(cleanliness, e_C, a_iso, hours):
    life = bearing_life(EXAMPLE, load=12e3, **{**RATED, "cleanliness": cleanliness})
    assert life.kappa == pytest.approx(1.3630, abs=5e-5)
    assert life.basic == pytest.approx(557.65e6, rel=1e-5)
    assert life.hours[0] == pytest.approx(6196.0, rel=1e-4)
    assert life.contamination == pytest.approx(e_C, abs=5e-5)
    assert life.a_iso == pytest.approx(a_iso, rel=3e-4)  # printed digits
    assert life.hours[1] == pytest.approx(hours, rel=3e-4)
    assert life.standard == "ISO 281:2007"


@pytest.mark.parametrize("kind", ["radial_ball", "radial_roller", "thrust_ball", "thrust_roller"])
@pytest.mark.parametrize("border", [0.4, 1.0])
def test_the_laws_of_a_iso_meet_at_their_borders(kind, border):
    one = replace(EXAMPLE, kind=kind)
    nu_1 = 14.673e-6
    below, above = (
        bearing_life(one, load=12e3, **{**RATED, "viscosity": nu_1 * border * factor}).a_iso
        for factor in (0.9999, 1.0001)
    )
    assert below == pytest.approx(above, rel=2e-3)  # constants have five digits


def test_reliability_additives_and_the_bounds_of_a_iso():
    def life(**changes):
        return bearing_life(EXAMPLE, **{**RATED, "load": 12e3, "cleanliness": "-/13/10", **changes})

    assert life(reliability=99).modified == pytest.approx(0.25 * life().modified)
    assert life(load=1e3).a_iso == 50.0
    thin = life(viscosity=5e-6)
    helped = life(viscosity=5e-6, additives=True)
    assert thin.a_iso < helped.a_iso <= 3.0
    assert life(viscosity=1.0).a_iso == life(viscosity=0.5).a_iso  # kappa counts up to 4


def test_a_film_gives_kappa_by_its_power():
    changed = {**RATED, "viscosity": None, "film_ratio": 1.363 ** (1.0 / 1.3)}
    found = bearing_life(EXAMPLE, load=12e3, **changed)
    assert found.a_iso == pytest.approx(0.5816, rel=3e-4)


def test_what_is_missing_or_outside_is_said_and_the_number_withheld():
    thin = bearing_life(EXAMPLE, load=12e3, **{**RATED, "viscosity": 1e-6})
    assert math.isnan(thin.modified)
    assert thin.basic == pytest.approx(557.65e6, rel=1e-5)
    assert "kappa from 0.1 on, got 0.0682" in thin.outside[0]
    bare = bearing_life(replace(EXAMPLE, fatigue_limit=None), load=12e3, **RATED)
    assert math.isnan(bare.a_iso)
    assert "got neither" in bare.outside[0]
    # the modified life stands, though C_u follows from C_0 by a formula from memory
    large = replace(EXAMPLE, fatigue_limit=None, static_rating=70e3, pitch_diameter=0.15)
    found = bearing_life(large, load=12e3, **RATED)
    assert "above 100 mm is a formula from memory" in found.outside[0]
    assert found.a_iso > 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"load": None}, "Give load or element_loads, one of them"),
        ({"load": -1.0}, "load must be above 0 N"),
        ({"viscosity": None}, "Give viscosity or film_ratio, one of them"),
        ({"cleanliness": "clean"}, "cleanliness must be one of -/13/10"),
        ({"reliability": 91}, "reliability must be one of 90, 95"),
        ({"load": None, "element_loads": np.ones(3)}, "a load of each of 16 elements"),
        ({"load": None, "element_loads": -np.ones(16)}, "not negative"),
    ],
)
def test_conditions_that_cannot_be_rated_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        bearing_life(EXAMPLE, **{**RATED, "load": 12e3, **changes})


def half_loaded(count: int, power: float) -> np.ndarray:
    """Loads of a zone of 180 degrees, the most loaded 1."""
    cos = np.cos(2.0 * np.pi * np.arange(count) / count)
    return np.maximum(cos, 0.0) ** power


@pytest.mark.parametrize(
    ("bearing", "power", "p"), [(BALL, 1.5, 3.0), (EXAMPLE, 10.0 / 9.0, 10.0 / 3.0)]
)
def test_a_radial_load_without_clearance_gives_the_life_of_the_catalogue(bearing, power, p):
    many = replace(bearing, elements=400)
    loads = half_loaded(400, power)
    F = float((loads * np.cos(2.0 * np.pi * np.arange(400) / 400)).sum())
    loads *= 0.15 * bearing.dynamic_rating / F
    life = bearing_life(many, element_loads=loads, **RATED)
    # balls: (C/P)^3; rollers have the power 4 of slices, so that both laws meet at P = C
    share = 0.15 if p == 3.0 else 0.15 ** (4.0 / p)
    assert life.basic == pytest.approx(1e6 * share**-p, rel=0.02)  # the shares have three digits
    assert life.standard == "ISO/TS 16281:2008"


@pytest.mark.parametrize("slices", [1, 2, 30, 47])
def test_equal_slices_give_one_life(slices):
    Q = 1e3
    loads = np.full((16, slices), Q / slices)
    q_ci, q_ce = EXAMPLE.race_ratings()
    closed = ((q_ci / Q) ** -4.5 + (q_ce / Q) ** -4.5) ** (-8.0 / 9.0)
    life = bearing_life(EXAMPLE, element_loads=loads, **RATED)
    assert life.basic == pytest.approx(1e6 * closed, rel=1e-12)
    assert life.a_iso == pytest.approx(
        bearing_life(EXAMPLE, load=life.load, **RATED).a_iso, rel=1e-9
    )


def test_rows_share_the_load_as_the_rating_of_several_rows_says():
    Q = 2e3
    one = bearing_life(BALL, element_loads=np.full(8, Q), **RATED).basic
    two = bearing_life(
        replace(BALL, rows=2, dynamic_rating=BALL.dynamic_rating * 2.0**0.7),
        element_loads=np.full((2, 8), Q), **RATED,
    ).basic  # fmt: skip
    assert two == pytest.approx(2.0 ** (-0.9) * one, rel=1e-9)


def test_misaligned_rollers_and_their_ends_last_less():
    even = np.full((16, 31), 30.0)
    tilted = even * np.linspace(0.4, 1.6, 31)
    lives = [bearing_life(EXAMPLE, element_loads=q, **RATED).basic for q in (even, tilted)]
    share = (np.linspace(0.4, 1.6, 31) ** 4.5).mean()
    assert lives[1] == pytest.approx(share ** (-8.0 / 9.0) * lives[0], rel=1e-9)
    # three slices: 1 - 0.01/ln(1.985 |2 k - 4|/4) at the ends, ratings over 0.83
    end = 1.0 - 0.01 / math.log(1.985 * 0.5)
    slices = 400.0 * np.array([end, 1.0, end])
    q_ci, q_ce = (q * 3.0 ** (-7.0 / 9.0) / 0.83 for q in EXAMPLE.race_ratings())
    closed = ((slices / q_ci) ** 4.5 + (slices / q_ce) ** 4.5).sum() ** (-8.0 / 9.0)
    found = bearing_life(EXAMPLE, element_loads=np.full((16, 3), 400.0), end_loads=True, **RATED)
    assert found.basic == pytest.approx(1e6 * closed, rel=1e-9)


def test_the_standing_ring_has_the_higher_exponent():
    loads = 2e3 * half_loaded(16, 10.0 / 9.0)
    turning, standing = (
        bearing_life(EXAMPLE, element_loads=loads, inner_turns=turns, **RATED).basic
        for turns in (True, False)
    )
    # the inner race, more curved, is the worse one: it lasts less where it stands in the load
    assert standing < turning


def test_loads_of_elements_bear_the_load_of_the_bearing():
    balls = gl.train.BallBearing(
        name="6205", body="shaft", n_balls=9, ball_diameter=7.94e-3, pitch_diameter=38.5e-3,
        inner_groove=0.52, outer_groove=0.53, f0=2.0, f1=3e-4,
    )  # fmt: skip
    found = gl.bearing.bearing_under_load(balls, [1500.0, 800.0, 400.0, 2.0, -1.0], cage_angle=0.3)
    loads = gl.bearing.element_loads(balls, found.displacement, cage_angle=0.3)
    assert loads.max() == pytest.approx(found.loads.largest, rel=1e-9)
    rollers = gl.train.CylindricalBearing(
        name="right", body="shaft", n_rollers=13, roller_diameter=9e-3, roller_length=9e-3,
        pitch_diameter=47e-3, clearance=2e-5, f0=2.0, f1=3e-4, laminae=31,
    )  # fmt: skip
    found = gl.bearing.bearing_under_load(rollers, [5000.0, 1000.0, 0.0, 5.0, 3.0], cage_angle=0.2)
    loads = gl.bearing.element_loads(rollers, found.displacement, cage_angle=0.2)
    angle = 0.2 + 2.0 * np.pi * np.arange(13) / 13
    assert loads.shape == (13, 31)
    assert (loads.sum(axis=1) * np.cos(angle)).sum() == pytest.approx(5000.0, rel=1e-6)
    assert (loads.sum(axis=1) * np.sin(angle)).sum() == pytest.approx(1000.0, rel=1e-6)


def test_the_classes_of_cleanliness_are_in_order():
    def of(start: str) -> list[float]:
        keys = [k for k in CLEANLINESS if k.startswith(start)]
        return [
            bearing_life(EXAMPLE, load=12e3, **{**RATED, "cleanliness": k}).modified for k in keys
        ]

    for start in ("-/", "bath", "grease"):
        assert of(start) == sorted(of(start), reverse=True)


def test_loads_of_tapered_rollers_bear_both_loads_and_a_loose_row_is_refused():
    geometry = BearingFile.named("wingertszahn_2023").geometry()
    loads = gl.bearing.tapered_loads(geometry, axial_load=6000.0, radial_load=5000.0)
    angle, a = 2.0 * np.pi * np.arange(loads.size) / loads.size, geometry.outer_angle
    assert loads.sum() * math.sin(a) == pytest.approx(6000.0, rel=1e-6)
    assert (loads * np.cos(angle)).sum() * math.cos(a) == pytest.approx(5000.0, rel=1e-6)
    with pytest.raises(ParameterError, match="axial_load must hold the rollers"):
        gl.bearing.tapered_loads(geometry, axial_load=100.0, radial_load=5000.0)


def test_a_groove_that_is_none_is_refused():
    with pytest.raises(ParameterError, match=r"groove of the outer ring must be within 0\.501"):
        replace(BALL, grooves=(0.52, 0.5))
