"""The command `gearlube helical`: what it writes, refuses, keeps when stopped and goes on from."""

import csv
import logging
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.output.toml_text import toml_text
from gearlube.plotting.style import house_style, new_figure
from gearlube.plotting.words import mark_edge_pressure
from gearlube.report.stored import read_report
from gearlube.studies.helical import run as helical_run
from gearlube.studies.helical import stages, sweep_grid
from gearlube.studies.helical.figures import catalogue
from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE
from gearlube.studies.helical.run import run_helical
from gearlube.studies.helical.settings import RPM, HelicalSettings
from gearlube.studies.helical.stages import HelicalResults
from gearlube.studies.helical.summary import summary_csv, summary_rows
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh, read_line_mesh
from tests.helpers.each import each
from tests.helpers.helical_dynamics_cases import estimated_pair

GEOMETRY = {"contact_plane", "contact_characteristics", "facet_gaps"}


def run(*arguments):
    return CliRunner().invoke(cli.app, ["helical", *map(str, arguments)])


@pytest.fixture
def asked(monkeypatch):
    """What the command would have studied; it ends as a failed study does."""
    calls = []

    def note(settings, **options):
        calls.append({"settings": settings, **options})
        raise ConvergenceError("noted")

    monkeypatch.setattr(helical_run, "run_helical", note)
    return calls


@pytest.fixture
def small(monkeypatch):
    """The command's dynamics at few points, without the continuation and figures."""
    real = HelicalSettings.__init__

    def init(self, **given):
        real(self, **given, stability_columns=4, stability_rows=2, separation_speeds=0)

    monkeypatch.setattr(HelicalSettings, "__init__", init)
    monkeypatch.setattr(catalogue, "save_helical_figures", lambda *_: [])
    return (
        "--parts",
        "dynamics",
        "--mesh",
        "density",
        "--mu",
        0.1,
        0.2,
        "--speeds-rpm",
        1000,
        3000,
        "--jobs",
        1,
    )


def datasets(folder):
    return {
        path.stem: xr.load_dataset(path, engine="scipy")
        for path in folder.glob("*.nc")
        if path.stem != "line_mesh"
    }


def assert_labelled(found):
    """Every variable has a unit and words, every dataset its command line and version."""
    for name, dataset in found.items():
        for variable in dataset.variables:
            attributes = dataset[variable].attrs
            assert "units" in attributes, (name, variable)
            assert attributes["long_name"], (name, variable)
        for attribute in ("command_line", "gearlube_version", "source", "name"):
            assert dataset.attrs[attribute], (name, attribute)


@pytest.mark.slow
def test_quick_run_writes_everything(tmp_path, monkeypatch, caplog):
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "cache"))
    out = tmp_path / "out"
    result = run("--quick", "--out", out)
    assert result.exit_code == 0, result.output
    found = datasets(out)
    assert_labelled(found)
    assert {"contact", "response", "friction_sweep", "sweep", "stability"} <= set(found)
    assert {"separation", "film", "geometry", "geometry_jamali_2015_a"} <= set(found)
    assert {path.stem for path in (out / "figures").glob("*.png")} == set(HELICAL_CATALOGUE)
    for folder in ("geometry", "thesis"):
        drawn = {path.stem for path in (out / "figures" / folder).glob("*.png")}
        assert drawn >= GEOMETRY
    assert read_line_mesh(out / "line_mesh.nc").pinion_teeth == 25
    # the pairs share the torque, whose part outside their lines is theirs too
    np.testing.assert_allclose(found["contact"]["share"].sum("line"), 1.0, atol=1e-4)
    with (out / "summary.csv").open(encoding="utf-8") as file:
        topics = {row["topic"] for row in csv.DictReader(file)}
    assert topics >= {"pair", "loaded contact", "operating point", "speed sweep", "stability"}
    assert not list(out.glob("*.part"))
    assert read_report(out)["study"] == "helical"
    assert "Report:" in caplog.text


