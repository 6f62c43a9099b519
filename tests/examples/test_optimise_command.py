"""The command `gearlube optimise`: what it writes, says, keeps and refuses."""

import logging
import tomllib

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.studies.optimise.figures import OPTIMISE_CATALOGUE
from gearlube_core.flank_optimisation import held_model, optimise
from gearlube_core.flank_optimisation.held_model import CheckSettings, plain_check
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.helical_contact_cases import stiff_teeth

PROBLEM = """name = "mine"
gear = "he_2007"
torques_n_m = [200.0]
orders = [1, 2]
positions = 6

[parameters]
pinion.flank.crown_um = { low = 0.0, high = 12.0, start = 1.0 }

[limits]
sensitivity = 3.0
"""
ERRORS = """
[errors]
lead_slope_um = 5.0
"""


def run(*arguments):
    return CliRunner().invoke(cli.app, ["optimise", *map(str, arguments)])


@pytest.mark.parametrize("name", ["helical", "hypoid"])
def test_an_example_is_printed_that_is_the_shipped_problem(name):
    printed = run(name, "--example")
    assert printed.exit_code == 0
    given = OptimisationFile.from_data(tomllib.loads(printed.stdout), "printed")
    assert given == OptimisationFile.named(name)


@pytest.mark.parametrize(
    ("errors", "options", "designs"),
    [
        ("", (), 2),
        pytest.param(ERRORS, ("--nominal", "--front", 2), 3, marks=pytest.mark.slow),
    ],
)
def test_a_better_pair_is_written_and_a_second_run_computes_nothing(
    tmp_path, monkeypatch, errors, options, designs
):
    # rigid teeth: the elastic ones take half a minute
    monkeypatch.setattr(optimise, "_stiffness", lambda *_: {"drive": stiff_teeth(1.1e11)})
    coarse = CheckSettings(positions=6, helical=held_model.HELICAL_CELLS)

    def quick_check(problem, file, stiffness, settings, **more):
        assert settings.positions == 6
        return plain_check(problem, file, stiffness, coarse, **more)

    monkeypatch.setattr(optimise, "plain_check", quick_check)
    problem, out = tmp_path / "problem.toml", tmp_path / "out"
    problem.write_text(PROBLEM + errors)
    asked = (problem, "--out", out, "--rounds", 1, "--positions", 6, "--jobs", 1)
    assert run(*asked, *options).exit_code == 0
    kept = {"evaluations", "positions", "gearlube_results.json"}
    names = {path.name for path in out.iterdir()}
    assert names == kept | {"mine.toml", "report.html", "optimise.nc", "figures"}
    drawn = set(OPTIMISE_CATALOGUE) - (set() if errors else {"errors", "front"})
    assert {path.stem for path in (out / "figures").iterdir()} == drawn
    better = HelicalGearFile.from_toml(out / "mine.toml")
    with xr.open_dataset(out / "optimise.nc") as dataset:
        crown = float(dataset["value"].sel(design="better", parameter="pinion.flank.crown_um"))
        assert better.pinion.flank.crown_um == crown
        whine = dataset["whine"].sel(torque=200.0)
        mean = np.sqrt((whine**2).mean("error"))
        assert mean.sel(design="better") < mean.sel(design="before")
        assert dataset.sizes["design"] == designs
        assert dataset.sizes["error"] == (3 if errors else 1)
    report = (out / "report.html").read_text(encoding="utf-8")
    assert "pinion.flank.crown_um" in report
    for part in ("sensitivity to errors", "With errors and without", "against loss"):
        assert (part in report) == bool(errors)
    monkeypatch.setattr(held_model.HeldModel, "_cut", lambda self: pytest.fail("cut again"))
    assert run(*asked, *options).exit_code == 0


@pytest.mark.parametrize(
    ("text", "more", "said"),
    [
        (PROBLEM.replace("low = 0.0", "low = 20.0"), (), "low must be below high"),
        (PROBLEM, ("--positions", 4), "--positions must be within 5 to 400, got 4"),
        (PROBLEM, ("--rounds", 0), "--rounds must be within 1 to 50"),
    ],
)
def test_wrong_inputs_are_refused_and_leave_nothing(tmp_path, caplog, text, more, said):
    problem, out = tmp_path / "problem.toml", tmp_path / "out"
    problem.write_text(text)
    with caplog.at_level(logging.ERROR, logger="gearlube"):
        found = run(problem, "--out", out, *more)
    assert found.exit_code == BAD_ARGUMENT
    assert said in caplog.text
    assert not out.exists()
