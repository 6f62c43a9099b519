"""The table of commands: a study is a folder and a line, and is imported when it is used."""

import errno
import os
import subprocess
import sys

import pytest
import typer
from typer.testing import CliRunner

from gearlube.cli.exit_codes import FAILED, exit_on_error
from gearlube.command import COMMANDS, LazyCommand, command_line
from gearlube_core.errors import FileError
from gearlube_core.storage.atomic_file import write_text
from tests.helpers.each import each

STUDY = '''
import typer

from gearlube.cli.exit_codes import exit_on_error


def spring(stiffness: float = 2.0, force: float = 4.0) -> None:
    """Stretch a spring."""
    from gearlube_core.checks import check_positive

    with exit_on_error():
        check_positive("--stiffness", stiffness, "N/m")
        typer.echo(f"{force / stiffness:g} m")
'''
HEAVY = ("numpy", "scipy", "numba", "xarray", "dask", "pandas", "matplotlib", "fmpy", "casadi")


@pytest.fixture
def app(tmp_path, monkeypatch):
    """The command `gearlube` with a study that stands outside the package."""
    folder = tmp_path / "spring_study"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "command.py").write_text(STUDY)
    monkeypatch.syspath_prepend(str(tmp_path))
    for module in ("spring_study", "spring_study.command"):
        sys.modules.pop(module, None)
    line = LazyCommand(name="spring", target="spring_study.command:spring", summary="Hooke's law.")
    return command_line([*COMMANDS, line])


def test_a_study_needs_one_folder_and_one_line(app):
    result = CliRunner().invoke(app, ["spring", "--force", "5"])
    assert result.exit_code == 0
    assert result.output.strip() == "2.5 m"


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.ENOSPC, "The disk is full at runs/a. Free some space, then run the same command"),
        (errno.EACCES, "The file system refused at runs/a: permission denied. Check path and"),
    ],
)
def test_errors_of_the_file_system_say_what_to_do(number, words, caplog):
    with pytest.raises(typer.Exit) as ended, exit_on_error():
        raise OSError(number, os.strerror(number), "runs/a")
    assert ended.value.exit_code == FAILED
    assert words in caplog.text


def test_a_reader_that_stops_is_no_error_of_the_file_system(caplog):
    with pytest.raises(BrokenPipeError), exit_on_error():
        raise BrokenPipeError(32, "Broken pipe")
    assert caplog.text == ""


def test_a_file_for_a_folder_that_is_not_there_names_the_folder(tmp_path):
    with pytest.raises(FileError, match=rf"a\.toml must be .* got {tmp_path / 'none'}\. Make"):
        write_text("", tmp_path / "none" / "a.toml")


def test_its_errors_have_the_exit_code_of_a_bad_argument(app, caplog):
    assert CliRunner().invoke(app, ["spring", "--stiffness", "-1"]).exit_code == 2
    assert "--stiffness" in caplog.text


def test_the_list_of_commands_shows_the_summary_and_imports_no_study(app):
    result = CliRunner().invoke(app, ["--help"])
    assert result.exit_code == 0
    assert "Hooke's law." in result.output
    assert "spring_study" not in sys.modules


@each("command", [entry.name for entry in COMMANDS])
def test_every_line_of_the_table_leads_to_a_command(command):
    result = CliRunner().invoke(command_line(COMMANDS), [command, "--help"])
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize("arguments", [["--help"], ["sweep", "--help"], ["build-fmu", "--help"]])
def test_help_imports_nothing_heavy(arguments):
    code = (
        "import sys; from gearlube.command import app\n"
        f"try: app({arguments!r})\nexcept SystemExit: pass\n"
        f"print('loaded:', *(m for m in {HEAVY!r} if m in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1].strip() == "loaded:"


def test_a_mistyped_command_brings_the_name_that_is_near(app):
    result = CliRunner().invoke(app, ["swep"])
    assert result.exit_code == 2
    assert "Did you mean 'sweep'?" in result.output
