"""Findings and key numbers of films, from datasets with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.films.findings import findings, numbers
from gearlube.studies.films.hypoid.summary import ratio_rows
from gearlube.studies.films.report import _tables, film_inputs, film_report
from gearlube.studies.films.results import summary_csv, summary_rows
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.known_answers import assert_cells, assert_findings, assert_numbers, quantities


def test_a_formula_whose_film_is_too_thick_for_its_radius_is_a_warning():
    one = line()
    assert not [f for f in findings(one) if "too thick" in f.headline]
    one["formula_film_over_radius"] = ("formula", [0.02, 0.008])
    (said,) = (f for f in findings(one) if "too thick" in f.headline)
    assert said.level == WARNING
    assert said.detail.startswith("The central film of A is 0.02 of the radius, above 0.01. Do")


def line(converged=1, error=0.01, **more):
    return xr.Dataset(
        {
            "formula_film": ("formula", np.array([0.30e-6, 0.24e-6])),
            "formula_source": ("formula", np.array(["A", "B"], dtype=object)),
            "formula_quantity": (
                "formula",
                np.array(["central film", "minimum film"], dtype=object),
            ),
        },
        coords={"x": np.linspace(0.0, 1.0, 11)},
        attrs={
            "contact": "line",
            "converged": converged,
            "outcome": "as it ended",
            "residual": 1e-9,
            "load_error": 1e-12,
            "error_central_film": error,
            "error_minimum_film": 0.5 * error,
            "error_pressure_max": float("nan"),
            "minimum_film": 0.2e-6,
            "central_film": 0.25e-6,
            "pressure_max": 1.1e9,
            "hertz_pressure_max": 1.0e9,
            "friction_coefficient": -0.03,
            "temperature_inlet": 313.15,
            "radius": 0.014,
            "line_load": 360e3,
        }
        | more,
    )


def cycle(failures=0):
    return xr.Dataset(
        {
            "pressure_max": ("step", np.array([0.8e9, 1.3e9, 1.0e9])),
            "minimum_film": ("step", np.array([0.3e-6, 0.25e-6, 0.1e-6])),
        },
        coords={"step": [10, 11, 12]},
        attrs={
            "contact": "helical_cycle",
            "converged": int(failures == 0),
            "failures": failures,
            "outcome": "as it ended",
        },
    )


def hypoid():
    """Loads 1 and 3: means count the second position three times."""
    at = "position"
    return xr.Dataset(
        {
            "steady_load": (at, np.array([100.0, 300.0])),
            "steady_phase": (at, np.array([-0.5, 0.5])),
            "steady_central_film": (at, np.array([0.2e-6, 0.4e-6])),
            "steady_minimum_film": (at, np.array([0.15e-6, 0.3e-6])),
            "steady_pressure_max": (at, np.array([0.5e9, 0.9e9])),
            "steady_traction_heated": (at, np.array([0.02, 0.03])),
            "steady_grid_error": (at, np.array([0.02, 0.14])),
            "chittenden_central": (at, np.array([0.4e-6, 0.4e-6])),
            "asperity_share": (at, np.array([0.05, 0.2])),
        },
        attrs={"contact": "hypoid", "converged": 1, "failures": 0, "outcome": "as it ended"},
    )


def test_an_ended_theory_and_a_cut_domain_are_warned_of():
    ended = " Thin-film theory has ended: the smallest film is 0.02 of the radius, above 0.01. More"
    found = findings(line(outcome=f"Converged.{ended}", domain_error_central_film=0.06))
    thin, domain = found[1], found[3]
    assert (thin.level, domain.level) == (WARNING, WARNING)
    assert "Thin-film theory has ended" in thin.headline
    assert thin.detail.startswith("The smallest film is 0.02 of the radius, above 0.01. Take")
    assert "The domain makes an error of about 6 % of the central film." in domain.headline
    calm = findings(line(domain_error_central_film=0.001))
    assert [one.level for one in calm[:3]] == [NOTE, GOOD, GOOD]


def headline(dataset, words):
    (one,) = [one for one in findings(dataset) if words in one.headline]
    return one


def test_a_film_that_did_not_converge_is_a_warning():
    assert not [one for one in findings(line()) if "NOT converge" in one.headline]
    failed = headline(line(converged=0), "NOT converge")
    assert (failed.level, failed.detail) == (WARNING, "as it ended")
    assert headline(cycle(failures=2), "2 films did NOT converge").level == WARNING


@pytest.mark.parametrize(("error", "level"), [(0.01, GOOD), (0.2, WARNING)])
def test_the_largest_known_error_of_the_grid_is_told(error, level):
    one = headline(line(error=error), "The grid makes an error")
    assert one.level == level
    assert f"{100.0 * error:.2g} % of the central film" in one.headline


def test_without_an_estimate_nothing_is_said_of_the_grid():
    unknown = line(error=float("nan"))
    assert not [one for one in findings(unknown) if "grid makes" in one.headline]


def test_rolling_without_sliding_says_nothing_of_friction():
    rolling = line(**FULL | {"friction_coefficient": 0.0, "error_friction": 0.0})
    assert not [one for one in findings(rolling) if "friction" in one.headline + one.detail]
    assert not [row for row in summary_rows(rolling) if "friction" in row.quantity]


def test_the_report_of_a_film_says_what_the_gear_file_says(tmp_path):
    of = {**remark_attributes(HelicalGearFile.named("he_2007")), "remarks": "Undercut. Look."}
    march = cycle().assign_attrs(of, name="he_2007", source="")
    _, first, second, *_ = film_report(march, tmp_path).findings
    assert (first.level, first.headline, first.detail) == (WARNING, "Undercut.", "Look.")
    assert (second.level, second.headline[:26]) == (NOTE, "Profile shift coefficients")


def test_inputs_are_told_in_everyday_units():
    told = {one.name: (one.value, one.unit) for one in film_inputs(line())}
    assert told["radius"] == ("14", "mm")
    assert told["load per length"] == ("360", "N/mm")
    assert told["oil temperature"] == ("40", "°C")
    assert told["nodes of the finest grid"] == ("11", "")


@pytest.mark.parametrize(
    ("roughness", "ratio", "level", "words"),
    [
        (0.5e-6, "0.5", WARNING, "asperities are in contact over much of the flank"),
        (0.125e-6, "2", NOTE, "mixed lubrication"),
        (0.05e-6, "5", GOOD, "full film"),
    ],
)
def test_film_over_roughness_tells_what_carries_the_load(roughness, ratio, level, words):
    rough = line(roughness_rms=roughness)  # central film 0.25 um, smallest 0.2 um
    one = headline(rough, "film ratio λ of the central film")
    assert one.headline.endswith(f" is {ratio}.")
    assert one.level == level
    assert words in one.detail
    value = {one.name: one.value for one in numbers(rough)}
    assert value["film ratio λ, smallest film"] == pytest.approx(0.2e-6 / roughness)
    told = {one.name: one.value for one in film_inputs(rough)}
    assert float(told["composite rms roughness"]) == pytest.approx(1e6 * roughness)


def test_without_a_roughness_the_one_that_would_matter_is_told():
    one = headline(line(), "No roughness was given")
    assert one.level == NOTE
    assert "above 0.083 µm" in one.detail  # a third of the central film of 0.25 um
    assert "above 0.033 µm" in headline(cycle(), "No roughness was given").detail
    told = {one.name: one.value for one in film_inputs(line())}
    assert told["composite rms roughness"] == "not given"


def test_a_hypoid_flank_takes_its_thinnest_place():
    flank = hypoid().assign_attrs(roughness_rms=0.5e-6)
    one = headline(flank, "film ratio λ of the central film")
    assert one.headline.endswith(" is 0.4.")  # 0.2 um over 0.5 um
    assert "smallest film has 0.3" in one.detail


def test_a_line_has_its_known_key_numbers_and_findings():
    full = line(
        roughness_rms=0.1e-6,
        domain_error_central_film=0.001,
        domain_error_minimum_film=0.02,
        sliding_power=55.0,
        temperature_max=393.15,
    )
    full["formula_film"][1] = 0.26e-6
    known = [
        ("smallest film", 0.2, "µm", "0.200"),
        ("central film", 0.25, "µm", "0.250"),
        ("largest pressure", 1.1, "GPa", "1.10"),
        ("film ratio λ, central film", 2.5, "", "2.5"),
        ("film ratio λ, smallest film", 2.0, "", "2.0"),
        ("coefficient of friction", 0.03, "", "0.0300"),
        ("largest estimated error", 1.0, "%", "1.0"),
        ("A over central film", 1.2, "", "1.20"),
    ]
    assert_numbers(numbers(full), known)
    unknown = {one.name: one.value for one in numbers(line())}
    assert np.isnan(unknown["film ratio λ, smallest film"])
    said = [
        (NOTE, "The smallest film is … the central one … the error of the grid is about",
         "0.200 µm, 0.250 µm, 0.5 %"),
        (GOOD, "grid makes … of the central film", "1 %, 1 %, 0.5 %"),
        (GOOD, "domain makes … of the smallest film … twice as wide", "2 %, 0.1 %, 2 %"),
        (NOTE, "film ratio λ of the central film … mixed … smallest film has",
         "2.5, 3, 0.10 µm, 2"),
        (NOTE, "largest pressure … relative to Hertz", "1.10 GPa, +10.0 %"),
        (NOTE, "coefficient of friction … lost by sliding. With heat", "0.0300, 55.0 W"),
        (NOTE, "central film of A is … times the solved … A, central film: … B, minimum film:",
         "1.20, 1.20, 1.30"),
    ]  # fmt: skip
    assert_findings(findings(full), said)
    cold = full.assign_attrs(temperature_max=np.nan, pressure_max=0.9e9)
    assert "Without heat" in findings(cold)[5].detail
    assert quantities(findings(cold)[4].detail) == ["−10.0 %"]


def test_a_march_has_its_known_key_numbers_and_findings():
    known = [
        ("smallest film", 0.1, "µm", "0.100"),
        ("film ratio λ, smallest film", 0.5, "", "0.50"),
        ("largest pressure", 1.3, "GPa", "1.30"),
        ("largest estimated error", np.nan, "%", "–"),
        ("films not converged", 2, "", "2"),
    ]
    marched = cycle(failures=2).assign_attrs(roughness_rms=0.2e-6)
    assert_numbers(numbers(marched), known)
    said = [
        (NOTE, "smallest film is … at step … meshing cycle", "0.100 µm, 12, 10, 12"),
        (WARNING, "films did NOT converge", "2"),
        (WARNING, "film ratio λ of the smallest film", "0.5, 1, 0.20 µm"),
        (NOTE, "largest pressure is … at step", "1.30 GPa, 11"),
    ]
    assert_findings(findings(marched), said)


def test_a_hypoid_flank_has_its_known_key_numbers_and_findings():
    known = [
        ("smallest film", 0.15, "µm", "0.150"),
        ("film ratio λ, central film", 0.4, "", "0.40"),
        ("film ratio λ, smallest film", 0.3, "", "0.30"),
        ("largest pressure", 0.9, "GPa", "0.900"),
        ("largest estimated error", 14.0, "%", "14"),
        ("films not converged", 0, "", "0"),
        ("largest friction", 0.03, "", "0.0300"),
        # a quarter of 2 and three quarters of 1
        ("Chittenden et al. 1985 over central film", 1.25, "", "1.25"),
    ]
    flank = hypoid().assign_attrs(roughness_rms=0.5e-6)
    assert_numbers(numbers(flank), known)
    said = [
        (
            NOTE,
            "smallest steady film … the error of the grid is about",
            "0.150 µm, −0.50, 14 %, −0.50, 0.50, 0.300 µm",
        ),
        (WARNING, "grid makes … of the films … more nodes", "14 %, 14 %, 2%"),
        (WARNING, "film ratio λ of the central film … smallest film has", "0.4, 1, 0.50 µm, 0.3"),
        (NOTE, "largest pressure", "0.900 GPa, 0.50"),
        (NOTE, "coefficient of friction … asperities add up to", "0.0200, 0.0300, 20 %"),
        (NOTE, "Chittenden et al. 1985 is on average", "1985, 1.25, 1985, 1.25"),
    ]
    assert_findings(findings(flank), said)


FULL = {
    "friction_1": 11.0, "friction_2": 13.0, "temperature_max": 393.15, "turns": 7.0,
    "group_M": 17.0, "group_L": 19.0, "iterations": 43, "seconds": 47.0,
    "domain_error_central_film": 0.03, "roughness_rms": 0.1e-6,
}  # fmt: skip
OF_BOTH = [
    ["largest pressure", "solution", 1.1e9, "Pa", np.nan],
    ["largest pressure", "Hertz{}", 1.0e9, "Pa", 1.0 / 1.1 - 1.0],
    ["central film", "solution", 0.25e-6, "m", np.nan],
    ["central film", "A{}", 0.30e-6, "m", 0.2],
    ["minimum film", "solution", 0.2e-6, "m", np.nan],
    ["minimum film", "B{}", 0.24e-6, "m", 0.2],
    ["film ratio λ, central film", "solution", 2.5, "1", np.nan],
    ["film ratio λ, smallest film", "solution", 2.0, "1", np.nan],
    ["friction coefficient", "solution", 0.03, "1", np.nan],
]
ENDS = [
    ("highest temperature above the inlet", 80.0, "K"),
    ("turns of film and energy", 7.0, "1"),
    ("group M", 17.0, "1"),
    ("group L", 19.0, "1"),
    ("estimated error, central film", 1.0, "%"),
    ("estimated error, minimum film", 0.5, "%"),
    ("estimated error of the domain, central film", 3.0, "%"),
    ("unbalanced flow", 1e-9, "1"),
    ("load error", 1e-12, "1"),
    ("iterations", 43.0, "1"),
    ("time", 47.0, "s"),
]


@pytest.mark.parametrize(
    ("kind", "basis", "own", "attributes"),
    [
        ("line", "", [("force of the film on body 1", 11.0, "N/m"),
                      ("force of the film on body 2", 13.0, "N/m")], {}),
        ("helical", ", mean load",
         [("power lost to sliding", 23.0, "W"), ("load of the line", 29.0, "N"),
          ("loaded length", 31.0, "mm"), ("largest pressure at y", 37.0, "mm"),
          ("minimum film at y", 41.0, "mm")],
         {"sliding_power": 23.0, "load": 29.0, "loaded_length": 0.031, "pressure_max_y": 0.037,
          "minimum_film_y": 0.041}),
    ],
)  # fmt: skip
def test_the_summary_of_a_film_has_its_known_rows(kind, basis, own, attributes):
    found = summary_rows(line(**FULL, **attributes).assign_attrs(contact=kind))
    expected = [[name, who.format(basis), *rest] for name, who, *rest in OF_BOTH]
    expected += [[name, "solution", value, unit, np.nan] for name, value, unit in [*own, *ENDS]]
    assert [one.quantity for one in found] == [row[0] for row in expected]
    for got, row in zip(found, expected, strict=True):
        assert_cells(list(got), row, row[0])
    head, first, second, *_ = summary_csv(found).splitlines()
    assert head == "quantity,source,value,unit,deviation"
    assert first == "largest pressure,solution,1.1e+09,Pa,"
    assert second == f"largest pressure,{HERTZ[kind]},1e+09,Pa,-0.09091"


HERTZ = {"line": "Hertz", "helical": '"Hertz, mean load"'}


def test_the_summary_of_a_hypoid_flank_has_its_known_ratios():
    """Each source is a prime times the solution at 100 N and twice this at 300 N."""
    flank = hypoid()
    at = "position"
    given = {"psi": [0.1, 0.2], "chi": [0.3, 0.5], "R_y": [6.0, 12.0], "R_x": [3.0, 4.0]}
    for name, values in given.items():
        flank[f"steady_{name}"] = (at, np.array(values))
    solved = {
        "central film": "steady_central_film", "minimum film": "steady_minimum_film",
        "largest pressure": "steady_pressure_max", "friction": "steady_traction_heated",
    }  # fmt: skip
    sources = [
        ("central film", "Chittenden et al. 1985", "chittenden_central"),
        ("central film", "Chittenden, minor-axis component", "component_central"),
        ("central film", "Grubin 1949", "grubin"),
        ("minimum film", "Chittenden et al. 1985", "chittenden_minimum"),
        ("minimum film", "Chittenden, minor-axis component", "component_minimum"),
        ("largest pressure", "Hertz", "hertz_pressure"),
        ("friction", "Evans and Johnson 1986", "evans_johnson"),
        ("friction", "Evans and Johnson, solved film", "evans_johnson_solved"),
        ("friction", "Evans and Johnson, film and Roelands", "evans_johnson_roelands"),
        ("friction", "axle, with asperities", "axle_friction"),
        ("friction", "Eyring, isothermal", "steady_traction_eyring"),
    ]
    primes = (2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0)
    for prime, (quantity, _, name) in zip(primes, sources, strict=True):
        flank[name] = flank[solved[quantity]] * xr.DataArray([prime, 2.0 * prime], dims=at)
    degrees = 180.0 / np.pi
    expected = [
        # least, largest, a quarter of the first and three quarters of the second
        ["load", "solution", 100.0, 300.0, 250.0, "N"],
        ["central film", "solution", 0.2e-6, 0.4e-6, 0.35e-6, "m"],
        ["minimum film", "solution", 0.15e-6, 0.3e-6, 0.2625e-6, "m"],
        ["film ratio λ, central film", "over roughness", 0.4, 0.8, 0.7, "1"],
        ["film ratio λ, minimum film", "over roughness", 0.3, 0.6, 0.525, "1"],
        ["largest pressure", "solution", 0.5e9, 0.9e9, 0.8e9, "Pa"],
        ["friction", "solution, heated Eyring", 0.02, 0.03, 0.0275, "1"],
        ["entrainment angle", "given", 0.1 * degrees, 0.2 * degrees, 0.175 * degrees, "deg"],
        ["sliding angle", "given", 0.3 * degrees, 0.5 * degrees, 0.45 * degrees, "deg"],
        ["R_y/R_x", "given", 2.0, 3.0, 2.75, "1"],
        *([quantity, source, prime, 2.0 * prime, 1.75 * prime, "over solution"]
          for prime, (quantity, source, _) in zip(primes, sources, strict=True)),
    ]  # fmt: skip
    found = ratio_rows(flank.assign_attrs(roughness_rms=0.5e-6))
    assert len(found) == len(expected)
    for got, row in zip(found, expected, strict=True):
        assert_cells(list(got), row, f"{row[0]}, {row[1]}")


def test_the_table_of_a_film_has_everyday_units():
    (table,) = _tables(line(**FULL))
    shown = {(row[0], row[1]): row[2:] for row in table.rows}
    assert shown["largest pressure", "Hertz"] == ["1", "GPa", "−9.1 %"]
    assert shown["central film", "solution"] == ["0.2500", "µm", ""]
    assert shown["force of the film on body 1", "solution"] == ["0.01100", "N/mm", ""]
    assert shown["iterations", "solution"] == ["43", "", ""]
