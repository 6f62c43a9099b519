"""`gearlube measured` on the made data of examples/measured."""

from pathlib import Path

from typer.testing import CliRunner

from gearlube import command as cli
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = Path(__file__).parents[2] / "examples" / "measured" / "axle_17.toml"


def measured(*arguments):
    return CliRunner().invoke(cli.app, ["measured", *map(str, arguments)])


def test_the_example_becomes_a_gear_file_with_a_picture(tmp_path):
    done = measured(FILE, "--out", tmp_path / "m")
    assert done.exit_code == 0, done.output
    file = HypoidGearFile.from_toml(tmp_path / "m" / "axle_17.toml")
    # the pinion's coast flank of the example was cut with 21 um more from toe root to heel tip
    ends = file.correction("pinion", "coast").bends([0.9, 0.3], [0.1, 0.9], 1.0, 1.0).value
    assert 15e-6 < ends[0] - ends[1] < 25e-6
    assert (tmp_path / "m" / "flanks.png").stat().st_size > 10_000


def test_a_wrong_file_ends_with_a_sentence_and_no_folder(tmp_path, caplog):
    (tmp_path / "one.toml").write_text(FILE.read_text().replace("degree = 3", "degree = 9"))
    done = measured(tmp_path / "one.toml", "--out", tmp_path / "m")
    assert done.exit_code != 0
    assert "degree must be a whole number, 0 to 5" in caplog.text
    assert not (tmp_path / "m").exists()
