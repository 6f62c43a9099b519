"""The problem file that a design writes."""

from types import SimpleNamespace

import pytest

from gearlube.output.toml_text import toml_text
from gearlube.studies.design.problem import SHARES, problem_text
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

# twice 45 um over 8 % of the height would be steeper than a gear file takes
RELIEF = {"tip_relief_um": 45.0, "tip_relief_depth_mm": 1.5}
AMOUNTS = {"pinion tip": 45.0, "gear tip": 45.0, "ends": 30.0}


def design(relief):
    """A design of the shipped pair's settings, with relief of the drive flanks or without."""
    pair = HypoidGearFile.named("mohammadpour_2015")
    flanks = {f"{role}.drive_flank": relief for role in ("pinion", "gear")} if relief else {}
    names = [f"{flank}.{name}" for flank in flanks for name in relief]
    file = pair.varied(flanks | {"completed": (*pair.completed, *names)})
    return SimpleNamespace(
        file=file,
        designed=SimpleNamespace(blank=file.blank()),
        relief=SimpleNamespace(torque=300.0, amounts={"drive": AMOUNTS}),
    )


@pytest.mark.parametrize("relief", [RELIEF, {}])
def test_the_problem_of_a_design_is_one_that_optimise_takes_beside_its_gear_file(tmp_path, relief):
    made = design(relief)
    gear = toml_text(made.file.model_dump(exclude_defaults=True))
    (tmp_path / f"{made.file.name}.toml").write_text(gear, encoding="utf-8")
    path = tmp_path / "problem.toml"
    path.write_text(problem_text(made), encoding="utf-8")
    problem = Problem.of(OptimisationFile.from_toml(path))
    assert problem.file == made.file
    assert [one.torque for one in problem.loads] == pytest.approx([45.0, 90.0, 90.0])
    assert [one.side for one in problem.loads] == ["drive", "drive", "coast"]
    assert ("gear.drive_flank.tip_relief_um" in problem.names) == bool(relief)
    assert any(name.startswith("pinion.machine.") for name in problem.names)
    assert not any(name.startswith(("gear.machine.", "gear.cutter.")) for name in problem.names)
    assert len(SHARES) == len(problem.given.torques_n_m)


def test_a_gear_file_that_is_nowhere_is_refused_by_its_name(tmp_path):
    path = tmp_path / "problem.toml"
    path.write_text(problem_text(design({})), encoding="utf-8")
    with pytest.raises(ParameterError, match=r"mohammadpour_2015\.toml"):
        Problem.of(OptimisationFile.from_toml(path))
