"""The command `gearlube design`: what it writes, says and refuses."""

import logging
import tomllib

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.studies.design import command
from gearlube.studies.design.figures import DESIGN_CATALOGUE
from gearlube.studies.design.summary import unmet_targets
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import design_pair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.units import without_units

EXAMPLE = BlankFile.shipped_text("hypoid_13_42")


def run(*arguments):
    return CliRunner().invoke(cli.app, ["design", *map(str, arguments)])


# seconds: settings and ease-off of both sides are found in full
def test_the_example_is_designed_and_what_is_written_can_be_used(tmp_path, monkeypatch):
    then = []
    monkeypatch.setattr(command, "run_next", lambda _, *rest: then.append(rest))
    printed = run("--example")
    assert printed.exit_code == 0
    blank, out = tmp_path / "blank.toml", tmp_path / "out"
    # relief that is chosen needs elastic teeth
    relief = "[relief]\ntip_relief_um = 20.0\nend_relief_um = 30.0\n"
    blank.write_text(printed.stdout.replace("hypoid_13_42", "mine") + relief)
    assert run(blank, "--out", out, "--optimise").exit_code == 0
    assert then == [("optimise", [str(out / "problem.toml"), "--out", str(out / "optimised")])]
    problem = Problem.of(OptimisationFile.from_toml(out / "problem.toml"))
    names = {path.name for path in out.iterdir()}
    written = {
        "mine.toml",
        "axle.toml",
        "problem.toml",
        "report.html",
        "design.nc",
        "gearlube_results.json",
    }
    assert names == written | {"figures", "gearlube_results.json"}
    assert {path.stem for path in (out / "figures").iterdir()} == set(DESIGN_CATALOGUE)
    gear = HypoidGearFile.from_toml(out / "mine.toml")
    assert problem.file == gear
    check_pair(gear)
    # a quarter of the tooth height, and 15 % of the gear's face and what the pinion's is longer, as
    # the page of fields says
    depth = 1e3 * gear.blank().whole_depth
    for flank in (gear.pinion.drive_flank, gear.gear.coast_flank):
        assert flank.tip_relief_depth_mm == pytest.approx(0.25 * depth, abs=1e-6)
    heel = gear.pinion.coast_flank.heel_relief_length_mm
    beyond = 0.5 * (gear.pinion.face_width_mm - gear.gear.face_width_mm)
    assert heel == pytest.approx(0.15 * gear.gear.face_width_mm + beyond, abs=1e-6)
    axle = tomllib.loads((out / "axle.toml").read_text())
    assert axle["gear_set"]["gear_file"] == "mine.toml"
    report = (out / "report.html").read_text(encoding="utf-8")
    for part in ("wanted and found", "undercut", "blade points", "a third of the face width"):
        assert part in report
    with xr.open_dataset(out / "design.nc") as dataset:
        assert not without_units(dataset)
        errors = [dataset["error"].sel(side=side).values for side in ("drive", "coast")]
        # 40 positions miss the handover by up to an 80th of the period, 5 % of a parabola
        assert [np.ptp(one) for one in errors] == pytest.approx([50e-6, 80e-6], rel=0.06)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("offset_mm = 15.0", "offset_mm = 80.0", "No blank of method 1"),
        ('name = "hypoid_13_42"', 'name = "../mine"', "Files are named after it"),
        ("drive_error_urad = 50.0", "drive_path_angle_deg = 156.0", "from the lines of contact"),
        ("drive_error_urad = 50.0", "ellipse_length_mm = 100.0", "at most twice"),
    ],
)
def test_what_cannot_be_designed_is_refused_and_nothing_is_left(tmp_path, caplog, old, new, said):
    assert old in EXAMPLE
    blank, out = tmp_path / "blank.toml", tmp_path / "out"
    blank.write_text(EXAMPLE.replace(old, new))
    with caplog.at_level(logging.WARNING):
        result = run(blank, "--out", out)
    assert result.exit_code == BAD_ARGUMENT
    assert said in result.output + caplog.text
    assert not out.exists()


@pytest.mark.slow
def test_without_curved_blades_the_report_says_how_near_it_came_and_what_to_relax():
    file = BlankFile.named("hypoid_13_42").varied({"machine.curved_blades": False})
    said = " ".join(unmet_targets(design_pair(file)))
    assert "coast flanks" in said
    assert "Or allow machine.curved_blades" in said
