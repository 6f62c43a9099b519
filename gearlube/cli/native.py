"""The command `gearlube native`."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube_core.errors import ParameterError


def native(
    program: Annotated[
        list[str] | None,
        typer.Argument(
            help="Program and its arguments. Default: print the settings for a shell script.",
            metavar="[PROGRAM [ARGUMENTS]...]",
        ),
    ] = None,
) -> None:
    """Run a program that is not written in Python so that it can load the FMUs."""
    from fmu_src.native_host import native_environment, shell_lines

    with exit_on_error():
        if not program:
            typer.echo("\n".join(shell_lines()))
            return
        environment = native_environment(os.environ)
        found = shutil.which(program[0])
        if found is None:
            raise ParameterError(
                f"The program must be on PATH, or be given with its path, got {program[0]}."
            )
        if sys.platform != "win32":
            os.execve(found, program, environment)
        raise typer.Exit(subprocess.run([found, *program[1:]], env=environment).returncode)
