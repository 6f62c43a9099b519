"""The command `gearlube design`: designs that the contact analysis judges, files, refusals."""

import logging
import math
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.output.toml_text import toml_text
from gearlube.studies.design import command
from gearlube.studies.design import run as design_run
from gearlube.studies.design.figures import DESIGN_CATALOGUE
from gearlube.studies.design.findings import unmet_targets
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import design_pair, misses
from gearlube_core.hypoid_design.flank_target import measured_contact
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.units import without_units

EXAMPLE = BlankFile.shipped_text("hypoid_13_42")
# relief as given: that which is chosen needs elastic teeth (test_chosen_relief.py)
RELIEF = "[relief]\ntip_relief_um = 20.0\nend_relief_um = 30.0\n"
SAMPLE = BlankFile.from_data(tomllib.loads(EXAMPLE + RELIEF), "the example")
SIDES = ("drive", "coast")
# transmission error [-], path direction [rad], centre [m] that a design may miss
NEAR = {"drive": (0.10, math.radians(2.0), 0.5e-3), "coast": (0.15, math.radians(2.0), 0.5e-3)}


def run(*arguments):
    return CliRunner().invoke(cli.app, ["design", *map(str, arguments)])


def check_near(design):
    for side in SIDES:
        found = measured_contact(design.as_cut, side)
        for missed, limit in zip(
            misses(design.targets[side], found, design.designed), NEAR[side], strict=False
        ):
            assert abs(missed) < limit, side


# seconds: settings and ease-off of both sides are found in full
@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The example as printed, designed by the command: what was found, written and run then."""
    folder, then, designs = tmp_path_factory.mktemp("design"), [], []
    blank, out = folder / "blank.toml", folder / "out"

    def designed(*given):
        designs.append(design_pair(*given))
        return designs[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(command, "run_next", lambda _, *rest: then.append(rest))
        patch.setattr(design_run, "design_pair", designed)
        printed = run("--example")
        assert printed.exit_code == 0
        blank.write_text(printed.stdout.replace("hypoid_13_42", "mine") + RELIEF)
        assert run(blank, "--out", out, "--optimise").exit_code == 0
    return SimpleNamespace(out=out, then=then, design=designs[0])


@pytest.mark.slow
def test_the_contact_analysis_finds_what_was_asked(made):
    check_near(made.design)


def test_the_gear_file_is_taken_as_it_is_and_says_what_was_not_given(made):
    file = made.design.file
    text = toml_text(file.model_dump(exclude_none=True))
    assert HypoidGearFile.from_data(tomllib.loads(text), "the design") == file
    assert pair_warnings(file) == []
    assert file.origin("pinion.machine.tilt_angle_deg") == "completed"
    assert file.origin("gear.pitch_angle_deg") == "inferred"
    assert file.origin("gear.teeth") == "table"


def test_both_members_have_sound_teeth_without_undercut(made):
    for role in ("pinion", "gear"):
        said = " ".join(tooth_form(made.design.file, role).report())
        assert "undercut" not in said
        assert "pointed" not in said
        assert "slot closes" not in said


def test_what_is_written_can_be_used(made):
    out = made.out
    assert made.then == [("optimise", [str(out / "problem.toml"), "--out", str(out / "optimised")])]
    problem = Problem.of(OptimisationFile.from_toml(out / "problem.toml"))
    names = {path.name for path in out.iterdir()}
    written = {"mine.toml", "axle.toml", "problem.toml", "report.html", "design.nc"}
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
        errors = [dataset["error"].sel(side=side).values for side in SIDES]
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


BEVEL = {  # teeth and size of the bevel sample F.2 of ISO 23509
    "pair.pinion_teeth": 14,
    "pair.gear_teeth": 39,
    "pair.offset_mm": 0.0,
    "pair.face_width_mm": 25.4,
    "pair.outer_pitch_diameter_mm": 176.893,
    "pair.pinion_spiral_angle_deg": None,
    "pair.gear_spiral_angle_deg": 35.0,
    "cutter.radius_mm": 114.3,
}
GENERATED = {"machine.gear": "generated"}
MITRE = {"pair.pinion_teeth": 20, "pair.gear_teeth": 20, "pair.face_width_mm": 15.0,
         "pair.outer_pitch_diameter_mm": 80.0, "cutter.radius_mm": 57.15}  # fmt: skip
ZEROL = {"pair.pinion_teeth": 20, "pair.gear_teeth": 40, "pair.face_width_mm": 22.0,
         "pair.outer_pitch_diameter_mm": 120.0, "pair.gear_spiral_angle_deg": 0.0,
         "cutter.radius_mm": 76.2}  # fmt: skip
DUPLEX = {
    "machine.curved_blades": False,
    "machine.modified_roll": True,
    "machine.helical_motion": True,
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        BEVEL,
        {"cutter.blade_groups": 5},
        GENERATED,
        BEVEL | GENERATED,
        GENERATED | {"cutter.blade_groups": 5},
        DUPLEX,
        GENERATED | DUPLEX,
        BEVEL | MITRE | GENERATED,
        BEVEL | ZEROL,
    ],
)
def test_other_processes_have_the_contact_that_was_asked(changes):
    design = design_pair(SAMPLE.varied(changes))
    check_near(design)
    check_pair(design.file)
