"""What the commands `gearlube ehl line`, `point` and `helical` write."""

import math

import numpy as np
import pytest

from gearlube.studies.films.figures.catalogue import drawn_figures
from tests.helpers.ehl_command import run, written


def test_a_line_writes_dataset_summary_and_figures(tmp_path):
    result = run("line", "--nodes", 201, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset, summary = written(tmp_path, "line")
    assert dataset.sizes["x"] == 201
    # the load of 360 N/mm is carried by the pressure that is written and by the oil beyond, whose
    # share far away is 8 eta0 u R^2/X^2 over the load
    inside = 1.0 - dataset.attrs["load_beyond"]
    carried = np.trapezoid(dataset["pressure"], dataset["x"])
    assert carried == pytest.approx(3.6e5 * inside, rel=1e-6)
    assert 0.0 < 1.0 - inside < 1e-3
    # what goes in comes out: between the surfaces the flow is one number
    full = (dataset["pressure"].values[1:] > 0.0) & (dataset["pressure"].values[:-1] > 0.0)
    flow = dataset["mass_flow"].values[full]
    assert np.ptp(flow) < 1e-6 * flow.mean()
    # u1 > u2: the film holds body 1 back and drives body 2
    assert dataset.attrs["friction_1"] < 0.0 < dataset.attrs["friction_2"]
    assert dataset["residual_history"][-1] <= 1e-8
    assert dataset["nodes_history"][-1] == 201
    films = {row["source"]: row for row in summary if row["quantity"] == "central film"}
    assert set(films) == {"solution", "Dowson and Toyoda 1979"}
    own, formula = (float(films[who]["value"]) for who in films)
    assert float(films["Dowson and Toyoda 1979"]["deviation"]) == pytest.approx(
        formula / own - 1.0, abs=1e-3
    )


@pytest.mark.slow
def test_a_thermal_line_writes_its_temperatures(tmp_path):
    result = run("line", "jamali_2015_thermal", "--nodes", 201, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset, summary = written(tmp_path, "line")
    rise = float(dataset["temperature"].max()) - 363.15
    (row,) = [r for r in summary if r["quantity"] == "highest temperature above the inlet"]
    assert 0.0 < rise == pytest.approx(float(row["value"]), rel=1e-4)
    assert dataset["temperature_change"][-1] <= 1e-3


@pytest.mark.slow
def test_a_point_writes_dataset_summary_and_figures(tmp_path):
    result = run("point", "--nodes", 33, "--slide-roll", 0.1, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset, summary = written(tmp_path, "point")
    assert dict(dataset.sizes)["x"] == dict(dataset.sizes)["y"] == 33
    carried = np.trapezoid(np.trapezoid(dataset["pressure"], dataset["y"]), dataset["x"])
    # pressure is small on the border, so that both sums are nearly the same
    inside = 1.0 - dataset.attrs["load_beyond"]
    assert carried == pytest.approx(15.0 * inside, rel=2e-3)
    assert inside < 0.998  # why oil beyond was taken
    # a Newtonian film: shear force of eta |du|/h over the plane, |du| = 0.1 u
    stress = dataset["viscosity"] * 0.009 / dataset["film"]
    force = np.trapezoid(np.trapezoid(stress, dataset["y"]), dataset["x"])
    assert dataset.attrs["friction_force"] == pytest.approx(force, rel=1e-9)
    sources = {row["source"] for row in summary if row["quantity"] == "minimum film"}
    assert sources == {"solution", "Hamrock and Dowson 1977", "Chittenden et al. 1985"}
    assert (dataset["fill"] == 1.0).all()


@pytest.mark.slow
def test_a_point_that_conserves_mass_writes_what_broken_film_holds(tmp_path):
    options = ("--nodes", 33, "--slide-roll", 0.1, "--cavitation", "mass_conserving")
    assert run("point", *options, "--out", tmp_path).exit_code == 0
    dataset, _ = written(tmp_path, "point")
    fill = dataset["fill"]
    assert 0.0 < fill.min() < 0.5
    assert (dataset["pressure"].where(fill < 1.0, 0.0) == 0.0).all()
    # sheared streaks cover the share of the surface that they fill
    stress = fill * dataset["viscosity"] * 0.009 / dataset["film"]
    force = np.trapezoid(np.trapezoid(stress, dataset["y"]), dataset["x"])
    assert dataset.attrs["friction_force"] == pytest.approx(force, rel=1e-9)


@pytest.mark.slow  # a thermal line is in the default run
def test_a_thermal_point_writes_its_temperatures(tmp_path):
    result = run("point", "elliptical_thermal", "--nodes", 33, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset, summary = written(tmp_path, "point")
    assert "temperature" in drawn_figures(dataset)
    rise = float(dataset["temperature"].max()) - 313.15
    (row,) = [r for r in summary if r["quantity"] == "highest temperature above the inlet"]
    assert 0.0 < rise == pytest.approx(float(row["value"]), rel=1e-4)
    assert dataset["temperature"].values[..., -1] == pytest.approx(dataset["temperature_2"].values)
    assert dataset["heat_balance_history"][-1] <= 1e-6
    # what sliding works against the film becomes heat
    heat = np.trapezoid(np.trapezoid(dataset["heating"], dataset["y"]), dataset["x"])
    slip = np.hypot(dataset.attrs["sliding_x"], dataset.attrs["sliding_y"])
    assert heat == pytest.approx(dataset.attrs["friction_force"] * slip, rel=0.05)


@pytest.mark.slow
def test_a_helical_line_writes_dataset_summary_and_figures(tmp_path):
    grid = ("--nodes-across", 41, "--nodes-along", 49)
    result = run("helical", "--step", 300, *grid, "--newtonian", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset, summary = written(tmp_path, "helical")
    assert dict(dataset.sizes)["x"] == 41
    # Jamali 2015 sec. 4.4: s_i = -18.7 mm + 300 * 0.04 mm
    assert dataset.attrs["position"] == pytest.approx(-6.7e-3)
    # sec. 4.1: at most 14.4 kN of a load that leaves out cos(beta_b), 18.38 deg; change points
    # move it by 4.3 %
    assert dataset.attrs["load"] == pytest.approx(14.4e3 / math.cos(math.radians(18.38)), rel=0.043)
    carried = np.trapezoid(np.trapezoid(dataset["pressure"], dataset["y"]), dataset["x"])
    assert carried == pytest.approx(dataset.attrs["load"], rel=1e-5)
    # rolling without sliding at the pitch point alone, which the line crosses at one place
    slide = (dataset["speed_2"] - dataset["speed_1"]).values
    assert (np.diff(slide) < 0.0).all()
    assert slide[0] > 0.0 > slide[-1]
    # mid-film shear follows the sliding on both sides of the pitch point: all of it is lost
    stress = dataset["mean_stress"].values
    power = np.trapezoid(np.trapezoid(stress * slide, dataset["y"], axis=1), dataset["x"])
    assert dataset.attrs["sliding_power"] == pytest.approx(power, rel=1e-9)
    assert (stress * slide >= 0.0).all()
    largest = np.abs(slide).max()
    assert 0.0 < power < dataset.attrs["friction_coefficient"] * dataset.attrs["load"] * largest
    assert "Hertz, mean load" in {row["source"] for row in summary}
