"""The command `gearlube native`."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube_core.errors import GearLubeError, ParameterError


def shared_python() -> Path:
    """Return the shared library of this Python (Linux).

    Raises
    ------
    GearLubeError
        When this Python comes without one.
    """
    version = f"{sys.version_info.major}.{sys.version_info.minor}{sys.abiflags}"
    name = f"libpython{version}.so.1.0"
    stated = sysconfig.get_config_var("LIBDIR") or ""
    # A Python that was moved after it was built still states where it was meant to be.
    folders = [Path(sys.base_prefix) / "lib", Path(stated)]
    multiarch = sysconfig.get_config_var("MULTIARCH") or ""
    folders += [folder / multiarch for folder in folders]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    raise GearLubeError(
        f"A program that is not Python needs {name} to run the FMUs, not found in "
        f"{', '.join(map(str, dict.fromkeys(folders)))}. Install it (Debian and Ubuntu: "
        f"apt install libpython{version}), or make the environment with a Python that has it."
    )


def additions() -> dict[str, list[str]]:
    """Return the entries to put in front of each search path.

    Returns
    -------
    dict of list of str
        By name of the environment variable. On Linux the wrapper finds Python's symbols in
        LD_PRELOAD, and Python finds its environment by the first python3 on PATH. On Windows the
        wrapper's library asks for python3.dll, which PATH leads to; there Python finds no
        environment, so PYTHONPATH names its folders.

    Raises
    ------
    GearLubeError
        When this Python cannot be preloaded.
    """
    if sys.platform == "win32":
        base = Path(sys.base_prefix)
        own = [p for p in sys.path if p and Path(p).is_dir() and base not in Path(p).parents]
        return {"PATH": [str(base)], "PYTHONPATH": [p for p in own if Path(p) != base]}
    library = str(shared_python())
    if " " in library or ":" in library:
        raise GearLubeError(
            f"LD_PRELOAD cannot hold a path with a space or a colon, got {library}. "
            "Move that Python, or link to its folder from elsewhere."
        )
    return {"LD_PRELOAD": [library], "PATH": [str(Path(sys.executable).parent)]}


def native_environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the environment `base` with `additions` in front."""
    return dict(base) | {
        name: os.pathsep.join(values + ([base[name]] if base.get(name) else []))
        for name, values in additions().items()
    }


def shell_lines() -> list[str]:
    """Return `additions` as lines of a shell script, on Windows of a batch file."""
    if sys.platform == "win32":
        return [
            f'set "{name}={os.pathsep.join([*values, f"%{name}%"])}"'
            for name, values in additions().items()
        ]
    return [
        f"export {name}={shlex.quote(':'.join(values))}${{{name}:+:${name}}}"
        for name, values in additions().items()
    ]


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
