"""Every option of every command, wrong in every way: told what is wrong, and nothing written."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from fmu_src.build import axle_definition
from gearlube import command
from gearlube.cli import results_folder
from gearlube_core.errors import GearLubeError

REACHED = 77  # exit code of a run that would begin to compute
# where computing begins: what is wrong has to be said before
SOLVERS = (
    "gearlube.studies.contact.run.analyse_contact",
    "gearlube.studies.design.run.design_pair",
    "gearlube.studies.resonance.run.study_resonance",
    "gearlube.studies.helical.run._solved",
    "gearlube.studies.films.run_steady.solve_line",
    "gearlube.studies.films.run_steady.solve_thermal_line",
    "gearlube.studies.films.run_steady.solve_point_contact",
    "gearlube.studies.films.run_steady.solve_thermal_point",
    "gearlube.studies.films.run_steady.solve_helical_line",
    "gearlube.studies.films.run_march.march_helical_cycle",
    "gearlube.studies.films.hypoid.flank.dynamic_drive",
    "gearlube.studies.films.hypoid.flank.static_drive",
    "gearlube.studies.bearing.run.bearing_loss",
    "gearlube.variation.run.BlockStore.made",
    "gearlube.studies.loss_map.run.axle_losses",
    "gearlube.studies.drive_cycle.run.losses_along",
    "gearlube.studies.films.rough.files.solve_point_contact",
    "gearlube.studies.films.rough.run.FilmMarch",
    "gearlube.studies.roughness.results.write_results",
    "gearlube_core.rough_patch.table.flow_factors",
    "fmu_src.build._build",
)
COMMANDS = (
    ("sweep",),
    ("build-fmu",),
    ("contact",),
    ("design",),
    ("bearing",),
    ("map",),
    ("cycle",),
    ("resonance",),
    ("helical",),
    ("ehl", "line"),
    ("ehl", "point"),
    ("ehl", "helical"),
    ("ehl", "hypoid"),
    ("ehl", "rough"),
    ("roughness", "make"),
    ("roughness", "stand-in"),
    ("roughness", "flow-factors"),
    ("vary", "map"),
    ("vary", "bearing"),
    ("ehl", "compare"),
)
# without which a command is refused for that reason alone, or makes large patches first
NEEDED = {
    ("roughness", "flow-factors"): ("--seeds=1", "--points=64"),
    ("roughness", "make"): ("--rq-um=0.4",),
    ("roughness", "stand-in"): ("A",),
    ("vary", "map"): ("--vary", "bearing.preload=2000,3000"),
    ("vary", "bearing"): ("--vary", "load.axial=1000:4000", "--design", "lhs:4"),
}
NUMBERS = ("nan", "inf", "-inf", "-1e308", "1e308", "-1", "0", "1,5", "1e999", "0x10")
TEXTS = ("", "text", "no such thing", "a\nb", "no_file.toml", "../..", "1:2:3:4", "5:1", "\u20ac")
WRONG = (*NUMBERS, *TEXTS)
# these only ask, or name things that are not input
HARMLESS = {
    "help",
    "out",
    "quick",
    "example",
    "overwrite",
    "export",
    "newtonian",
    "no_march",
    "scatter",
    "keys",
}


load = command.LazyCommand.load
commands: dict[int, Any] = {}


def load_once(lazy: command.LazyCommand) -> Any:
    """Return the command; typer would read its options in every call."""
    if id(lazy) not in commands:
        commands[id(lazy)] = load(lazy)
    return commands[id(lazy)]


@pytest.fixture(autouse=True)
def nothing_computes(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(command.LazyCommand, "load", load_once)
    # in a process of its own, which would compile
    monkeypatch.setattr(
        "gearlube.studies.sweep.run._modes_aside", lambda *_, **_to_build: lambda: None
    )
    # a folder of the user that is in the way must stay as it is
    (tmp_path / "notes.txt").write_text("mine")

    def reached(*_arguments: Any, **_named: Any) -> None:
        raise typer.Exit(REACHED)

    def built(mesh_table: Path | None, *, axle: str | None, **_report: Any) -> None:
        axle_definition(mesh_table, axle)
        reached()

    for name in SOLVERS:
        monkeypatch.setattr(name, reached)
    # checks of the gear file alone, which no option changes
    monkeypatch.setattr("gearlube.studies.contact.findings.gear_file_warnings", lambda file: [])
    monkeypatch.setattr("fmu_src.build.cached_hypoid_axle", built)


@pytest.fixture
def run(caplog) -> Callable[..., tuple[int, str]]:
    def invoke(*arguments: str) -> tuple[int, str]:
        caplog.clear()
        with caplog.at_level(logging.WARNING):
            result = CliRunner().invoke(command.app, list(arguments))
        said = result.output + caplog.text
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise AssertionError(f"{arguments} end in {result.exception!r}") from result.exception
        return result.exit_code, said

    return invoke


def options_of(words: tuple[str, ...]) -> Iterator[str]:
    """Flags of the options that take a value; empty for an argument."""
    group: Any = typer.main.get_command(command.app)
    for word in words:  # a word after the command is an argument
        group = group.get_command(None, word) if hasattr(group, "get_command") else group
    for parameter in group.params:
        if parameter.name not in HARMLESS:
            yield parameter.opts[0] if parameter.param_type_name == "option" else ""


def check_wrong_values(words, run, folder, every):
    """Try every `every`-th wrong value on each option, for each option others."""
    wrong = (*WRONG, str(folder / "notes.txt"), str(folder))
    refused = 0
    for number, flag in enumerate(options_of(words)):
        for value in wrong[number % every :: every]:
            given = [f"{flag}={value}"] if flag else ["--", value]
            needed = NEEDED.get(words, ()) if flag else ()
            code, said = run(*words, "--out", "results", *needed, *given)
            if code == REACHED:
                assert value not in ("text", "nan", "inf", "-inf", "1e308", "1e999"), (flag, value)
            else:
                assert code in (1, 2), (flag, value, code, said)
                assert len(said) > 30, (flag, value, said)
                refused += 1
            left = sorted(path.name for path in folder.iterdir())
            assert left == ["notes.txt"], (flag, value, left)
    assert refused > 5 / every


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_a_wrong_value_is_refused_with_a_reason_and_nothing_is_left(words, run, tmp_path):
    check_wrong_values(words, run, tmp_path, 13)


@pytest.mark.slow
@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_every_wrong_value_is_refused_with_a_reason(words, run, tmp_path):
    check_wrong_values(words, run, tmp_path, 1)


@pytest.mark.slow
@pytest.mark.parametrize("words", COMMANDS[:-1], ids=" ".join)
def test_a_folder_that_cannot_be_written_is_refused_in_plain_words(words, run, tmp_path):
    for out in ("notes.txt", "notes.txt/deeper", "/proc/nothing/here"):
        code, said = run(*words, *NEEDED.get(words, ()), "--out", out)
        assert code == 2
        assert f"--out must be a folder that can be written, got {out}" in said.replace("\n", " ")
        assert "Errno" not in said
    assert (tmp_path / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize("words", [w for w in COMMANDS if w[-1] not in ("build-fmu", "compare")])
def test_a_folder_of_another_study_or_version_is_not_written_into(words, run, tmp_path):
    folder = tmp_path / "results"
    folder.mkdir()
    mark = folder / results_folder.MARK
    mark.write_text('{"study": "ehl gears", "gearlube_version": "0.0.1"}')
    code, said = run(*words, *NEEDED.get(words, ()), "--out", "results")
    assert code == 2
    assert "holds results of `gearlube ehl gears`" in said
    mark.write_text(json.dumps({"study": " ".join(words), "gearlube_version": "0.0.1"}))
    code, said = run(*words, *NEEDED.get(words, ()), "--out", "results")
    assert code == 2
    assert "holds results of gearlube 0.0.1" in said
    code, _ = run(*words, *NEEDED.get(words, ()), "--out", "results", "--overwrite")
    assert code == REACHED
    code, _ = run(*words, *NEEDED.get(words, ()), "--out", "results")  # now it is ours
    assert code == REACHED


def test_results_without_a_mark_are_not_mixed_with_new_ones(run, tmp_path):
    folder = tmp_path / "results"
    folder.mkdir()
    (folder / "summary.csv").write_text("theirs")
    code, said = run("ehl", "line", "--out", "results")
    assert code == 2
    assert "where summary.csv would be mixed with new results" in said
    assert [path.name for path in folder.iterdir()] == ["summary.csv"]


def test_a_folder_with_a_damaged_mark_is_of_an_unknown_study(run, tmp_path):
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / results_folder.MARK).write_text("[]")
    code, said = run("sweep", "--out", "results")
    assert code == 2
    assert "an unknown study" in said


def test_a_run_that_fails_leaves_what_it_had_written(tmp_path):
    def write_half() -> None:
        with results_folder.results_folder(tmp_path / "a" / "b", "sweep"):
            (tmp_path / "a" / "b" / "half.nc").write_text("half")
            raise GearLubeError("no")

    with pytest.raises(GearLubeError):
        write_half()
    assert {p.name for p in (tmp_path / "a" / "b").iterdir()} == {"half.nc", results_folder.MARK}


@pytest.mark.parametrize("words", [*COMMANDS, (), ("ehl",), ("native",)], ids=" ".join)
def test_help_is_plain_text(words, run):
    code, said = run(*words, "--help")
    assert code == 0
    frame = "─│╭╮╰╯…┌┐└┘"
    assert {letter for letter in said if ord(letter) > 127} <= set(frame)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("sweep", "--oil-temperature", "-10"), "within 0 to 150 degC, got -10 degC"),
        (("sweep", "--oil-temperature", "155"), "within 0 to 150 degC, got 155 degC"),
        (("helical", "--oil-temperature", "155"), "within 0 to 150 degC, got 155 degC"),
        (("resonance", "--oil-temperature", "-1"), "degC, got -1 degC"),
        (("sweep", "--oil", "olive"), "must be one of mohammadpour_2015, karagiannis_2012"),
        (("sweep", "--preload", "0"), "--preload must be within 1 to 100000 N, got 0 N"),
        (("sweep", "--speeds", "301"), "--speeds must be within 1 to 300 km/h, got 301 km/h"),
        (("sweep", "--equations", "wrong"), "equations must be one of consistent, as_printed"),
        (("ehl", "helical", "--march", "10:5"), "must be above the first, got 10 and 5"),
        (("ehl", "helical", "--march", "7:7"), "must be above the first, got 7 and 7"),
    ],
)
def test_the_reason_names_value_and_limit_in_the_unit_of_the_option(run, arguments, reason):
    code, said = run(*arguments)
    assert code == 2
    assert reason in said


@pytest.mark.parametrize(
    "words", [("resonance", "--torque"), ("ehl", "hypoid", "--torque")], ids=" ".join
)
def test_a_torque_beyond_the_mesh_table_is_named_and_far_beyond_refused(run, words):
    code, said = run(*words, "390")
    assert (code, "N.m" in said) == (REACHED, False)
    code, said = run(*words, "450")
    assert code == REACHED
    assert "450 N.m" in said
    assert "400 N.m" in said
    code, said = run(*words, "601")
    assert code == 2
    assert "got 601 N.m" in said


def test_speed_limits_are_those_of_the_library(run):
    from gearlube.studies.sweep.settings import SPEED_RANGE

    low, high = SPEED_RANGE
    assert run("sweep", "--speeds", f"{low:g}", f"{high:g}")[0] == REACHED


# commands that write no folder of results
SHOWING = (("axle", "show"), ("oil", "show"), ("oil", "fit"))


@pytest.mark.slow
@pytest.mark.parametrize("words", SHOWING, ids=" ".join)
def test_what_shows_or_fits_refuses_every_wrong_value_with_a_reason(words, run, tmp_path):
    measured = tmp_path / "measured.csv"
    measured.write_text("slide_roll_ratio,traction_coefficient\n0.1,0.05\n")
    refused = 0
    for flag in options_of(words):
        for value in (*WRONG, str(tmp_path / "notes.txt"), str(tmp_path)):
            given = [f"{flag}={value}"] if flag else ["--", value]
            if flag and words == ("oil", "fit"):
                given = [str(measured), *given]
            code, said = run(*words, *given)
            if code != 0:
                assert code in (1, 2), (flag, value, code, said)
                assert len(said) > 30, (flag, value, said)
                refused += 1
            left = sorted(path.name for path in tmp_path.iterdir())
            assert left == ["measured.csv", "notes.txt"], (flag, value, left)
    assert refused > 5
