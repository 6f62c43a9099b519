"""Case files of rough line contacts: what they become, and which are refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gearlube.studies.films.rough import run as rough_run
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError
from gearlube_core.surface.files import write_surface
from gearlube_core.surface.heights import Profile
from tests.helpers.each import each

WAVE = {"amplitude_um": 0.1, "period_um": 100.0, "turns": 1}
CASE: dict[str, Any] = {
    "name": "waves",
    "source": "made up",
    "radius_mm": 14.0,
    "load_n_per_mm": 360.0,
    "length_mm": 1.0,
    "speed_1_m_s": 7.9285,
    "speed_2_m_s": 5.4915,
    "reduced_modulus_gpa": 227.5,
    "oil": {
        "viscosity_pa_s": 0.00625,
        "pressure_viscosity_per_gpa": 13.3,
        "eyring_stress_mpa": 10.0,
    },
    "surface_1": WAVE,
    "solver": {"nodes_x": 201, "rows": 32},
    "times": {"steps_per_half_width": 100},
}


def case(**changes: Any) -> RoughCase:
    return RoughCase.from_data(CASE, "waves").varied(changes)


def test_the_contact_of_the_thesis():
    # Table 7.1: a 237.7 um with E' 227.5 GPa, p 0.965 GPa, 720 N over 2 mm
    section = case(length_mm=2.0).section()
    a, half_length, pressure = section.hertz_contact
    assert a == pytest.approx(math.sqrt(8 * 3.6e5 * 0.014 / (math.pi * 227.5e9)))
    assert pressure == pytest.approx(2 * 3.6e5 / (math.pi * a))
    assert section.load == pytest.approx(720.0)
    assert half_length == pytest.approx(1e-3)
    assert section.x_limits == pytest.approx((-2.5 * a, 1.5 * a))


def test_the_time_steps_of_the_thesis():
    # 2888 until both are rough, 1600 more, half a column of a/200 a step
    schedule = case(**{"times.steps_per_half_width": 400}).schedule()
    assert (schedule.until_rough, schedule.rough) == (2888, 1600)
    a = case().section().hertz_contact[0]
    assert schedule.time_step * 7.9285 == pytest.approx(a / 400.0)


def test_a_sine_leans_by_its_turns_and_moves_with_its_surface():
    rough = case(**{"times.feed": "in_place"}).roughness()
    t = 3.0 * rough.rough_time
    x, y = rough.x[:, None], rough.y[None, :]
    wave = 1e-7 * np.cos(2.0 * np.pi * ((x - 7.9285 * t) / 1e-4 - y / 1e-3))
    # a spline through 256 points of a wave: (2 pi/256)^4/400
    assert rough.height(t) == pytest.approx(wave, abs=1e-9 * 1e-7 * 1e4)


def test_the_second_surface_of_a_stand_in_is_the_slow_part():
    given = {
        "surface_1": {"stand_in": "A", "turns": 1, "cutoff_um": 60.0},
        "surface_2": {"stand_in": "A", "turns": 1, "cutoff_um": 60.0},
        "solver.nodes_x": 241,
    }
    fast, slow = case(**given).surfaces()
    assert (fast.period, slow.period) == pytest.approx((149e-6, 100e-6), rel=1e-2)
    swapped = {"speed_1_m_s": 5.4915, "speed_2_m_s": 7.9285}
    first, second = case(**given, **swapped).surfaces()
    assert (first.period, second.period) == pytest.approx((100e-6, 149e-6), rel=1e-2)
    # 8.475 and 5.711 deg [jamali_2015 section 7.6]
    angles = [math.degrees(one.lay.angle) for one in (fast, slow)]
    assert angles == pytest.approx([8.475, 5.711], abs=0.02)


def test_generated_heights_have_their_ra_and_seed():
    made = {"ra_um": 0.1, "period_um": 1000.0, "shortest_um": 40.0, "correlation_um": 17.0}
    one, again, other = (
        case(surface_1=made | {"seed": seed}).surfaces()[0].heights.height for seed in (1, 1, 2)
    )
    assert np.abs(one).mean() == pytest.approx(1e-7, rel=1e-6)
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)


def test_a_part_of_a_profile_counts_from_the_case_file(tmp_path):
    x = 1e-6 * np.arange(1500.0)
    height = 1e-7 * (np.sin(2 * np.pi * x / 90e-6) + 0.5 * np.sin(2 * np.pi * x / 130e-6 + 1.0))
    write_surface(Profile(height=height, spacing=1e-6), tmp_path / "disc.csv")
    text = "\n".join(
        [
            *(f"{k} = {v!r}".replace("'", '"') for k, v in CASE.items() if not isinstance(v, dict)),
            *(
                f"[{k}]\n" + "\n".join(f"{n} = {one}" for n, one in v.items())
                for k, v in CASE.items()
                if isinstance(v, dict) and k != "surface_1"
            ),
            '[surface_1]\nfile = "disc.csv"\nstart_um = 300.0\nperiod_um = 250.0\nturns = 1',
        ]
    )
    (tmp_path / "case.toml").write_text(text)
    (surface,) = RoughCase.from_toml(tmp_path / "case.toml").surfaces()
    assert surface.period == pytest.approx(250e-6)
    assert surface.lay.turns == 1


def test_kept_films_are_those_named_and_regular_ones():
    steps = case(**{"frames.every": 400, "frames.steps": [17, 5, 100000]}).kept_steps()
    assert steps == (0, 5, 17, 400, 800)


def test_the_key_knows_surfaces_and_grid_and_not_names():
    key = case().key()
    assert case(name="other", **{"frames.every": 7}).key() == key
    for change in (
        {"surface_1.amplitude_um": 0.11},
        {"solver.rows": 34},
        {"side_conditions": "no_flow"},
        {"times.rough": 5.0},
        {"solver.scheme": "crank_nicolson"},
    ):
        assert case(**change).key() != key


def test_the_key_knows_what_an_oil_file_says(tmp_path):
    oil = tmp_path / "oil.toml"
    text = 'name = "o"\nbase_oil = "pao"\ndensity_kg_m3 = 868.0\nviscosity_index = 150\n'
    keys = []
    for viscosity in (100.0, 101.0):
        oil.write_text(f"{text}viscosity_40_degc_mm2_s = {viscosity}\n")
        made = RoughCase.from_data({**CASE, "oil": {"library": str(oil)}}, "waves")
        keys.append(made.key())
    assert keys[0] != keys[1]


@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_a_march_stores_oil_by_the_scheme_of_its_case(scheme, monkeypatch):
    given = []

    class BegunError(Exception):
        pass

    def begin(film: object, step: float, **more: object) -> None:
        given.append(more["scheme"])
        raise BegunError

    monkeypatch.setattr(rough_run, "FilmMarch", begin)
    monkeypatch.setattr(rough_run, "Gathered", lambda case: None)
    with pytest.raises(BegunError):
        rough_run.run_rough(case(**{"solver.scheme": scheme}))
    assert given == [scheme]


@each(
    ("changes", "words"),
    [
        ({"surface_1": None}, "surface_1 and surface_2 are both missing"),
        ({"surface_1": {"turns": 1}}, "give one of file, stand_in, ra_um, amplitude_um, got none"),
        ({"surface_1": {"amplitude_um": 0.1}}, "period_um is missing"),
        ({"surface_1": WAVE | {"lay_deg": 3.0}}, "give one of turns and lay_deg"),
        # tan 7 deg over 1 mm are 1.228 periods of 100 um
        ({"surface_1": WAVE | {"turns": None, "lay_deg": 7.0}}, "must be an angle that closes"),
        ({"surface_1.period_um": 10.0}, "8 nodes a wave along x"),
        ({"surface_1.turns": 20}, "8 nodes a wave along y"),
        # rms slope 2 pi 5/100/sqrt(2)
        ({"surface_1.amplitude_um": 5.0}, "slope along x must be at most 0.2"),
        ({"surface_1.amplitude_um": 1e-4}, "a thousand times too small"),
        ({"solver.rows": 14}, "solver.rows must be a whole number, 16 to 2048, got 14"),
        ({"solver.rows": 33}, "solver.rows: the number of rows must be even, got 33. Take 34"),
        # 4 a are 950.1 um, 217.2 steps of 35/8 um; 20 turns, eight rows each
        ({"surface_1.period_um": 35.0}, "8 nodes a wave along x.*Take 219 nodes along x or more"),
        ({"surface_1.turns": 20}, "Take 160 rows or more"),
        ({"surface_1.period_um": 0.1}, "surface_1.period_um must be .*Is it in mm"),
        ({"surface_1.period_um": 4000.0}, "shorter than the computed 0.95.. mm, got 4 mm"),
        # 0.965 GPa of the thesis times the root of a thousand
        ({"load_n_per_mm": 3.6e5}, "Hertz pressure must be at most 10 GPa, got 30.5"),
        ({"length_mm": 1000.0}, "length_mm must be .*Is it in um. 1000 um is 1 mm"),
        ({"times.steps_per_half_width": 40}, "time_step must be at most"),
        ({"speed_2_m_s": 0.0}, "must be above 0 m/s"),
        ({"side_conditions": "open"}, "side_conditions must be"),
        ({"solver.wedge": "upwind"}, "solver.wedge must be"),
        ({"surface_1": {"file": "none.csv"}}, "none.csv"),
    ],
)
def test_wrong_cases_are_refused_with_what_to_do(changes, words):
    given = {k: v for k, v in changes.items() if not isinstance(v, dict)}
    for name, section in changes.items():
        if isinstance(section, dict):
            given[name] = {k: v for k, v in section.items() if v is not None}
    with pytest.raises(ParameterError, match=words):
        case(**given)


def test_surfaces_of_equal_speed_take_as_many_steps_as_either_needs():
    rolling = case(speed_1_m_s=6.71, speed_2_m_s=6.71)
    assert rolling.section().sliding == (0.0, 0.0)
    # both surfaces move alike: as many steps for five half widths of either
    assert rolling.schedule().until_rough == 500


def test_elements_make_another_march_and_refuse_crank_nicolson():
    case = RoughCase.named("jamali_2015_a")
    elements = case.varied({"solver.discretisation": "elements"})
    assert elements.settings().discretisation == "elements"
    assert elements.key() != case.key()
    # records of before there was a choice belong to finite volumes
    assert case.varied({"solver.discretisation": "differences"}).key() == case.key()
    with pytest.raises(ParameterError, match=r"crank_nicolson, got elements.*Take bdf2"):
        elements.varied({"solver.scheme": "crank_nicolson"})
