"""A command that runs another command when it is done."""

import pytest
import typer
from typer.testing import CliRunner

from gearlube.cli.next_command import run_next


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
