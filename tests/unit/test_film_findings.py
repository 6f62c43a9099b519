"""Findings and key numbers of films, from datasets with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.films.findings import findings, formula_ratios, mean_ratios, numbers
from gearlube.studies.films.report import film_inputs, film_report
from gearlube_core.helical_geometry.gear_file import HelicalGearFile


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
    assert [one.level for one in calm[:3]] == [GOOD, GOOD, GOOD]


def headline(dataset, words):
    (one,) = [one for one in findings(dataset) if words in one.headline]
    return one


def test_a_film_that_did_not_converge_is_a_warning():
    assert headline(line(), "converged").level == GOOD
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
    assert not [one for one in findings(unknown) if "grid" in one.headline]


def test_film_pressure_and_friction_of_a_line_are_told_in_everyday_units():
    film = headline(line(), "smallest film")
    assert "0.200 µm" in film.headline
    assert "0.250 µm" in film.headline
    pressure = headline(line(), "largest pressure")
    assert "1.10 GPa" in pressure.headline
    assert "+10.0 % relative to Hertz" in pressure.detail
    assert "0.0300" in headline(line(), "friction").headline


def test_rolling_without_sliding_has_no_finding_of_friction():
    rolling = line(friction_coefficient=0.0)
    assert not [one for one in findings(rolling) if "friction" in one.headline]


def test_formulas_are_told_as_ratios_to_the_solution():
    # 0.30 over 0.25 and 0.24 over 0.20, exact but for rounding
    assert [one.ratio for one in formula_ratios(line())] == pytest.approx([1.2, 1.2], rel=1e-12)
    one = headline(line(), "central film of A")
    assert one.level == NOTE
    assert "1.20 times" in one.headline


def test_the_report_of_a_film_says_what_the_gear_file_says(tmp_path):
    of = {**remark_attributes(HelicalGearFile.named("he_2007")), "remarks": "Undercut. Look."}
    march = cycle().assign_attrs(of, name="he_2007", source="")
    first, second, *_ = film_report(march, tmp_path).findings
    assert (first.level, first.headline, first.detail) == (WARNING, "Undercut.", "Look.")
    assert (second.level, second.headline[:26]) == (NOTE, "Profile shift coefficients")


def test_a_march_tells_the_steps_of_its_extremes():
    assert "0.100 µm, at step 12" in headline(cycle(), "smallest film").headline
    assert "1.30 GPa, at step 11" in headline(cycle(), "largest pressure").headline


def test_a_hypoid_flank_tells_its_extremes_and_ratios_by_load():
    flank = hypoid()
    assert "0.150 µm, at phase −0.50" in headline(flank, "smallest steady film").headline
    assert "0.900 GPa, at phase 0.50" in headline(flank, "largest pressure").headline
    assert "20 %" in headline(flank, "friction").detail
    assert headline(flank, "14 % of the films").level == WARNING
    # a quarter of 2 and three quarters of 1
    (ratio,) = mean_ratios(flank)
    assert ratio.ratio == pytest.approx(1.25, rel=1e-12)


@pytest.mark.parametrize("dataset", [line(), cycle(), hypoid()], ids=["line", "cycle", "hypoid"])
def test_key_numbers_hold_the_smallest_film_and_largest_pressure(dataset):
    value = {one.name: one.value for one in numbers(dataset)}
    expected = {"line": (0.2, 1.1), "helical_cycle": (0.1, 1.3), "hypoid": (0.15, 0.9)}
    film, pressure = expected[dataset.attrs["contact"]]
    assert value["smallest film"] == pytest.approx(film)
    assert value["largest pressure"] == pytest.approx(pressure)


def test_inputs_are_told_in_everyday_units():
    told = {one.name: (one.value, one.unit) for one in film_inputs(line())}
    assert told["radius"] == ("14", "mm")
    assert told["load per length"] == ("360", "N/mm")
    assert told["oil temperature"] == ("40", "°C")
    assert told["nodes of the finest grid"] == ("11", "")


@pytest.mark.parametrize(
    ("roughness", "ratio", "level", "words"),
    [
        (0.5e-6, "0.5", WARNING, "asperities carry much of the load"),
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
