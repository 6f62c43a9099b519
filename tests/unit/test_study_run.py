"""What surrounds a study in its command."""

import logging
from pathlib import Path
from types import SimpleNamespace
from typing import Annotated

import pytest
import typer
from typer.testing import CliRunner

from gearlube.cli.option_groups import MultiValueCommand
from gearlube.cli.study_run import _ProgressLines, progress_on, run_next, study_run
from gearlube.report.page import write_report
from gearlube.report.parts import Report


@pytest.mark.parametrize("code", [0, 3])
def test_the_next_command_gets_its_arguments_and_its_exit_code_is_that_of_both(code):
    app, said = typer.Typer(), []

    @app.command()
    def first(context: typer.Context):
        run_next(context, "second", ["a.toml", "--jobs", "2"])
        said.append("after")

    @app.command()
    def second(name: str, jobs: int = 1):
        said.append((name, jobs))
        raise typer.Exit(code)

    assert CliRunner().invoke(app, ["first"]).exit_code == code
    assert said == [("a.toml", 2), *(["after"] if code == 0 else [])]


def test_options_whose_metavar_ends_in_dots_take_several_values():
    app, found = typer.Typer(), {}

    @app.command(cls=MultiValueCommand)
    def vary(
        study: str,
        file: str,
        vary: Annotated[list[str], typer.Option(metavar="KEY=VALUES...")],
        speed: Annotated[list[str], typer.Option(metavar="RANGE...")],
        out: Annotated[str, typer.Option(metavar="DIR")],
    ):
        found.update(locals())

    typed = [
        "map",
        "--vary",
        "a.b=1",
        "c=2,3",
        "--speed",
        "20:40:10",
        "55",
        "axle.toml",
        "--out",
        "x=y",
        "--vary",
        "d=4",
    ]
    assert CliRunner().invoke(app, typed).exit_code == 0
    assert found["vary"] == ["a.b=1", "c=2,3", "d=4"]
    assert found["speed"] == ["20:40:10", "55"]
    assert (found["study"], found["file"], found["out"]) == ("map", "axle.toml", "x=y")


def test_a_stopped_study_says_what_may_be_incomplete(tmp_path: Path, caplog):
    def stopped() -> None:
        with study_run("springs", tmp_path / "out") as run, run.results() as progress:
            progress(0.5, "half")
            raise KeyboardInterrupt

    with pytest.raises(typer.Exit) as stop:
        stopped()
    assert stop.value.exit_code == 130
    assert f"{tmp_path / 'out'} may be incomplete" in caplog.text
    assert not (tmp_path / "out").exists()  # nothing was written, so nothing stays


def test_what_is_written_is_named_with_its_folder(tmp_path: Path, caplog):
    caplog.set_level(logging.INFO, "gearlube")
    with study_run("springs", tmp_path) as run:
        run.written("a.nc", "figures", note=" (table)")
    assert f"Results: {tmp_path / 'a.nc'} (table), {tmp_path / 'figures'}" in caplog.text


def test_progress_that_is_no_terminal_is_a_line_each_tenth_with_the_time_left(caplog, monkeypatch):
    clock = [100.0]
    monkeypatch.setattr("gearlube.cli.study_run.time.monotonic", lambda: clock[0])
    caplog.set_level(logging.INFO, "gearlube")
    with progress_on("sweep") as report:
        for step in range(1, 101):
            clock[0] += 0.5  # s, 50 s in all
            report(step / 100.0, f"point {step}")
    lines = [one.getMessage() for one in caplog.records]
    assert len(lines) == 10
    assert lines[1] == "sweep 20 % after 10 s, about 40 s left: point 20"
    assert lines[-1] == "sweep 100 % after 50 s: point 100"


def test_progress_that_stands_still_is_told_each_half_a_minute(caplog, monkeypatch):
    """A span of half a minute has a line where none was written in it."""
    clock = iter([0.0, 5.0, 60.0, 90.0])
    monkeypatch.setattr("gearlube.cli.study_run.time.monotonic", lambda: next(clock))
    caplog.set_level(logging.INFO, "gearlube")
    lines, spans = _ProgressLines("sweep"), iter([False, False, False, True])
    lines.ended = SimpleNamespace(wait=lambda _: next(spans))
    lines.report(0.0, "compiling")
    lines.tell_in_silence()
    assert caplog.messages == [f"sweep 0 % after {s} s: compiling" for s in (5, 60, 90)]


def test_a_report_within_a_command_says_the_command(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.argv", ["gearlube", "map", "my axle.toml"])
    app = typer.Typer()
    app.command()(lambda: write_report(Report(study="map", title="Map"), tmp_path) and None)
    assert CliRunner().invoke(app, []).exit_code == 0
    assert "gearlube map &#39;my axle.toml&#39;" in (tmp_path / "report.html").read_text()
    write_report(Report(study="map", title="Map"), tmp_path)
    assert "my axle.toml" not in (tmp_path / "report.html").read_text()


def test_time_left_does_not_count_preparation(monkeypatch, caplog):
    """60 s of preparation, then a fifth of the work in 10 s: four fifths are left."""
    times = iter([0.0, 60.0, 70.0])
    monkeypatch.setattr("gearlube.cli.study_run.time.monotonic", lambda: next(times))
    with caplog.at_level(logging.INFO), progress_on("sweep") as report:
        report(0.0, "starting")
        report(0.2, "a point")
    assert caplog.messages[-1] == "sweep 20 % after 70 s, about 40 s left: a point"
