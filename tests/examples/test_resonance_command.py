"""The command `gearlube resonance`: what it writes, refuses and keeps when stopped."""

import logging

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.studies.resonance import run as resonance_run
from gearlube.studies.resonance import study
from gearlube.studies.resonance.figures.catalogue import RESONANCE_CATALOGUE
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.errors import ConvergenceError
from gearlube_core.mesh_table.netcdf import write_mesh_table
from tests.helpers.each import each


def run(*arguments):
    return CliRunner().invoke(cli.app, ["resonance", *map(str, arguments)])


@pytest.fixture
def asked(monkeypatch):
    """What the command would have studied; it ends as a failed study does."""
    calls = []

    def note(settings, **options):
        calls.append({"settings": settings, **options})
        raise ConvergenceError("noted")

    monkeypatch.setattr(resonance_run, "run_resonance", note)
    return calls


@pytest.mark.slow
def test_quick_run_writes_datasets_and_all_figures(tmp_path):
    result = run("--quick", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    assert {path.stem for path in (tmp_path / "figures").glob("*.png")} == set(RESONANCE_CATALOGUE)
    response = xr.load_dataset(tmp_path / "resonance.nc", engine="scipy")
    cycle = xr.load_dataset(tmp_path / "cycle.nc", engine="scipy")
    assert response.sizes["model"] == 4
    # three pairs, at 0.3 and 1 of the natural frequency and at 0.3 with hot oil
    assert cycle["load"].dims == ("case", "pair", "phase")
    np.testing.assert_allclose(cycle["case_relative_frequency"], [0.3, 1.0, 0.3])
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.slow  # the library call without friction is in the default run
def test_run_without_friction_leaves_out_the_lubricated_model_and_its_figures(tmp_path):
    options = ("--mesh", "synthetic", "--friction", "off", "--frequencies", 5)
    options += ("--range", "0.7:1.1")  # with the folds of the resonance
    result = run(*options, "--quick", "--out", tmp_path)
    assert result.exit_code == 0, result.output
    response = xr.load_dataset(tmp_path / "resonance.nc", engine="scipy")
    assert list(response["model"].values) == ["two_dof", "one_dof", "two_dof_mean_radii"]
    figures = {path.stem for path in (tmp_path / "figures").glob("*.png")}
    lubricated = {name for name, one in RESONANCE_CATALOGUE.items() if one.needs == "load"}
    assert figures == set(RESONANCE_CATALOGUE) - lubricated


def test_a_stopped_run_writes_what_was_found_and_says_so(tmp_path, monkeypatch, caplog):
    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(study, "motions_at", stop)
    options = ("--mesh", "synthetic", "--friction", "off", "--quick", "--frequencies", 2)
    options += ("--range", "0.9:1.05")
    with caplog.at_level(logging.WARNING, "gearlube"):
        assert run(*options, "--out", tmp_path).exit_code == INTERRUPTED
    assert "Stopped" in caplog.text
    response = xr.load_dataset(tmp_path / "resonance.nc", engine="scipy")
    assert response.attrs["interrupted"] == 1
    assert response.sizes["model"] == 3
    figures = {path.stem for path in (tmp_path / "figures").glob("*.png")}
    assert figures == {"response", "harmonics", "stability"}


def test_a_run_stopped_at_once_writes_empty_datasets(tmp_path, monkeypatch):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(study, "follow_response", stop)
    assert run("--friction", "off", "--out", tmp_path).exit_code == INTERRUPTED
    response = xr.load_dataset(tmp_path / "resonance.nc", engine="scipy")
    assert not response.data_vars
    assert response.attrs["interrupted"] == 1
    assert not list((tmp_path / "figures").glob("*.png"))


def test_options_reach_the_settings_in_si_units(asked):
    result = run(
        *("--mesh", "synthetic", "--mismatch", "0.3", "--radii", "paper", "--torque", "80"),
        *("--oil-temperature", "100", "--roughness-um", "0.4", "--range", "0.3:1.2"),
        *("--frequencies", "50", "--load-at", "0.9"),
    )
    assert result.exit_code == FAILED, result.output
    settings = asked[0]["settings"]
    mesh = synthetic_mesh(radius_mismatch=0.003, torque=80.0)
    np.testing.assert_array_equal(settings.mesh.series["R_p"], mesh.series["R_p"])
    assert (settings.first, settings.last, settings.frequencies) == (0.3, 1.2, 50)
    assert settings.load_at == 0.9
    assert settings.radii == "paper"
    assert settings.pinion_torque == 80.0
    assert settings.oil_temperature == pytest.approx(373.15)
    assert settings.roughness_rms == pytest.approx(0.4e-6)
    assert str(asked[0]["folder"]) == "gearlube_resonance"


def test_defaults_are_the_shipped_mesh_with_consistent_radii(asked):
    assert run().exit_code == FAILED
    settings = asked[0]["settings"]
    assert settings.mesh.name == "mohammadpour_2015"
    assert (settings.radii, settings.friction, settings.frequencies) == (
        "consistent",
        "thermal_eyring",
        200,
    )


def test_a_mesh_table_is_read_from_its_file(asked, tmp_path):
    path = write_mesh_table(synthetic_mesh(stiffness=3e8), tmp_path / "own.nc")
    assert run("--mesh", path).exit_code == FAILED
    assert asked[0]["settings"].mesh.series["k_m"][0, 0, 0] == 3e8


@each(
    "options",
    [
        ("--mesh", "no_such_file.nc"),
        ("--mismatch", "0.3"),
        ("--mesh", "synthetic", "--mismatch", "0.3"),
        ("--mesh", "synthetic", "--mismatch", "90", "--radii", "paper"),
        ("--radii", "other"),
        ("--friction", "some"),
        ("--range", "0.2"),
        ("--range", "1.6:0.2"),
        ("--range", "a:b"),
        ("--range", "0.2:9"),
        ("--frequencies", "1"),
        ("--torque", "-5"),
        ("--torque", "1e5"),
        ("--oil-temperature", "400"),
        ("--roughness-um", "-1"),
        ("--load-at", "5"),
    ],
)
def test_bad_options_end_with_bad_argument(options, asked):
    result = run(*options)
    assert result.exit_code == BAD_ARGUMENT, result.output
    assert not asked
