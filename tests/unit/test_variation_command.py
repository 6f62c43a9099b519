"""The command `gearlube vary` from words to files."""

import csv

import pytest
from typer.testing import CliRunner

from gearlube import command
from gearlube.variation.store import open_variation
from gearlube_core.errors import GearLubeError

WORDS = (
    "vary", "bearing", "--vary", "load.axial=1000:3000", "shaft.speed=500,2000", "--design",
    "lhs:16", "--limit", "torque=1.5", "--jobs", "1", "--out", "results",
)  # fmt: skip


@pytest.fixture
def run(tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)

    def invoke(*words):
        caplog.clear()
        with caplog.at_level("INFO"):
            result = CliRunner().invoke(command.app, list(words))
        return result.exit_code, result.output + caplog.text

    return invoke


@pytest.mark.slow
def test_a_bearing_is_varied_and_all_files_are_there(run, tmp_path):
    """Draws three figures: seconds."""
    code, said = run(*WORDS)
    assert code == 0, said
    assert "% of the points have a torque above 1.5" in said.replace("1.50", "1.5")
    folder = tmp_path / "results"
    names = {path.name for path in folder.iterdir()}
    assert names >= {"results.zarr", "points.csv", "summary.csv", "summary.nc", "sensitivity.csv"}
    drawn = {path.name for path in (folder / "figures").iterdir()}
    assert drawn == {"histograms.png", "sensitivity.png", "lines.png"}
    found = open_variation(folder)
    assert found["shaft.speed_rpm"].values.tolist() == [500.0] * 16 + [2000.0] * 16
    with (folder / "sensitivity.csv").open() as stream:
        ranks = [row for row in csv.DictReader(stream) if row["quantity"] == "torque"]
    # more load, more friction, in every law: the order of loads is the order of torques
    assert [float(row["load.axial_n"]) for row in ranks] == pytest.approx([1.0, 1.0])
    code, said = run(*WORDS)
    assert code == 0
    assert "0 points computed" in said


def test_the_keys_of_a_study_are_listed_with_units_and_usual_values(run):
    code, said = run("vary", "map", "--keys")
    assert code == 0
    rows = {line.split()[0]: line for line in said.splitlines() if line.startswith("  ")}
    assert " N " in rows["pinion.bearing.preload_n"]
    assert " N " in rows["bearing.preload"]
    assert "usually 80.0" in rows["oil.temperature_degc"]
    assert "gearbox.ratios" not in rows
    assert " W " in rows["loss"]


def test_scatter_samples_the_tolerances_of_the_file_that_are_not_varied_otherwise(
    run, tmp_path, monkeypatch
):
    made = []

    def stop(folder, study, design, **others):
        made.append(design)
        raise GearLubeError("far enough")

    monkeypatch.setattr("gearlube.variation.run.BlockStore.made", stop)
    monkeypatch.setattr("gearlube.variation.run.check_all", lambda *others: None)
    (tmp_path / "axle.toml").write_text(
        'gear_set.mesh_table = "mohammadpour_2015"\n'
        "tolerances.gear_set.backlash_um = { plus_minus = 30.0 }\n"
        "tolerances.pinion.bearing.preload_n = { plus_minus = 500.0 }\n"
    )
    run("vary", "map", "axle.toml", "--scatter", "--vary", "pinion.bearing.preload=2000,3000")
    assert [axis.key for axis in made[0].axes] == ["pinion.bearing.preload_n"]
    assert [one.key for one in made[0].spreads] == ["gear_set.backlash_um"]
    assert (made[0].sampling.method, made[0].sampling.count) == ("lhs", 1000)
    for words, reason in (
        (("vary", "bearing", "--scatter"), "got none in the file of wingertszahn_2023"),
        (("vary", "map", "--scatter"), "needs [tolerances] in the file"),
    ):
        code, said = run(*words)
        assert code == 2
        assert reason in said


@pytest.mark.slow
def test_many_parts_of_a_tolerance_file_are_predicted_with_their_share_above_a_limit(run, tmp_path):
    """Forty bearings: draws five figures, seconds."""
    (tmp_path / "load.toml").write_text("[tolerances]\nload.axial_n = { plus_minus = 900.0 }\n")
    words = "--design", "lhs:40", "--parts", "500", "--limit", "torque=1.7", "--jobs", "1"
    code, said = run("vary", "bearing", "--tolerances", "load.toml", *words, "--out", "results")
    assert code == 0, said
    assert "of 500 parts have a torque above 1.70 N·m" in said
    assert "of the full runs alone" in said
    assert "load.axial_n 100 %" in said  # the one tolerance has all of the scatter
    folder = tmp_path / "results"
    assert (folder / "parts.nc").is_file()
    drawn = {path.name for path in (folder / "figures").iterdir()}
    assert drawn >= {"parts.png", "pays.png", "check.png", "histograms.png"}
    assert "Which tolerance pays" in (folder / "report.html").read_text()
    code, said = run("vary", "bearing", "--vary", "load.axial=1000,2000", "--parts", "500")
    assert code != 0
    assert "--parts needs at least 40 samples" in said
