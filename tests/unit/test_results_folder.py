"""A folder of results belongs to one run at a time, and to one input."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from pathlib import Path
from typing import Annotated

import pytest
import typer
from typer.testing import CliRunner

from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.results_folder import MARK, results_folder
from gearlube_core.errors import ParameterError
from gearlube_core.storage.folders import LOCK, locked_folder

OF_ANOTHER_PROCESS = """
import sys, time
from pathlib import Path
from gearlube_core.storage.folders import locked_folder
with locked_folder(Path(sys.argv[1])):
    print("locked", flush=True)
    time.sleep(60.0)
"""


def study(
    axle: str,
    speeds: Annotated[list[int] | None, typer.Option()] = None,
    jobs: int = 1,
    out: Path = Path("out"),
    overwrite: bool = False,
) -> None:
    with exit_on_error(), results_folder(out, "map", overwrite=overwrite):
        (out / "map.nc").write_text(Path(axle).read_text())


@pytest.fixture
def run(tmp_path, monkeypatch, caplog):
    application = typer.Typer()
    application.command()(study)
    monkeypatch.chdir(tmp_path)

    def invoke(*words):
        caplog.clear()
        return CliRunner().invoke(application, words).exit_code, caplog.text

    return invoke


def test_results_of_another_input_are_replaced_only_on_demand(run, tmp_path):
    (tmp_path / "soft.toml").write_text('gear_file = "gear.toml"')
    (tmp_path / "same.toml").write_text('gear_file = "gear.toml"')
    (tmp_path / "stiff.toml").write_text('gear_file = "other.toml"')
    (tmp_path / "gear.toml").write_text("teeth = 13")
    assert run("soft.toml", "--speeds", "1")[0] == 0
    # another name of the same content, and what changes no result
    assert run("same.toml", "--speeds", "1", "--jobs", "2")[0] == 0
    for words, reason in (
        (("stiff.toml", "--speeds", "1"), "axle was same.toml (SHA-256"),
        (("soft.toml", "--speeds", "2"), "speeds was 1, now 2"),
        (("soft.toml",), "speeds was 1, now not given"),
    ):
        code, said = run(*words)
        assert code == 2
        assert reason in said
        assert "or --overwrite" in said
    # a file that the input names
    (tmp_path / "gear.toml").write_text("teeth = 14")
    assert run("soft.toml", "--speeds", "1")[0] == 2
    assert (tmp_path / "out/map.nc").read_text() == 'gear_file = "gear.toml"'
    assert run("stiff.toml", "--speeds", "1", "--overwrite")[0] == 0
    assert (tmp_path / "out/map.nc").read_text() == 'gear_file = "other.toml"'
    assert run("stiff.toml", "--speeds", "1")[0] == 0


def test_input_is_free_while_a_folder_has_no_results(run, tmp_path):
    (tmp_path / "out").mkdir()
    mark = {"study": "map", "input": {"axle": "old.toml"}}
    (tmp_path / "axle.toml").write_text("")
    assert run("axle.toml")[0] == 0
    mark["gearlube_version"] = json.loads((tmp_path / "out" / MARK).read_text())["gearlube_version"]
    (tmp_path / "out" / MARK).write_text(json.dumps(mark))
    assert run("axle.toml")[0] == 2
    (tmp_path / "out/map.nc").unlink()
    assert run("axle.toml")[0] == 0


def test_half_written_files_of_dead_runs_are_removed(run, tmp_path):
    (tmp_path / "axle.toml").write_text("")
    assert run("axle.toml")[0] == 0
    halves = [
        "map.nc.123.part",
        "points/a.nc.k3x_92ab.part",
        f"results.zarr/c/0.{32 * 'a'}.partial",
    ]
    others = ["holiday.part", "map.nc", MARK]
    for name in (*halves, *others[:1]):
        (tmp_path / "out" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "out" / name).write_text("half")
    assert run("axle.toml")[0] == 0
    left = {path.name for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert left == set(others)


def test_a_second_run_is_refused_and_a_dead_one_is_followed(run, tmp_path):
    (tmp_path / "axle.toml").write_text("")
    out = tmp_path / "out"
    out.mkdir()
    command = [sys.executable, "-c", OF_ANOTHER_PROCESS, str(out)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "locked\n"
        code, said = run("axle.toml", "--overwrite")
        assert code == 2
        assert f"process {other.pid} on " in said
        assert "started 2" in said
        assert {path.name for path in out.iterdir()} == {LOCK}
        other.kill()
    assert run("axle.toml")[0] == 0  # the lock of a dead process holds nobody up
    assert {path.name for path in out.iterdir()} == {"map.nc", MARK}


def test_a_thread_enters_twice_and_another_one_is_refused(tmp_path):
    refused = []

    def enter() -> None:
        try:
            with locked_folder(tmp_path):
                pass
        except ParameterError as error:
            refused.append(str(error))

    with locked_folder(tmp_path), locked_folder(tmp_path / "x" / ".."):
        other = threading.Thread(target=enter)
        other.start()
        other.join()
    assert "no other run writes to" in refused[0]
    enter()
    assert len(refused) == 1
    assert list(tmp_path.iterdir()) == []
