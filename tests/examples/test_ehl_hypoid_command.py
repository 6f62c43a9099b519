"""The command `gearlube ehl hypoid`: what it writes, goes on from and refuses."""

import csv

import numpy as np
import pytest
import typer
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT, INTERRUPTED
from gearlube.studies.films import results, run_hypoid
from gearlube.studies.films.figures.catalogue import drawn_figures
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from tests.helpers.each import each

TINY = ("--nodes-minor", 33, "--nodes-major", 25, "--steps", 6, "--steady", 3)


def run(*arguments):
    return CliRunner().invoke(cli.app, ["ehl", "hypoid", *map(str, arguments)])


def test_it_writes_films_formulas_summary_and_figures(tmp_path):
    result = run(*TINY, "--phases", "0.2:0.8", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset = xr.load_dataset(tmp_path / "hypoid.nc", engine="scipy")
    assert {path.stem for path in (tmp_path / "figures").glob("*.png")} == set(
        drawn_figures(dataset)
    )
    for name, variable in {**dataset.data_vars, **dataset.coords}.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert dataset.sizes["step"] == 7
    assert dataset.sizes["position"] == 3
    # what the axle says at the samples is what its kernels say of load, radii and speeds there:
    # film to the lateral motion's share of speeds
    np.testing.assert_allclose(dataset["chittenden_central"], dataset["axle_film"], rtol=5e-3)
    np.testing.assert_allclose(dataset["axle_friction"], dataset["running_friction"], rtol=5e-3)
    np.testing.assert_allclose(dataset["steady_load"], dataset["steady_given_load"], rtol=1e-5)
    with (tmp_path / "summary.csv").open(newline="") as file:
        rows = {(row["quantity"], row["source"]): row for row in csv.DictReader(file)}
    ratio = dataset["chittenden_central"] / dataset["steady_central_film"]
    row = rows["central film", "Chittenden et al. 1985"]
    assert float(row["least"]) == pytest.approx(float(ratio.min()), rel=1e-4)
    assert float(row["largest"]) == pytest.approx(float(ratio.max()), rel=1e-4)


@pytest.mark.slow
def test_thermal_films_stand_beside_the_cold_ones(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(results, "save_film_figures", lambda *_: [])
    options = (*TINY, "--load", "static", "--phases", "0.2:0.8", "--temperature", "thermal")
    result = run(*options, "--no-march", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    dataset = xr.load_dataset(tmp_path / "hypoid.nc", engine="scipy")
    assert (dataset["warm_heat_balance"] <= 1e-6).all()
    assert (dataset["warm_rise_max"] > dataset["warm_rise_surface"]).all()
    assert (dataset["warm_rise_surface"] > 1.0).all()
    # warm surfaces take friction off what cool ones leave
    assert (dataset["warm_traction"] < dataset["steady_traction_heated"]).all()
    assert (dataset["warm_central_film"] < dataset["warm_cold_central_film"]).all()
    with (tmp_path / "summary.csv").open(newline="") as file:
        rows = {(row["quantity"], row["source"]): row for row in csv.DictReader(file)}
    ratio = dataset["evans_johnson"] / dataset["warm_traction"]
    row = rows["friction", "Evans and Johnson 1986, over thermal"]
    assert float(row["largest"]) == pytest.approx(float(ratio.max()), rel=1e-4)
    # transient thermal films are not implemented
    assert run(*options, "--out", tmp_path).exit_code == BAD_ARGUMENT
    assert "no-march" in caplog.text


@pytest.mark.slow
def test_a_stopped_march_goes_on_to_the_same_film(tmp_path, monkeypatch):
    """Its record stands after every 2 steps; the rest gives what an unbroken march gives."""
    monkeypatch.setattr(results, "save_film_figures", lambda *_: [])
    options = (*TINY, "--load", "static", "--phases", "0.2:0.8")
    stop_at = []
    calls = []
    itself = run_hypoid.run_hypoid

    def stopping(case, *, progress, **given):
        def stop(share, sentence):
            progress(share, sentence)
            if sentence.startswith("film in time"):
                calls.append(sentence)
                if len(calls) in stop_at:
                    raise KeyboardInterrupt

        return itself(case, progress=stop, record_every=2, **given)

    monkeypatch.setattr(run_hypoid, "run_hypoid", stopping)
    assert run(*options, "--out", tmp_path / "whole").exit_code == 0
    calls.clear()
    stop_at.append(4)
    assert run(*options, "--out", tmp_path / "parts").exit_code == INTERRUPTED
    assert run(*options, "--out", tmp_path / "parts").exit_code == 0
    whole, parts = (
        xr.load_dataset(tmp_path / name / "hypoid.nc", engine="scipy")
        for name in ("whole", "parts")
    )
    # steps 0 to 3, the record of 2, then 3 to 6
    assert len(calls) == 8
    for name in ("central_film", "pressure_max", "traction_heated"):
        np.testing.assert_array_equal(parts[name], whole[name])


@pytest.fixture
def asked(monkeypatch):
    """The cases that the command would have solved."""
    calls = []

    def remember(case, **given):
        calls.append({"case": case, **given})
        raise typer.Exit(0)

    monkeypatch.setattr(run_hypoid, "run_hypoid", remember)
    return calls


def test_the_example_is_the_shipped_case_and_can_be_read(tmp_path, asked):
    text = run("--example").output
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    assert run(tmp_path / "mine.toml", "--torque", -20, "--no-march", "--quick").exit_code == 0
    (given,) = asked
    shipped = HypoidCase.named("mohammadpour_2015")
    assert given["march"] is False
    assert given["case"].pinion_torque_n_m == -20.0
    assert given["case"].solver.steady < shipped.solver.steady
    assert given["case"].oil == shipped.oil


@pytest.mark.slow
@each(
    ("options", "says"),
    [
        (("nobody",), "No hypoid flank is called 'nobody'"),
        (("--phases", "1"), "--phases must be two numbers"),
        (("--phases", "-1.5:-1.2"), "carries no load between phases"),
        (("--speed-rpm", "0"), "pinion_speed_rpm must be a number, 1 to 47000 rpm"),
        (("--torque", "0"), "pinion_torque_n_m must not be 0"),
        (("--load", "heavy"), "load must be a text, dynamic or static"),
        (
            ("--oil-temperature", "190"),
            "oil_temperature_degc must be within 0 to 150 degC, got 190 degC",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(tmp_path, options, says, caplog):
    caplog.clear()
    result = run(*options, "--out", tmp_path)
    assert result.exit_code == BAD_ARGUMENT, result.output
    assert says in caplog.text
