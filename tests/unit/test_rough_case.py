"""Cases of rough films and their surfaces."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.films.rough import run as rough_run
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError
from gearlube_core.surface.files import write_surface
from gearlube_core.surface.heights import Profile
from gearlube_core.surface.measured_heights import (
    MeasuredMap,
    MeasuredProfile,
    read_map,
    read_profile,
)
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


@pytest.mark.slow
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


@pytest.mark.parametrize(("option", "value"), [("threads", -1), ("threads", 65), ("steps", 0)])
def test_a_wrong_option_of_a_march_is_refused_before_its_first_film(option, value, monkeypatch):
    monkeypatch.setattr(rough_run, "Gathered", None)  # its call would fail otherwise
    with pytest.raises(ParameterError, match=f"{option} must be within .*, got {value}"):
        rough_run.run_rough(case(), **{option: value})


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


X = np.array([-0.002, -0.0013, -0.0002, 0.0001, 0.0012, 0.0021])  # m
Y = np.array([0.001, 0.0014, 0.0023, 0.0031, 0.0034])


def cubic(x: np.ndarray) -> np.ndarray:
    return 2e-6 + 3e-3 * x - 4.0 * x**2 + 500.0 * x**3


def test_splines_of_measured_heights_are_exact_for_cubics():
    profile = MeasuredProfile(X, cubic(X))
    between = np.linspace(-0.002, 0.0021, 17)
    assert profile(between) == pytest.approx(cubic(between), rel=1e-9)
    surface = MeasuredMap(X, Y, cubic(X)[:, None] * (1.0 + 1e3 * Y - 2e8 * Y**3))
    y = np.linspace(0.001, 0.0034, 17)
    expected = cubic(between) * (1.0 + 1e3 * y - 2e8 * y**3)
    assert surface(between, y) == pytest.approx(expected, rel=1e-9)
    assert surface(between[:, None], y[:3]).shape == (17, 3)


def test_files_give_metres(tmp_path):
    table = tmp_path / "heights.csv"
    rows = "\n".join(f"{1e3 * x},{1e6 * z}" for x, z in zip(X, cubic(X), strict=True))
    table.write_text(f"# an instrument\nx_mm, height_um\n\n# more\n{rows}\n")
    profile = read_profile(table)
    assert profile.x == pytest.approx(X)
    assert profile.height == pytest.approx(cubic(X))
    assert profile.name == f"profile {table}"

    height = np.outer(cubic(X), Y)
    np.savez(tmp_path / "map.npz", x=1e3 * X, y=1e3 * Y, height=1e6 * height)
    data = {"height": (("y", "x"), 1e6 * height.T)}
    xr.Dataset(data, coords={"x": 1e3 * X, "y": 1e3 * Y}).to_netcdf(tmp_path / "map.nc")
    for name in ("map.npz", "map.nc"):
        stored = read_map(tmp_path / name)
        assert stored.x == pytest.approx(X)
        assert stored.y == pytest.approx(Y)
        assert stored.height == pytest.approx(height)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "must have a line of names"),
        ("x,height_um\n", "missing: x_mm; got x, height_um"),
        ("x_mm,height_um\n0,1\n1,2\n2;3,0,1\n", "line 4"),
    ],
)
def test_tables_of_another_kind_are_refused(tmp_path, text: str, words: str):
    table = tmp_path / "heights.csv"
    table.write_text(text)
    with pytest.raises(ParameterError, match=words):
        read_profile(table)
    with pytest.raises(ParameterError, match="table missing\\.csv was not found"):
        read_profile(tmp_path / "missing.csv")


def test_maps_of_another_kind_are_refused(tmp_path):
    np.savez(tmp_path / "map.npz", x=X, y=Y)
    with pytest.raises(ParameterError, match=r"'height.*' is missing|height.* is missing"):
        read_map(tmp_path / "map.npz")
    (tmp_path / "map.nc").write_text("no data")
    with pytest.raises(ParameterError, match="not a readable NetCDF"):
        read_map(tmp_path / "map.nc")


def test_places_must_rise_and_numbers_be_finite():
    four = np.array([0.0, 1.0, 2.0, 3.0]) * 1e-3
    assert MeasuredProfile(four, four)(1.5e-3) == pytest.approx(1.5e-3)
    with pytest.raises(ParameterError, match="at least 4 places along x"):
        MeasuredProfile(four[:3], four[:3])
    with pytest.raises(ParameterError, match="along x"):
        MeasuredProfile(four.reshape(1, 4), four)
    with pytest.raises(ParameterError, match=r"got 2 mm and then 1\.5 mm"):
        MeasuredProfile(np.array([0.0, 1.0, 2.0, 1.5, 3.0]) * 1e-3, np.zeros(5))
    with pytest.raises(ParameterError, match=r"shape \(4,\) of their places, got \(5,\)"):
        MeasuredProfile(four, np.zeros(5))
    heights = np.zeros((4, 4))
    heights[1, 2] = heights[3, 0] = math.nan
    with pytest.raises(ParameterError, match=r"2 of 16 numbers are not, the first at index \(1, 2"):
        MeasuredMap(four, four, heights)
    with pytest.raises(ParameterError, match="1 of 4 numbers are not, the first at index 3"):
        MeasuredProfile(four, np.array([0.0, 0.0, 0.0, math.inf]))


def test_grid_must_lie_within_the_places_but_for_rounding():
    places = np.linspace(-1e-3, 1e-3, 201)
    profile = MeasuredProfile(places, np.zeros(201))
    for less, more in ((1.0, 1.05), (1.05, 1.0)):  # 1e-6 of the range is rounding
        beyond = np.linspace(-1e-3 - less * 1e-6 * 2e-3, 1e-3 + more * 1e-6 * 2e-3, 81)
        with pytest.raises(ParameterError, match="must cover the domain -1 to 1 mm"):
            profile.check_serves(beyond)
    profile.check_serves(np.linspace(-1e-3 - 0.95e-9 * 2, 1e-3 + 0.95e-9 * 2, 81))


def test_grid_must_not_be_finer_than_the_places_on_it():
    # wide intervals beyond the grid do no harm
    places = np.array([-5.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 4.0]) * 1e-3
    surface = MeasuredMap(places, places, np.zeros((8, 8)))
    grid = np.linspace(-1e-3, 1e-3, 5)
    surface.check_serves(grid, grid)
    with pytest.raises(ParameterError, match=r"along y, 400 um, got places up to 500 .*most 5 "):
        surface.check_serves(grid, np.linspace(-1e-3, 1e-3, 6))
    with pytest.raises(ParameterError, match=r"along x, 1900 um, got places up to 3500 .*most 2 "):
        surface.check_serves(np.linspace(-1.8e-3, 2e-3, 3), grid)
    for share, served in ((0.95e-6, True), (1.05e-6, False)):
        finer = np.linspace(0.0, 0.5e-3 * (1.0 - share), 2)
        if served:
            surface.check_serves(finer, grid)
        else:
            with pytest.raises(ParameterError, match="along x"):
                surface.check_serves(finer, grid)