@pytest.mark.slow
def test_dynamics_alone_are_those_of_the_pair(small, tmp_path):
    result = run(*small, "--density", 13.16, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    found = datasets(tmp_path)
    assert_labelled(found)
    assert set(found) == {"response", "friction_sweep", "sweep", "stability", "film"}
    # by another way to the same pair; the gear file prints seven digits of its masses
    direct = periodic_response(estimated_pair(0.1), 3000.0 * RPM)
    for name in ("u_xp", "u_yp", "delta_z"):
        amplitude = found["sweep"][f"{name}_harmonic"].sel(mu=0.1, speed=3000.0 * RPM)
        expected = harmonics(direct.signal(name))
        np.testing.assert_allclose(amplitude, expected, rtol=1e-4, atol=1e-4 * expected.max())
    # amplitudes in the response are those of its own histories
    response = found["response"]
    assert list(response["case"].values) == ["0.01", "0.1", "film"]
    history = response["F_yp"].sel(case="0.1").values
    first = 2.0 * abs(np.mean(history * np.exp(-2j * np.pi * response["phase"].values)))
    assert float(response["F_yp_harmonic"].sel(case="0.1", harmonic=1)) == pytest.approx(first)


@pytest.mark.slow
def test_a_stopped_run_keeps_its_speeds_and_goes_on(small, tmp_path, monkeypatch, caplog):
    real, computed = sweep_grid.speed_column, []

    def stop_at_second(parameters, mu, speed):
        if parameters.film is None:
            return real(parameters, mu, speed)
        if computed:
            raise KeyboardInterrupt
        computed.append(speed)
        return real(parameters, mu, speed)

    monkeypatch.setattr(sweep_grid, "speed_column", stop_at_second)
    with caplog.at_level(logging.WARNING, "gearlube"):
        assert run(*small, "--out", tmp_path).exit_code == INTERRUPTED
    assert "to continue from" in caplog.text
    assert set(datasets(tmp_path)) == {"response", "friction_sweep"}
    assert len(list((tmp_path / "parts").glob("*_speed_*.npz"))) == 1

    def count(parameters, mu, speed):
        if parameters.film is not None:
            computed.append(speed)
        return real(parameters, mu, speed)

    monkeypatch.setattr(sweep_grid, "speed_column", count)
    assert run(*small, "--out", tmp_path).exit_code == 0
    assert len(computed) == len(set(computed)) == 2  # none twice
    sweep = datasets(tmp_path)["sweep"]
    assert np.isfinite(sweep["u_xp_harmonic"]).all()


@pytest.mark.slow
def test_parts_of_another_pair_are_not_taken(small, tmp_path):
    assert run(*small, "--out", tmp_path).exit_code == 0
    before = datasets(tmp_path)["sweep"]["delta_z_harmonic"].values
    assert run(*small, "--torque", 100, "--out", tmp_path).exit_code == 0
    after = datasets(tmp_path)["sweep"]["delta_z_harmonic"].values
    # below 100 N/mm ISO 6336-1 takes the teeth as softer: not just the ratio of the torques
    assert abs(after / before - 100.0 / 225.970).max() > 1e-3


def test_geometry_of_the_thesis_comes_with_the_default_pair(small, tmp_path):
    assert run("--parts", "geometry", "--out", tmp_path).exit_code == 0
    found = datasets(tmp_path)
    assert_labelled(found)
    assert set(found) == {"geometry", "geometry_jamali_2015_a", "geometry_jamali_2015_b"}


def test_a_gear_file_says_what_it_is_compared_with():
    file = HelicalGearFile.named("he_2007").varied({"name": "own", "compared_with": []})
    settings = HelicalSettings(file=file, pinion_torque=100.0, pinion_speed=100.0, parts="geometry")
    assert set(run_helical(settings).datasets) == {"geometry"}
    both = file.varied({"compared_with": ["jamali_2015_b"]})
    found = run_helical(replace(settings, file=both)).datasets
    assert set(found) == {"geometry", "geometry_jamali_2015_b"}


def test_defaults_are_those_of_the_paper(asked):
    assert run().exit_code == FAILED
    settings = asked[0]["settings"]
    assert settings.file.name == "he_2007"
    assert settings.pinion_speed == pytest.approx(104.7198, rel=1e-6)  # 1000 rpm
    assert settings.pinion_torque == pytest.approx(225.97, rel=1e-4)  # 2000 lbf in
    assert len(settings.mu) == 31
    assert (settings.mu[0], settings.mu[-1]) == (0.0, 0.3)
    assert len(settings.swept_speeds(settings.parameters())) == 60
    assert (settings.mesh, settings.friction, settings.parts) == ("contact", "arana_2019", "all")


def test_options_reach_the_settings_in_si_units(asked):
    result = run(
        *("jamali_2015_b", "--torque", 500, "--speed-rpm", 1500, "--mu", "0:0.1:0.05", "0.2"),
        *("--speeds-rpm", "500:1500:500", "--density", 12.5, "--torques", 800, 400),
        *("--positions", 12, "--oil", "jamali_2015", "--oil-temperature", 90),
        *("--roughness-um", 0.4, "--friction", "constant", "--jobs", 2, "--out", "here"),
    )
    assert result.exit_code == FAILED, result.output
    settings = asked[0]["settings"]
    assert settings.file.name == "jamali_2015_b"
    assert settings.pinion_torque == 500.0
    assert settings.mu == (0.0, 0.05, 0.1, 0.2)
    np.testing.assert_allclose(settings.speeds, np.array([500.0, 1000.0, 1500.0]) * np.pi / 30.0)
    assert settings.stiffness_density == pytest.approx(1.25e10)
    assert settings.mesh == "density"  # which a given density implies
    assert settings.load_steps == (400.0, 800.0)
    assert settings.oil_temperature == pytest.approx(363.15)
    assert settings.roughness_rms == pytest.approx(0.4e-6)
    assert (asked[0]["jobs"], str(asked[0]["folder"])) == (2, "here")


@each(
    ("options", "words"),
    [
        (("nothing",), ("nothing", "he_2007")),
        (("missing.toml",), ("gear file missing.toml was not found in",)),
        (("--torque", "-5"), ("--torque", "-5 N.m", "magnitude")),
        (("--speed-rpm", "0"), ("--speed-rpm", "rpm")),
        (("--mu", "0:0.3"), ("--mu", "'0:0.3'", "first:last:step")),
        (("--mu", "0.3:0:0.1"), ("--mu", "0.3", "first:last:step")),
        (("--mu", "1.5"), ("--mu", "1.5", "within 0 to 1")),
        (("--mu", "a"), ("--mu", "'a'")),
        (("--speeds-rpm", "0:1e6:1"), ("--speeds-rpm", "2000", "larger step")),
        (("--friction", "some"), ("friction", "film", "'some'")),
        (("--mesh", "some"), ("mesh", "contact, density", "'some'")),
        (("--parts", "some"), ("parts", "all", "'some'")),
        (("--density", "0"), ("--density", "N/(um mm)", "13")),
        (("--mesh", "contact", "--density", "13"), ("density", "contact", "Leave it out")),
        (
            ("--mesh", "contact", "--torques", "20", "30"),
            ("pinion_torque", "30", "225.97", "mesh density"),
        ),
        (("--torques", "-1"), ("torques", "-1 N.m")),
        (("--positions", "2"), ("positions", "within 4 to 400")),
        (("--oil", "water"), ("water",)),
        (("--oil-temperature", "400"), ("--oil-temperature", "400 degC")),
        (("--roughness-um", "-1"), ("roughness_rms", "um")),
        (("--jobs", "0"), ("--jobs", "1 to 1024")),
    ],
)
def test_bad_options_say_what_is_wrong_and_what_would_be_right(options, words, asked, caplog):
    caplog.clear()
    with caplog.at_level(logging.ERROR, "gearlube"):
        result = run(*options)
    assert result.exit_code == BAD_ARGUMENT, result.output
    assert not asked
    for word in words:
        assert word in caplog.text, caplog.text


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"operation": None}, "--torque"),
        ({"pinion.bearing_1": None, "pinion.bearing_2": None}, "bearing_1"),
        ({"damping.tilt": 0.02}, "damping.tilt"),
    ],
)
def test_files_that_lack_something_are_refused(changes, word, asked, caplog, monkeypatch, tmp_path):
    file = HelicalGearFile.named("jamali_2015_a")
    keep = {
        key: value
        for key, value in file.completed.items()
        if not any(key.startswith(name.split(".")[0]) for name in changes)
    }
    varied = file.model_copy(update={"completed": keep}).varied(changes)
    monkeypatch.setattr(HelicalGearFile, "from_toml", lambda path: varied)
    (tmp_path / "own.toml").write_text(toml_text(file.model_dump(exclude_none=True)))
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run(str(tmp_path / "own.toml")).exit_code == BAD_ARGUMENT
    assert word in caplog.text
    assert not asked


