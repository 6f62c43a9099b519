"""`gearlube axle show` and the example that commands print."""

from pathlib import Path

from typer.testing import CliRunner

from drivetrain.axle_file.read_axle import read_axle
from gearlube import command as cli

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_axle.toml"


def test_the_command_shows_inputs_and_prints_the_example(tmp_path: Path) -> None:
    shown = CliRunner().invoke(cli.app, ["axle", "show", str(EXAMPLE)])
    assert shown.exit_code == 0
    lines = {line.split()[0]: line.split()[1:4] for line in shown.output.splitlines()[2:]}
    assert lines["vehicle.mass_kg"] == ["2100", "kg", "given"]
    assert lines["driveline.wheel_inertia_kg_m2"] == ["0.9", "kg.m2", "assumed"]
    only = CliRunner().invoke(cli.app, ["axle", "show", str(EXAMPLE), "--assumed"]).output
    assert "given" not in only.replace("not given", "")
    for command in (["sweep"], ["axle", "show"]):
        text = CliRunner().invoke(cli.app, [*command, "--example"]).output
        path = tmp_path / "copy.toml"
        path.write_text(text)
        assert read_axle(path).name == "mohammadpour_2015"
