"""`gearlube runup` as it is typed."""

import pytest
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import app
from gearlube.studies.runup.animation.dataset import load_animation
from gearlube.studies.runup.figures.catalogue import CATALOGUE
from gearlube.studies.runup.run import load_runup


@pytest.mark.slow
def test_up_and_down_writes_two_ramps_one_summary_and_one_report(tmp_path) -> None:
    out = tmp_path / "ramp"
    told = CliRunner().invoke(
        app,
        "runup --rpm --from 1500 --to 1900 --duration 2 --torque 80 --coast-down "
        "--coast-torque -40 --animate-rpm 1700 "
        f"--out {out}".split(),
    )
    assert told.exit_code == 0, told.output
    up, down = load_runup(out), load_runup(out / "coastdown.nc")
    assert (up.attrs["ramp"], down.attrs["ramp"]) == ("run-up", "coast-down")
    assert float(up["mesh_force"].mean()) > 0.0 > float(down["mesh_force"].mean())
    html = (out / "report.html").read_text(encoding="utf-8")
    assert "Run-up: the loudest is mesh order" in html
    assert "Coast-down: the loudest is mesh order" in html
    assert len(list((out / "figures").glob("*.png"))) == 2 * len(CATALOGUE)
    assert "Run-up: flanks in motion" in html
    assert "Coast-down: rollers in motion" in html
    moving = {path.name for path in (out / "animation").iterdir()}
    assert {"runup.nc", "runup_flanks.gif", "coastdown_rollers.gif"} < moving
    down = load_animation(out / "animation" / "coastdown.nc")
    assert float(down["pinion_speed"].mean()) == pytest.approx(gl.rpm_to_rads(1700.0), rel=1e-3)
    assert (down["side"].values == -1.0).all()
    ramps = {line.split(",")[0] for line in (out / "summary.csv").read_text().splitlines()[1:]}
    assert ramps == {"run-up", "coast-down"}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--from 20 --to 120 --duration 3", "the ramp is too fast"),
        ("--rpm --from 600", "--rpm needs --from and --to"),
        ("--coast-down --torque 50", "--coast-down needs --torque and --coast-torque"),
        ("--torque 50 --engine-orders", "pinion_torque must be left out"),
    ],
)
def test_options_that_contradict_are_refused_before_anything_runs(
    tmp_path, caplog, options, said
) -> None:
    out = tmp_path / "ramp"
    told = CliRunner().invoke(app, [*f"runup {options} --out".split(), str(out)])
    assert told.exit_code == 2
    assert said in caplog.text
    assert not out.exists()