@pytest.mark.slow
def test_a_stage_that_fails_leaves_the_others(small, tmp_path, monkeypatch, caplog):
    def fail(*_, **__):
        raise ConvergenceError("no map")

    monkeypatch.setattr(stages, "stability_dataset", fail)
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run(*small, "--out", tmp_path).exit_code == FAILED
    assert "parametric instability: no map" in caplog.text
    assert set(datasets(tmp_path)) == {"response", "friction_sweep", "sweep", "film"}


def test_a_run_stopped_at_once_writes_the_summary_of_the_pair(small, tmp_path, monkeypatch):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(stages, "operating_point", stop)
    assert run(*small, "--out", tmp_path).exit_code == INTERRUPTED
    assert not datasets(tmp_path)
    text = (tmp_path / "summary.csv").read_text(encoding="utf-8")
    assert "total contact ratio" in text


def test_numbers_that_a_study_lacks_are_not_in_its_summary():
    """Own pairs, stable at every factor studied, had rows of nan."""
    growth = (("variation", "mesh_frequency"), np.full((3, 2), -0.1))
    stability = xr.Dataset(
        {"growth_variation": growth, "growth_variation_light": growth},
        coords={"variation": [0.5, 1.0, 2.0]},
    )
    file = HelicalGearFile.named("he_2007")
    settings = HelicalSettings(file=file, pinion_torque=200.0, pinion_speed=100.0, parts="geometry")
    attributes = {"operating_mean_coefficient": np.nan, "operating_power_loss": 3.0}
    film = xr.Dataset(attrs=attributes | {"loss_factor": np.nan})
    results = HelicalResults(
        settings=settings,
        datasets={"stability": stability, "film": film},
        mesh=None,
        failures={},
        interrupted=False,
    )
    rows = {row.quantity: row.value for row in summary_rows(results)}
    assert rows["stable up to the largest factor, with the pair's damping"] == 2.0
    assert "loss factor H_V" not in rows
    assert "nan" not in summary_csv(summary_rows(results))


