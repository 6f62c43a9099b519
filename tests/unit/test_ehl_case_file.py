"""Files of film cases, and sections through them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube.studies.films.run_steady import run_point
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import thermal_viscosity
from gearlube_core.oil.film_oil_data import check_warms
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.each import each

OIL = {"viscosity_pa_s": 0.02, "pressure_viscosity_per_gpa": 18.0}
SHARED = {"name": "own", "source": "test", "speed_1_m_s": 3.0, "speed_2_m_s": 1.0, "oil": OIL}
LINE = {**SHARED, "radius_mm": 20.0, "load_n_per_mm": 150.0}
POINT = {**SHARED, "radius_x_mm": 12.0, "radius_y_mm": 60.0, "load_n": 80.0}


def line(**changes):
    return LineCase.from_data({**LINE, **changes}, "own.toml")


def point(**changes):
    return PointCase.from_data({**POINT, **changes}, "own.toml")


@pytest.mark.parametrize("kind", [LineCase, PointCase])
def test_every_shipped_case_is_a_problem(kind):
    assert kind.shipped()
    for name in kind.shipped():
        case = kind.named(name)
        assert case.name == name
        assert case.problem().lubricant.eta0 == pytest.approx(case.oil.viscosity_pa_s)


def test_the_line_of_the_thesis_is_its_table_7_1():
    problem = LineCase.named("jamali_2015").problem()
    assert problem.radius == pytest.approx(0.014)
    assert problem.line_load == pytest.approx(720.0 / 0.002)
    assert problem.entrainment_speed == pytest.approx(6.71)
    slide_roll = (problem.speed_1 - problem.speed_2) / problem.entrainment_speed
    assert slide_roll == pytest.approx(0.36)


def test_mouriers_contact_has_the_groups_of_its_source():
    # M 63.78, L 5.788 in the open solver ErikHansenGit/EHL
    problem = PointCase.named("mourier_2006").problem()
    E, R = 2.0 * problem.contact_modulus, problem.hertz.R_x
    U = 0.25 * problem.entrainment[0] / (E * R)
    assert problem.load / (E * R**2) * (2.0 * U) ** -0.75 == pytest.approx(63.78, rel=1e-3)
    assert pytest.approx(5.788, rel=1e-3) == 22e-9 * E * (2.0 * U) ** 0.25


def test_a_line_is_read_in_engineers_units():
    oil = {**OIL, "eyring_stress_mpa": 5.0, "temperature_degc": 60.0}
    case = line(oil=oil, domain={"first_mm": -1.0, "last_mm": 0.5}, solver={"nodes": 201})
    problem = case.problem()
    assert (problem.radius, problem.line_load) == pytest.approx((0.02, 1.5e5))
    assert problem.extent() == pytest.approx((-1e-3, 0.5e-3))
    assert problem.lubricant.shear.tau0 == pytest.approx(5e6)
    assert problem.lubricant.temperature == pytest.approx(333.15)
    assert case.settings().nodes == 201


def test_modulus_of_the_bodies_is_that_of_hertz_and_gives_way_to_a_given_one():
    # steel 210 GPa, 0.3: E' = 2 E* = E/(1 - nu^2)
    assert line().problem().reduced_modulus == pytest.approx(210e9 / (1.0 - 0.09))
    glass = {"youngs_modulus_gpa": 75.0, "poisson_ratio": 0.22}
    compliance = (1.0 - 0.22**2) / 75e9 + 0.91 / 210e9
    assert point(body_1=glass).problem().contact_modulus == pytest.approx(1.0 / compliance)
    assert line(reduced_modulus_gpa=110.0).problem().reduced_modulus == pytest.approx(110e9)


def test_side_speeds_turn_entrainment_and_sliding():
    case = point(side_speed_1_m_s=0.5, side_speed_2_m_s=1.5)
    assert case.problem().entrainment == pytest.approx((2.0, 1.0))
    assert case.sliding == pytest.approx((-2.0, 1.0))


def test_an_oil_of_the_library_comes_at_its_temperature():
    oil = {"library": "karagiannis_2012", "temperature_degc": 80.0, "shear": "newtonian"}
    lubricant = line(oil=oil).problem().lubricant
    viscosity = Lubricant.named("karagiannis_2012").dynamic_viscosity(353.15)
    assert lubricant.eta0 == pytest.approx(viscosity)
    assert lubricant.shear.tau0 == 0.0


@pytest.mark.parametrize("build", [line, point])
def test_an_oil_of_the_library_warms_in_a_thermal_film(build):
    oil = {"library": "karagiannis_2012", "temperature_degc": 60.0, "expansion_per_k": 7e-4}
    warm = build(oil=oil, temperature="thermal").problem().lubricant
    own = Lubricant.named("karagiannis_2012")
    # Houpert's law through 40 and 100 degC is within 3 % of Walther's line
    for T in (333.15, 353.15, 373.15):
        eta = thermal_viscosity(warm, 0.0, T)
        assert eta == pytest.approx(own.dynamic_viscosity(T), rel=0.03)
    assert warm.expansion == 7e-4
    check_warms(warm)
    for cold in (build(oil=oil), build(oil=OIL | {"law": "houpert"})):
        with pytest.raises(ParameterError, match="leave both out"):
            check_warms(cold.problem().lubricant)
    assert build(oil=OIL | {"temperature_exponent": 1.1}).problem().lubricant.viscosity.S0 == 1.1


OWN_OIL = """
name = "75W-90"
base_oil = "pao"
density_kg_m3 = 868.0
viscosity_40_degc_mm2_s = 102.0
viscosity_100_degc_mm2_s = 15.1
"""


def test_an_oil_file_is_named_from_the_folder_of_the_case(tmp_path):
    (tmp_path / "oil.toml").write_text(OWN_OIL)
    (tmp_path / "cases").mkdir()
    path = tmp_path / "cases" / "line.toml"
    fields = "".join(f"{key} = {value!r}\n" for key, value in LINE.items() if key != "oil")
    path.write_text(f'{fields}[oil]\nlibrary = "../oil.toml"\ntemperature_degc = 100.0\n')
    lubricant = LineCase.from_toml(path).problem().lubricant
    # 15.1 mm2/s times 868 kg/m3 less 0.6 kg/(m3.K) from 15 to 70 degC: a model has one density
    assert lubricant.eta0 == pytest.approx(15.1e-6 * (868.0 - 0.6 * 55.0), rel=1e-6)
    (tmp_path / "oil.toml").write_text(OWN_OIL.replace("name", "nam"))
    with pytest.raises(ParameterError, match="is it name"):
        LineCase.from_toml(path).problem()


@pytest.mark.parametrize(
    ("entrainment", "slide_roll", "speeds"),
    [(None, None, (3.0, 1.0)), (4.0, None, (6.0, 2.0)), (None, 0.0, (2.0, 2.0)),
     (1.0, -0.5, (0.75, 1.25))],
)  # fmt: skip
def test_another_speed_keeps_the_slide_roll_ratio_and_the_other_way_round(
    entrainment, slide_roll, speeds
):
    case = line().moved(entrainment, slide_roll)
    assert (case.speed_1_m_s, case.speed_2_m_s) == pytest.approx(speeds)


def test_a_ratio_needs_a_mean_speed():
    with pytest.raises(ParameterError, match="mean speed of 0"):
        line(speed_2_m_s=-3.0).moved(None, 0.5)


@each(
    ("build", "changes", "words"),
    [
        (line, {"radius_mm": -3.0}, ["radius_mm", "-3", "mm"]),
        (line, {"load_n_per_mm": math.nan}, ["load_n_per_mm"]),
        (line, {"radiusmm": 3.0}, ["radiusmm", "radius_mm"]),
        (line, {"domain": {"first_mm": 1.0, "last_mm": -1.0}}, ["domain"]),
        (line, {"oil": {"viscosity_pa_s": 0.02}}, ["pressure_viscosity_per_gpa", "missing"]),
        (line, {"oil": {**OIL, "library": "karagiannis_2012"}}, ["viscosity_pa_s", "library"]),
        (line, {"oil": {"library": "no_such_oil"}}, ["no_such_oil"]),
        (
            line,
            {"oil": {"library": "karagiannis_2012", "temperature_exponent": 1.1}},
            ["temperature_exponent", "library"],
        ),
        (line, {"oil": {**OIL, "law": "reynolds"}}, ["oil.law", "barus or roelands"]),
        (line, {"oil": {**OIL, "limiting_stress_slope": 0.05}}, ["limiting_stress_mpa"]),
        (line, {"solver": {"stencil": "galerkin", "cavitation": "mass_conserving"}}, ["galerkin"]),
        (point, {"solver": {"nodes_x": 3}}, ["nodes_x", "17"]),
        (point, {"speed_2_m_s": -3.0}, ["entrainment", "0"]),
        (point, {"load_n_per_mm": 3.0}, ["load_n_per_mm"]),
    ],
)
def test_what_is_wrong_is_named(build, changes, words):
    with pytest.raises(ParameterError) as refusal:
        build(**changes)
    for word in words:
        assert word in str(refusal.value)


def test_an_unknown_name_lists_the_shipped_cases():
    with pytest.raises(ParameterError, match=r"No line contact .* jamali_2015"):
        LineCase.named("mourier_2006")


def test_a_point_slides_by_the_difference_of_its_speeds():
    speeds = {"side_speed_1_m_s": 0.5, "side_speed_2_m_s": 1.5}
    for oil in (OIL, {**OIL, "eyring_stress_mpa": 5.0}):
        assert point(oil=oil, **speeds).problem().sliding == pytest.approx((-2.0, 1.0))


def test_a_point_contact_is_discretised_as_its_file_says():
    assert point().settings().discretisation == "differences"
    case = point(solver={"discretisation": "elements"})
    assert case.settings().discretisation == "elements"
    with pytest.raises(ParameterError, match=r"solver\.discretisation must be a text, differences"):
        point(solver={"discretisation": "volumes"})


def test_a_starved_point_needs_its_cavitation():
    solver = {"cavitation": "mass_conserving"}
    case = point(inlet_layer_um=0.25, solver=solver)
    assert case.problem().inlet_layer == pytest.approx(2.5e-7)
    assert case.settings().cavitation == "mass_conserving"
    # oil beyond the border would flood it
    assert not case.problem().oil_beyond
    for changes, words in (
        ({"inlet_layer_um": 0.25}, "a starved inlet needs cavitation mass_conserving"),
        ({"inlet_layer_um": 0.0, "solver": solver}, "inlet_layer_um"),
        (
            {"inlet_layer_um": 0.25, "solver": solver, "domain": {"oil_beyond": True}},
            "oil_beyond floods the border",
        ),
        ({"solver": {**solver, "discretisation": "elements"}}, "elements cannot be combined"),
    ):
        with pytest.raises(ParameterError, match=words):
            point(**changes)


SMALL = {"solver.nodes_x": 97, "solver.nodes_y": 16 + 2}


def section(**changes) -> PointCase:
    return PointCase.named("jamali_2015_section").varied(SMALL | changes)


def test_the_section_of_the_thesis_is_its_line_contact():
    part, line = PointCase.named("jamali_2015_section").problem(), LineCase.named("jamali_2015")
    smooth = line.problem()
    assert part.line_load == pytest.approx(smooth.line_load)
    assert part.hertz_contact[0] == pytest.approx(smooth.half_width)
    assert part.hertz_contact[2] == pytest.approx(smooth.hertz_pressure)
    assert part.entrainment == pytest.approx((smooth.entrainment_speed, 0.0))
    assert part.x_limits == pytest.approx((-2.5 * smooth.half_width, 1.5 * smooth.half_width))
    assert part.sides == "cyclic"


def test_its_dataset_has_the_dry_pressure_and_the_formulas_of_a_line():
    found = run_point(section())
    x = found["x"].values
    dry = found["hertz_pressure"].values
    half_width, most = found.attrs["semi_axis_x"], found.attrs["hertz_pressure_max"]
    expected = most * np.sqrt(np.maximum(1.0 - (x / half_width) ** 2, 0.0))
    assert dry == pytest.approx(np.tile(expected[:, None], 18))
    assert math.isinf(found.attrs["radius_y"])
    names = {str(one) for one in found["formula_source"].values}
    assert names == {"Dowson and Toyoda 1979", "Dowson 1968"}
    assert found.attrs["friction_coefficient"] == pytest.approx(0.031, abs=1e-3)


def test_waves_that_repeat_over_the_length_are_taken_and_others_refused():
    # crests along x: 2 mm are 4 waves of 0.5 mm
    waves = {"amplitude_um": 0.1, "wavelength_mm": 0.5, "direction_deg": 90.0}
    grid = {"solver.nodes_y": 64}
    repeating = section(waviness=waves, **grid).problem()
    first, last = (repeating.gap(np.zeros(1), np.array([y])) for y in repeating.y_limits)
    assert first == pytest.approx(last)
    with pytest.raises(ParameterError, match="must repeat over the length of 2 mm"):
        section(waviness=waves | {"wavelength_mm": 0.6}, **grid)


@each(
    ("changes", "words"),
    [
        ({"length_mm": None}, "length_mm must be given and radius_y_mm left out"),
        ({"radius_y_mm": 14.0}, "length_mm must be given and radius_y_mm left out"),
        ({"side_conditions": "ambient"}, "radius_y_mm must be given and length_mm left out"),
        ({"solver.nodes_y": 33}, "nodes along y must be even"),
        ({"side_speed_1_m_s": 1.0}, "entrainment along y must be 0 m/s"),
        ({"domain.oil_beyond": True}, "oil_beyond and inlet_layer cannot be combined with"),
        ({"solver.cavitation": "mass_conserving"}, "needs sides ambient, got cyclic"),
    ],
)
def test_wrong_sections_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        section(**changes)


def test_thermal_sections_are_refused():
    oil = {"oil.law": "houpert", "oil.temperature_exponent": 1.0}
    with pytest.raises(ParameterError, match="a thermal film needs sides ambient, got cyclic"):
        section(temperature="thermal", **oil)