@pytest.mark.slow
@pytest.mark.parametrize(("options", "stiffness"), [((), 756e6), (("--mesh", "density"), 539e6)])
def test_the_pair_vibrates_on_the_stiffness_of_its_loaded_contact(
    options, stiffness, tmp_path, monkeypatch
):
    """By default; that of ISO 6336-1 on request. Values of docs/helical.md, tangent at 226 N.m."""
    real = HelicalSettings.__init__

    def init(self, **given):
        given |= {"stability_columns": 4, "stability_rows": 2, "separation_speeds": 0}
        real(self, **given)

    def contact(study, _):
        study.mesh = named_line_mesh("he_2007")

    monkeypatch.setattr(HelicalSettings, "__init__", init)
    monkeypatch.setattr(catalogue, "save_helical_figures", lambda *_: [])
    monkeypatch.setattr(stages, "_contact", contact)
    few = ("--parts", "dynamics", "--mu", 0.1, "--speeds-rpm", 1000, "--jobs", 1)
    result = run(*few, *options, "--friction", "constant", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    # the shipped line mesh is at 226 N.m; the operating point is 225.97 N.m
    found = datasets(tmp_path)["response"].attrs["mean_mesh_stiffness"]
    assert found == pytest.approx(stiffness, rel=2e-3)


def test_a_pressure_that_no_flank_bears_is_explained():
    with house_style():
        figure = new_figure(4.0, 3.0)
        calm, sharp = figure.subplots(1, 2)
        calm.plot([0.0, 1.0], [0.5, 1.5])
        sharp.plot([0.0, 1.0], [0.5, 6.0])
        for ax in (calm, sharp):
            mark_edge_pressure(ax)
    assert not calm.texts
    assert "sharp edge" in sharp.texts[0].get_text()


def test_numbers_of_the_share_are_taken_as_given_and_refused_where_nothing_takes_them(asked):
    run("--boundary-friction", "0.1")
    asperities = asked[0]["settings"].film().asperities
    assert asperities.numbers == {"boundary_friction": 0.1, "share_exponent": 1.0}
    with pytest.raises(ParameterError, match="takes --boundary-friction, got --friction film"):
        replace(asked[0]["settings"], friction="film")
    run("--share-exponent", "0.5")
    asperities = asked[1]["settings"].film().asperities
    assert asperities.numbers == {"boundary_friction": 0.07, "share_exponent": 0.5}
    with pytest.raises(ParameterError, match="takes --share-exponent, got --friction film"):
        replace(asked[1]["settings"], friction="film")
    with pytest.raises(ParameterError, match=r"share_exponent must be within 0\.2 to 5, got 0"):
        replace(asked[1]["settings"], share_exponent=0.0).film()
